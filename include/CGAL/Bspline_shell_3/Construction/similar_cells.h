// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SIMILAR_CELLS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SIMILAR_CELLS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns cells at the mesh that are similar to given cells: connected to them by cells of the same size, and
 * with |f| on the mesh about as large or larger.
 *
 * If they were not split as well, these cells would often fail in the next round.
 *
 * \param ranges enclosures of the field on the part of the mesh in each cell
 * \return the similar cells without the given ones, ascending
 *
 * \cgalHeading{Cost} Linear in the number of cells.
 */
inline std::vector<Cell_hierarchy_3::Index> similar_cells(const Cell_hierarchy_3& cells,
                                                          const std::vector<Level_range>& ranges,
                                                          const std::vector<Cell_hierarchy_3::Index>& given)
{
  typedef Cell_hierarchy_3::Index Index;
  // negative where there is no mesh
  const auto largest = [&](Index c) { return (std::max)(-ranges[c].min, ranges[c].max); };
  enum : char
  {
    UNSEEN,
    GIVEN,
    PASSED
  };
  std::vector<char> state(cells.number_of_cells(), UNSEEN);
  for(Index c : given) state[c] = GIVEN;
  // The search starts at the cells with the smallest |f|, which reach all cells that others would reach through the
  // same cells.
  std::vector<Index> starts = given, similar, front;
  std::stable_sort(starts.begin(), starts.end(), [&](Index a, Index b) { return largest(a) < largest(b); });
  for(Index start : starts) {
    if(state[start] == PASSED) continue;
    state[start] = PASSED;
    const double least = condition_tuning.similar * largest(start);
    front.assign(1, start);
    while(!front.empty()) {
      const Index from = front.back();
      front.pop_back();
      const std::array<double, 3> corner = cells.corner(from);
      const double width = cells.width(from);
      cells.visit_cells(
        Bbox_3(corner[0], corner[1], corner[2], corner[0] + width, corner[1] + width, corner[2] + width), [&](Index c) {
          if(state[c] == PASSED || cells.level(c) != cells.level(from) || !(largest(c) >= least)) return;
          if(state[c] == UNSEEN) similar.push_back(c);
          state[c] = PASSED;
          front.push_back(c);
        });
    }
  }
  std::sort(similar.begin(), similar.end());
  return similar;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SIMILAR_CELLS_H
