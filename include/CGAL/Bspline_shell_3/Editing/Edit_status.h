// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_EDIT_STATUS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_EDIT_STATUS_H

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Editing
/// the outcome of the simplification or remeshing of a mesh. The mesh is unchanged unless the value is `SUCCESS` or
/// `PARTIALLY_EDITED`.
enum class Edit_status
{
  SUCCESS, ///< the result is certified
  /// with `freeze_rejected_facets(true)`: facets were frozen, and the result is not certified. The other facets are
  /// proved to lie in the shell and to face along the gradient
  PARTIALLY_EDITED,
  NO_SHELL,              ///< there is no shell
  INVALID_PARAMETER,     ///< a parameter has an invalid value (`Edit_report::invalid_parameter`)
  MEMORY_LIMIT_EXCEEDED, ///< the result and its certificate would need more memory than allowed
  TIME_LIMIT_EXCEEDED,   ///< the time limit was reached before the result was certified
  NOT_FINITE,            ///< a coordinate is infinite or not a number
  NOT_TRIANGULATED,      ///< the mesh has no facet, or a facet that is not a triangle
  OPEN_MESH,             ///< the mesh has a border
  NOT_CLOSABLE,          ///< the mesh has the border of the shell, but also an edge of the shell's closing
  NOT_IN_SHELL, ///< a facet is not proved to lie in the shell and to face along the gradient, or a fan winds twice
  /// no facet was rejected before the edit, but the certificate of the result fails; the report lists the places
  NOT_CERTIFIED
};

/// \ingroup PkgBsplineShell3Editing
/// returns one sentence that describes the problem and a remedy
inline const char* message(Edit_status status)
{
  switch(status) {
    case Edit_status::SUCCESS: return "The mesh was edited, and the result is certified.";
    case Edit_status::PARTIALLY_EDITED:
      return "The mesh was edited except for the frozen facets, and is not certified: only its other facets are proved "
             "to lie in the shell and "
             "to face along the gradient.";
    case Edit_status::NO_SHELL: return "There is no shell: its own status says why.";
    case Edit_status::INVALID_PARAMETER:
      return "A parameter has a value that is not allowed: the report has its name and its bounds "
             "(CGAL::Bspline_shells::Invalid_parameter).";
    case Edit_status::MEMORY_LIMIT_EXCEEDED:
      return "The result would need more memory than allowed: ask for longer edges, or raise the limit (memory_limit).";
    case Edit_status::TIME_LIMIT_EXCEEDED:
      return "The time limit was reached before the result was certified: raise the limit (time_limit).";
    case Edit_status::NOT_FINITE: return "The mesh has vertices whose coordinates are infinite or not a number.";
    case Edit_status::NOT_TRIANGULATED:
      return "The mesh has no facets, or some that are no triangles: triangulate it "
             "(CGAL::Polygon_mesh_processing::triangulate_faces).";
    case Edit_status::OPEN_MESH:
      return "The mesh is open: close its holes (CGAL::Polygon_mesh_processing::triangulate_hole).";
    case Edit_status::NOT_CLOSABLE:
      return "The mesh has the border of the shell, but also an edge of the shell's closing: edit a mesh without this "
             "edge.";
    case Edit_status::NOT_IN_SHELL:
      return "The mesh is not the one that the shell truncates, or its listed facets are not in the shell or face the "
             "wrong way, "
             "or the facets at the listed vertices fold through themselves: edit "
             "a mesh for which the shell is certified, or leave these facets as they are (freeze_rejected_facets).";
    case Edit_status::NOT_CERTIFIED:
      return "The certificate of the result fails, as it does for the mesh before, at the places that its witnesses "
             "have: ask for a "
             "certified shell of this mesh.";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_STATUS_H
