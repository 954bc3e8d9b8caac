// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_ROUND_H
#define CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_ROUND_H

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the reason why refinement ended.
 */
enum class Refinement_status
{
  NOT_REFINED, ///< the shell was built on equal cells, or was read from a file
  CERTIFIED,   ///< all claims are proved, and the shell is as thin as requested
  NO_PROGRESS, ///< smaller cells are not expected to help, or made no progress; the certificate lists the places
  /// a limit of memory, effort, or rounds was reached. All claims may be proved for a shell that is thicker than
  /// requested
  LIMIT_REACHED,
  DISTANCE_NOT_FINITE, ///< the signed-distance oracle returned a value that is infinite or not a number
  SOLVER_FAILED        ///< the linear solver failed, or did not reach its tolerance
};

inline const char* message(Refinement_status status)
{
  switch(status) {
    case Refinement_status::NOT_REFINED: return "The cells were not refined.";
    case Refinement_status::CERTIFIED: return "All claims are proved, and the shell is as thin as requested.";
    case Refinement_status::NO_PROGRESS:
      return "Smaller cells are not expected to help to prove the remaining claims: see the obstacles, and the "
             "witnesses of the certificate.";
    case Refinement_status::LIMIT_REACHED:
      return "A limit of memory, effort or rounds was reached before all claims were proved for a shell as thin as "
             "requested: raise the limit (memory_limit, effort_limit), or see the obstacles in the report.";
    case Refinement_status::DISTANCE_NOT_FINITE:
      return "The signed-distance oracle returned an infinite or NaN value: return a finite distance at every point.";
    case Refinement_status::SOLVER_FAILED:
      return "The linear solver failed: loosen its tolerance, use another solver (spd_solver), or raise the "
             "resolution.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief statistics of one round of refinement.
 */
struct Refinement_round
{
  std::size_t cells = 0, unknowns = 0;
  int levels = 0;
  double thickness = 0;        ///< largest minus smallest value of the field on the mesh, coarsely bounded
  std::size_t thick_cells = 0; ///< cells in which |f| may exceed half the thickness on the mesh
  /// cells where the slope across a facet is too small or |f| is too large, before corrections of the field
  std::size_t sloping_cells = 0;
  std::size_t sloping_cells_left = 0; ///< such cells after corrections of the field
  std::size_t failing_facets = 0;     ///< facets that are not proved to face along the gradient of the corrected field
  std::size_t undecided_cells = 0;    ///< places where the gradient claim fails and that thresholds cannot exclude
  std::size_t marked_cells = 0;
  bool partial = false;               ///< whether only the neighborhood of changed cells was fitted
  bool examined = false;              ///< whether thresholds were chosen; the certificate follows if no cell fails
  std::array<double, 7> seconds = {}; ///< cells, distance, assembly, solver, slopes, bounds, certificate
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_ROUND_H
