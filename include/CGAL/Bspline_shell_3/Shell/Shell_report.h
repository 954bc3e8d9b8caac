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
 * \brief a report on the construction of a shell. Lengths are in the units of the coordinates.
 */
struct Shell_report
{
  Shell_status status = Shell_status::NOT_BUILT;
  Offending_simplices offending_simplices; ///< facets and vertices at which the construction failed
  Invalid_parameter invalid_parameter;     ///< the rejected parameter, if the status is `INVALID_PARAMETER`
  Closing_report closing;                  ///< how the mesh was closed, if it is open
  Truncation_report truncation;            ///< places where the mesh was truncated
  /// number of triangles of the mesh after triangulation, closing, and truncation
  std::size_t triangles = 0;
  std::size_t components = 0;    ///< number of components of the mesh
  double unit = 0;               ///< the box size: length of the longest side of the mesh's bounding box
  double gamma = 0;              ///< number of cells, or of root cells, per `unit`
  std::size_t surface_cells = 0; ///< number of cells that the mesh intersects
  std::size_t cells = 0;
  std::size_t unknowns = 0;
  int widenings = 0;        ///< number of times that cells were added because the shell reached their boundary
  Fit_report fit;           ///< the fit on equal cells; for refined cells, only its status
  Level_range edges;        ///< extrema of the field on the edges of the clipped mesh, not rounded
  Level_range facets_bound; ///< bounds on the field on the facets, not rounded
  Refinement_status refinement = Refinement_status::NOT_REFINED; ///< the reason why refinement ended
  Refinement_limit limit;                                        ///< the limit that ended refinement, if any
  std::vector<Refinement_round> rounds;                          ///< rounds of refinement
  /// obstacles to the proof if refinement ended without a certificate: at most 1000, narrowest first
  std::vector<Refinement_obstacle> obstacles;
  Certificate_report certificate;     ///< results of the certificate, of the construction or of `certify()`
  double thickness = 0;               ///< largest difference of the thresholds on the mesh
  double narrowed_area = 0;           ///< fraction of the mesh's area where the thickness is less than requested
  std::array<double, 6> seconds = {}; ///< time of each `Shell_step`

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
