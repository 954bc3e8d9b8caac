// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SIMPLIFICATION_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SIMPLIFICATION_REPORT_H

#include <CGAL/Bspline_shell_3/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Status.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Editing
/// what became of a mesh that was to be simplified. Every value but `SUCCESS` means that it is as it was before.
enum class Simplification_status
{
  SUCCESS,               ///< the result is certified
  NO_SHELL,              ///< there is no shell
  NOT_FINITE,            ///< a coordinate is infinite or not a number
  NOT_TRIANGULATED,      ///< the mesh has no facet, or one that is no triangle
  OPEN_MESH,             ///< the mesh has a border
  NOT_IN_SHELL,          ///< a facet is not proved to lie in the shell and to face along the gradient, or a fan winds twice
  NOT_CERTIFIED          ///< all facets are in the shell, but the certificate of the result fails: the report says where
};

/// \ingroup PkgBsplineShell3Editing
/// what is wrong and what can be done about it, in one sentence
inline const char* message(Simplification_status status)
{
  switch(status) {
    case Simplification_status::SUCCESS:
      return "The mesh was simplified, and the result is certified.";
    case Simplification_status::NO_SHELL:
      return "There is no shell: its own status says why.";
    case Simplification_status::NOT_FINITE:
      return "The mesh has vertices whose coordinates are infinite or not a number.";
    case Simplification_status::NOT_TRIANGULATED:
      return "The mesh has no facets, or some that are no triangles: triangulate it (CGAL::Polygon_mesh_processing::triangulate_faces).";
    case Simplification_status::OPEN_MESH:
      return "The mesh is open: close its holes (CGAL::Polygon_mesh_processing::triangulate_hole).";
    case Simplification_status::NOT_IN_SHELL:
      return "The listed facets are not in the shell or face the wrong way, or the facets at the listed vertices fold through themselves: simplify a mesh for which the shell is certified.";
    case Simplification_status::NOT_CERTIFIED:
      return "The certificate of the result fails, as it does for the mesh before: ask for a certified shell of this mesh.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief how the simplification of a mesh went.
 */
struct Simplification_report
{
  Simplification_status status = Simplification_status::NO_SHELL;
  Offending_simplices offending_simplices;      ///< where the mesh is not in the shell
  std::size_t facets_before = 0, facets = 0;    ///< of the mesh
  std::size_t selected = 0;                     ///< edges that were considered, with those considered again
  std::size_t collapsed = 0;                    ///< with those of length zero
  std::size_t retried = 0;                      ///< edges for which another place was accepted than the first one
  Placement_statistics placements;              ///< all that were tried, by verdict
  Certificate_report certificate;               ///< of the result
  /// of the first check; of the collapses; of the certificate
  double check_seconds = 0, collapse_seconds = 0, certificate_seconds = 0;

  double total_seconds() const { return check_seconds + collapse_seconds + certificate_seconds; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SIMPLIFICATION_REPORT_H
