// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_SHELL_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_SHELL_REPORT_H

#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Shell/Fit_report.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_limit.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>
#include <CGAL/Bspline_shell_3/Shell/Truncation_report.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief how the construction of a shell went.
 */
struct Shell_report
{
  Shell_status status = Shell_status::NOT_BUILT;
  Offending_simplices offending_simplices; ///< where it failed
  Invalid_parameter invalid_parameter;     ///< the parameter that is refused, if the status is `INVALID_PARAMETER`
  Closing_report closing;                  ///< how the mesh was closed, if it is open
  Truncation_report truncation;            ///< where the mesh was truncated
  /// of the mesh, polygons being cut into triangles; with those that close it; truncated
  std::size_t triangles = 0;
  std::size_t components = 0;    ///< of the mesh
  double unit = 0;               ///< longest side of the mesh's box: the paper's unit of length
  double gamma = 0;              ///< cells, or root cells, per unit
  std::size_t surface_cells = 0; ///< cells that the mesh enters
  std::size_t cells = 0;
  std::size_t unknowns = 0;
  int widenings = 0; ///< how often cells were added where the shell would have left them
  Fit_report fit;
  Level_range edges;        ///< extrema on the edges of the clipped mesh (paper, Eq. 4.7), not rounded
  Level_range facets_bound; ///< bounds on the facets, not rounded
  Refinement_status refinement = Refinement_status::NOT_REFINED; ///< why refinement ended
  Refinement_limit limit;                                        ///< which one that was, if it was a limit
  std::vector<Refinement_round> rounds;                          ///< of refinement
  /// if that was without a proof: what stands in the way, narrowest first, a thousand at most
  std::vector<Refinement_obstacle> obstacles;
  Certificate_report certificate;     ///< of the mesh, if cells were refined until it held
  double thickness = 0;               ///< largest difference of the thresholds on the mesh, user units
  double narrowed_area = 0;           ///< share of the mesh's area where it is less than asked for
  std::array<double, 6> seconds = {}; ///< per `Shell_step`

  double total_seconds() const
  {
    double sum = 0;
    for(double s : seconds) sum += s;
    return sum;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_SHELL_REPORT_H
