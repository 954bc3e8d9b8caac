// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_VERTEX_IMAGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_VERTEX_IMAGES_H

#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// For each original vertex of a mesh, the vertex into which it was collapsed. Original vertices with the same image
// form a ring. New vertices may reuse the descriptors of removed ones.
template <typename TriangleMesh>
class Vertex_images
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
public:
  // \param mesh not constant: dynamic maps of constant meshes may not grow
  Vertex_images(TriangleMesh& mesh, const std::vector<vertex_descriptor>& originals)
    : m_mesh(mesh), m_first(get(dynamic_vertex_property_t<std::size_t>(), mesh))
  {
    for(vertex_descriptor v : vertices(mesh)) put(m_first, v, none);
    for(vertex_descriptor v : originals) {
      put(m_first, v, m_next.size());
      m_next.push_back(m_next.size());
    }
  }

  void add_vertex(vertex_descriptor v) { put(m_first, v, none); }

  // Must be called before a vertex is removed in favor of another. Two rings are joined by exchanging the successors of
  // two vertices.
  void collapse(vertex_descriptor removed, vertex_descriptor kept)
  {
    const std::size_t from = get(m_first, removed), to = get(m_first, kept);
    if(from == none) return;
    if(to == none) put(m_first, kept, from);
    else std::swap(m_next[from], m_next[to]);
  }

  // Returns the images in the order of the original vertices.
  std::vector<vertex_descriptor> all() const
  {
    std::vector<vertex_descriptor> images(m_next.size());
    for(vertex_descriptor v : vertices(m_mesh)) {
      std::size_t n = get(m_first, v);
      if(n == none) continue;
      do {
        images[n] = v;
        n = m_next[n];
      } while(n != get(m_first, v));
    }
    return images;
  }

private:
  static constexpr std::size_t none = std::size_t(-1);

  const TriangleMesh& m_mesh;
  // by vertex of the mesh: the first original vertex of its ring, by number, or none
  typename boost::property_map<TriangleMesh, dynamic_vertex_property_t<std::size_t> >::type m_first;
  std::vector<std::size_t> m_next; // by original vertex, in its ring
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_VERTEX_IMAGES_H
