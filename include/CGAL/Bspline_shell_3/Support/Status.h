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
 * \brief the outcome of reading a mesh, or of building or examining a shell. Unless it is `SUCCESS`, there is no
 * result.
 */
enum class Shell_status
{
  SUCCESS,
  NOT_BUILT,                ///< no shell or mesh was built or read yet
  INVALID_PARAMETER,        ///< a parameter value is not allowed (`Shell_report::invalid_parameter`)
  MISSING_FILE,             ///< there is no file with this name
  UNREADABLE_FILE,          ///< the file cannot be opened or read: it is a directory, or permission is denied
  UNSUPPORTED_FILE,         ///< the format, or this variant of it, is not supported
  EMPTY_FILE,               ///< the file has no bytes
  MALFORMED_FILE,           ///< the file does not follow its format, or ends early
  TRIANGLE_STRIPS,          ///< the file stores its facets as triangle strips
  EMPTY_MESH,               ///< the mesh has no facets
  NOT_FINITE,               ///< a coordinate is infinite or not a number
  COORDINATES_OUT_OF_RANGE, ///< coordinates beyond 1e60, or a box smaller than 1e-60: products would over- or underflow
  NON_MANIFOLD,             ///< an edge has more than two facets, or the facets at a vertex do not form one fan
  NOT_ORIENTABLE,           ///< the facets cannot be oriented consistently
  OPEN_MESH,                ///< an edge has only one facet
  NOT_CLOSABLE,             ///< the mesh is open, and neither caps of its holes nor a sheet behind it can close it
  DEGENERATE_FACET,         ///< a facet has no area, or cannot be triangulated without such a facet
  SELF_INTERSECTION,        ///< two facets meet outside of common vertices and edges
  INCONSISTENT_ORIENTATION, ///< the components of the mesh do not bound one volume, or the mesh bounds none
  SINGULAR_VERTEX,          ///< the facets at a vertex face no common direction
  GRID_TOO_FINE,            ///< the cells are too small for the mesh's coordinates
  TOO_MANY_CELLS,           ///< more cells or unknowns than can be numbered
  MEMORY_LIMIT_EXCEEDED,    ///< the memory limit would be exceeded
  DISTANCE_NOT_FINITE,      ///< the signed-distance oracle returned a value that is infinite or not a number
  SOLVER_FAILED,            ///< the linear solver failed, or did not reach its tolerance
  SHELL_REACHES_BOUNDARY,   ///< the inner or the outer surface of the shell reaches the boundary of the cells
  MESH_NOT_CONTAINED,       ///< it could not be proved that the shell contains the mesh
  UNSOUND_ARITHMETIC,       ///< rounding errors are not bounded in this build, or on this machine (`Arithmetic_status`)
  THRESHOLDS_ON_OTHER_CELLS, ///< a threshold is not a tricubic function on the cells of the field
  CANCELED,                  ///< the visitor canceled the computation
  NOT_TRUNCATABLE,           ///< the shell's discs do not fit the mesh: with them, it is open or has a degenerate facet
  TOO_MANY_FACETS,           ///< the mesh has more vertices or edges than can be numbered
  TIME_LIMIT_EXCEEDED        ///< the time limit was reached
};

/// \ingroup PkgBsplineShell3Support
/// returns a sentence that describes the problem and, for most values, a remedy
inline const char* message(Shell_status status)
{
  switch(status) {
    case Shell_status::SUCCESS: return "The shell was built.";
    case Shell_status::NOT_BUILT: return "No shell has been built yet.";
    case Shell_status::INVALID_PARAMETER:
      return "A parameter value is not allowed: see its name and bounds in the report "
             "(CGAL::Bspline_shells::Invalid_parameter).";
    case Shell_status::MISSING_FILE: return "The file does not exist: check its path.";
    case Shell_status::UNREADABLE_FILE:
      return "The file cannot be read: check its permissions, and that it is not a directory.";
    case Shell_status::UNSUPPORTED_FILE:
      return "The file format or this variant of it is not supported: save the mesh as ASCII OFF, OBJ, PLY or STL.";
    case Shell_status::EMPTY_FILE: return "The file is empty: save the mesh again.";
    case Shell_status::MALFORMED_FILE:
      return "The file does not follow the format of its extension, or is truncated: check it, or save the mesh again.";
    case Shell_status::TRIANGLE_STRIPS:
      return "The file stores its facets as triangle strips, which are not supported: save the mesh with a list of "
             "facets.";
    case Shell_status::EMPTY_MESH:
      return "The mesh has no facets: check that the input contains polygons with three or more points and a positive "
             "area.";
    case Shell_status::NOT_FINITE:
      return "The mesh has vertices with infinite or NaN coordinates: repair or remove them.";
    case Shell_status::COORDINATES_OUT_OF_RANGE:
      return "Coordinates exceed 1e60, or the bounding box is smaller than 1e-60: choose another unit of length.";
    case Shell_status::NON_MANIFOLD:
      return "The mesh is not manifold at the listed facets or vertices: separate the parts that meet there, or build "
             "a proxy (CGAL::certified_soup_proxy_3).";
    case Shell_status::NOT_ORIENTABLE:
      return "The mesh is not orientable, so its facets cannot be oriented consistently: cut it open, or build a proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::OPEN_MESH:
      return "The mesh is open at the listed facets: close its holes "
             "(CGAL::Polygon_mesh_processing::triangulate_hole), or use the shell of a mesh with the same border "
             "(CGAL::certified_bspline_shell_3).";
    case Shell_status::NOT_CLOSABLE:
      return "The mesh is open, and neither caps of its holes nor a sheet behind it can close it at the listed facets: "
             "close its holes (CGAL::Polygon_mesh_processing::triangulate_hole), or build a proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::DEGENERATE_FACET:
      return "The listed facets have no area, or are too small for their coordinates: remove them "
             "(CGAL::Polygon_mesh_processing::remove_degenerate_faces).";
    case Shell_status::SELF_INTERSECTION:
      return "The mesh intersects itself at the listed facets: repair it, or build a proxy "
             "(CGAL::certified_soup_proxy_3).";
    case Shell_status::INCONSISTENT_ORIENTATION:
      return "The components of the mesh do not bound one volume: reverse the components that contain the listed "
             "facets (CGAL::Polygon_mesh_processing::orient_to_bound_a_volume).";
    case Shell_status::SINGULAR_VERTEX:
      return "The facets at the listed vertices face no common direction, so no field can increase across all of them: "
             "move or split these vertices, or accept them (allow_singular_vertices).";
    case Shell_status::GRID_TOO_FINE:
      return "The cells, or the offset of the proxy, are too small for coordinates of this size: lower the resolution, "
             "increase the offset, or move the mesh to the origin.";
    case Shell_status::TOO_MANY_CELLS:
      return "The grid would have more cells or unknowns than can be numbered: lower the resolution or the number of "
             "rings (number_of_rings).";
    case Shell_status::MEMORY_LIMIT_EXCEEDED:
      return "The construction would exceed the memory limit: raise the limit (memory_limit), lower the resolution, "
             "or, for a proxy, increase alpha.";
    case Shell_status::DISTANCE_NOT_FINITE:
      return "The signed-distance oracle returned an infinite or NaN value: return a finite distance at every point.";
    case Shell_status::SOLVER_FAILED:
      return "The linear solver failed: loosen its tolerance, use another solver (spd_solver), or raise the "
             "resolution.";
    case Shell_status::SHELL_REACHES_BOUNDARY:
      return "A bounding surface leaves the cells of the field: raise the resolution, or the number of rings of cells "
             "around the mesh (number_of_rings).";
    case Shell_status::MESH_NOT_CONTAINED:
      return "No shell was proved to contain the mesh: raise the resolution, or the limits of memory and effort "
             "(memory_limit, effort_limit).";
    case Shell_status::THRESHOLDS_ON_OTHER_CELLS:
      return "A threshold and the field have different cells: define both on the same cells.";
    case Shell_status::UNSOUND_ARITHMETIC:
      return "Floating-point arithmetic is unsound in this build: compile with -frounding-math and without "
             "-ffast-math, as the CMake target CGAL::CGAL does.";
    case Shell_status::TIME_LIMIT_EXCEEDED:
      return "The time limit was reached before the shell was complete: raise the limit (time_limit), lower the "
             "resolution, or limit the effort instead (effort_limit) to get a list of obstacles.";
    case Shell_status::CANCELED: return "The visitor canceled the computation.";
    case Shell_status::NOT_TRUNCATABLE:
      return "The truncation of the shell does not fit the mesh at the listed vertices: build a shell for this mesh.";
    case Shell_status::TOO_MANY_FACETS:
      return "The mesh has more vertices or edges than can be numbered (about 2^31): simplify it, or split it.";
  }
  return "";
}

/// \ingroup PkgBsplineShell3Support
/// returns the message of the status; for `INVALID_PARAMETER`, the message of the parameter
inline std::string message(Shell_status status, const Invalid_parameter& parameter)
{
  return status == Shell_status::INVALID_PARAMETER && parameter ? message(parameter) : message(status);
}

/// \ingroup PkgBsplineShell3Support
/// whether a facet belongs to the user's mesh, or was added internally
enum class Surface_part : unsigned char
{
  MESH,    ///< the user's mesh
  CLOSING, ///< triangles that close an open mesh (`Shell_closing_3`)
  DISC     ///< triangles that replace tips of the mesh (`Shell_truncation_3`)
};

/// \ingroup PkgBsplineShell3Support
/// returns the name of a facet of the part, in words
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

// Returns whether every further attempt would end with this status as well.
inline bool ends_all_attempts(Shell_status status)
{
  return status == Shell_status::CANCELED || status == Shell_status::TIME_LIMIT_EXCEEDED
         || status == Shell_status::INVALID_PARAMETER || status == Shell_status::UNSOUND_ARITHMETIC;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief the facets and vertices that cause a status: positions, counted from 0, in `faces(mesh)` and `vertices(mesh)`
 * or, if a file was read, among its faces and vertices.
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
