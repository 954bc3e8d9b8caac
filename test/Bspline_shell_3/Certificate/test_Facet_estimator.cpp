// Facet_estimator.h: a facet with a clear estimate is proved in nearly all cases; a rejected facet never is.
#include "polynomial_fields.h"

#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Facet_estimator.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace test_Facet_estimator {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::internal::Facet_estimate;
using BS::Placement_verdict;
typedef BS::Second_order_bounds_3<Field> Bounds;
typedef BS::internal::Facet_estimator<Bounds> Estimator;
typedef BS::Shell_facet_oracle_3<Field> Oracle;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
typedef std::array<Point_3, 3> Triangle;

constexpr double pi = 3.141592653589793;

// Returns the shell between spheres of radii 0.7 and 0.8.
CGAL::Bspline_shell_3<Field> ball_shell()
{
  return shell_of(uniform_field(squared_distance), 0.49, 0.64);
}

Facet_estimate estimate(const Bounds& bounds, const Triangle& t)
{
  const auto normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  const std::array<Bounds::Sample, 3> corners = { { bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) } };
  return Estimator(bounds, { normal.x(), normal.y(), normal.z() })({ &corners[0], &corners[1], &corners[2] });
}

// Returns a triangle with corners near a point, between two spheres.
Triangle random_triangle(std::mt19937& random, double size)
{
  std::uniform_real_distribution<double> unit(-1, 1), radius(0.695, 0.805);
  const double x = unit(random), y = unit(random), z = unit(random);
  Triangle t;
  for(Point_3& p : t) {
    const double a = x + size * unit(random), b = y + size * unit(random), c = z + size * unit(random);
    const double scale = radius(random) / std::sqrt(a * a + b * b + c * c);
    p = Point_3(scale * a, scale * b, scale * c);
  }
  return t;
}

} // namespace

TEST_CASE("Facet estimates: for random triangles, clear estimates are proved, rejections are not, and few are doubtful")
{
  const auto shell = ball_shell();
  const Oracle oracle(shell);
  std::mt19937 random(1);
  std::array<std::size_t, 4> number = {};
  for(double size : { 0.05, 0.3, 1. })
    for(int n = 0; n < 3000; ++n) {
      const Triangle t = random_triangle(random, size);
      const Facet_estimate found = estimate(*oracle.bounds(), t);
      ++number[std::size_t(found)];
      const Placement_verdict proved = oracle(t[0], t[1], t[2]);
      if(found == Facet_estimate::CLEAR) CHECK(proved == Placement_verdict::ACCEPTED);
      if(found == Facet_estimate::LEAVES_SHELL || found == Facet_estimate::FACES_AWAY)
        CHECK(proved != Placement_verdict::ACCEPTED);
    }
  CHECK(number[std::size_t(Facet_estimate::CLEAR)] > 1000);
  CHECK(number[std::size_t(Facet_estimate::LEAVES_SHELL)] > 1000);
  CHECK(number[std::size_t(Facet_estimate::FACES_AWAY)] > 1000);
  CHECK(number[std::size_t(Facet_estimate::DOUBTFUL)] < 100);
}

TEST_CASE("Facet estimates: known edge midpoints are used, and correct ones do not change the estimate")
{
  const auto shell = ball_shell();
  const Oracle oracle(shell);
  const Bounds& bounds = *oracle.bounds();
  std::mt19937 random(3);
  std::array<std::size_t, 4> number = {};
  for(int n = 0; n < 1000; ++n) {
    const Triangle t = random_triangle(random, 0.1 * (1 + n % 8));
    const auto normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
    const std::array<Bounds::Sample, 3> corners = { { bounds.sample(t[0]), bounds.sample(t[1]), bounds.sample(t[2]) } };
    const auto with = [&](const Estimator::Samples& middles) {
      return Estimator(bounds, { normal.x(), normal.y(), normal.z() })({ &corners[0], &corners[1], &corners[2] },
                                                                       middles);
    };
    const Facet_estimate expected = with({});
    ++number[std::size_t(expected)];
    for(int v = 0; v < 3; ++v) {
      Bounds::Sample middle = bounds.sample_middle(corners[(v + 1) % 3], corners[(v + 2) % 3]);
      Estimator::Samples middles = {};
      middles[v] = &middle;
      CHECK(with(middles) == expected);
      middle.above = middle.below = -1;
      if(expected == Facet_estimate::CLEAR) CHECK(with(middles) == Facet_estimate::LEAVES_SHELL);
    }
  }
  CHECK(number[std::size_t(Facet_estimate::CLEAR)] > 100);
  CHECK(number[std::size_t(Facet_estimate::LEAVES_SHELL)] > 100);
}

TEST_CASE("Facet estimates: a facet that fails only away from corners and edge midpoints is not cleared")
{
  const auto ball = ball_shell();
  const Oracle oracle(ball);
  const double r = 0.79;
  const auto at = [&](double polar, double degrees) {
    return Point_3(r * std::sin(polar) * std::cos(degrees * pi / 180),
                   r * std::sin(polar) * std::sin(degrees * pi / 180), r * std::cos(polar));
  };
  // The distance of the triangle's plane from the center is r cos(polar); the middles of edges are farther away.
  const double polar = std::acos(0.699 / r);
  const Triangle t = { { at(polar, 0), at(polar, 120), at(polar, 240) } };
  for(int v = 0; v < 3; ++v) {
    const auto middle = CGAL::midpoint(t[v], t[(v + 1) % 3]);
    REQUIRE(CGAL::squared_distance(middle, Point_3(0, 0, 0)) > 0.49);
  }
  CHECK(estimate(*oracle.bounds(), t) != Facet_estimate::CLEAR);
  // The slope of horizontal facets is 2 x^2 - 1e-9.
  const auto shell = shell_of(uniform_field({ { -1e-9, { 0, 0, 1 } }, { 2, { 2, 0, 1 } } }), -5, 5);
  const Oracle of_slope(shell);
  CHECK(estimate(*of_slope.bounds(), { { Point_3(0.31, 0, 0.1), Point_3(-0.47, -0.4, 0.1), Point_3(0.83, -0.4, 0.1) } })
        != Facet_estimate::CLEAR);
}

TEST_CASE("Facet estimates: proving only doubtful facets accepts the same fans as proving all facets")
{
  const auto shell = ball_shell();
  const Oracle proving(shell), estimating(shell, BS::Facet_proofs::WHERE_DOUBTFUL);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> radius(0.7, 0.8), angle(0.2, 0.7);
  std::array<std::size_t, 2> number = {};
  for(int n = 0; n < 500; ++n) {
    std::vector<Point_3> link;
    for(int k = 0; k < 6; ++k) {
      const double r = radius(random), polar = angle(random), longitude = k * pi / 3;
      link.push_back(Point_3(r * std::sin(polar) * std::cos(longitude), r * std::sin(polar) * std::sin(longitude),
                             r * std::cos(polar)));
    }
    Oracle::Memory memory, other_memory;
    const Point_3 p(0, 0, radius(random));
    const bool is_accepted = proving(p, link, memory) == Placement_verdict::ACCEPTED;
    CHECK((estimating(p, link, other_memory) == Placement_verdict::ACCEPTED) == is_accepted);
    ++number[is_accepted];
  }
  CHECK(number[0] > 50);
  CHECK(number[1] > 50);
}
} // namespace test_Facet_estimator
