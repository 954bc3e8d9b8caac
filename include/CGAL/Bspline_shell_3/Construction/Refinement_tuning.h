// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_TUNING_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief tuning parameters of the refinement: when cells are split, and when the field is corrected instead.
 *
 * They affect time and the number of cells; no proof depends on them. A *surface cell* is a cell that the mesh
 * intersects. Fractions that are compared with numbers of cells are stored as their reciprocals.
 */
struct Refinement_tuning
{
  /// \name Partial fits
  /// @{

  /// Largest fraction of the cells that a partial fit may cover. Beyond it, a partial fit takes as long as a full fit.
  double largest_part = 0.75;
  /// @}

  /// \name Corrections of slopes and values on the mesh (`Corrected_field`)
  /// @{

  /// Number of times that a facet with a failing slope may cause refinement. More refinement is not expected to help.
  int max_refinements_of_a_facet = 5;
  /// If conditions fail in more than 1/`violated_cells` of the surface cells and in more than `least_violated_cells`,
  /// the field is not corrected: the problem is not local, and splitting is faster.
  std::size_t violated_cells = 6, least_violated_cells = 64;
  /// Number of times that the places that still fail after a correction are added to the conditions.
  int max_slope_exchanges = 6;
  /// Largest fraction of thick cells that an exchange may leave; otherwise, cells are split. The limit does not apply
  /// if at most `few_thick_cells` remain: another exchange is then faster than a round.
  double thick_cells_left = 0.5;
  std::size_t few_thick_cells = 2;
  /// Factor on the slope required around cells whose conditions contradict each other, as along sharp fins.
  double relaxed_slope = 0.5;
  /// @}

  /// \name Thick cells
  /// A surface cell is *thick* if |f| may exceed half the thickness on the mesh in it.
  /// @{

  /// If more than 1/`thick_cells` of the surface cells, or more than `most_thick_cells`, are thick, they are split.
  /// Otherwise, they are corrected, which takes some milliseconds per cell.
  std::size_t thick_cells = 8, most_thick_cells = 1000;
  /// If more than 1/`many_thick_at_first` of the surface cells are thick before corrections, these cells are split
  /// when thresholds have many obstacles later.
  std::size_t many_thick_at_first = 24;
  /// Fraction of half the thickness above which |f| makes a cell nearly thick. Such a cell is often thick in the next
  /// round.
  double nearly_thick = 0.8;
  /// Fraction of half the thickness at which corrections aim.
  double size_aimed_at = 0.95;
  /// @}

  /// \name Obstacles to thresholds
  /// @{

  /// There are many obstacles if they are in more than 1/`many_obstacles` of the surface cells and in more than
  /// `least_many_obstacles`.
  std::size_t many_obstacles = 128, least_many_obstacles = 100;
  /// Walls or gaps are considered too narrow for the shell if more than 1/`cells_of_thin` of the surface cells have
  /// obstacles, or more than 1/`cells_of_nearly_thin` in two successive rounds with many obstacles.
  std::size_t cells_of_thin = 5, cells_of_nearly_thin = 12;
  /// If more than 1/`cells_to_split_alone` of the surface cells have obstacles, they are split without neighbors.
  std::size_t cells_to_split_alone = 38;
  /// Up to this number of cells with obstacles, only their face neighbors are split with them, and weights at gaps are
  /// not increased.
  std::size_t few_obstacles = 8;
  /// Number of times that the field is corrected at obstacles. It is not corrected again if more than the fraction
  /// `obstacles_left` of the cells with obstacles remain, unless these are at most `few_obstacles_left` and no more
  /// than before.
  int max_obstacle_exchanges = 8;
  double obstacles_left = 0.75;
  std::size_t few_obstacles_left = 8;
  /// @}

  /// \name Narrow walls and gaps
  /// @{

  /// Fraction of an obstacle's value that |f| may reach on the mesh nearby before the cell there is split.
  double most_at_obstacles = 0.7;
  /// Largest number of times that a cell is split in one round.
  int max_halvings = 2;
  /// Layers of cells that are split around a split cell.
  int rings = 1;
  /// @}

  /// \name End of the refinement
  /// @{

  /// Number of successive rounds without progress after which refinement ends. A round makes progress if it reduces the
  /// volume or the number of obstacles below `progress` times the smallest one so far.
  int max_stalled_rounds = 4;
  double progress = 0.9;
  /// Refinement also ends after `max_rounds_at_folds` successive rounds without thick cells in which at least the
  /// fraction `share_at_folds` of the failing cells contain facets at folds, and no fewer cells fail than in the round
  /// before. Near a fold, the field looks the same on cells of all sizes. Hand is not certified with or without this
  /// rule, which ends its refinement at 14 K cells after 4 rounds, instead of at 59 K cells after more than 9. With two
  /// rounds instead of three, no mesh of \cgal's data folder is lost, and none of 38 decimated ones. Meshes with a few
  /// moved vertices take half the time until these are excised.
  int max_rounds_at_folds = 2;
  double share_at_folds = 0.75;
  /// @}
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_TUNING_H
