// Rotations and pseudoinverses of Tangent_field.h, also in degenerate cases.
#include <CGAL/Bspline_shell_3/Transfer/internal/Tangent_field.h>
#include "test_random.h"

#include <catch2/catch.hpp>

#include <CGAL/Random.h>

#include <Eigen/Core>

#include <cmath>

namespace test_Tangent_field {
namespace {

namespace BS = CGAL::Bspline_shells;

Eigen::Vector3d random_vector(CGAL::Random& random)
{
  return BS::internal::eigen_vector(random_point(random, -1, 1));
}

} // namespace

TEST_CASE("Tangent field: the rotation takes one direction to the other, and turns about their common normal only")
{
  CGAL::Random random(1);
  for(int n = 0; n < 100; ++n) {
    const Eigen::Vector3d from = random_vector(random), to = random_vector(random), v = random_vector(random);
    const Eigen::Vector3d axis = from.cross(to);
    CHECK((BS::internal::rotated(from.normalized(), from, to) - to.normalized()).norm() < 1e-14);
    CHECK((BS::internal::rotated(axis, from, to) - axis).norm() < 1e-14);
    CHECK(std::abs(BS::internal::rotated(v, from, to).norm() - v.norm()) < 1e-14);
  }
}

TEST_CASE("Tangent field: equal normals change no vector, and opposite normals keep tangent vectors tangent")
{
  CGAL::Random random(2);
  for(int n = 0; n < 100; ++n) {
    const Eigen::Vector3d normal = random_vector(random), tangent = normal.cross(random_vector(random));
    CHECK((BS::internal::rotated(tangent, normal, 3 * normal) - tangent).norm() < 1e-14);
    const Eigen::Vector3d opposite = BS::internal::rotated(tangent, normal, -normal);
    CHECK(std::abs(opposite.dot(normal)) < 1e-14);
    CHECK(std::abs(opposite.norm() - tangent.norm()) < 1e-14);
  }
}

TEST_CASE("Tangent field: pseudoinverses of matrices of rank two, one and zero")
{
  CGAL::Random random(3);
  for(int n = 0; n < 100; ++n) {
    const Eigen::Vector2d u = random_vector(random).head<2>(), v = random_vector(random).head<2>();
    const Eigen::Matrix2d line = u * u.transpose(), plane = line + v * v.transpose();
    CHECK((BS::internal::pseudoinverse(line) * u - u / u.squaredNorm()).norm() < 1e-12 / u.norm());
    const Eigen::Matrix2d product = plane * BS::internal::pseudoinverse(plane) * plane;
    CHECK((product - plane).norm() < 1e-10 * plane.norm());
  }
  CHECK(BS::internal::pseudoinverse(Eigen::Matrix2d::Zero()) == Eigen::Matrix2d::Zero());
}

} // namespace test_Tangent_field
