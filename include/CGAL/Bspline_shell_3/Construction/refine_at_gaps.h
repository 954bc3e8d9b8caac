// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_AT_GAPS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_AT_GAPS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/gap_in_cell.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns a box that meets all leaves in a cell that was split a few times, and no other leaves.
inline Bbox_3 inner_box(const Cell_hierarchy_3& cells, Cell_hierarchy_3::Index c)
{
  const std::array<double, 3> corner = cells.corner(c);
  const double width = cells.width(c), margin = width / 64, length = width - margin;
  return Bbox_3(corner[0] + margin, corner[1] + margin, corner[2] + margin, corner[0] + length, corner[1] + length,
                corner[2] + length);
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns refined cells: `marked` leaves are split once, and `obstacles` are split repeatedly where the mesh has
 * gaps that are much narrower than a cell.
 *
 * On cells much wider than a gap, a field can increase only little through the two sides of the gap
 * (`slopes_at_gaps()`). Refinement level by level would therefore usually fail at each intermediate level. If the gap
 * is only slightly narrower than a cell, intermediate levels often suffice.
 *
 * \param marked leaves to split
 * \param rings layers of cells around them that are split as well
 * \param obstacles marked leaves that are split again, up to `most_halvings` times, until the width of their parts is
 *   at most `Condition_tuning::cell_at_gap` times the gap
 * \param most_halvings largest number of times that an obstacle is split; at most five
 * \param is_too_many whether a number of cells exceeds the limit, before which repeated splitting ends
 */
template <typename ConcurrencyTag, typename Limit>
Cell_hierarchy_3 refine_at_gaps(const Cell_hierarchy_3& cells, const std::vector<Cell_hierarchy_3::Index>& marked,
                                int rings, const std::vector<Cell_hierarchy_3::Index>& obstacles, int most_halvings,
                                const Local_gap_3& gap, const Clipped_mesh_3& clipped, const Limit& is_too_many)
{
  typedef Cell_hierarchy_3::Index Index;
  constexpr std::size_t chunk = 16;
  std::vector<int> halvings(obstacles.size(), 1);
  internal::for_each_chunk<ConcurrencyTag>(obstacles.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      double width = cells.width(obstacles[n]) / 2;
      const double narrowest = gap_in_cell(gap, clipped, obstacles[n], width);
      for(; width > condition_tuning.cell_at_gap * narrowest && halvings[n] < most_halvings; width /= 2) ++halvings[n];
    }
  });
  Cell_hierarchy_3 refined = cells.refined(marked, rings);
  for(int level = 1; level < most_halvings; ++level) {
    std::vector<Index> again;
    for(std::size_t n = 0; n < obstacles.size(); ++n) {
      if(halvings[n] <= level) continue;
      const int target = cells.level(obstacles[n]) + level;
      refined.visit_cells(internal::inner_box(cells, obstacles[n]), [&](Index c) {
        if(refined.level(c) <= target) again.push_back(c);
      });
    }
    if(again.empty()) break;
    Cell_hierarchy_3 next = refined.refined(again, rings);
    if(is_too_many(next.number_of_cells())) break;
    refined = std::move(next);
  }
  return refined;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_AT_GAPS_H
