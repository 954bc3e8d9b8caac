// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_CUT_REPORT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_CUT_REPORT_H

#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Editing
/// the outcome of `cut_along_polylines()`. The mesh is unchanged unless the value is `SUCCESS`.
enum class Cut_status
{
  SUCCESS,          ///< the polylines are sequences of edges
  NO_SHELL,         ///< there is no shell
  NOT_TRIANGULATED, ///< the mesh has no facets, or a facet that is not a triangle
  INVALID_LOCATION, ///< barycentric coordinates are negative or NaN, or their sum differs from 1
  NO_COMMON_FACET,  ///< consecutive vertices of a polyline do not lie in a common facet
  FACET_TURNS,      ///< a new facet would have no area or face the wrong way, because its vertices are rounded
  NOT_CERTIFIED     ///< the result is not certified
};

/// \ingroup PkgBsplineShell3Editing
/// returns a sentence that describes the problem and a remedy
inline const char* message(Cut_status status)
{
  switch(status) {
    case Cut_status::SUCCESS: return "The polylines are sequences of edges.";
    case Cut_status::NO_SHELL: return "There is no shell: see the status of the shell for the reason.";
    case Cut_status::NOT_TRIANGULATED:
      return "The mesh has no facets, or facets that are not triangles: triangulate it "
             "(CGAL::Polygon_mesh_processing::triangulate_faces).";
    case Cut_status::INVALID_LOCATION:
      return "A vertex of a polyline is not in its facet: pass barycentric coordinates that are not negative and have "
             "the sum one (CGAL::Polygon_mesh_processing::Face_location).";
    case Cut_status::NO_COMMON_FACET:
      return "Consecutive vertices of a polyline do not lie in a common facet: insert a vertex at each edge that the "
             "polyline crosses, or use the parts of an image (CGAL::Bspline_shells::map_polyline).";
    case Cut_status::FACET_TURNS:
      return "A new facet would be so narrow that rounding turns it, so the mesh is unchanged: map the polylines with "
             "a "
             "larger tolerance, or without vertices so close to each other.";
    case Cut_status::NOT_CERTIFIED:
      return "The result was not certified, so the mesh is unchanged: verify the mesh before it is cut "
             "(CGAL::Bspline_shells::Shell_certificate_3), and do not cut its border edges.";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the report of `cut_along_polylines()`.
 */
struct Cut_report
{
  Cut_status status = Cut_status::NO_SHELL;
  /// with `INVALID_LOCATION` or `NO_COMMON_FACET`: number of the polyline, and of the first of its vertices concerned
  std::size_t polyline = 0, vertex = 0;
  std::size_t facets_before = 0, facets = 0; ///< number of facets of the mesh before and after the cut
  std::size_t cut_facets = 0;                ///< number of facets that were replaced by smaller ones
  std::size_t cut_edges = 0;                 ///< number of edges of the result on polylines
  /// number of vertices where polylines cross each other inside facets; they have no vertex of their own there
  std::size_t crossings = 0;
  Certificate_report certificate; ///< the certificate of the result, if a shell was passed

  explicit operator bool() const { return status == Cut_status::SUCCESS; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_CUT_REPORT_H
