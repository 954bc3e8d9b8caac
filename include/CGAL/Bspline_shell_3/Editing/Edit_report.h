// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_EDIT_REPORT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_EDIT_REPORT_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the part of the report that all edits of a mesh in a shell have in common.
 */
struct Edit_report
{
  Edit_status status = Edit_status::NO_SHELL;
  Edit_termination end = Edit_termination::NOT_EDITED; ///< the reason why the edit ended, and why a target was not reached
  Invalid_parameter invalid_parameter; ///< the rejected parameter, if the status is `INVALID_PARAMETER`
  /// facets and vertices where the mesh is not in the shell before the edit. The vertex of a tip stands for the
  /// triangles that replace the tip in the shell.
  Offending_simplices offending_simplices;
  /// with `freeze_rejected_facets(true)`: the positions of the frozen facets in `faces(mesh)` before the edit,
  /// ascending, and the positions of the same facets, in the same order, after it. If the shell replaces tips of the
  /// mesh, the order is different: parts of a facet that was cut have its position, and triangles that replace a tip
  /// have `no_facet`.
  std::vector<std::size_t> frozen_facets_before, frozen_facets;
  static constexpr std::size_t no_facet = std::size_t(-1); ///< an entry of `frozen_facets_before`
  std::size_t facets_before = 0, facets = 0;               ///< numbers of facets of the mesh
  std::size_t constrained_edges = 0;                       ///< number in the result; 0 if the mesh was not edited
  Placement_statistics placements;                         ///< all placements that were tried, by verdict
  /// certificate of the result; with `PARTIALLY_EDITED`, not all of its claims are proved
  Certificate_report certificate;
  /// whether the edit was undone and repeated with a proof for each facet. In the first run, facets that passed an
  /// estimate were accepted without a proof, and the certificate failed.
  bool is_repeated = false;
  /// times of the first check, the edit, the certificate, and the location of vertices
  double check_seconds = 0, edit_seconds = 0, certificate_seconds = 0, location_seconds = 0;

  double total_seconds() const { return check_seconds + edit_seconds + certificate_seconds + location_seconds; }
  /// returns the message of the status, or of the parameter if the status is `INVALID_PARAMETER`
  std::string message() const
  {
    return status == Edit_status::INVALID_PARAMETER && invalid_parameter ? Bspline_shells::message(invalid_parameter)
                                                                         : Bspline_shells::message(status);
  }
  /// returns whether the mesh was edited and the result is certified
  explicit operator bool() const { return status == Edit_status::SUCCESS; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_REPORT_H
