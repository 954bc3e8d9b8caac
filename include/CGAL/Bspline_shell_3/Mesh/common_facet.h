// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_COMMON_FACET_H
#define CGAL_BSPLINE_SHELL_3_MESH_COMMON_FACET_H

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <array>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Locations on triangle meshes follow the convention of Polygon_mesh_processing: a facet, and barycentric coordinates
// for source(h), target(h), and target(next(h)) of its halfedge h.

// Returns the halfedge from corner i of a facet to the next corner.
template <typename TriangleMesh>
typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_at_corner(
  const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::face_descriptor f, int i)
{
  auto h = halfedge(f, mesh);
  for(; i > 0; --i) h = next(h, mesh);
  return h;
}

// Returns the index of the corner at the source of a halfedge, in the facet of the halfedge.
template <typename TriangleMesh>
int corner_at_source(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h)
{
  const auto first = halfedge(face(h, mesh), mesh);
  return h == first ? 0 : h == next(first, mesh) ? 1 : 2;
}

// Calls visit(l) for the location l of a point in each facet that contains it, until this returns true. Returns whether
// it did. A coordinate that is exactly 0 means that the point is on the opposite edge.
template <typename TriangleMesh, typename Location, typename Visitor>
bool visit_locations(const TriangleMesh& mesh, const Location& location, const Visitor& visit)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  const auto& w = location.second;
  const int zeros = int(std::count(w.begin(), w.end(), 0.));
  if(zeros == 2) {
    const int corner = int(std::max_element(w.begin(), w.end()) - w.begin());
    const auto incoming = halfedge_at_corner(mesh, location.first, (corner + 2) % 3);
    for(auto h : CGAL::halfedges_around_target(incoming, mesh)) {
      if(face(h, mesh) == Graph_traits::null_face()) continue;
      Location other(face(h, mesh), {});
      other.second[std::size_t(corner_at_source(mesh, next(h, mesh)))] = w[std::size_t(corner)];
      if(visit(other)) return true;
    }
    return false;
  }
  if(visit(location)) return true;
  if(zeros != 1) return false;
  const int i = (int(std::find(w.begin(), w.end(), 0.) - w.begin()) + 1) % 3;
  const auto h = opposite(halfedge_at_corner(mesh, location.first, i), mesh);
  if(face(h, mesh) == Graph_traits::null_face()) return false;
  Location other(face(h, mesh), {});
  const int j = corner_at_source(mesh, h);
  other.second[std::size_t(j)] = w[std::size_t((i + 1) % 3)];
  other.second[std::size_t((j + 1) % 3)] = w[std::size_t(i)];
  return visit(other);
}

// If two points lie in a common facet, replaces their locations by those in such a facet, and returns true.
template <typename TriangleMesh, typename Location>
bool move_to_common_facet(const TriangleMesh& mesh, Location& a, Location& b)
{
  if(a.first == b.first) return true;
  return visit_locations(mesh, Location(a), [&](const Location& of_a) {
    return visit_locations(mesh, Location(b), [&](const Location& of_b) {
      if(of_a.first != of_b.first) return false;
      a = of_a;
      b = of_b;
      return true;
    });
  });
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_COMMON_FACET_H
