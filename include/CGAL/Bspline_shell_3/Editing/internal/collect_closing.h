// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLECT_CLOSING_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLECT_CLOSING_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the facets that close a mesh as a closing. They are ordered so that they can be added to the mesh one by one:
// each shares an edge with the border of the mesh or with an earlier one.
// \param facets these facets, in any order
// \param kinds their kinds
// pre: each of these facets is connected to the mesh by others
template <typename TriangleMesh, typename VertexPointMap>
Shell_closing_3 collect_closing(const TriangleMesh& mesh, VertexPointMap vpm,
                                const std::vector<typename boost::graph_traits<TriangleMesh>::face_descriptor>& facets,
                                const std::vector<Shell_closing_3::Kind>& kinds)
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  typedef Shell_closing_3::Index Index;
  std::unordered_map<face_descriptor, Shell_closing_3::Kind> kind;
  for(std::size_t n = 0; n < facets.size(); ++n) kind.emplace(facets[n], kinds[n]);
  std::vector<face_descriptor> ordered;
  std::unordered_map<face_descriptor, Shell_closing_3::Kind> left = kind;
  const auto add = [&](face_descriptor f) {
    if(left.erase(f) > 0) ordered.push_back(f);
  };
  std::vector<Shell_closing_3::Point> points;
  std::unordered_map<vertex_descriptor, Index> index;
  const auto add_point = [&](vertex_descriptor v) {
    if(index.emplace(v, Index(points.size())).second) points.push_back(rounded_coordinates(get(vpm, v)));
  };
  for(face_descriptor f : facets)
    for(auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
      if(kind.count(face(opposite(h, mesh), mesh)) > 0) continue;
      add(f);
      add_point(source(h, mesh));
      add_point(target(h, mesh));
    }
  const std::size_t border = points.size();
  for(std::size_t n = 0; n < ordered.size(); ++n)
    for(auto h : CGAL::halfedges_around_face(halfedge(ordered[n], mesh), mesh)) add(face(opposite(h, mesh), mesh));
  std::vector<Shell_closing_3::Triangle> triangles;
  std::vector<Shell_closing_3::Kind> ordered_kinds;
  for(face_descriptor f : ordered) {
    const auto h = halfedge(f, mesh);
    const vertex_descriptor corners[] = { source(h, mesh), target(h, mesh), target(next(h, mesh), mesh) };
    for(vertex_descriptor v : corners) add_point(v);
    triangles.push_back({ index.at(corners[0]), index.at(corners[1]), index.at(corners[2]) });
    ordered_kinds.push_back(kind.at(f));
  }
  return Shell_closing_3(std::move(points), border, std::move(triangles), std::move(ordered_kinds));
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLECT_CLOSING_H
