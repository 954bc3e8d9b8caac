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

// Facets of a mesh that edits do not change, with their vertices and edges. They keep their descriptors. Facets that
// close the mesh are less restrictive: edges may be collapsed into their vertices, and along the border of the mesh.
template <typename TriangleMesh>
class Frozen_facets
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
public:
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;

  explicit Frozen_facets(const TriangleMesh& mesh) : m_mesh(&mesh) {}

  // Adds a facet. Returns whether it is new.
  bool freeze(face_descriptor f)
  {
    if(!m_facets.insert(f).second) return false;
    for(vertex_descriptor v : CGAL::vertices_around_face(halfedge(f, *m_mesh), *m_mesh)) m_vertices.insert(v);
    return true;
  }

  // Adds a facet that closes the mesh.
  void close(face_descriptor f)
  {
    m_closing.insert(f);
    for(vertex_descriptor v : CGAL::vertices_around_face(halfedge(f, *m_mesh), *m_mesh)) m_fixed.insert(v);
  }

  // These functions ignore facets that close the mesh.
  bool empty() const { return m_facets.empty(); }
  std::size_t size() const { return m_facets.size(); }
  bool has_facet(face_descriptor f) const { return !empty() && m_facets.count(f) > 0; }
  bool has_vertex(vertex_descriptor v) const { return !empty() && m_vertices.count(v) > 0; }

  std::size_t number_of_closing_facets() const { return m_closing.size(); }
  bool closes(face_descriptor f) const { return !m_closing.empty() && m_closing.count(f) > 0; }
  // Returns whether an edge does not belong to the open mesh.
  bool closes(edge_descriptor e) const
  {
    const auto h = halfedge(e, *m_mesh);
    return closes(face(h, *m_mesh)) && closes(face(opposite(h, *m_mesh), *m_mesh));
  }
  // Returns whether a vertex must not move because a facet at it closes the mesh. An edge at it may be collapsed, so
  // that another vertex takes its place.
  bool is_fixed(vertex_descriptor v) const { return !m_closing.empty() && m_fixed.count(v) > 0; }
  // Must be called before an edge collapse removes a facet.
  void remove(face_descriptor f) { m_closing.erase(f); }
  // Must be called when an edge collapse has put `v` in the place of `w`.
  void replace(vertex_descriptor w, vertex_descriptor v)
  {
    if(is_fixed(w) && m_fixed.erase(w) > 0) m_fixed.insert(v);
  }
  // Returns whether an edge belongs to a frozen facet.
  bool is_frozen(edge_descriptor e) const
  {
    const auto h = halfedge(e, *m_mesh);
    return has_facet(face(h, *m_mesh)) || has_facet(face(opposite(h, *m_mesh), *m_mesh));
  }
  // Returns whether an edge belongs to a facet that closes the mesh.
  bool is_at_closing(edge_descriptor e) const
  {
    const auto h = halfedge(e, *m_mesh);
    return closes(face(h, *m_mesh)) || closes(face(opposite(h, *m_mesh), *m_mesh));
  }
  // Returns whether an edge belongs to a facet that is frozen or closes the mesh.
  bool has_edge(edge_descriptor e) const { return is_frozen(e) || is_at_closing(e); }
  bool has_end_of(edge_descriptor e) const
  {
    return !empty() && (has_vertex(source(e, *m_mesh)) || has_vertex(target(e, *m_mesh)));
  }

private:
  const TriangleMesh* m_mesh;
  std::unordered_set<face_descriptor> m_facets, m_closing;
  std::unordered_set<vertex_descriptor> m_vertices, m_fixed;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FROZEN_FACETS_H
