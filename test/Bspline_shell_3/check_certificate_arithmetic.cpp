// check_certificate/interval.h: intervals contain the exact results for all numbers of their operands, even where
// rounding to nearest would exclude them. check_certificate/polynomials.h: so do coefficients and ranges of
// polynomials.
#include "interval.h"
#include "polynomials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

bool contains(const Interval& i, const Rational& r)
{
  return Rational(i.lo) <= r && r <= Rational(i.hi);
}

// Returns intervals of all signs and very different sizes; some are single numbers.
std::vector<Interval> intervals()
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60);
  std::vector<Interval> result;
  for(int n = 0; n < 60; ++n) {
    const double a = std::ldexp(number(random), exponent(random)),
                 b = n % 3 == 0 ? a : std::ldexp(number(random), exponent(random));
    result.emplace_back((std::min)(a, b), (std::max)(a, b));
  }
  result.emplace_back(-0.1, 0.1);
  result.emplace_back(0.);
  return result;
}

typedef std::array<Rational, 3> Point;

// Returns the weights of the four coefficients along an axis, or those of the derivative.
std::array<Rational, 4> weights(const Rational& t, bool derived)
{
  const Rational s = 1 - t;
  if(derived) return { -3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t };
  return { s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t };
}

// Returns the value of the lower ends of coefficients. If `derived` is less than three, it is the derivative along that
// axis.
Rational value(const Coefficients& b, const Point& t, int derived = 3)
{
  std::array<std::array<Rational, 4>, 3> w;
  for(int a = 0; a < 3; ++a) w[a] = weights(t[a], a == derived);
  Rational sum = 0;
  for(int n = 0; n < 64; ++n) sum += Rational(b[n].lo) * w[0][n % 4] * w[1][n / 4 % 4] * w[2][n / 16];
  return sum;
}

bool encloses(const Coefficients& b, const Point& t, const Rational& exact)
{
  // Weights are not negative in the cube, so the ends of coefficients give the ends of values.
  std::array<std::array<Rational, 4>, 3> w;
  for(int a = 0; a < 3; ++a) w[a] = weights(t[a], false);
  Rational low = 0, high = 0;
  for(int n = 0; n < 64; ++n) {
    const Rational weight = w[0][n % 4] * w[1][n / 4 % 4] * w[2][n / 16];
    low += Rational(b[n].lo) * weight;
    high += Rational(b[n].hi) * weight;
  }
  return low <= exact && exact <= high && high - low <= Rational(1e-12);
}

Coefficients random_coefficients(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> number(0.5, 1.5);
  Coefficients b;
  for(Interval& i : b) i = Interval(number(random));
  return b;
}

Point random_point(std::mt19937_64& random)
{
  std::uniform_int_distribution<int> number(0, 16);
  return { Rational(number(random)) / 16, Rational(number(random)) / 16, Rational(number(random)) / 16 };
}

} // namespace

TEST_CASE("Intervals of the checker: sums, differences, products and quotients contain the exact results")
{
  std::size_t wrong_sums = 0, wrong_differences = 0, wrong_products = 0, wrong_quotients = 0;
  for(const Interval& i : intervals())
    for(const Interval& j : intervals())
      for(double x : { i.lo, i.hi })
        for(double y : { j.lo, j.hi }) {
          wrong_sums += !contains(i + j, Rational(x) + Rational(y));
          wrong_differences += !contains(i - j, Rational(x) - Rational(y));
          wrong_products += !contains(i * j, Rational(x) * Rational(y));
          if(y > 0) wrong_quotients += !contains(i / y, Rational(x) / Rational(y));
        }
  CHECK(wrong_sums == 0);
  CHECK(wrong_differences == 0);
  CHECK(wrong_products == 0);
  CHECK(wrong_quotients == 0);
}

TEST_CASE("Intervals of the checker: results are no wider than rounding requires")
{
  const Interval i(1, 2), j(-3, 5);
  CHECK((i + j).lo == down(-2.));
  CHECK((i + j).hi == up(7.));
  CHECK((i - j).lo == down(-4.));
  CHECK((i - j).hi == up(5.));
  CHECK((i * j).lo == down(-6.));
  CHECK((i * j).hi == up(10.));
}

TEST_CASE("Intervals of the checker: a hull contains all its intervals, and a rational number lies in its enclosure")
{
  const Interval h = hull(std::vector<Interval>{ { 0, 1 }, { -2, -1 }, { 3, 4 } });
  CHECK(h.lo == -2);
  CHECK(h.hi == 4);
  std::size_t wrong = 0;
  for(int p = -20; p <= 20; ++p)
    for(int q = 1; q <= 20; ++q) {
      const Rational r = Rational(p) / q;
      const Interval i = enclose(r);
      wrong += !contains(i, r) || i.hi > up(up(up(i.lo)));
    }
  CHECK(wrong == 0);
}

TEST_CASE("Intervals of the checker: the arithmetic of this machine meets their requirements")
{
  CHECK(usable_arithmetic());
}

TEST_CASE("Polynomials of the checker: the range on a triangle contains all values, and is narrow on small triangles")
{
  std::mt19937_64 random(2);
  std::size_t wrong = 0, wide = 0;
  for(int n = 0; n < 30; ++n) {
    const Coefficients b = random_coefficients(random);
    const std::array<Point, 3> corner = { random_point(random), random_point(random), random_point(random) };
    const Rational size = n % 2 == 0 ? Rational(1) : Rational(1) / 1024;
    const auto at = [&](int i, int a) { return Rational(corner[0][a] + (corner[i][a] - corner[0][a]) * size); };
    Triangle triangle;
    for(int i = 0; i < 3; ++i)
      for(int a = 0; a < 3; ++a) triangle[i][a] = Interval(at(i, a).convert_to<double>());
    const Interval range = range_on_triangle(b, triangle);
    Rational low = value(b, { at(0, 0), at(0, 1), at(0, 2) }), high = low;
    for(int i = 0; i <= 6; ++i)
      for(int j = 0; i + j <= 6; ++j) {
        Point p;
        for(int a = 0; a < 3; ++a) p[a] = (i * at(1, a) + j * at(2, a) + (6 - i - j) * at(0, a)) / 6;
        const Rational v = value(b, p);
        wrong += !contains(range, v);
        low = (std::min)(low, v);
        high = (std::max)(high, v);
      }
    if(size < 1) wide += Rational(range.hi) - Rational(range.lo) > 2 * (high - low) + Rational(1e-9);
  }
  CHECK(wrong == 0);
  CHECK(wide == 0);
}

TEST_CASE("Polynomials of the checker: halves, differences, derivatives and half offsets agree with the polynomial")
{
  std::mt19937_64 random(3);
  std::size_t wrong_halves = 0, wrong_differences = 0, wrong_derivatives = 0, wrong_offsets = 0;
  for(int n = 0; n < 30; ++n) {
    const Coefficients b = random_coefficients(random), c = random_coefficients(random);
    const Point t = random_point(random);
    for(int axis = 0; axis < 3; ++axis)
      for(bool upper : { false, true }) {
        Coefficients half = b;
        halve(half, axis, upper);
        Point p = t;
        p[axis] = (p[axis] + (upper ? 1 : 0)) / 2;
        wrong_halves += !encloses(half, t, value(b, p));
      }
    wrong_differences += !encloses(difference(b, c), t, value(b, t) - value(c, t));
    const std::array<Interval, 3> d = { Interval(0.5), Interval(-1.25), Interval(2) };
    Rational along = 0;
    for(int axis = 0; axis < 3; ++axis) along += Rational(d[axis].lo) * value(b, t, axis);
    wrong_derivatives += !encloses(derivative(b, d), t, along);
    Rational offset = 0;
    for(int axis = 0; axis < 3; ++axis) offset += (t[axis] - Rational(d[axis].lo)) * value(b, t, axis) / 2;
    wrong_offsets += !encloses(along_half_offset(b, d), t, offset);
  }
  CHECK(wrong_halves == 0);
  CHECK(wrong_differences == 0);
  CHECK(wrong_derivatives == 0);
  CHECK(wrong_offsets == 0);
}

TEST_CASE("Polynomials of the checker: adjacent cells agree on their common face, and a linear spline is linear")
{
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  double grid[4][4][5];
  for(auto& plane : grid)
    for(auto& row : plane)
      for(double& x : row) x = number(random);
  const auto coefficients = [&](int first, bool linear) {
    Coefficients c;
    for(int n = 0; n < 64; ++n)
      c[n] = Interval(linear ? double(n % 4 + first) : grid[n / 16][n / 4 % 4][n % 4 + first]);
    return bernstein(c);
  };
  const Coefficients left = coefficients(0, false), right = coefficients(1, false);
  std::size_t wrong = 0;
  for(int n = 0; n < 64; n += 4) wrong += left[n + 3].lo > right[n].hi || right[n].lo > left[n + 3].hi;
  // Points of the spline are corners of cells; the first cell begins at the second one.
  const Coefficients line = coefficients(0, true);
  for(int n = 0; n < 64; ++n) wrong += !contains(line[n], Rational(1) + Rational(n % 4) / 3);
  CHECK(wrong == 0);
}
