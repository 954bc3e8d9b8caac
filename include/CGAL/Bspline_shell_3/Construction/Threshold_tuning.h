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
/// \brief tuning parameters of the choice of thresholds (`Narrowed_thresholds`, `Mesh_ranges`). They affect time and
/// the thickness of shells only.
struct Threshold_tuning
{
  /// Number of passes if there are many obstacles, because the cells there are split in any case.
  int max_passes_of_many = 2;
  /// A cap is useful if the mesh requires less than this fraction of the room and, in a coarse box, the cap is at most
  /// this fraction of the threshold.
  double useful_cap = 0.98;
  /// A place is tight if the mesh requires more than this fraction of the room.
  double tight = 0.7;
  /// Boxes after at most this number of subdivisions of a cell are coarse: the cover ran out of boxes.
  int coarse_depth = 3;
  /// Ranges on the mesh: largest number of bisections of the edges of a piece for values on grids (a third bisection
  /// would take 30 values), and for bounds on parts of a piece. Each bisection reduces the excess of a bound to a
  /// quarter.
  int max_grid_halvings = 2, max_range_depth = 5;
  /// A point may represent the worst point if its value is at least this fraction of the largest possible value.
  double nearly_largest = 0.95;
  /// Excess of a bound, relative to the allowed size, below which the bound is not improved.
  double range_excess = 0.004;
};

inline constexpr Threshold_tuning threshold_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_TUNING_H
