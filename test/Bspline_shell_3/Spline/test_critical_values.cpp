// critical_values.h: bounds at critical points hold in exact arithmetic for every function within the radius. They are
// sharp for quadratic functions, whatever their axes.
#include "exact_spline.h"
#include "test_random.h"

#include <CGAL/Bspline_shell_3/Spline/critical_values.h>

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace test_critical_values {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Critical_center;
using BS::Enclosed_tricubic;
using BS::Level_range;
typedef std::array<double, 3> Point;

// Returns a function at the ends of the radius.
Exact_coefficients random_member(CGAL::Random& random, const Enclosed_tricubic& f)
{
  Exact_coefficients b = exact_coefficients(f.coefficients);
  for(Rational& x : b) x += Rational(f.radius) * (random.get_bool() ? 1 : -1);
  return b;
}

// Returns half the slope at t in the direction from c to t.
Rational half_slope(const Exact_coefficients& b, const Point& c, const Exact_point& t)
{
  Rational slope(0);
  for(int a = 0; a < 3; ++a) slope += (t[a] - Rational(c[a])) * bernstein_value(b, t, { a == 0, a == 1, a == 2 });
  return slope / 2;
}

// Returns the coefficients of u^T H u / 2 + constant with u = x - center; those of t^2 are 0, 0, 1/3, 1.
Enclosed_tricubic quadratic(const double (&H)[3][3], const Point& center, double constant)
{
  Enclosed_tricubic f;
  for(int n = 0; n < 64; ++n) {
    const int i[3] = { n % 4, n / 4 % 4, n / 16 };
    double u[3], square[3];
    for(int a = 0; a < 3; ++a) {
      u[a] = i[a] / 3. - center[a];
      square[a] = (i[a] < 2 ? 0 : i[a] == 2 ? 1. / 3 : 1) - 2 * center[a] * i[a] / 3. + center[a] * center[a];
    }
    f.coefficients[n] = constant;
    for(int a = 0; a < 3; ++a)
      for(int b = 0; b < 3; ++b) f.coefficients[n] += H[a][b] / 2 * (a == b ? square[a] : u[a] * u[b]);
  }
  return f;
}

} // namespace

TEST_CASE("Critical values: g minus half the slope of f towards the center is enclosed exactly at every point")
{
  CGAL::Random random(1);
  int close = 0;
  for(int n = 0; n < 400; ++n) {
    const double radius = n % 3 == 0 ? 0 : std::ldexp(1., -random.get_int(10, 60));
    const Enclosed_tricubic f = random_function(random, n % 2 ? 0 : 60, radius),
                            g = random_function(random, n % 4 < 2 ? 0 : 60, radius / 2);
    const double far = n % 5 == 0 ? 1e3 : 2;
    const Point c = random_point(random, -far, far);
    const Enclosed_tricubic found = BS::values_at_critical_points(g, f, c);
    const Exact_coefficients in_f = random_member(random, f), in_g = random_member(random, g);
    const Exact_point t = exact(random_point(random, 0, 1));
    const Rational truth = bernstein_value(in_g, t) - half_slope(in_f, c, t),
                   center = bernstein_value(exact_coefficients(found.coefficients), t);
    CHECK(CGAL::abs(truth - center) <= Rational(found.radius));
    CHECK(truth >= Rational(found.range().min));
    CHECK(truth <= Rational(found.range().max));
    close += found.radius < 1e-12 * far;
  }
  CHECK(close > 100); // the radius covers roundings only
}

TEST_CASE("Critical values: rounding errors of canceling terms are covered, even if little else is left")
{
  // The function is close to x - y; the center is far away on the diagonal.
  CGAL::Random random(5);
  for(int n = 0; n < 200; ++n) {
    Enclosed_tricubic f, none = {};
    for(int m = 0; m < 64; ++m) f.coefficients[m] = (m % 4 - m / 4 % 4) / 3. + 1e-9 * random_number(random, -1, 1);
    f.radius = 0;
    const double far = random_number(random, 1e3, 1e6);
    const Point c = { far, far, 0.5 };
    const Enclosed_tricubic found = BS::values_at_critical_points(none, f, c);
    for(int corner = 0; corner < 8; ++corner) {
      const Exact_point t = { Rational(corner & 1), Rational(corner >> 1 & 1), Rational(corner >> 2) };
      const Rational truth = -half_slope(exact_coefficients(f.coefficients), c, t);
      const int at = 3 * (corner & 1) + 12 * (corner >> 1 & 1) + 48 * (corner >> 2);
      CHECK(CGAL::abs(truth - Rational(found.coefficients[at])) <= Rational(found.radius));
    }
    CHECK(found.radius < 1e-13 * far);
  }
}

TEST_CASE("Critical values: a quadratic function has one value about its center, and the center is found")
{
  CGAL::Random random(2);
  for(int n = 0; n < 200; ++n) {
    double H[3][3];
    for(int a = 0; a < 3; ++a)
      for(int b = 0; b <= a; ++b) H[a][b] = H[b][a] = random.get_double(-1, 1) + (a == b ? (a == 1 ? -2.5 : 2.5) : 0);
    const Point c = random_point(random, 0, 1);
    const Enclosed_tricubic f = quadratic(H, c, 0.7);
    const Level_range values = BS::values_at_critical_points(f, f, c).range();
    CHECK(values.min > 0.7 - 1e-13);
    CHECK(values.max < 0.7 + 1e-13);
    CHECK(values.min < 0.7);
    CHECK(values.max > 0.7);
    // The center is damped: it is off by a few percent of its distance from the middle.
    const Critical_center found = BS::critical_center(f);
    for(int a = 0; a < 3; ++a) CHECK(std::abs(found.point[a] - c[a]) < 0.15);
    CHECK(std::abs(found.value - 0.7) < 0.05);
    const Level_range close = BS::critical_values(f), all = f.range();
    CHECK(close.min <= 0.7);
    CHECK(close.max >= 0.7);
    CHECK(close.max - close.min < 0.3 * (all.max - all.min));
  }
}

TEST_CASE("Critical values: the values across a wall of any direction are the values in its middle")
{
  // f = (n . (x - m))^2 + 0.3 has critical points on a whole plane, where its value is 0.3, and no others.
  CGAL::Random random(3);
  for(int k = 0; k < 200; ++k) {
    Point n = random_point(random, -1, 1);
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if(length < 0.3) continue;
    double H[3][3];
    for(int a = 0; a < 3; ++a)
      for(int b = 0; b < 3; ++b) H[a][b] = 2 * n[a] * n[b] / (length * length);
    const Point m = random_point(random, 0, 1);
    const Enclosed_tricubic f = quadratic(H, m, 0.3);
    const Critical_center center = BS::critical_center(f);
    CHECK(std::abs(center.value - 0.3) < 0.01);
    CHECK(center.slope < 0.02);
    const Level_range values = BS::critical_values(f);
    CHECK(values.min <= 0.3);
    CHECK(values.max >= 0.3);
    CHECK(values.max - values.min < 0.02);
  }
}

TEST_CASE("Critical values: with a third derivative, one bound across a wall is nearly exact")
{
  // z^2 - 0.2 z^3 - 0.1 on [0, 1]: critical points in the box are at z = 0, with the value -0.1
  Enclosed_tricubic f;
  for(int n = 0; n < 64; ++n) f.coefficients[n] = -0.1 + (n / 16 == 2 ? 1. / 3 : n / 16 == 3 ? 0.8 : 0);
  const Level_range values = BS::critical_values(f);
  CHECK(values.max >= -0.1);
  CHECK(values.max < -0.09);
  const Level_range about_middle = BS::values_at_critical_points(f, f, { 0.5, 0.5, 0 }).range();
  CHECK(about_middle.max > -0.001);
}

TEST_CASE("Critical values: the slope along a wall is returned")
{
  // z^2 + s x has no critical point. The remaining slope is s, relative to a curvature of 2.
  for(double s : { 0.1, 0.4, 1. }) {
    Enclosed_tricubic f;
    for(int n = 0; n < 64; ++n) f.coefficients[n] = s * (n % 4) / 3. + (n / 16 < 2 ? 0 : n / 16 == 2 ? 1. / 3 : 1);
    CHECK(BS::critical_center(f).slope == Approx(s / 2).epsilon(0.05));
  }
}

TEST_CASE("Critical values: coefficients that are not finite, or overflow, yield no bound")
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto says_nothing = [](const Level_range& r) { return !(r.max < 1e308) && !(r.min > -1e308); };
  CGAL::Random random(4);
  const Enclosed_tricubic f = random_function(random, 0, 0);
  for(double bad : { nan, infinity, -infinity, 1e308, -1e308 })
    for(int a = 0; a < 3; ++a) {
      Point c = { 0.5, 0.5, 0.5 };
      c[a] = bad;
      Enclosed_tricubic steep = f;
      for(double& x : steep.coefficients) x *= 1e3;
      CHECK(says_nothing(BS::values_at_critical_points(steep, steep, c).range()));
    }
  Enclosed_tricubic unknown = f;
  unknown.radius = infinity;
  CHECK(says_nothing(BS::values_at_critical_points(f, unknown, { 0.5, 0.5, 0.5 }).range()));
  CHECK(says_nothing(BS::values_at_critical_points(unknown, f, { 0.5, 0.5, 0.5 }).range()));
  // Differences overflow.
  Enclosed_tricubic large = f;
  for(std::size_t n = 0; n < 64; ++n) large.coefficients[n] = n % 2 ? 1.7e308 : -1.7e308;
  CHECK(says_nothing(BS::values_at_critical_points(f, large, { 0.5, 0.5, 0.5 }).range()));
}

TEST_CASE("Critical values: scaling a function by a power of two does not move its center")
{
  CGAL::Random random(5);
  for(int n = 0; n < 20; ++n) {
    const Enclosed_tricubic f = random_function(random, 3, 0);
    const Critical_center center = BS::critical_center(f);
    for(int exponent : { -900, -535, 524, 1000 }) {
      Enclosed_tricubic scaled = f;
      for(double& x : scaled.coefficients) x = std::ldexp(x, exponent);
      const Critical_center of_scaled = BS::critical_center(scaled);
      CHECK(of_scaled.point == center.point);
      CHECK(of_scaled.value == std::ldexp(center.value, exponent));
      CHECK(of_scaled.slope == center.slope);
    }
  }
}
} // namespace test_critical_values
