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
/// \brief tuning parameters of the conditions on slopes and of cells at gaps. They affect time, number of cells, and
/// whether the proof succeeds, but no proof depends on them.
struct Condition_tuning
{
  /// Largest width of a piece of the mesh, in cells, for which one condition at its center suffices. Larger pieces also
  /// have conditions at their corners, unless the cell has more than `few_pieces` pieces.
  double small_piece = 0.25;
  std::size_t few_pieces = 8;
  /// Largest number of pieces in a cell that have conditions.
  std::size_t max_pieces = 48;
  /// Smallest cosine between a direction and every normal nearby for which the direction is considered common to them.
  double least_common_cosine = 0.01;
  /// A cell is at a fold if the slope possible at a vertex of one of its facets is below this, and so is the slope
  /// possible along the common direction of the facets nearby. At an edge, the normals then differ by more than 166
  /// degrees. Without conditions at folds, a block with a groove of 10 degrees is not certified. With 0.3, hand is no
  /// longer certified after simplification to 1000 facets, where two folds have one facet in between.
  double fold_margin = 0.12;
  /// Distance from a cell within which facets count for the common direction, in widths of the cell. With 0, facets on
  /// the other side of a groove are missed in some cells; with 0.5, facets beyond it count.
  double fold_reach = 0.35;
  /// Slope required in a cell with a gap, as a multiple of gap / cell width.
  double slope_at_gap = 0.25;
  /// Cells at a gap are split in one round until their width is at most this multiple of the gap.
  double cell_at_gap = 4;
  /// Factor on the weight of the surface term in a cell as wide as a gap in it (`surface_factor_at_gap()`). With 100, a
  /// plain plate of 0.2 % needs 39 K cells instead of one thousand; with 10000, nested layers with gaps of 3 % need
  /// 109 K instead of 14 K.
  double weight_at_gap = 1000;
  /// Largest width of a cell with a larger weight, as a multiple of the gap. Without a limit, the cover of a plain
  /// plate of 0.1 % needs too many boxes.
  double widest_cell_at_gap = 24;
  /// Least |cosine| of the angle between two facets in a cell with a larger weight. With 0.7, the mesh three_peaks of
  /// \cgal's data folder needs twice as many cells; with 0.95, layers with gaps of 3 % need six times as many.
  double least_parallel_cosine = 0.9;
  /// Weights are increased if at least this fraction of the obstacles can be removed in this way. An obstacle can if
  /// the weight can be increased in at least this fraction of its causing cells. With 0.55, a plate of 2 % needs three
  /// times as many cells.
  double weighable = 0.5;
};

inline constexpr Condition_tuning condition_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_TUNING_H
