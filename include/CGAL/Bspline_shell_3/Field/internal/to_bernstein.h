// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_TO_BERNSTEIN_H
#define CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_TO_BERNSTEIN_H

#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>

#include <array>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Converts the 64 B-spline coefficients that act on a cell to Bernstein coefficients, one axis after the other.
template <typename NT>
inline void to_bernstein(NT* b)
{
  for_each_coefficient_line([b](int, int n, auto stride) {
    const std::array<NT, 4> r = Cubic_bspline<NT>::bernstein_coefficients(
      { b[n], b[n + stride], b[n + 2 * stride], b[n + 3 * stride] });
    for(int m = 0; m < 4; ++m) b[n + m * stride] = r[std::size_t(m)];
  });
}

// Returns a bound on the errors of Bernstein coefficients, in every rounding mode. The error of an operation is at most
// eps times its result, or at most the smallest positive number. Each of the three passes takes averages, with weights
// that sum to one, in three operations; magnitudes never grow. Dependent coefficients are averages of up to 27 others:
// the errors of their products sum to eps, and there are 26 sums. Of the smallest numbers, 27 are for the products, 3
// for divisions, and one for the radius itself. If coefficients are so large that sums of their multiples may overflow,
// the bound is infinite.
inline double conversion_radius(double largest_coefficient, bool has_dependent)
{
  constexpr double too_large = (std::numeric_limits<double>::max)() / 1024;
  if(!(largest_coefficient < too_large)) return std::numeric_limits<double>::infinity();
  constexpr double eps = std::numeric_limits<double>::epsilon(), least = std::numeric_limits<double>::denorm_min();
  return (has_dependent ? 37 : 10) * eps * largest_coefficient + (has_dependent ? 32 : 4) * least;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_TO_BERNSTEIN_H
