// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_SECOND_DERIVATIVES_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_SECOND_DERIVATIVES_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Spline
/// a symmetric matrix with the entries xx, yy, zz, yz, xz, xy
typedef std::array<double, 6> Symmetric_matrix_3;

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief a set of symmetric matrices, given by bounds on their entries.
 */
struct Symmetric_matrix_range_3
{
  Symmetric_matrix_3 least, most;

  void include(const Symmetric_matrix_range_3& other)
  {
    for(int m = 0; m < 6; ++m) {
      least[m] = (std::min)(least[m], other.least[m]);
      most[m] = (std::max)(most[m], other.most[m]);
    }
  }

  Symmetric_matrix_range_3 operator-() const
  {
    Symmetric_matrix_range_3 negative;
    for(int m = 0; m < 6; ++m) {
      negative.least[m] = -most[m];
      negative.most[m] = -least[m];
    }
    return negative;
  }

  /// returns a bound on the sum of the absolute entries of each matrix
  double size() const
  {
    double sum = 0;
    for(int m = 0; m < 6; ++m) sum += (m < 3 ? 1 : 2) * (std::max)(-least[m], most[m]);
    return sum;
  }

  /// returns a matrix, rounded, whose quadratic form is at least that of each matrix: the center of the range, with the
  /// row sums of the radius added to the diagonal, because \f$2 |d_a d_b| \le d_a^2 + d_b^2\f$
  Symmetric_matrix_3 largest_form() const
  {
    Symmetric_matrix_3 q, radius;
    for(int m = 0; m < 6; ++m) {
      q[m] = (most[m] + least[m]) / 2;
      radius[m] = (most[m] - least[m]) / 2;
    }
    for(int a = 0; a < 3; ++a) q[a] += radius[a] + radius[3 + (a + 1) % 3] + radius[3 + (a + 2) % 3];
    return q;
  }
};

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief encloses the second derivatives of a function on a cell, by second differences of its coefficients.
 *
 * \param width width of the cell, in the unit of length of the derivatives
 */
inline Symmetric_matrix_range_3 second_derivatives(const Enclosed_tricubic& f, double width)
{
  constexpr int stride[3] = { 1, 4, 16 };
  const std::array<double, 64>& b = f.coefficients;
  const double largest = internal::largest_size(b);
  // A difference has four coefficients, counted with multiplicity, and three roundings of at most four times the
  // largest.
  const double error = (1 + 16 * internal::rounding)
                       * (4 * f.radius + 16 * internal::rounding * largest + internal::underflow);
  Symmetric_matrix_range_3 h;
  if(!(16 * largest + error < std::numeric_limits<double>::infinity())) { // otherwise, all differences are finite
    h.least.fill(-std::numeric_limits<double>::infinity());
    h.most.fill(std::numeric_limits<double>::infinity());
    return h;
  }
  for(int m = 0; m < 6; ++m) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    const auto include = [&](double x) {
      least = (std::min)(least, x);
      most = (std::max)(most, x);
    };
    if(m < 3) {
      const int s = stride[m], t = stride[(m + 1) % 3], u = stride[(m + 2) % 3];
      for(int k = 0; k < 4; ++k)
        for(int j = 0; j < 4; ++j) {
          const double* p = &b[k * u + j * t];
          include(p[2 * s] - 2 * p[s] + p[0]);
          include(p[3 * s] - 2 * p[2 * s] + p[s]);
        }
    } else {
      const int s = stride[(m + 1) % 3], t = stride[(m + 2) % 3], u = stride[m % 3];
      for(int k = 0; k < 4; ++k)
        for(int j = 0; j < 3; ++j)
          for(int i = 0; i < 3; ++i) {
            const double* p = &b[k * u + j * t + i * s];
            include((p[s + t] - p[s]) - (p[t] - p[0]));
          }
    }
    // Divides twice, because the square of a width may overflow or underflow.
    const double factor = m < 3 ? 6 : 9, rounded = 8 * internal::rounding * (std::max)(std::abs(least), std::abs(most));
    h.least[m] = factor * (least - error - rounded) / width / width - internal::underflow;
    h.most[m] = factor * (most + error + rounded) / width / width + internal::underflow;
  }
  return h;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_SECOND_DERIVATIVES_H
