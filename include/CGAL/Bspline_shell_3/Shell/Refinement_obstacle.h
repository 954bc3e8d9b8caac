// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H
#define CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a place where the proof failed when refinement ended.
 */
struct Refinement_obstacle
{
  std::array<double, 3> point = {}; ///< in the units of the coordinates, as are all lengths here
  double cell_width = 0;            ///< width of the cell there
  /// local gap of the mesh (`Local_gap_3`); infinite if it is much wider than the cell
  double gap = std::numeric_limits<double>::infinity();
  bool is_wall = false; ///< whether the gap is behind facets (a wall), and not in front of them
};

/// \ingroup PkgBsplineShell3Shell
/// \param unit length to which the percentages of the sentence refer: the longest side of the mesh's bounding box
///   (`Shell_report::unit`)
/// \return a sentence that describes the obstacle
inline std::string message(const Refinement_obstacle& obstacle, double unit)
{
  constexpr double cells_across = 2;
  std::ostringstream out;
  const auto percent = [&](double x) {
    std::ostringstream number;
    number << std::setprecision(2) << 100 * x / unit << " %";
    return number.str();
  };
  if(std::isfinite(obstacle.gap))
    out << (obstacle.is_wall ? "A wall of " : "A gap of ") << percent(obstacle.gap) << " of the box";
  else out << "No proof";
  out << " at " << obstacle.point[0] << " " << obstacle.point[1] << " " << obstacle.point[2] << ", where cells are "
      << percent(obstacle.cell_width) << " wide";
  if(std::isfinite(obstacle.gap) && cells_across * obstacle.cell_width > obstacle.gap)
    out << "; they may have to be as small as " << percent(obstacle.gap / cells_across);
  out << ".";
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H
