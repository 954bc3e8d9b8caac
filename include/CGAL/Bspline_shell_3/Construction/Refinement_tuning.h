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
 * \brief the numbers that decide which cells are refined next, and when small changes of the field are tried instead.
 *
 * None of them decides what is proved. "One of `n`" cells is one of so many cells that the mesh passes through.
 */
struct Refinement_tuning
{
  /// the largest share of all cells that is fitted apart from the others; more of them take as long as all
  double largest_part = 0.75;

  /// how often a facet with too small a slope is a reason to refine: what that many refinements do not mend, more will
  /// not
  int max_refinements_of_a_facet = 5;
  /// small changes are not tried if slopes are too small in more than one of so many cells, and in more than
  /// `least_violated_cells`
  std::size_t violated_cells = 6, least_violated_cells = 64;
  /// how often the places that small changes leave are added to what they have to mend
  int max_slope_exchanges = 6;
  /// the largest share of thick cells that such an exchange may leave, unless it leaves no more than `few_thick_cells`
  double thick_cells_left = 0.5;
  std::size_t few_thick_cells = 2;
  /// the part of the slope asked for so far that is asked for along sharp fins, where not all conditions can be met
  double relaxed_slope = 0.5;

  /// a cell is thick if the field is too large on the mesh in it. More than one of so many cells, or more than
  /// `most_thick_cells`, are refined; small changes mend fewer, and take milliseconds each.
  std::size_t thick_cells = 8, most_thick_cells = 1000;
  /// if one of so many cells is thick before small changes, these cells are refined when thresholds have many obstacles
  std::size_t many_thick_at_first = 24;
  /// such cells are those where the field is larger on the mesh than this part of what it may be
  double nearly_thick = 0.8;
  /// the part of what the field may be on the mesh that small changes aim at
  double size_aimed_at = 0.95;

  /// obstacles in more than one of so many cells, and in more than `least_many_obstacles`, are many
  std::size_t many_obstacles = 128, least_many_obstacles = 100;
  /// with obstacles in one of so many cells, or twice in one of `cells_of_nearly_thin`, walls or gaps are too narrow
  /// for the shell asked for
  std::size_t cells_of_thin = 5, cells_of_nearly_thin = 12;
  /// with obstacles in one of so many cells, these are refined alone; fewer of them with their neighbors
  std::size_t cells_to_split_alone = 38;
  /// so few cells are refined with their neighbors across faces only
  std::size_t few_obstacles = 8;
  /// how often the field is asked to increase at obstacles, and the largest share of them that this may leave
  int max_obstacle_exchanges = 3;
  double obstacles_left = 0.75;

  /// at narrow walls and gaps: the part of the room for thresholds that the field may take on the mesh
  double most_at_obstacles = 0.7;
  /// the part of half the thickness below which the field's size on the mesh does not count; it is smaller in the
  /// middle of walls
  double considerable = 1e-3;
  /// how much more than elsewhere the next field's size on the mesh counts there
  double weight_near_obstacles = 20;
  /// how often cells next to many obstacles are halved in a round
  int max_halvings = 2;
  /// rings of cells around refined ones that are refined, too
  int rings = 1;

  /// refinement ends after so many rounds that leave more than this share of the volume of obstacles, and of their
  /// number
  int max_rounds_in_vain = 4;
  double progress = 0.9;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_TUNING_H
