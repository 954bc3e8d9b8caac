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
 * \brief the result of an edit: its report, and two maps from the vertices of the original mesh to the result.
 *
 * `images` and `locations` contain descriptors of the result as it is returned. `Surface_mesh::collect_garbage()`
 * renumbers vertices and facets, and thus invalidates them.
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

  /// vertices of the result into which the vertices of the original mesh were collapsed, or these vertices themselves,
  /// in the order of `vertices(mesh)`; empty if the mesh was not edited. Such a vertex may be far from the location
  /// below: vertices move when edges are collapsed, and when vertices are relaxed.
  std::vector<vertex_descriptor> images;

  /// locations where the integral curves through the original positions of the vertices of the original mesh meet the
  /// result, in the order of `vertices(mesh)`; computed with `locate_vertices(true)`. A location is the vertex's image
  /// under the `Shell_map_3` from the original mesh to the result. The facet is null if no image was found. If border
  /// edges were removed, and a curve meets the closing of the result instead, the location is the nearest point of the
  /// border. Empty if the mesh was not edited.
  std::vector<Location> locations;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_RESULT_H
