// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_EDIT_REPORT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_EDIT_REPORT_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the common part of the reports of `simplify_in_shell()` and `remesh_in_shell()`.
 */
struct Edit_report
{
  Edit_status status = Edit_status::NO_SHELL;
  Edit_termination end = Edit_termination::NOT_EDITED; ///< why the edit ended, possibly before its target
  Invalid_parameter invalid_parameter;                 ///< the rejected parameter, if the status is `INVALID_PARAMETER`
  /// the facets and vertices at which the mesh was not accepted before the edit; see `Edit_status::NOT_IN_SHELL`. The
  /// vertex of a truncated tip represents the triangles that replace the tip.
  Offending_simplices offending_simplices;
  /// positions of the facets that `freeze_rejected_facets(true)` freezes in `faces(mesh)` before the edit,
  /// ascending, and the positions of the same facets after it, in the same order. If the shell truncates tips of the
  /// mesh, the positions are not ascending: parts of a facet that was cut have its position, and triangles that replace
  /// a tip have `no_facet`.
  std::vector<std::size_t> frozen_facets_before, frozen_facets;
  static constexpr std::size_t no_facet = std::size_t(-1); ///< an entry of `frozen_facets_before`
  std::size_t facets_before = 0, facets = 0;               ///< number of facets of the mesh before and after the edit
  std::size_t constrained_edges = 0;                       ///< number in the result; 0 if the mesh was not edited
  /// the triangles that close the result; null if it is closed or was not edited. Pass them to
  /// `Shell_certificate_3::verify()`, `Shell_map_3`, and further edits (`closing`) if border edges were removed.
  std::shared_ptr<const Shell_closing_3> closing;
  std::size_t removed_border_edges = 0; ///< number of border edges that the result lacks (`border_tolerance`)
  Placement_statistics placements;      ///< number of placements that were tried, by verdict
  /// the certificate of the result; with `PARTIALLY_EDITED`, not all of its claims are proved
  Certificate_report certificate;
  /// whether the edit was undone and repeated with a proof for each facet. In the first run, facets were accepted
  /// without a proof if an estimate cleared them, and the certificate failed.
  bool is_repeated = false;
  /// time for the check before the edit, the edit, the certificate, and the location of vertices
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
