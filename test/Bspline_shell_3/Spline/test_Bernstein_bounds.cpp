// Bernstein_bounds.h: every function within the radius is enclosed, in exact arithmetic. This includes functions at the
// ends of the radius, where all roundings and displacements add up.
#include "exact_spline.h"
#include "test_random.h"

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Bernstein_bounds {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Enclosed_tricubic;
using BS::Level_range;
typedef std::array<double, 3> Point;

constexpr double eps = std::numeric_limits<double>::epsilon();

// Returns the function whose coefficients are moved to the ends of the radius, by signs.
template <typename Sign>
Exact_coefficients moved(const Enclosed_tricubic& f, const Sign& sign)
{
  Exact_coefficients b = exact_coefficients(f.coefficients);
  for(int n = 0; n < 64; ++n) b[n] += Rational(f.radius) * sign(n);
  return b;
}

bool contains(const Level_range& r, const Rational& x)
{
  return Rational(r.min) <= x && x <= Rational(r.max);
}

Enclosed_tricubic constant(double c, double radius = 0)
{
  Enclosed_tricubic f;
  f.coefficients.fill(c);
  f.radius = radius;
  return f;
}

Exact_point combined(const std::vector<Point>& corners, const std::vector<Rational>& weights)
{
  Exact_point p = { 0, 0, 0 };
  for(std::size_t v = 0; v < corners.size(); ++v)
    for(int a = 0; a < 3; ++a) p[a] += weights[v] * Rational(corners[v][a]);
  return p;
}

// Returns the index of the n-th coefficient along an axis.
int along(int n, int axis)
{
  return axis == 0 ? n % 4 : axis == 1 ? n / 4 % 4 : n / 16;
}

// Returns the derivative along an axis, per unit of the cell, elevated to degree three.
Exact_coefficients derivative(const Exact_coefficients& b, int axis)
{
  const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  Exact_coefficients d;
  for(int n = 0; n < 64; ++n) {
    const int i = along(n, axis);
    const Rational* row = &b[n - i * stride];
    // The coefficients of degree two are 3 (b1 - b0), .... After elevation, the i-th one is i/3 of the previous one
    // plus 1 - i/3 of the one at i.
    const Rational before = i > 0 ? Rational(row[i * stride] - row[(i - 1) * stride]) : Rational(0),
                   after = i < 3 ? Rational(row[(i + 1) * stride] - row[i * stride]) : Rational(0);
    d[n] = i * before + (3 - i) * after;
  }
  return d;
}

} // namespace

TEST_CASE("Bernstein bounds: the largest size is found, whichever coefficient has it")
{
  for(std::size_t n = 0; n < 64; ++n) {
    std::array<double, 64> b;
    b.fill(0.5);
    b[n] = n % 2 == 0 ? 2 : -2;
    CHECK(BS::internal::largest_size(b) == 2);
  }
}

TEST_CASE("Bernstein bounds: the range of the coefficients encloses the functions at both ends of the radius")
{
  const Enclosed_tricubic f = constant(1, 0.25);
  CHECK(f.range().min <= 0.75);
  CHECK(f.range().max >= 1.25);
}

TEST_CASE("Bernstein bounds: the range towards a face, an edge or a vertex is the range of the coefficients there")
{
  CGAL::Random random(12);
  const Enclosed_tricubic f = random_function(random, 4, 0.125);
  for(int direction = 0; direction < 27; ++direction) {
    const std::array<int, 3> towards = { direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1 };
    Level_range there;
    for(int n = 0; n < 64; ++n) {
      bool is_there = true;
      for(int a = 0; a < 3; ++a) is_there = is_there && (towards[a] == 0 || along(n, a) == (towards[a] < 0 ? 0 : 3));
      if(is_there) there.include(f.coefficients[n]);
    }
    const Level_range r = f.range_towards(towards);
    CHECK(r.min == there.min - 0.125);
    CHECK(r.max == there.max + 0.125);
  }
  CHECK(f.range_towards({ 0, 0, 0 }).min == f.range().min);
}

TEST_CASE("Bernstein bounds: values at points, on segments and on triangles are enclosed, with all rounding errors")
{
  CGAL::Random random(1);
  for(int n = 0; n < 60; ++n) {
    const Enclosed_tricubic f = random_function(random, n % 3 * 20);
    const Exact_coefficients b = exact_coefficients(f.coefficients);
    const Point p = random_point(random), q = random_point(random), r = random_point(random);
    CHECK(contains(BS::enclose_at_point(f, p, 0), bernstein_value(b, exact(p))));
    const Level_range on_segment = BS::enclose_on_segment(f, { p, q }, 0),
                      on_triangle = BS::enclose_on_triangle(f, { p, q, r }, 0);
    for(int i = 0; i <= 3; ++i)
      for(int j = 0; i + j <= 3; ++j) {
        const Rational u = Rational(i) / 3, v = Rational(j) / 3;
        CHECK(contains(on_triangle, bernstein_value(b, combined({ p, q, r }, { u, v, 1 - u - v }))));
        if(i + j == 3) CHECK(contains(on_segment, bernstein_value(b, combined({ p, q }, { u, v }))));
      }
  }
  // The extrema are at a corner, so nothing hides the roundings there.
  for(int n = 0; n < 200; ++n) {
    Enclosed_tricubic f;
    for(int m = 0; m < 64; ++m)
      f.coefficients[m] = along(m, 0) + along(m, 1) + along(m, 2) + random_number(random, 1000, 1000.001);
    const Point p = random_point(random, 0, 0.3), q = random_point(random, 0.4, 0.6), r = random_point(random, 0.7, 1);
    const Rational lowest = bernstein_value(exact_coefficients(f.coefficients), exact(p)),
                   highest = bernstein_value(exact_coefficients(f.coefficients), exact(r));
    for(const Level_range& range :
        { BS::enclose_on_segment(f, { p, r }, 0), BS::enclose_on_triangle(f, { p, q, r }, 0) }) {
      CHECK(Rational(range.min) <= lowest);
      CHECK(Rational(range.max) >= highest);
    }
  }
}

TEST_CASE("Bernstein bounds: forms enclose the functions at both ends of the radius, even beyond the cell")
{
  const Enclosed_tricubic f = constant(1, 0.25);
  const std::array<Point, 3> t = { Point{ 0, 0, 0 }, Point{ 1, 0, 0.5 }, Point{ 0.25, 1, 1 } };
  for(const Level_range& r : { BS::enclose_at_point(f, t[0], 0), BS::enclose_on_segment(f, { t[0], t[1] }, 0),
                               BS::enclose_on_triangle(f, t, 0) }) {
    CHECK(r.min <= 0.75);
    CHECK(r.max >= 1.25);
  }
  // Beyond the cell, a polynomial may grow far more than its coefficients.
  for(const Point& t : { Point{ 2, 2, 2 }, Point{ 2, 0.5, 0.5 }, Point{ 0.5, -1, 0.5 }, Point{ 0.5, 0.5, 3 },
                         Point{ -0.5, 1.5, 0.5 } }) {
    Exact_coefficients weight;
    for(int n = 0; n < 64; ++n) {
      Exact_coefficients unit;
      unit.fill(Rational(0));
      unit[n] = 1;
      weight[n] = bernstein_value(unit, exact(t));
    }
    for(int sign : { 1, -1 }) {
      const Exact_coefficients b = moved(f, [&](int n) { return weight[n] > 0 ? sign : -sign; });
      const Rational value = bernstein_value(b, exact(t));
      CHECK(contains(BS::enclose_at_point(f, t, 0), value));
      CHECK(contains(BS::enclose_on_triangle(f, { t, t, t }, 0), value));
    }
  }
}

TEST_CASE("Bernstein bounds: displaced corners are enclosed, even if the function is steep along all axes")
{
  const double shift = std::ldexp(1., -40);
  // Only the coefficient at the corner is nonzero. The derivatives there are three along each axis.
  for(int corner : { 0, 3, 12, 48, 63 })
    for(double sign : { 1., -1. }) {
      Enclosed_tricubic f = constant(0);
      f.coefficients[corner] = sign;
      Point p;
      Exact_point q;
      for(int a = 0; a < 3; ++a) {
        p[a] = along(corner, a) == 0 ? 0 : 1;
        q[a] = Rational(p[a]) + (p[a] == 0 ? 1 : -1) * Rational(shift);
      }
      const Rational value = bernstein_value(exact_coefficients(f.coefficients), q);
      CHECK(contains(BS::enclose_at_point(f, p, shift), value));
      CHECK(contains(BS::enclose_on_triangle(f, { p, p, p }, shift), value));
    }
}

TEST_CASE("Bernstein bounds: an octant's radius covers the exact coefficients of all functions within the radius")
{
  CGAL::Random random(3);
  for(int n = 0; n < 40; ++n) {
    const Enclosed_tricubic f = random_function(random, n % 3 * 20, n % 2 ? 0 : std::ldexp(1., -n % 12));
    for(int octant = 0; octant < 8; ++octant) {
      const Enclosed_tricubic g = BS::restrict_to_octant(f, octant);
      for(int sign : { 1, -1 }) {
        // de Casteljau's algorithm, one axis after the other
        Exact_coefficients b = moved(f, [&](int) { return sign; });
        for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
          for(int m = 0; m < 64; ++m) {
            if(along(m, axis) != 0) continue;
            const Rational c[4] = { b[m], b[m + stride], b[m + 2 * stride], b[m + 3 * stride] };
            const Rational half[7] = { c[0],
                                       (c[0] + c[1]) / 2,
                                       (c[0] + 2 * c[1] + c[2]) / 4,
                                       (c[0] + 3 * c[1] + 3 * c[2] + c[3]) / 8,
                                       (c[1] + 2 * c[2] + c[3]) / 4,
                                       (c[2] + c[3]) / 2,
                                       c[3] };
            for(int i = 0; i < 4; ++i) b[m + i * stride] = half[i + ((octant >> axis) & 1 ? 3 : 0)];
          }
        for(int m = 0; m < 64; ++m)
          CHECK(CGAL::abs(Rational(b[m] - Rational(g.coefficients[m]))) <= Rational(g.radius));
      }
    }
  }
}

TEST_CASE("Bernstein bounds: a difference covers the differences of all functions within the radii")
{
  CGAL::Random random(4);
  for(int n = 0; n < 20; ++n)
    for(const std::array<double, 2>& radius :
        { std::array<double, 2>{ 0, 0 }, std::array<double, 2>{ 0.5, 0 }, std::array<double, 2>{ 0, 0.25 } }) {
      const Enclosed_tricubic f = random_function(random, 10, radius[0]), g = random_function(random, 10, radius[1]),
                              d = BS::difference(f, g);
      for(int sign : { 1, -1 }) {
        const Exact_coefficients a = moved(f, [&](int) { return sign; }), b = moved(g, [&](int) { return -sign; });
        for(int m = 0; m < 64; ++m)
          CHECK(CGAL::abs(Rational(a[m] - b[m] - Rational(d.coefficients[m]))) <= Rational(d.radius));
      }
    }
}

TEST_CASE("Bernstein bounds: a derivative covers the derivatives of all functions and directions within the radii")
{
  CGAL::Random random(5);
  for(int n = 0; n < 60; ++n) {
    const double radius = n % 3 == 1 ? 0.125 : 0, direction_radius = n % 3 == 2 ? 0.0625 : 0;
    Enclosed_tricubic f = random_function(random, n % 2 * 20, radius);
    if(n % 5 == 0) { // steep along one axis only, at one of its ends
      const int axis = n / 5 % 3, at = n / 15 % 2 * 3;
      for(int m = 0; m < 64; ++m) f.coefficients[m] = along(m, axis) == at ? 1 : 0;
    }
    Point d = random_point(random, -1, 1);
    if(n % 4 == 0) d = { 0, 0, 0 };
    if(n % 4 == 0 || n % 4 == 2) d[n % 3] = 1;
    const Enclosed_tricubic g = BS::enclosed_derivative(f, d, direction_radius);
    for(int sign : { 1, -1 })
      for(int axis = 0; axis < 3; ++axis) {
        const Exact_coefficients b = moved(f, [&](int m) { return along(m, axis) % 2 ? sign : -sign; });
        const std::array<Exact_coefficients, 3> slopes = { derivative(b, 0), derivative(b, 1), derivative(b, 2) };
        for(int m = 0; m < 64; ++m)
          for(int away : { 1, -1 }) {
            Rational exact_slope = 0;
            for(int a = 0; a < 3; ++a)
              exact_slope += slopes[a][m]
                             * (Rational(d[a]) + Rational(direction_radius) * (slopes[a][m] > 0 ? away : -away));
            CHECK(CGAL::abs(Rational(exact_slope - Rational(g.coefficients[m]))) <= Rational(g.radius));
          }
      }
  }
}

TEST_CASE("Bernstein bounds: values are enclosed, even if products underflow")
{
  const double least = std::numeric_limits<double>::denorm_min();
  CGAL::Random random(6);
  for(int n = 0; n < 40; ++n) {
    Enclosed_tricubic f;
    for(double& x : f.coefficients) x = random.get_int(-3, 4) * least;
    const Exact_coefficients b = exact_coefficients(f.coefficients);
    const Point p = random_point(random);
    CHECK(contains(BS::enclose_at_point(f, p, 0), bernstein_value(b, exact(p))));
    const Enclosed_tricubic half = BS::restrict_to_octant(f, 0);
    CHECK(CGAL::abs(Rational(half.coefficients[1] - (b[0] + b[1]) / 2)) <= Rational(half.radius));
    const std::array<Exact_coefficients, 3> slopes = { derivative(b, 0), derivative(b, 1), derivative(b, 2) };
    for(double d : { 0.3, 0.3e300 }) { // along a long direction, derivatives are not small
      const Enclosed_tricubic g = BS::enclosed_derivative(f, { d, d, d });
      for(int m = 0; m < 64; ++m)
        CHECK(
          CGAL::abs(Rational(Rational(d) * (slopes[0][m] + slopes[1][m] + slopes[2][m]) - Rational(g.coefficients[m])))
          <= Rational(g.radius));
    }
  }
}

TEST_CASE("Bernstein bounds: if a coefficient is not finite, or overflows on the way, bounds are infinite")
{
  constexpr double infinity = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
  const auto is_infinite = [](const Level_range& r) {
    return r.min == -std::numeric_limits<double>::infinity() && r.max == -r.min;
  };
  CGAL::Random random(14);
  const std::array<Point, 3> corners = { random_point(random), random_point(random), random_point(random) };
  for(double bad : { std::numeric_limits<double>::quiet_NaN(), infinity, -infinity })
    for(int n = 0; n < 64; ++n) {
      Enclosed_tricubic f = random_function(random, 4);
      f.coefficients[n] = bad;
      CHECK(is_infinite(f.range()));
      std::array<int, 3> towards, away;
      for(int a = 0; a < 3; ++a) {
        towards[a] = along(n, a) == 0 ? -1 : along(n, a) == 3 ? 1 : 0;
        away[a] = along(n, a) == 0 ? 1 : -1;
      }
      CHECK(is_infinite(f.range_towards(towards)));
      CHECK_FALSE(is_infinite(f.range_towards(away)));
      CHECK(is_infinite(BS::enclose_on_triangle(f, corners, 0)));
      CHECK(is_infinite(BS::enclose_on_segment(f, { corners[0], corners[1] }, 0)));
      CHECK(is_infinite(BS::enclose_at_point(f, corners[2], 0)));
      CHECK(is_infinite(BS::difference(f, constant(1)).range()));
      CHECK(is_infinite(BS::enclosed_derivative(f, { 1, 1, 1 }).range()));
    }
  for(double radius : { infinity, std::numeric_limits<double>::quiet_NaN() }) {
    CHECK(is_infinite(constant(1, radius).range()));
    CHECK(is_infinite(BS::enclose_at_point(constant(1, radius), corners[0], 0)));
  }
  // differences, and products with a direction
  Enclosed_tricubic steep = constant(-largest);
  for(int n = 0; n < 64; ++n)
    if(along(n, 0) > 1) steep.coefficients[n] = largest;
  CHECK(is_infinite(BS::enclosed_derivative(steep, { 1, 0, 0 }).range()));
  CHECK(is_infinite(BS::enclosed_derivative(random_function(random, 4), { largest, -largest, largest }).range()));
  CHECK(is_infinite(BS::difference(constant(largest), constant(-largest)).range()));
}

TEST_CASE(
  "Bernstein bounds: a field on a cell has the cell's radius, and differences from thresholds include both radii")
{
  typedef BS::Hierarchical_bspline_field_3<> Field;
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), 1);
  Field field(BS::Cell_complex_3(lattice, { BS::Lattice_key::encode(0, 0, 0) })), other = field;
  CGAL::Random random(7);
  Eigen::VectorXd x(64), y(64);
  for(int n = 0; n < 64; ++n) {
    x[n] = random.get_double(-1, 1);
    y[n] = random.get_double(2, 3);
  }
  field.set_coefficients(x);
  other.set_coefficients(y);
  const Enclosed_tricubic f = BS::enclosed_value(field.cell(0)), g = BS::enclosed_value(other.cell(0));
  CHECK(f.radius >= field.cell(0).error_radius());
  const BS::Spline_threshold<Field> threshold(other);
  const Enclosed_tricubic above = threshold.difference(f, 0), above_two = BS::Constant_threshold(2).difference(f, 0);
  const Exact_coefficients exact_f = field.bernstein_coefficients<Rational>(0),
                           exact_g = other.bernstein_coefficients<Rational>(0);
  for(int n = 0; n < 64; ++n) {
    CHECK(CGAL::abs(Rational(exact_f[n] - exact_g[n] - Rational(above.coefficients[n]))) <= Rational(above.radius));
    CHECK(CGAL::abs(Rational(exact_f[n] - 2 - Rational(above_two.coefficients[n]))) <= Rational(above_two.radius));
  }
  const Level_range range = threshold.range(0), two = BS::Constant_threshold(2).range(0);
  for(int n = 0; n < 64; ++n) CHECK(contains(range, exact_g[n]));
  CHECK(range.max - range.min < 1.1);
  CHECK(contains(two, 2));
  CHECK(two.max - two.min < 1e-12);
  CHECK(g.radius < 100 * eps);
}
} // namespace test_Bernstein_bounds
