// is_positive_on_triangle.h: thresholds in closed form, least values of random forms, and values that are not finite.
#include <CGAL/Bspline_shell_3/Spline/is_positive_on_triangle.h>

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace test_is_positive_on_triangle {
namespace {

typedef std::array<double, 3> Numbers;
using CGAL::Bspline_shells::is_positive_on_triangle;

// Returns the least value of sum l_i g_i - sum l_i l_j q_ij / 2. It is attained at a corner, or where the derivative
// along an edge or in the triangle is zero.
double least_value(const Numbers& g, const Numbers& q)
{
  double least = std::numeric_limits<double>::infinity();
  const auto visit = [&](double l0, double l1, double l2) {
    if(!(l0 >= 0 && l1 >= 0 && l2 >= 0)) return;
    least = (std::min)(least,
                       l0 * g[0] + l1 * g[1] + l2 * g[2] - (l1 * l2 * q[0] + l0 * l2 * q[1] + l0 * l1 * q[2]) / 2);
  };
  visit(1, 0, 0);
  visit(0, 1, 0);
  visit(0, 0, 1);
  // the extremum of a linear function minus t (1-t) q / 2
  const auto on_edge = [](double from, double to, double q) { return 0.5 - (to - from) / q; };
  const double t0 = on_edge(g[1], g[2], q[0]), t1 = on_edge(g[2], g[0], q[1]), t2 = on_edge(g[0], g[1], q[2]);
  visit(0, 1 - t0, t0);
  visit(t1, 0, 1 - t1);
  visit(1 - t2, t2, 0);
  // the zero of both derivatives in the first two coordinates
  const double xx = q[1], yy = q[0], xy = (q[0] + q[1] - q[2]) / 2, x = g[2] - g[0] + q[1] / 2,
               y = g[2] - g[1] + q[0] / 2;
  const double determinant = xx * yy - xy * xy, u = (x * yy - y * xy) / determinant,
               v = (y * xx - x * xy) / determinant;
  visit(u, v, 1 - u - v);
  return least;
}

} // namespace

TEST_CASE("Positive on a triangle: the limits for equal corners, and for a single edge, agree with closed forms")
{
  for(double margin : { 1e-3, 1e-9, 1e-12 }) {
    CHECK(is_positive_on_triangle({ 2, 2, 2 }, { 12 - margin, 12 - margin, 12 - margin }));
    CHECK_FALSE(is_positive_on_triangle({ 2, 2, 2 }, { 12 + margin, 12 + margin, 12 + margin }));
    for(std::size_t v = 0; v < 3; ++v) {
      Numbers q = { -1, -1, -1 };
      q[v] = 16 - margin;
      CHECK(is_positive_on_triangle({ 2, 2, 2 }, q));
      q[v] = 16 + margin;
      CHECK_FALSE(is_positive_on_triangle({ 2, 2, 2 }, q));
      // The bound on an edge is 2 (sqrt(1) + sqrt(9))^2 = 32.
      Numbers g = { 1, 1, 1 };
      g[(v + 1) % 3] = 9;
      q[v] = 32 - margin;
      CHECK(is_positive_on_triangle(g, q));
      q[v] = 32 + margin;
      CHECK_FALSE(is_positive_on_triangle(g, q));
    }
  }
  // One corner is low, with a steep rise from it.
  CHECK(is_positive_on_triangle({ 1e-9, 1, 1 }, { 0, 1.9, 1.9 }));
  CHECK_FALSE(is_positive_on_triangle({ 1e-9, 1, 1 }, { 0, 2.1, 1.9 }));
}

TEST_CASE(
  "Positive on a triangle: the answer agrees with the sign of the least value, up to rounding, at any magnitude")
{
  CGAL::Random random(7);
  int positive = 0, negative = 0, in_the_middle = 0;
  for(int n = 0; n < 200000; ++n) {
    Numbers g, q;
    for(double& x : g) x = n % 2 ? random.get_double(0, 1) : std::pow(10, random.get_double(-12, 0));
    for(std::size_t v = 0; v < 3; ++v)
      q[v] = n % 3
               ? random.get_double(-1, 8)
               : 2 * random.get_double(0.8, 1.2) * std::pow(std::sqrt(g[(v + 1) % 3]) + std::sqrt(g[(v + 2) % 3]), 2);
    const double least = least_value(g, q),
                 size = *std::max_element(g.begin(), g.end()) + *std::max_element(q.begin(), q.end());
    const bool is_positive = is_positive_on_triangle(g, q);
    if(std::abs(least) < 1e-13 * size) continue;
    const double at_border = (std::min)({ least_value(g, { q[0], -1e9, -1e9 }), least_value(g, { -1e9, q[1], -1e9 }),
                                          least_value(g, { -1e9, -1e9, q[2] }) });
    in_the_middle += least < 0 && at_border > 0;
    if(is_positive) CHECK(least > 0);
    else CHECK(least < 0);
    ++(least > 0 ? positive : negative);
  }
  CHECK(positive > 10000);
  CHECK(negative > 10000);
  CHECK(in_the_middle > 500);
}

TEST_CASE("Positive on a triangle: NaN and corners that are not positive are rejected, and any magnitude is compared")
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for(std::size_t v = 0; v < 3; ++v)
    for(double wrong : { nan, 0., -0., -1., -inf }) {
      Numbers g = { 1, 1, 1 }, q = { 1, 1, 1 };
      g[v] = wrong;
      CHECK_FALSE(is_positive_on_triangle(g, q));
      if(!std::isnan(wrong)) continue;
      g[v] = 1;
      q[v] = wrong;
      CHECK_FALSE(is_positive_on_triangle(g, q));
    }
  CHECK_FALSE(is_positive_on_triangle({ 1, 1, 1 }, { 1, inf, 1 }));
  CHECK(is_positive_on_triangle({ inf, inf, inf }, { 1, 1, 1 }));
  CHECK(is_positive_on_triangle({ 1e-300, 1e-300, 1e-300 }, { 5e-300, 5e-300, 5e-300 }));
  CHECK_FALSE(is_positive_on_triangle({ 1e-300, 1e-300, 1e-300 }, { 7e-300, 7e-300, 7e-300 }));
  CHECK(is_positive_on_triangle({ 1e300, 1e300, 1e300 }, { 5e300, 5e300, 5e300 }));
  CHECK_FALSE(is_positive_on_triangle({ 1e300, 1e300, 1e300 }, { 7e300, 7e300, 7e300 }));
}

TEST_CASE("Positive on a triangle: scaling by a power of two does not change the answer, up to the last bit")
{
  // Answers change within rounding errors of the limit for a single edge, 2 (sqrt(g0) + sqrt(g1))^2.
  CGAL::Random random(8);
  int positive = 0, negative = 0;
  for(int n = 0; n < 20000; ++n) {
    const Numbers g = { random.get_double(0.1, 1), random.get_double(0.1, 1), 1 };
    const double limit = 2 * std::pow(std::sqrt(g[0]) + std::sqrt(g[1]), 2);
    const Numbers q = { -1, -1, limit * (1 - random.get_double(0, 1e-13)) };
    const bool is_positive = is_positive_on_triangle(g, q);
    for(int exponent : { -901, -900, -1, 1, 2, 900, 901 }) {
      Numbers scaled_g = g, scaled_q = q;
      for(double& x : scaled_g) x = std::ldexp(x, exponent);
      for(double& x : scaled_q) x = std::ldexp(x, exponent);
      CHECK(is_positive_on_triangle(scaled_g, scaled_q) == is_positive);
    }
    ++(is_positive ? positive : negative);
  }
  CHECK(positive > 1000);
  CHECK(negative > 1000);
}
} // namespace test_is_positive_on_triangle
