// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_OBSTACLES_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_OBSTACLES_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/gap_in_cell.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the obstacles at places where a proof failed, with the local gap of the mesh there; at most 1000,
 * narrowest first.
 *
 * \param places the failing cells, with a point in each
 */
template <typename ConcurrencyTag>
std::vector<Refinement_obstacle> refinement_obstacles(
  const Cell_hierarchy_3& cells, const Clipped_mesh_3& clipped, const Local_gap_3& gap,
  const std::map<Cell_hierarchy_3::Index, std::array<double, 3> >& places)
{
  constexpr std::size_t most = 1000, chunk = 16;
  constexpr double far = 4; // cell widths
  const std::vector<std::pair<Cell_hierarchy_3::Index, std::array<double, 3> > > list(places.begin(), places.end());
  std::vector<Refinement_obstacle> result(list.size());
  internal::for_each_chunk<ConcurrencyTag>(list.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const Cell_hierarchy_3::Index c = list[n].first;
      Refinement_obstacle& obstacle = result[n];
      obstacle.point = list[n].second;
      obstacle.cell_width = cells.width(c);
      const double widest = far * obstacle.cell_width, wall = gap_in_cell(gap, clipped, c, NEGATIVE, widest);
      const double gap_in_front = gap_in_cell(gap, clipped, c, POSITIVE, wall);
      obstacle.is_wall = !(gap_in_front < wall);
      if(gap_in_front < widest) obstacle.gap = gap_in_front;
    }
  });
  std::stable_sort(result.begin(), result.end(),
                   [](const Refinement_obstacle& a, const Refinement_obstacle& b) { return a.gap < b.gap; });
  if(result.size() > most) result.resize(most);
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_OBSTACLES_H
