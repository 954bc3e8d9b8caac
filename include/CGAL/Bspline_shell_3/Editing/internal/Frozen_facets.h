// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_FACETS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_FACETS_H

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <unordered_set>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Facets of a mesh that edits leave alone, with their vertices and edges. So they keep their descriptors.
template <typename TriangleMesh>
class Frozen_facets
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
public:
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

  explicit Frozen_facets(const TriangleMesh& mesh) : m_mesh(&mesh) {}

  // adds a facet; whether it is new
  bool freeze(face_descriptor f)
  {
    if(!m_facets.insert(f).second) return false;
    for(vertex_descriptor v : CGAL::vertices_around_face(halfedge(f, *m_mesh), *m_mesh)) m_vertices.insert(v);
    return true;
  }

  bool empty() const { return m_facets.empty(); }
  std::size_t size() const { return m_facets.size(); }
  bool has_facet(face_descriptor f) const { return !empty() && m_facets.count(f) > 0; }
  bool has_vertex(vertex_descriptor v) const { return !empty() && m_vertices.count(v) > 0; }
  bool has_edge(edge_descriptor e) const
  {
    const auto h = halfedge(e, *m_mesh);
    return !empty() && (has_facet(face(h, *m_mesh)) || has_facet(face(opposite(h, *m_mesh), *m_mesh)));
  }
  bool has_end_of(edge_descriptor e) const { return !empty() && (has_vertex(source(e, *m_mesh)) || has_vertex(target(e, *m_mesh))); }

private:
  const TriangleMesh* m_mesh;
  std::unordered_set<face_descriptor> m_facets;
  std::unordered_set<vertex_descriptor> m_vertices;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_FACETS_H
