// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CHECK_EMBEDDING_H
#define CGAL_BSPLINE_SHELL_3_MESH_CHECK_EMBEDDING_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Facets must not intersect, except along common edges and vertices.
template <typename ConcurrencyTag>
Mesh_refusal check_intersections(Mesh_with_origins& m)
{
  constexpr unsigned int max_pairs = 1000; // overlapping meshes may have a quadratic number of pairs
  m.is_embedded = embedded_fans<ConcurrencyTag>(m.mesh);
  std::vector<std::size_t> facets, with_closing;
  for(const auto& pair : intersecting_facets<ConcurrencyTag>(m.mesh, m.is_embedded, max_pairs)) {
    const std::size_t f = m.facet_origin[pair.first], g = m.facet_origin[pair.second];
    auto& found = f < m.user_facets && g < m.user_facets ? facets : with_closing;
    found.push_back(f);
    found.push_back(g);
  }
  return facets.empty() ? m.refuse_facets_if_any(Shell_status::NOT_CLOSABLE, std::move(with_closing))
                        : m.refuse_facets(Shell_status::SELF_INTERSECTION, std::move(facets));
}

// The facets at each vertex must face a common direction.
template <typename ConcurrencyTag>
Mesh_refusal check_vertices(const Mesh_with_origins& m)
{
  constexpr std::size_t chunk = 1024;
  return m.refuse_vertices_if_any(
    Shell_status::SINGULAR_VERTEX,
    collect_from_chunks<ConcurrencyTag, std::size_t>(
      m.mesh.number_of_vertices(), chunk, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
        for(std::size_t n = begin; n < end; ++n) {
          const Mesh_with_origins::Vertex_index v(static_cast<unsigned int>(n));
          const bool is_regular = (!m.is_embedded.empty() && m.is_embedded[n]) || m.mesh.is_isolated(v)
                                  || vertex_cone(m.mesh, v);
          if(!is_regular) found.push_back(m.vertex_origin[n]);
        }
      }));
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CHECK_EMBEDDING_H
