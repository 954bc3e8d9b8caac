// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_IS_POSITIVE_ON_TRIANGLE_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_IS_POSITIVE_ON_TRIANGLE_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns whether \f$\sum_i \lambda_i g_i - \frac{1}{2} \sum_{i<j} \lambda_i \lambda_j q_{ij}\f$ is proved to be
 * positive for all barycentric coordinates \f$\lambda\f$ of a triangle.
 *
 * The expression is a lower bound on a function that is \f$g_i\f$ at the corners. The second derivative of this
 * function along the edge from corner i to j, times the squared length of the edge, is at most \f$q_{ij}\f$.
 *
 * The coordinates sum to one. The expression is therefore the quadratic form of the matrix \f$a_{ii} = g_i\f$,
 * \f$a_{ij} = (g_i + g_j) / 2 - q_{ij} / 4\f$. Let \f$c_{ij} = a_{ij} / \sqrt{g_i g_j}\f$. The form is positive if and
 * only if \f$g_i > 0\f$, \f$c_{ij} > -1\f$, and \f$1 + \sum c_{ij} + \sqrt{2 \prod (1 + c_{ij})} > 0\f$ (*On copositive
 * matrices*, K. P. Hadeler, Linear Algebra and its Applications 49, 1983). A function that rises steeply from one
 * corner may bend by much more than a multiple of its smallest value. Rounding is included: if the expression is
 * positive by less than rounding errors, the result may be `false`.
 *
 * \param g values at the corners
 * \param q \f$q_{ij}\f$ of the edge opposite to each corner
 */
inline bool is_positive_on_triangle(const std::array<double, 3>& g, const std::array<double, 3>& q)
{
  using internal::rounding;
  std::array<double, 3> a;
  bool are_positive = true; // the usual case
  for(std::size_t v = 0; v < 3; ++v) {
    const double gi = g[(v + 1) % 3], gj = g[(v + 2) % 3];
    if(!(g[v] > internal::underflow)) return false;
    a[v] = (gi / 2 + gj / 2) * (1 - 8 * rounding) - (q[v] + 8 * rounding * std::abs(q[v]) + internal::underflow) / 4;
    are_positive = are_positive && a[v] > 0;
  }
  if(are_positive) return true;
  // Square roots round differently after scaling by an odd power of two, so all numbers are scaled to unit size first.
  const double unit = internal::reciprocal_power_of_two(g);
  std::array<double, 3> root;
  for(std::size_t v = 0; v < 3; ++v) {
    if(!(unit * g[v] > internal::underflow)) return false;
    root[v] = std::sqrt(unit * g[v]);
  }
  constexpr double slack = 64 * rounding; // covers rounding of sums of a few numbers that are at most one
  double sum = 1 - slack, product = 2;
  for(std::size_t v = 0; v < 3; ++v) {
    const double c = unit * a[v] / (root[(v + 1) % 3] * root[(v + 2) % 3]) - slack;
    if(!(c > -1)) return false;
    const double at_most_one = (std::min)(1., c); // smaller entries make the form smaller
    sum += at_most_one;
    product *= 1 + at_most_one;
  }
  return sum + std::sqrt(product) > slack;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_IS_POSITIVE_ON_TRIANGLE_H
