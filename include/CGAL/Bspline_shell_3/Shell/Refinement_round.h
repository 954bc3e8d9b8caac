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
 * \brief why refinement ended.
 */
enum class Refinement_status
{
  NOT_REFINED,         ///< the cells are equal, as asked, or the shell comes from a file
  CERTIFIED,           ///< all claims are proved, and the shell is as thin as asked
  NOTHING_TO_REFINE,   ///< what is not proved cannot be mended by smaller cells: the certificate has the places
  LIMIT_REACHED,       ///< a limit of memory, effort or rounds; all claims may be proved of a thicker shell than asked
  DISTANCE_NOT_FINITE, ///< the signed-distance oracle returned a value that is infinite or not a number
  SOLVER_FAILED        ///< the linear solver did not reach its tolerance
};

inline const char* message(Refinement_status status)
{
  switch(status) {
    case Refinement_status::NOT_REFINED: return "Cells were not refined.";
    case Refinement_status::CERTIFIED: return "All claims are proved, and the shell is as thin as asked.";
    case Refinement_status::NOTHING_TO_REFINE:
      return "What is not proved cannot be mended by smaller cells: see the witnesses of the certificate.";
    case Refinement_status::LIMIT_REACHED:
      return "A limit of memory, effort or rounds was reached before all claims were proved of a shell as thin as "
             "asked.";
    case Refinement_status::DISTANCE_NOT_FINITE:
      return "The signed-distance oracle returned a value that is infinite or not a number.";
    case Refinement_status::SOLVER_FAILED: return "The linear solver did not reach its tolerance.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief one round of refinement: what was fitted, and what was found wanting.
 */
struct Refinement_round
{
  std::size_t cells = 0, unknowns = 0;
  int levels = 0;
  double thickness = 0;          ///< largest minus least value on the mesh, bounded coarsely
  std::size_t thick_cells = 0;   ///< where the field exceeds half of the thickness on the mesh
  std::size_t sloping_cells = 0; ///< where points of facets have too small a slope or too large a value, before and
  std::size_t sloping_cells_left = 0; ///< after small changes of the field
  std::size_t failing_facets = 0;     ///< that did not certainly cross the field upwards afterwards
  std::size_t undecided_cells = 0;    ///< that keep the gradient claim from being proved, and no threshold can avoid
  std::size_t marked_cells = 0;
  bool partial = false;               ///< fitted near the cells that were split, and as it was elsewhere
  bool examined = false;              ///< for thresholds, and by the certificate if nothing was found wanting
  std::array<double, 7> seconds = {}; ///< cells, distance, assembly, solver, slopes, bounds, certificate
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_ROUND_H
