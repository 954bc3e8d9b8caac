// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_TUNING_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// \brief tuned numbers of the choice of thresholds (`Narrowed_thresholds`, `Mesh_ranges`). They affect time and the
/// thickness of shells only.
struct Threshold_tuning
{
  /// Number of passes where there are many obstacles: cells are refined there in any case.
  int max_passes_of_many = 2;
  /// A cap is worth its while if it is less than this fraction of the room that there is.
  double useful_cap = 0.98;
  /// Fraction of the room that the mesh may take before a place counts as tight.
  double tight = 0.7;
  /// Number of halvings of a cell up to which boxes are coarse: the cover ran out of them.
  int coarse_depth = 3;
  /// Ranges on the mesh: number of halvings of the edges of a piece at which values are taken (a third would take 30
  /// values), and of the parts of a piece for which bounds are computed; each leaves a quarter of the excess of a
  /// bound.
  int max_grid_halvings = 2, max_range_depth = 5;
  /// Fraction of the largest value at which a value will do.
  double nearly_largest = 0.95;
  /// Excess of a bound that is not improved, relative to the size that matters.
  double range_excess = 0.004;
};

inline constexpr Threshold_tuning threshold_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_TUNING_H
