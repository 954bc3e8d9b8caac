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
  /// facets were frozen (`freeze_rejected_facets(true)`), and the result is not certified; its other facets are
  /// proved to lie in the shell and to face along the gradient
  PARTIALLY_EDITED,
  NO_SHELL,              ///< there is no shell
  INVALID_PARAMETER,     ///< a parameter has an invalid value (`Edit_report::invalid_parameter`)
  MEMORY_LIMIT_EXCEEDED, ///< the result and its certificate would need more memory than allowed
  TIME_LIMIT_EXCEEDED,   ///< the time limit was reached before the result was certified
  NOT_FINITE,            ///< a coordinate is infinite or not a number
  NOT_TRIANGULATED,      ///< the mesh has no facets, or a facet that is not a triangle
  OPEN_MESH,             ///< the mesh has a border, which is not that of its closing, by default the shell's
  NOT_CLOSABLE,          ///< the mesh has the border of its closing, but also an edge of the closing
  /// a facet is not proved to lie in the shell and to face along the gradient, or the facets at a vertex do not wind
  /// around it once; also if the shell's truncation does not fit the mesh
  NOT_IN_SHELL,
  /// no facet was rejected before the edit, but the result could not be certified; the report lists the places
  NOT_CERTIFIED
};

/// \ingroup PkgBsplineShell3Editing
/// returns a sentence that describes the problem and a remedy
inline const char* message(Edit_status status)
{
  switch(status) {
    case Edit_status::SUCCESS: return "The mesh was edited, and the result is certified.";
    case Edit_status::PARTIALLY_EDITED:
      return "The mesh was edited except for the frozen facets, and the result is not certified: only the other facets "
             "are proved to lie in the shell and to face along the gradient.";
    case Edit_status::NO_SHELL: return "There is no shell: see the status of the shell for the reason.";
    case Edit_status::INVALID_PARAMETER:
      return "A parameter value is not allowed: see its name and bounds in the report "
             "(CGAL::Bspline_shells::Invalid_parameter).";
    case Edit_status::MEMORY_LIMIT_EXCEEDED:
      return "The edit would exceed the memory limit: raise the limit (memory_limit), or request longer edges.";
    case Edit_status::TIME_LIMIT_EXCEEDED:
      return "The time limit was reached before the result was certified: raise the limit (time_limit).";
    case Edit_status::NOT_FINITE:
      return "The mesh has vertices with infinite or NaN coordinates: repair or remove them.";
    case Edit_status::NOT_TRIANGULATED:
      return "The mesh has no facets, or facets that are not triangles: triangulate it "
             "(CGAL::Polygon_mesh_processing::triangulate_faces).";
    case Edit_status::OPEN_MESH:
      return "The mesh is open, and its border is not that of the shell: close its holes "
             "(CGAL::Polygon_mesh_processing::triangulate_hole), use the shell of a mesh with the same border "
             "(CGAL::certified_bspline_shell_3), or pass the triangles that close the mesh (closing).";
    case Edit_status::NOT_CLOSABLE:
      return "In addition to its border, the mesh shares an edge with the triangles that close it: edit a mesh without "
             "this edge.";
    case Edit_status::NOT_IN_SHELL:
      return "The mesh is not proved to lie in the shell and to face along the gradient at the listed facets and "
             "vertices: edit a mesh for which the shell is certified, or freeze these facets (freeze_rejected_facets).";
    case Edit_status::NOT_CERTIFIED:
      return "The result was not certified, so the mesh is unchanged: see the witnesses in the report, and build a "
             "certified shell for this mesh.";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_STATUS_H
