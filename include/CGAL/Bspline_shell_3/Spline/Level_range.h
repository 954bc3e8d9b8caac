// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_LEVEL_RANGE_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_LEVEL_RANGE_H

#include <algorithm>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Spline
/// an interval of field values
struct Level_range
{
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void include(double x)
  {
    min = (std::min)(min, x);
    max = (std::max)(max, x);
  }
  /// returns the largest absolute value in the interval; less than zero if the interval is empty
  double largest_size() const { return (std::max)(-min, max); }
  void include(const Level_range& r)
  {
    min = (std::min)(min, r.min);
    max = (std::max)(max, r.max);
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_LEVEL_RANGE_H
