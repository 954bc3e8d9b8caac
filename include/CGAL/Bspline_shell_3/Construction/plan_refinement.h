// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PLAN_REFINEMENT_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PLAN_REFINEMENT_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Marked_cells.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_history.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the cells of a round that fail, by kind of failure.
 */
struct Round_findings
{
  typedef Cell_hierarchy_3::Index Index;

  std::vector<Index> cells_with_small_slopes; ///< cells in which slopes still fail after corrections
  std::vector<Index> thick;                   ///< thick cells after corrections
  bool are_many_thick = false;                ///< whether there are too many of them for corrections
  std::vector<Index> thick_at_first;          ///< thick and nearly thick cells before corrections, if many were thick
  std::vector<Threshold_obstacle> obstacles;
  Obstacle_kind kind = Obstacle_kind::FEW; ///< kind of the obstacles
  std::vector<Index> causing_cells;        ///< cells at narrow gaps, where |f| leaves no room for thresholds
  std::vector<Index> two_sheets;           ///< cells where two components of the mesh share a component of the shell
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the cells to split before the next round.
 */
struct Refinement_plan
{
  typedef Cell_hierarchy_3::Index Index;

  std::vector<Index> split;   ///< cells to split, ascending; empty if none can be split
  std::vector<Index> at_gaps; ///< cells to split repeatedly where gaps are far narrower than the cell
  bool fits_again = false;    ///< whether to fit the field again even if no cell is split

  bool is_empty() const { return split.empty() && !fits_again; }
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the cells to split after a round.
 *
 * Around failing slopes and few obstacles, neighbors of the same size are split as well, because splitting a single
 * cell gives the field little freedom. If many cells fail, they are split alone. Obstacles at gaps where the field will
 * be fitted again with larger weights cause no splitting in this round.
 *
 * \param cells_at_mesh number of surface cells
 */
inline Refinement_plan plan_refinement(const Cell_hierarchy_3& cells, const Round_findings& found,
                                       std::size_t cells_at_mesh, const Refinement_tuning& tuning)
{
  typedef Cell_hierarchy_3::Index Index;
  constexpr int all_axes = 3;
  Refinement_plan plan;
  Marked_cells marked(cells);
  const auto mark = [&](const std::vector<Index>& chosen) {
    for(Index c : chosen) marked.mark(c);
  };
  const auto mark_widely = [&](const std::vector<Index>& chosen, int axes) {
    for(Index c : chosen) marked.mark_widely(c, axes);
  };

  mark_widely(found.cells_with_small_slopes, all_axes);
  if(found.are_many_thick) {
    mark(found.thick);
    mark(found.thick_at_first);
  } else {
    mark_widely(found.thick, all_axes);
  }
  const std::vector<Index> obstacles = cells_of(found.obstacles);
  switch(found.kind) {
    case Obstacle_kind::WEIGHED_GAPS: plan.fits_again = true; break;
    case Obstacle_kind::THICK_FIELD: mark(found.thick_at_first); break;
    case Obstacle_kind::NARROW_GAPS:
      mark(found.causing_cells);
      if(marked.empty()) mark_widely(obstacles, all_axes); // causing cells cannot be split further
      plan.at_gaps = found.causing_cells;
      break;
    case Obstacle_kind::MANY: plan.at_gaps = obstacles; [[fallthrough]];
    case Obstacle_kind::FEW:
      const bool alone = obstacles.size() > cells_at_mesh / tuning.cells_to_split_alone;
      mark_widely(obstacles, alone ? 0 : obstacles.size() <= tuning.few_obstacles ? 1 : all_axes);
  }
  mark(found.two_sheets);
  plan.split = marked.sorted();
  return plan;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_PLAN_REFINEMENT_H
