#include "test_meshes.h"

#include <Commands/patch_bound.h>

#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace test_patch_bound {

typedef Eigen::Vector3d Vector_3;
typedef std::array<Vector_3, 3> Triangle;

constexpr double rounding = 1e-14;

// A grid of 2 n^2 triangles over the square with the given half side, bent and displaced
template <typename Height>
Mesh grid(std::size_t n, double half, const Height& height)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(std::size_t j = 0; j <= n; ++j)
    for(std::size_t i = 0; i <= n; ++i) {
      const double x = half * (2. * double(i) / double(n) - 1), y = half * (2. * double(j) / double(n) - 1);
      v.push_back(mesh.add_vertex(Point_3(x, y, height(x, y))));
    }
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < n; ++i) {
      const std::size_t k = j * (n + 1) + i;
      mesh.add_face(v[k], v[k + 1], v[k + n + 2]);
      mesh.add_face(v[k], v[k + n + 2], v[k + n + 1]);
    }
  return mesh;
}

double bound(const Triangle& triangle, const Mesh& mesh, double within)
{
  const CGAL::Bspline_shells::Projection_target_3<Mesh> target(mesh, mesh.points());
  const Vector_3 center = Tool::incenter(triangle);
  const auto [facet, weights] = target.closest({ center.x(), center.y(), center.z() });
  const auto p = target.point(facet, weights);
  return Tool::patch_bound(triangle, mesh, target.face_of(facet), (Vector_3(p.data()) - center).norm(), within,
                           rounding);
}

const Triangle triangle = { Vector_3(-0.8, -0.7, 0), Vector_3(0.9, -0.6, 0), Vector_3(0.1, 0.8, 0) };

TEST_CASE("patch_bound: a plane above a triangle has its distance")
{
  for(double z : { 0., 0.01, -0.02 }) {
    const Mesh mesh = grid(20, 1, [&](double, double) { return z; });
    const double b = bound(triangle, mesh, 0.03);
    CHECK(b >= std::abs(z));
    CHECK(b <= 0.03);
  }
}

TEST_CASE("patch_bound: the orientation of the triangle does not matter")
{
  const Mesh mesh = grid(20, 1, [](double x, double y) { return 0.01 * std::sin(3 * x + y); });
  CHECK(bound(triangle, mesh, 0.03) == bound({ triangle[1], triangle[0], triangle[2] }, mesh, 0.03));
}

TEST_CASE("patch_bound: bounds are not less than distances of points of the triangle")
{
  const Mesh mesh = grid(30, 1, [](double x, double y) { return 0.02 * std::sin(5 * x) * std::cos(4 * y); });
  const double b = bound(triangle, mesh, 0.025);
  CHECK(b <= 0.025);
  const CGAL::Bspline_shells::Projection_target_3<Mesh> target(mesh, mesh.points());
  constexpr int steps = 50;
  for(int i = 0; i <= steps; ++i)
    for(int j = 0; i + j <= steps; ++j) {
      const double s = double(i) / steps, t = double(j) / steps;
      const Vector_3 p = s * triangle[0] + t * triangle[1] + (1 - s - t) * triangle[2];
      const auto [facet, weights] = target.closest({ p.x(), p.y(), p.z() });
      CHECK((Vector_3(target.point(facet, weights).data()) - p).norm() <= b);
    }
}

TEST_CASE("patch_bound: there is no bound if the surface is too far, has a hole, ends, or folds over the triangle")
{
  const auto flat = [](double, double) { return 0.; };
  CHECK(std::isinf(bound(triangle, grid(20, 1, [](double x, double) { return x > 0.3 ? 0.1 : 0.; }), 0.05)));
  CHECK(std::isinf(bound(triangle, grid(20, 0.5, flat), 0.05)));
  Mesh hole = grid(20, 1, flat);
  const auto far_from_center = std::find_if(hole.faces().begin(), hole.faces().end(), [&](Mesh::Face_index f) {
    const auto& p = hole.point(hole.target(hole.halfedge(f)));
    return std::abs(p.x() - 0.5) < 0.06 && std::abs(p.y() + 0.4) < 0.06;
  });
  CGAL::Euler::remove_face(hole.halfedge(*far_from_center), hole);
  CHECK(std::isinf(bound(triangle, hole, 0.05)));
  Mesh fold = grid(20, 1, flat);
  for(auto v : fold.vertices()) {
    const auto& p = fold.point(v);
    if(p.x() > 0.3) fold.point(v) = Point_3(0.8 - p.x(), p.y(), 0.001);
  }
  CHECK(std::isinf(bound(triangle, fold, 0.05)));
}

TEST_CASE("patch_bound: a surface that covers all but the rim of a triangle bounds its distance")
{
  const Mesh mesh = grid(40, 1, [](double, double) { return 0.; });
  const Triangle large = { Vector_3(-1.005, -1.005, 0), Vector_3(1.005, -1.005, 0), Vector_3(-1.005, 1.005, 0) };
  CHECK(bound(large, mesh, 0.2) <= 0.2);
  CHECK(std::isinf(bound(large, mesh, 0.01)));
}

} // namespace test_patch_bound
