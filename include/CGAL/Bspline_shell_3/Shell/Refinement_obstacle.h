// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H
#define CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H

#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>

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
  std::array<double, 3> point = {}; ///< place in the units of the coordinates, as are all lengths here
  double cell_width = 0;            ///< width of the cell there
  /// local gap of the mesh (`Local_gap_3`); infinite if it is much wider than the cell
  double gap = std::numeric_limits<double>::infinity();
  bool is_wall = false; ///< whether the gap is behind facets (a wall), and not in front of them
};

/// \ingroup PkgBsplineShell3Shell
/// \param unit length to which the percentages of the sentence refer: the longest side of the mesh's bounding box
///   (`Shell_report::unit`)
/// \param refinement the reason why refinement ended (`Shell_report::refinement`)
/// \return a sentence that describes the obstacle and, if a wall or gap is narrow, a remedy to try
inline std::string message(const Refinement_obstacle& obstacle, double unit, Refinement_status refinement)
{
  constexpr double cells_across = 2;
  std::ostringstream out;
  const auto percent = [&](double x) {
    std::ostringstream number;
    number << std::setprecision(2) << 100 * x / unit << " %";
    return number.str();
  };
  const bool is_at_gap = std::isfinite(obstacle.gap);
  const char* const subject = !is_at_gap ? "The proof fails at " : obstacle.is_wall ? "The wall at " : "The gap at ";
  out << subject << obstacle.point[0] << " " << obstacle.point[1] << " " << obstacle.point[2];
  if(is_at_gap)
    out << " is " << percent(obstacle.gap) << " of the bounding box " << (obstacle.is_wall ? "thick" : "wide")
        << ", and cells are " << percent(obstacle.cell_width) << " wide";
  else out << ", where cells are " << percent(obstacle.cell_width) << " of the bounding box wide";
  if(is_at_gap && cells_across * obstacle.cell_width > obstacle.gap) {
    if(refinement == Refinement_status::LIMIT_REACHED)
      out << "; cells of " << percent(obstacle.gap / cells_across) << " may be needed";
    else out << ": remove it if it is an error of the mesh, or try a smaller thickness there (sizing)";
  }
  out << ".";
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_OBSTACLE_H
