// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_TUNING_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// \brief tuned numbers of the conditions on slopes and of cells at gaps. They affect time and the number of cells
/// only.
struct Condition_tuning
{
  /// Width of a piece of the mesh, in cells, up to which one condition in its middle stands for it; the corners of
  /// larger ones have conditions, too, unless there are more than `few_pieces` in the cell.
  double small_piece = 0.25;
  std::size_t few_pieces = 8;
  /// Largest number of pieces in a cell that have conditions.
  std::size_t max_pieces = 48;
  /// Least cosine between a direction and all normals nearby for it to be common to them.
  double least_common_cosine = 0.01;
  /// Slope asked for in a cell with a gap, in gaps per width of the cell.
  double slope_at_gap = 0.25;
  /// Width of cells at a gap, in gaps, down to which they are halved at once.
  double cell_at_gap = 4;
  /// Fraction of the field on the mesh in a cell above which a neighbor is refined like it.
  double similar = 0.7;
};

inline constexpr Condition_tuning condition_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_TUNING_H
