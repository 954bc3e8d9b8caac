// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SLOPE_CONDITION_H
#define CGAL_BSPLINE_SHELL_3_FIT_SLOPE_CONDITION_H

#include <array>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief a condition on a field at a point: it increases along a direction, \f$d \cdot \nabla f \ge \delta\f$, and is
 * near zero.
 */
struct Slope_condition
{
  std::uint32_t cell;              ///< leaf cell of the field
  std::uint32_t facet;             ///< facet at the point or near it, for reports
  std::array<double, 3> position;  ///< position in the cell, in [0, 1]^3
  std::array<double, 3> direction; ///< unit vector
  double least;                    ///< \f$\delta\f$, per user unit
  /// largest \f$|f|\f$ at the point, in units of the width of root cells
  double largest = std::numeric_limits<double>::infinity();
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SLOPE_CONDITION_H
