// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_EDIT_RESULT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_EDIT_RESULT_H

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief a report, and where the vertices went.
 *
 * `images` and `locations` have descriptors of the result as it is. `Surface_mesh::collect_garbage()` makes them
 * invalid, as it renumbers vertices and facets: use them before.
 *
 * \tparam Report `Simplification_report` or `Remeshing_report`
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename Report, typename TriangleMesh>
struct Edit_result : Report
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  /// facet and barycentric coordinates: a `CGAL::Polygon_mesh_processing::Face_location`
  typedef std::pair<face_descriptor, std::array<double, 3> > Location;

  /// for each vertex that the mesh had, in the order of `vertices(mesh)`, the vertex of the result into which it was
  /// collapsed, or which it still is; empty if the mesh was not edited. It is always found, and costs next to nothing,
  /// but says nothing of places: vertices move when edges are collapsed, and when they are relaxed.
  std::vector<vertex_descriptor> images;

  /// with `locate_vertices(true)`: for each vertex that the mesh had, in the order of `vertices(mesh)`, where on the
  /// result the integral curve through its former place leads, as `Shell_map_3` from the mesh before to the result
  /// would find it. The facet is null where none was found. Empty if the mesh was not edited, or if not asked for.
  std::vector<Location> locations;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_RESULT_H
