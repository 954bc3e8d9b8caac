// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_ATTACH_CLOSING_H
#define CGAL_BSPLINE_SHELL_3_MESH_ATTACH_CLOSING_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>

#include <CGAL/boost/graph/helpers.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Closes a mesh, unless it is closed, and checks the result.
// \pre the mesh is validated
template <typename ConcurrencyTag>
Mesh_refusal attach_closing(std::shared_ptr<const Shell_closing_3> closing, Mesh_with_origins& m)
{
  if(CGAL::is_closed(m.mesh)) return Mesh_refusal();
  const std::vector<std::size_t> at_border = facets_at_border(m);
  if(!closing->match_border(m.mesh, m.mesh.points())) return m.refuse_facets(Shell_status::OPEN_MESH, at_border);
  const auto attached = closing->attach(m.mesh, m.mesh.points());
  if(!attached) return m.refuse_facets(Shell_status::NOT_CLOSABLE, at_border);
  m.closing = std::move(closing);
  m.facet_origin.resize(m.mesh.number_of_faces());
  for(auto f : attached->faces) m.facet_origin[f] = m.number_of_facet_origins++;
  m.vertex_origin.resize(m.mesh.number_of_vertices());
  for(auto v : attached->vertices) {
    m.vertex_origin[v] = m.number_of_vertex_origins++;
    m.bbox += m.mesh.point(v).bbox();
  }
  return is_closed_surface<ConcurrencyTag>(m) ? Mesh_refusal() : m.refuse_facets(Shell_status::NOT_CLOSABLE, at_border);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_ATTACH_CLOSING_H
