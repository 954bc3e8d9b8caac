// Recent_samples.h: each vertex gets its own sample, whichever vertices were requested before.
#include "polynomial_fields.h"

#include <CGAL/Bspline_shell_3/Certificate/Second_order_bounds_3.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Recent_samples.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <random>
#include <vector>

namespace test_Recent_samples {
namespace BS = CGAL::Bspline_shells;

TEST_CASE("Recent samples: each vertex gets its own sample, whichever vertices were requested before")
{
  typedef BS::Second_order_bounds_3<Field> Bounds;
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  const auto field = uniform_field(squared_distance);
  const Bounds bounds(field, BS::Constant_threshold(0.36), BS::Constant_threshold(0.64));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.9, 0.9);
  std::vector<Point_3> points;
  for(int n = 0; n < 1000; ++n) points.push_back(Point_3(coordinate(random), coordinate(random), coordinate(random)));
  BS::internal::Recent_samples<Bounds> samples(bounds);
  for(std::size_t most : { std::size_t(3), points.size() })
    for(int n = 0; n < 3000; ++n) {
      const std::size_t v = random() % most;
      const auto found = samples(v, points[v]), expected = bounds.sample(points[v]);
      REQUIRE(found.point == expected.point);
      REQUIRE(found.cell == expected.cell);
      REQUIRE(found.above == expected.above);
      REQUIRE(found.below == expected.below);
      REQUIRE(found.gradient == expected.gradient);
    }
}
} // namespace test_Recent_samples
