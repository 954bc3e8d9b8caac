// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_COEFFICIENT_LINES_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_COEFFICIENT_LINES_H

#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <array>
#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <int axis, typename Visitor>
inline void for_each_line_along(const Visitor& visit)
{
  constexpr int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  for(int slab = 0; slab < 64; slab += 4 * stride)
    for(int n = slab; n < slab + stride; ++n) visit(axis, n, std::integral_constant<int, stride>());
}

// Calls visit(axis, n, stride) for each line of four coefficients of a tricubic, along x first, then y, then z. The 64
// coefficients form 16 lines along each axis. The coefficients of a line are n, n + stride, n + 2 stride, and n + 3
// stride. The stride is a compile-time constant, so that compilers can vectorize over neighboring lines.
template <typename Visitor>
inline void for_each_coefficient_line(const Visitor& visit)
{
  for_each_line_along<0>(visit);
  for_each_line_along<1>(visit);
  for_each_line_along<2>(visit);
}

// Returns, for each axis, the range of the differences of neighboring coefficients along the axis. NaN is skipped. The
// partial derivative has these differences as coefficients, times 3 in the Bernstein basis.
inline std::array<Level_range, 3> difference_ranges(const double* coefficients)
{
  std::array<Level_range, 3> ranges;
  for_each_coefficient_line([&](int axis, int n, auto stride) {
    const double* b = coefficients + n;
    for(int m = 0; m < 3; ++m) ranges[std::size_t(axis)].include(b[(m + 1) * stride] - b[m * stride]);
  });
  return ranges;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_COEFFICIENT_LINES_H
