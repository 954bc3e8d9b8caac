// monotone_direction.h: a function that is reported as increasing along a direction does so, as steeply as reported.
#include <CGAL/Bspline_shell_3/Spline/monotone_direction.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace test_monotone_direction {
namespace {

namespace BS = CGAL::Bspline_shells;

// Returns slopes . x in Bernstein coefficients, with a radius.
BS::Enclosed_tricubic linear(const std::array<double, 3>& slopes, double radius)
{
  BS::Enclosed_tricubic f;
  for(int n = 0; n < 64; ++n)
    f.coefficients[n] = (slopes[0] * (n % 4) + slopes[1] * (n / 4 % 4) + slopes[2] * (n / 16)) / 3;
  f.radius = radius;
  return f;
}

// Returns whether the function increases by more than `steepest` per unit of length along the computed direction.
bool is_monotone(const BS::Enclosed_tricubic& f, double steepest)
{
  std::array<double, 3> direction;
  return BS::internal::is_monotone(f, steepest, direction);
}

} // namespace

TEST_CASE(
  "Monotone direction: a linear function is monotone if the radius is less than half the coefficient difference")
{
  // A difference of two coefficients, 1/3 apart, is known up to twice their radius.
  for(int axis = 0; axis < 3; ++axis)
    for(double sign : { -1., 1. }) {
      std::array<double, 3> slopes = { 0, 0, 0 };
      slopes[axis] = sign;
      CHECK(is_monotone(linear(slopes, 0.16), 0));
      CHECK_FALSE(is_monotone(linear(slopes, 0.17), 0));
    }
}

TEST_CASE("Monotone direction: a function is monotone only if it is steeper than requested")
{
  CHECK(is_monotone(linear({ 1, 0, 0 }, 0.05), 0.69));
  CHECK_FALSE(is_monotone(linear({ 1, 0, 0 }, 0.05), 0.71));
  CHECK(is_monotone(linear({ 3, 4, 0 }, 0), 4.99));
  CHECK_FALSE(is_monotone(linear({ 3, 4, 0 }, 0), 5.01));
  // Within the radius, a function has the slope 0.7 sqrt(3) = 1.21.
  CHECK(is_monotone(linear({ 1, 1, 1 }, 0.05), 1.2));
  CHECK_FALSE(is_monotone(linear({ 1, 1, 1 }, 0.05), 1.22));
  // The comparison is strict.
  CHECK_FALSE(is_monotone(linear({ 1, 0, 0 }, 0), 1));
}

TEST_CASE("Monotone direction: a constant function is not monotone, nor is one with a critical point")
{
  CHECK_FALSE(is_monotone(linear({ 0, 0, 0 }, 0), 0));
  BS::Enclosed_tricubic saddle = linear({ 0, 0, 0 }, 0);
  for(int n = 0; n < 64; ++n) saddle.coefficients[n] = (n % 4 - 1.5) * (n / 4 % 4 - 1.5);
  CHECK_FALSE(is_monotone(saddle, 0));
}

TEST_CASE("Monotone direction: bounds on lengths are never below the length, and hardly above it, at any magnitude")
{
  CGAL::Random random(7);
  std::size_t too_small = 0, too_large = 0;
  for(int n = 0; n < 20000; ++n) {
    std::array<double, 3> v;
    for(double& x : v) x = std::ldexp(random.get_double(-1, 1), random.get_int(-4, 5));
    CGAL::Exact_rational squared = 0;
    for(double x : v) squared += CGAL::Exact_rational(x) * CGAL::Exact_rational(x);
    const CGAL::Exact_rational bound = BS::internal::length_bound(v);
    too_small += bound * bound < squared;
    too_large += bound * bound > squared * CGAL::Exact_rational(1 + 1e-14);
  }
  CHECK(too_small == 0);
  CHECK(too_large == 0);
}
} // namespace test_monotone_direction
