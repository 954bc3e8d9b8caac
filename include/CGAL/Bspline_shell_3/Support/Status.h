// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_STATUS_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_STATUS_H

#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief The outcome of a request. Every value except `SUCCESS` means that there is no shell.
 */
enum class Shell_status
{
  SUCCESS,
  NOT_BUILT,                ///< nothing was requested yet
  INVALID_PARAMETER,        ///< a parameter value is not allowed (`Shell_report::invalid_parameter`)
  MISSING_FILE,             ///< there is no file of that name
  UNREADABLE_FILE,          ///< the file cannot be opened or read: it is a directory, or permission is denied
  UNSUPPORTED_FILE,         ///< the format, or this variant of it, is not supported
  EMPTY_FILE,               ///< the file has no bytes
  MALFORMED_FILE,           ///< the file does not follow its format, or ends early
  TRIANGLE_STRIPS,          ///< the file holds its facets as triangle strips
  EMPTY_MESH,               ///< the mesh has no facet
  NOT_FINITE,               ///< a coordinate is infinite or not a number
  COORDINATES_OUT_OF_RANGE, ///< coordinates beyond 1e60, or a box smaller than 1e-60: products would over- or underflow
  NON_MANIFOLD,             ///< an edge has more than two facets, or the facets at a vertex do not form one fan
  NOT_ORIENTABLE,           ///< the facets cannot be oriented so that neighbors agree
  OPEN_MESH,                ///< an edge has only one facet
  NOT_CLOSABLE,             ///< the mesh is open, and the triangles that would close it intersect the mesh or each
                            ///< other, wind twice around a vertex, use an interior edge of the mesh, or have no area
  DEGENERATE_FACET,         ///< a facet has no area, or cannot be triangulated without such a facet
  SELF_INTERSECTION,        ///< two facets meet outside of common vertices and edges
  INCONSISTENT_ORIENTATION, ///< the components of the mesh do not bound one volume, or the mesh bounds none
  SINGULAR_VERTEX,          ///< the facets at a vertex face no common direction
  GRID_TOO_FINE,            ///< the cells are too small for the mesh's coordinates
  TOO_MANY_CELLS,           ///< more cells or unknowns than can be numbered
  MEMORY_LIMIT_EXCEEDED,    ///< the cells would need more memory than allowed
  DISTANCE_NOT_FINITE,      ///< the signed-distance oracle returned a value that is infinite or not a number
  SOLVER_FAILED,            ///< the linear solver did not reach its tolerance
  SHELL_REACHES_BOUNDARY,        ///< a bounding surface runs into the end of the cells
  MESH_NOT_CONTAINED,       ///< it could not be proved that the shell contains the mesh
  UNSOUND_ARITHMETIC,       ///< nothing can be proved in this build (`Arithmetic_status`)
  THRESHOLDS_ON_OTHER_CELLS, ///< a threshold is not tricubic on the cells of the field
  CANCELED,                  ///< the visitor stopped the request
  NOT_TRUNCATABLE,           ///< the mesh with discs in place of its tips is not closed, or has a degenerate facet
  TOO_MANY_FACETS,           ///< the mesh has more vertices or edges than can be numbered
  TIME_LIMIT_EXCEEDED        ///< the time limit was reached
};

/// \ingroup PkgBsplineShell3Support
/// Returns a sentence that describes the problem and its remedy.
inline const char* message(Shell_status status)
{
  switch(status) {
    case Shell_status::SUCCESS: return "There is a shell.";
    case Shell_status::NOT_BUILT: return "There is no shell yet.";
    case Shell_status::INVALID_PARAMETER:
      return "A parameter has a value that is not allowed: the report has its name and its bounds "
             "(CGAL::Bspline_shells::Invalid_parameter).";
    case Shell_status::MISSING_FILE: return "There is no such file: check its path.";
    case Shell_status::UNREADABLE_FILE: return "The file cannot be read: it is a directory, or permission is denied.";
    case Shell_status::UNSUPPORTED_FILE:
      return "The format of the file is not supported: save the mesh as OFF, OBJ, PLY or STL.";
    case Shell_status::EMPTY_FILE: return "The file is empty: save the mesh again.";
    case Shell_status::MALFORMED_FILE:
      return "The file does not follow the format of its extension, or ends early: check it, or save the mesh again.";
    case Shell_status::TRIANGLE_STRIPS:
      return "The file holds its facets as triangle strips (tristrips), which are not read: save it with a list of "
             "facets.";
    case Shell_status::EMPTY_MESH: return "The mesh has no facet.";
    case Shell_status::NOT_FINITE:
      return "The mesh has vertices whose coordinates are infinite or not a number: repair or remove them.";
    case Shell_status::COORDINATES_OUT_OF_RANGE:
      return "Coordinates are larger than 1e60, or the mesh is smaller than 1e-60: choose another unit of length.";
    case Shell_status::NON_MANIFOLD:
      return "The mesh is not manifold at the listed facets or vertices: split them, or take a proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::NOT_ORIENTABLE:
      return "The mesh is one-sided, as it has no orientation that neighboring facets share: cut it open, or take a "
             "proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::OPEN_MESH:
      return "The mesh is open at the listed facets: close its holes "
             "(CGAL::Polygon_mesh_processing::triangulate_hole).";
    case Shell_status::NOT_CLOSABLE:
      return "The mesh is open, and cannot be closed, by caps of its holes or a sheet behind it, at the listed facets: "
             "close its holes "
             "(CGAL::Polygon_mesh_processing::triangulate_hole), or take a proxy (CGAL::certified_soup_proxy_3).";
    case Shell_status::DEGENERATE_FACET:
      return "The listed facets have no area: remove them (CGAL::Polygon_mesh_processing::remove_degenerate_faces).";
    case Shell_status::SELF_INTERSECTION:
      return "The mesh intersects itself at the listed facets: repair it, or take a proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::INCONSISTENT_ORIENTATION:
      return "The mesh does not bound one volume: turn the components that contain the listed facets inside out.";
    case Shell_status::SINGULAR_VERTEX:
      return "The facets at the listed vertices face no common direction, so that no field can pass all of them the "
             "same way: move or split "
             "the vertices, or ask for a shell all the same (allow_singular_vertices).";
    case Shell_status::GRID_TOO_FINE:
      return "The cells are too small for coordinates of that size: lower the resolution, or move the mesh towards the "
             "origin.";
    case Shell_status::TOO_MANY_CELLS:
      return "The grid has more cells than can be numbered: lower the resolution or the number of rings.";
    case Shell_status::MEMORY_LIMIT_EXCEEDED:
      return "The cells would need more memory than allowed: lower the resolution or raise the limit.";
    case Shell_status::DISTANCE_NOT_FINITE:
      return "The signed-distance oracle returned a value that is infinite or not a number.";
    case Shell_status::SOLVER_FAILED:
      return "The linear solver did not reach its tolerance: loosen the tolerance, use a direct solver, or raise the "
             "resolution.";
    case Shell_status::SHELL_REACHES_BOUNDARY:
      return "A bounding surface runs into the end of the cells: raise the resolution, or the number of rings of cells "
             "around the mesh.";
    case Shell_status::MESH_NOT_CONTAINED:
      return "No shell was found that contains the mesh: raise the limits of memory and effort, or the resolution.";
    case Shell_status::THRESHOLDS_ON_OTHER_CELLS:
      return "A threshold and the field have different cells: define both on the same cells.";
    case Shell_status::UNSOUND_ARITHMETIC:
      return "Floating point arithmetic is not sound in this build: compile with -frounding-math and without "
             "-ffast-math, as the target "
             "CGAL::CGAL does.";
    case Shell_status::TIME_LIMIT_EXCEEDED:
      return "The time limit was reached before the shell was complete: raise the limit, or ask for a thicker shell.";
    case Shell_status::CANCELED: return "The visitor asked to stop.";
    case Shell_status::NOT_TRUNCATABLE:
      return "The truncation of the shell does not fit the mesh at the listed vertices: build a shell of this mesh.";
    case Shell_status::TOO_MANY_FACETS:
      return "The mesh has more vertices or edges than can be numbered (2^31): simplify it, or split it.";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Support
/// Returns the message of the status; for `INVALID_PARAMETER`, the message of the parameter.
inline std::string message(Shell_status status, const Invalid_parameter& parameter)
{
  return status == Shell_status::INVALID_PARAMETER && parameter ? message(parameter) : message(status);
}

/// \ingroup PkgBsplineShell3Support
/// The part of the examined surface to which a facet belongs.
enum class Surface_part : unsigned char
{
  MESH,    ///< the user's mesh
  CLOSING, ///< the triangles that close an open mesh (`Shell_closing_3`)
  DISC     ///< the triangles that replace tips of the mesh (`Shell_truncation_3`)
};

/// \ingroup PkgBsplineShell3Support
/// Returns the name of a facet of the part, in words.
inline const char* name(Surface_part part)
{
  switch(part) {
    case Surface_part::MESH: return "facet";
    case Surface_part::CLOSING: return "triangle that closes the mesh";
    case Surface_part::DISC: return "triangle that replaces a tip";
  }
  return "";
}

namespace internal {

// Returns the status of a run that ended early.
inline Shell_status status(Run::End end)
{
  return end == Run::End::OUT_OF_TIME ? Shell_status::TIME_LIMIT_EXCEEDED : Shell_status::CANCELED;
}

// Returns true if every further attempt would end with this status, too.
inline bool ends_all_attempts(Shell_status status)
{
  return status == Shell_status::CANCELED || status == Shell_status::TIME_LIMIT_EXCEEDED
         || status == Shell_status::INVALID_PARAMETER || status == Shell_status::UNSOUND_ARITHMETIC;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief The facets and vertices that cause a status: positions in the ranges `faces(mesh)` and `vertices(mesh)`. If a
 * file was read, these are positions among its faces and vertices.
 */
struct Offending_simplices
{
  std::vector<std::size_t> facets;
  std::vector<std::size_t> vertices;
  std::size_t line = 0; ///< first offending line of a text file, counted from 1; 0 if it is unknown
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_STATUS_H
