// move_to_level.h: points are moved along the gradient to the mean level of two others.
#include "polynomial_fields.h"

#include <CGAL/Bspline_shell_3/Editing/internal/move_to_level.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <optional>

namespace test_move_to_level {
namespace {

namespace internal = CGAL::Bspline_shells::internal;
typedef Field::Point_3 Point_3;

} // namespace

TEST_CASE("Mean level: a point is moved along the gradient to the mean level of two others, at any scale of the field")
{
  for(int exponent : { -900, -535, 0, 524, 900 }) {
    CAPTURE(exponent);
    Polynomial scaled = squared_distance;
    for(Monomial& m : scaled) m.factor *= std::ldexp(1., exponent);
    const Field field = uniform_field(scaled);
    const Point_3 p(0.3, 0.4, 0.5);
    const std::optional<Point_3> moved = internal::move_to_mean_level(field, p, Point_3(0.6, 0, 0),
                                                                      Point_3(0, 0, -0.8));
    REQUIRE(moved);
    CHECK((*moved - CGAL::ORIGIN).squared_length() == Approx((0.36 + 0.64) / 2).epsilon(1e-4));
    CHECK(std::sqrt(CGAL::cross_product(*moved - CGAL::ORIGIN, p - CGAL::ORIGIN).squared_length()) < 1e-12);
  }
}

TEST_CASE("Mean level: no point is returned if one of the points is outside the domain")
{
  const Field field = uniform_field(squared_distance);
  const Point_3 a(0.6, 0, 0), b(0, 0, -0.8), outside(0, 0, 50);
  CHECK(internal::move_to_mean_level(field, a, a, b));
  CHECK_FALSE(internal::move_to_mean_level(field, outside, a, b));
  CHECK_FALSE(internal::move_to_mean_level(field, a, outside, b));
  CHECK_FALSE(internal::move_to_mean_level(field, a, a, outside));
}

TEST_CASE("Mean level: no point is returned if the gradient is zero")
{
  const Field field = uniform_field(squared_distance);
  CHECK_FALSE(internal::move_to_mean_level(field, Point_3(0, 0, 0), Point_3(0.6, 0, 0), Point_3(0, 0, -0.8)));
}
} // namespace test_move_to_level
