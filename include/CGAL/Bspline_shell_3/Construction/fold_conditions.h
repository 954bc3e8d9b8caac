// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FOLD_CONDITIONS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FOLD_CONDITIONS_H

#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/common_direction.h>
#include <CGAL/Bspline_shell_3/Construction/condition_points.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns conditions that make a field increase out of narrow grooves, and beyond the edges of thin fins. The
 * sharp edges and vertices there are *folds*.
 *
 * Near a fold, the distance between the facets is less than the width of any cell. If the field is near zero on both
 * sides, it usually has critical points between them. The conditions require instead that it increases along the common
 * direction of the facets nearby (`common_direction()`), at the points of `visit_condition_points()`. A cell has no
 * conditions if there is no common direction, or if its margin is at least `Condition_tuning::fold_margin`.
 *
 * \tparam ConcurrencyTag unless it is `Sequential_tag`, functions are called concurrently
 * \param is_at_fold whether the slope possible at a vertex of a facet is below `Condition_tuning::fold_margin`. Only
 *   cells with such facets have conditions.
 * \param needs_conditions whether a cell needs conditions
 * \param fraction the required derivative along the common direction, as a fraction of its margin
 */
template <typename ConcurrencyTag = Sequential_tag, typename Field, typename Facet_predicate, typename Cell_predicate>
std::vector<Slope_condition> fold_conditions(const Field& field, const Clipped_mesh_3& clipped,
                                             const Facet_predicate& is_at_fold, const Cell_predicate& needs_conditions,
                                             double fraction)
{
  return conditions_by_cell<ConcurrencyTag>(
    clipped, [&](std::uint32_t c, const Clipped_mesh_3::Piece_range& pieces, std::vector<Slope_condition>& conditions) {
      if(!needs_conditions(c)
         || std::none_of(pieces.begin(), pieces.end(), [&](const auto& piece) { return is_at_fold(piece.facet); }))
        return;
      const typename Field::Cell cell = field.cell(c);
      const std::array<double, 3> low = cell.corner();
      const double near = condition_tuning.fold_reach * cell.width(), far = cell.width() + near;
      const std::optional<Common_direction> common = common_direction(
        field, clipped, Bbox_3(low[0] - near, low[1] - near, low[2] - near, low[0] + far, low[1] + far, low[2] + far));
      if(!common || common->margin >= condition_tuning.fold_margin) return;
      visit_condition_points(clipped, pieces, cell.width(),
                             [&](const Clipped_mesh_3::Piece& piece, const std::array<double, 3>& p) {
                               conditions.push_back({ c, piece.facet, cell.local_coordinates(p), common->direction,
                                                      fraction * common->margin });
                             });
    });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FOLD_CONDITIONS_H
