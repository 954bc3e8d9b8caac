// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_BOUNDS_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_BOUNDS_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_forms.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Encloses numbers that are each known to within an error. If a number or the error is not finite, the bounds are
// infinite: comparisons could pass over NaN. Four searches at a time: one would wait for each of its comparisons. The
// sum is finite only if all numbers are.
template <std::size_t n>
Level_range hull(const std::array<double, n>& b, double error)
{
  static_assert(n >= 4, "four numbers at a time");
  std::array<double, 4> least = { b[0], b[1], b[2], b[3] }, most = least, sum = least;
  const auto include = [&](std::size_t lane, double x) {
    least[lane] = (std::min)(least[lane], x);
    most[lane] = (std::max)(most[lane], x);
    sum[lane] += x;
  };
  std::size_t m = 4;
  for(; m + 4 <= n; m += 4)
    for(std::size_t lane = 0; lane < 4; ++lane) include(lane, b[m + lane]);
  for(; m < n; ++m) include(0, b[m]);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if(!(std::isfinite((sum[0] + sum[1]) + (sum[2] + sum[3])) && error < infinity)) return { -infinity, infinity };
  return { (std::min)((std::min)(least[0], least[1]), (std::min)(least[2], least[3])) - error,
           (std::max)((std::max)(most[0], most[1]), (std::max)(most[2], most[3])) + error };
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief 64 Bernstein coefficients over a cell, each known to within a radius: all that a bound needs to know of a
 * field, of its difference to a threshold, or of its derivative along a direction.
 *
 * Every bound in this header is rigorous for every function within the radius. It is computed in `double`s, and what
 * rounding can do is added by an error analysis. Single operations are taken to err by at most `eps`
 * = \f$2^{-52}\f$ relatively, which holds in every rounding mode, or by the least normal number, of which every radius
 * gets more than enough. An infinite radius stands for a function of which nothing is known. If a coefficient is not
 * finite, nothing is known either, and the bounds are infinite.
 */
struct Enclosed_tricubic
{
  std::array<double, 64> coefficients;
  double radius = 0;

  /// the range of the coefficients with their radius, which encloses the function on the cell
  Level_range range() const { return internal::hull(coefficients, radius); }

  /// the same on a face, an edge or a vertex of the cell
  /// \param direction from the cell's center to it: of minus one, zero and one
  Level_range range_towards(const std::array<int, 3>& direction) const
  {
    const auto first = [&](std::size_t a) { return direction[a] > 0 ? 3 : 0; };
    const auto last = [&](std::size_t a) { return direction[a] < 0 ? 0 : 3; };
    std::array<double, 64> there; // the first one several times, in the end
    there.fill(coefficients[std::size_t(16 * first(2) + 4 * first(1) + first(0))]);
    std::size_t size = 0;
    for(int k = first(2); k <= last(2); ++k)
      for(int j = first(1); j <= last(1); ++j)
        for(int i = first(0); i <= last(0); ++i) there[size++] = coefficients[std::size_t(16 * k + 4 * j + i)];
    return internal::hull(there, radius);
  }
};

namespace internal {

// The largest absolute value of those that are numbers. Four searches at a time: one would wait for each of its
// comparisons.
inline double largest_size(const std::array<double, 64>& b)
{
  std::array<double, 4> largest = {};
  for(std::size_t n = 0; n < 64; n += 4)
    for(std::size_t m = 0; m < 4; ++m) largest[m] = (std::max)(largest[m], std::abs(b[n + m]));
  return (std::max)((std::max)(largest[0], largest[1]), (std::max)(largest[2], largest[3]));
}

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr double underflow = 1024 * (std::numeric_limits<double>::min)();

// of coefficients that are differences, rounded, of others with these radii
inline double radius_of_difference(double f, double g, double largest_difference)
{
  return (1 + 4 * rounding) * (f + g + rounding * largest_difference + underflow);
}

// What rounding can do to a coefficient of a form of degree nine.
//
// With |t| + |1-t| <= s_a for the local coordinates t of the corners along axis a, the absolute weights of a polar form
// sum to at most S = (s_x s_y s_z)^3 (one, in the cell). Roundings on the way of one term:
//   weights: two differences, two products, two sums, the multiplicity, for each of three axes   21
//   contractions: a product and three sums each                                                   12
//   sums over the permutations of arguments: of up to ten terms, then of up to seven              15
//   the division                                                                                   1
// are 49, each eps of at most S times the largest coefficient. Corners displaced by `shift` cell units change the
// polynomial's polar form, which is of degree three per axis, by at most 9 S (max - min) shift.
struct Form_error
{
  double amplification = 1; // S
  double shift = 0;

  // for corners in the cell
  explicit Form_error(double shift) : Form_error(std::array<std::array<double, 3>, 0>(), shift) {}

  template <std::size_t n>
  Form_error(const std::array<std::array<double, 3>, n>& corners, double shift) : shift(shift)
  {
    for(int a = 0; a < 3; ++a) {
      double s = 1;
      for(const auto& t : corners) s = (std::max)(s, std::abs(t[a]) + std::abs(1 - t[a]));
      s *= 1 + 4 * rounding + 2 * shift;
      amplification *= s * s * s;
    }
  }

  double operator()(const Enclosed_tricubic& f) const
  {
    const Level_range all = hull(f.coefficients, 0);
    const double largest = (std::max)(std::abs(all.min), std::abs(all.max));
    // the factor covers the roundings of this very expression
    return (1 + 16 * rounding) * amplification
           * (f.radius + 52 * rounding * largest + 9 * (all.max - all.min) * shift + underflow);
  }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief encloses a function on a triangle; corners are in local coordinates of the cell, in it or near it, and each
 * may be off by `shift` per axis. Outside of the cell, the function is its polynomial, continued.
 */
inline Level_range enclose_on_triangle(const Enclosed_tricubic& f, const std::array<std::array<double, 3>, 3>& corners,
                                       double shift)
{
  return internal::hull(triangle_bernstein_form<double>(f.coefficients.data(), corners[0], corners[1], corners[2]),
                        internal::Form_error(corners, shift)(f));
}

/// \ingroup PkgBsplineShell3Spline
/// the same on a segment
inline Level_range enclose_on_segment(const Enclosed_tricubic& f, const std::array<std::array<double, 3>, 2>& corners,
                                      double shift)
{
  return internal::hull(segment_bernstein_form<double>(f.coefficients.data(), corners[0], corners[1]),
                        internal::Form_error(corners, shift)(f));
}

/// \ingroup PkgBsplineShell3Spline
/// the same at a point
inline Level_range enclose_at_point(const Enclosed_tricubic& f, const std::array<double, 3>& t, double shift)
{
  return enclose_on_segment(f, { t, t }, shift);
}

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief the function on a dyadic part of the cell, as coefficients over the part: an eighth, by halving along each
 * axis.
 *
 * \param octant bit `a` chooses the upper half along axis `a`
 */
inline Enclosed_tricubic restrict_to_octant(const Enclosed_tricubic& f, int octant)
{
  Enclosed_tricubic r = f;
  const double largest = internal::largest_size(f.coefficients);
  internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
    double* b = &r.coefficients[std::size_t(n)];
    const double b0 = b[0], b1 = b[stride], b2 = b[2 * stride], b3 = b[3 * stride];
    const double m01 = (b0 + b1) / 2, m12 = (b1 + b2) / 2, m23 = (b2 + b3) / 2;
    const double l = (m01 + m12) / 2, u = (m12 + m23) / 2, middle = (l + u) / 2;
    if((octant >> axis) & 1) {
      b[0] = middle;
      b[stride] = u;
      b[2 * stride] = m23;
      b[3 * stride] = b3;
    } else {
      b[0] = b0;
      b[stride] = m01;
      b[2 * stride] = l;
      b[3 * stride] = middle;
    }
  });
  // averages: three additions per axis, halving is exact
  r.radius = (1 + 4 * internal::rounding) * (f.radius + 10 * internal::rounding * largest + internal::underflow);
  return r;
}

/// \ingroup PkgBsplineShell3Spline
/// the field on a cell
template <typename Cell>
Enclosed_tricubic enclosed_value(const Cell& cell)
{
  Enclosed_tricubic f;
  std::copy(cell.coefficients(), cell.coefficients() + 64, f.coefficients.begin());
  f.radius = cell.error_radius();
  return f;
}

/// \ingroup PkgBsplineShell3Spline
/// the difference of two functions on the same cell
inline Enclosed_tricubic difference(const Enclosed_tricubic& f, const Enclosed_tricubic& g)
{
  Enclosed_tricubic d;
  for(int n = 0; n < 64; ++n) d.coefficients[n] = f.coefficients[n] - g.coefficients[n];
  d.radius = internal::radius_of_difference(f.radius, g.radius, internal::largest_size(d.coefficients));
  return d;
}

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief the derivative of a function along a direction, per cell unit, as a tricubic on the same cell.
 *
 * \param direction three numbers, each known to within `direction_radius`
 */
inline Enclosed_tricubic enclosed_derivative(const Enclosed_tricubic& f, const std::array<double, 3>& direction,
                                             double direction_radius = 0)
{
  Enclosed_tricubic g;
  g.coefficients.fill(0);
  std::array<double, 3> steepest = {};
  internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
    const double* b = &f.coefficients[std::size_t(n)];
    double* along = &g.coefficients[std::size_t(n)];
    const double d = direction[std::size_t(axis)];
    const double s0 = b[stride] - b[0], s1 = b[2 * stride] - b[stride], s2 = b[3 * stride] - b[2 * stride];
    // the derivative 3 s0, 3 s1, 3 s2 of degree two, raised to degree three
    along[0] += d * (3 * s0);
    along[stride] += d * (s0 + 2 * s1);
    along[2 * stride] += d * (2 * s1 + s2);
    along[3 * stride] += d * (3 * s2);
    // what is not a number is passed over, and hides no other
    double& most = steepest[std::size_t(axis)];
    most = (std::max)(most, (std::max)((std::max)((std::max)(0., std::abs(s0)), std::abs(s1)), std::abs(s2)));
  });
  // Each s carries twice the radius of f and one rounding, the raised coefficient two more, the product one, the sum
  // over the axes two: together at most six of three times the steepest. The product with the direction comes first, as
  // the rounding of a small slope could vanish.
  for(std::size_t axis = 0; axis < 3; ++axis)
    g.radius += 6 * f.radius * std::abs(direction[axis])
                + 18 * internal::rounding * (std::abs(direction[axis]) * steepest[axis])
                + direction_radius * (6 * f.radius + 3 * (1 + 4 * internal::rounding) * steepest[axis]);
  g.radius = (1 + 16 * internal::rounding) * (g.radius + internal::underflow);
  return g;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_BOUNDS_H
