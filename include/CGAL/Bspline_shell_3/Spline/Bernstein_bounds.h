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

// Encloses numbers, each of which is known to within an error. If a number or the error is not finite, the bounds are
// infinite, because comparisons could skip NaN; a finite sum implies that all numbers are finite. Four searches are
// interleaved, because a single search would wait for each of its comparisons.
template <std::size_t n>
Level_range hull(const std::array<double, n>& b, double error)
{
  static_assert(n >= 4, "There must be at least four numbers.");
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
 * \brief a tricubic function on a cell, given by 64 Bernstein coefficients, each of which is known to within a radius.
 *
 * It represents a field, the difference of a field and a threshold, or the derivative of one of these along a
 * direction.
 *
 * Every bound in this header is rigorous for every function within the radius. Bounds are computed in `double`s, and an
 * error analysis adds the effect of rounding. In every rounding mode, the error of a single operation is at most `eps`
 * = \f$2^{-52}\f$ times the result, or at most the smallest normal number. Every radius includes an ample allowance for
 * the latter. If the radius is infinite, the function is not bounded. If a coefficient is not finite, the bounds are
 * infinite.
 */
struct Enclosed_tricubic
{
  std::array<double, 64> coefficients;
  double radius = 0;

  /// returns the range of the coefficients, extended by their radius; it encloses the function on the cell
  Level_range range() const { return internal::hull(coefficients, radius); }

  /// encloses the function on a face, an edge, or a vertex of the cell.
  /// \param direction direction from the cell's center to the face, edge, or vertex; components are -1, 0, or 1
  Level_range range_towards(const std::array<int, 3>& direction) const
  {
    const auto first = [&](std::size_t a) { return direction[a] > 0 ? 3 : 0; };
    const auto last = [&](std::size_t a) { return direction[a] < 0 ? 0 : 3; };
    std::array<double, 64> there; // unused entries repeat the first coefficient
    there.fill(coefficients[std::size_t(16 * first(2) + 4 * first(1) + first(0))]);
    std::size_t size = 0;
    for(int k = first(2); k <= last(2); ++k)
      for(int j = first(1); j <= last(1); ++j)
        for(int i = first(0); i <= last(0); ++i) there[size++] = coefficients[std::size_t(16 * k + 4 * j + i)];
    return internal::hull(there, radius);
  }
};

namespace internal {

// Returns the largest absolute value of the coefficients that are not NaN. Four searches are interleaved, because a
// single search would wait for each of its comparisons.
inline double largest_size(const std::array<double, 64>& b)
{
  std::array<double, 4> largest = {};
  for(std::size_t n = 0; n < 64; n += 4)
    for(std::size_t m = 0; m < 4; ++m) largest[m] = (std::max)(largest[m], std::abs(b[n + m]));
  return (std::max)((std::max)(largest[0], largest[1]), (std::max)(largest[2], largest[3]));
}

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr double underflow = 1024 * (std::numeric_limits<double>::min)();

// Returns the radius of the rounded differences of coefficients with radii f and g.
inline double radius_of_difference(double f, double g, double largest_difference)
{
  return (1 + 4 * rounding) * (f + g + rounding * largest_difference + underflow);
}

// A bound on the error of a coefficient of a form of degree nine, from the function's radius, rounding, and displaced
// corners.
//
// Let |t| + |1-t| <= s_a for the local coordinates t of the corners along axis a. Then the absolute weights of a polar
// form sum to at most S = (s_x s_y s_z)^3, which is one in the cell. The roundings of one term are:
//   weights: two differences, two products, two sums and the multiplicity, for each of three axes   21
//   contractions: a product and three sums each                                                    12
//   sums over the permutations of the arguments: up to ten terms, then up to seven                 15
//   the division                                                                                    1
// Each of these 49 roundings is at most eps S times the largest coefficient. The polar form is of degree three per
// axis. If corners are displaced by `shift` cell units, it changes by at most 9 S (max - min) shift.
struct Form_error
{
  double amplification = 1; // S
  double shift = 0;

  // Assumes that the corners are in the cell.
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
    // The factor accounts for the roundings in this expression.
    return (1 + 16 * rounding) * amplification
           * (f.radius + 52 * rounding * largest + 9 * (all.max - all.min) * shift + underflow);
  }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief encloses a function on a triangle.
 *
 * Corners are given in local coordinates of the cell, and lie in the cell or near it. Each coordinate may have an error
 * of up to `shift`. Outside the cell, the function is the continuation of its polynomial.
 */
inline Level_range enclose_on_triangle(const Enclosed_tricubic& f, const std::array<std::array<double, 3>, 3>& corners,
                                       double shift)
{
  return internal::hull(triangle_bernstein_form<double>(f.coefficients.data(), corners[0], corners[1], corners[2]),
                        internal::Form_error(corners, shift)(f));
}

/// \ingroup PkgBsplineShell3Spline
/// encloses a function on a segment; see `enclose_on_triangle()`
inline Level_range enclose_on_segment(const Enclosed_tricubic& f, const std::array<std::array<double, 3>, 2>& corners,
                                      double shift)
{
  return internal::hull(segment_bernstein_form<double>(f.coefficients.data(), corners[0], corners[1]),
                        internal::Form_error(corners, shift)(f));
}

/// \ingroup PkgBsplineShell3Spline
/// encloses a function at a point; see `enclose_on_triangle()`
inline Level_range enclose_at_point(const Enclosed_tricubic& f, const std::array<double, 3>& t, double shift)
{
  return enclose_on_segment(f, { t, t }, shift);
}

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns the function on an octant of the cell, with coefficients over the octant.
 *
 * \param octant bit `a` selects the upper half along axis `a`
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
  // The averages take three additions per axis; divisions by two are exact.
  r.radius = (1 + 4 * internal::rounding) * (f.radius + 10 * internal::rounding * largest + internal::underflow);
  return r;
}

/// \ingroup PkgBsplineShell3Spline
/// returns the field on a cell
template <typename Cell>
Enclosed_tricubic enclosed_value(const Cell& cell)
{
  Enclosed_tricubic f;
  std::copy(cell.coefficients(), cell.coefficients() + 64, f.coefficients.begin());
  f.radius = cell.error_radius();
  return f;
}

/// \ingroup PkgBsplineShell3Spline
/// returns the difference of two functions on the same cell
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
 * \brief returns the derivative of a function along a direction, per cell unit, as a tricubic on the same cell.
 *
 * \param direction three components, each known to within `direction_radius`
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
    // The derivative has the coefficients 3 s0, 3 s1, 3 s2 of degree two; its degree is raised to three.
    along[0] += d * (3 * s0);
    along[stride] += d * (s0 + 2 * s1);
    along[2 * stride] += d * (2 * s1 + s2);
    along[3 * stride] += d * (3 * s2);
    // NaN is skipped and does not hide other values.
    double& most = steepest[std::size_t(axis)];
    most = (std::max)(most, (std::max)((std::max)((std::max)(0., std::abs(s0)), std::abs(s1)), std::abs(s2)));
  });
  // Each s has an error of twice the radius of f and one rounding. The raised coefficient adds two roundings, the
  // product one, and the sum over the axes two: together at most six roundings of three times the steepest s. The
  // steepest s is multiplied by the direction first, because the product of a small slope and `rounding` could
  // underflow to zero.
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
