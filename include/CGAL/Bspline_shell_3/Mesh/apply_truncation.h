// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_APPLY_TRUNCATION_H
#define CGAL_BSPLINE_SHELL_3_MESH_APPLY_TRUNCATION_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Mesh/validate_mesh.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Truncates a mesh, and checks the result.
// \param patches the patches that the mesh has
// \pre the mesh is closed, and has no self-intersections: certificates of the truncated mesh do not cover the tips
template <typename ConcurrencyTag>
Mesh_refusal apply_truncation(std::shared_ptr<const Shell_truncation_3> truncation,
                              const Truncation_patches<Mesh_with_origins::Triangle_mesh>& patches, Mesh_with_origins& m)
{
  typedef Mesh_with_origins::Triangle_mesh Mesh;
  typedef Mesh_with_origins::Face_index Face_index;
  typedef Mesh_with_origins::Vertex_index Vertex_index;
  // Facets of origin of the cut facets, and the vertices to be cut off.
  std::vector<std::size_t> origin_of_cut(patches.cut_facets.size(), 0), centers;
  for(std::size_t n = 0; n < origin_of_cut.size(); ++n)
    if(patches.has(n)) origin_of_cut[n] = m.facet_origin[m.mesh.face(patches.cut_facets[n])];
  for(Vertex_index v : patches.centers)
    if(v != Mesh::null_vertex()) centers.push_back(m.vertex_origin[v]);
  const auto refused = [&] { return m.refuse_vertices(Shell_status::NOT_TRUNCATABLE, centers); };
  // Maps to and from an open mesh find its own facets only.
  const auto is_of_closing = [&](std::size_t facet) { return m.part_of_facet(facet) == Surface_part::CLOSING; };
  if(std::any_of(origin_of_cut.begin(), origin_of_cut.end(), is_of_closing)) return refused();
  // Origins are stored in property maps, which follow the elements through the truncation.
  auto facet_origin = m.mesh.add_property_map<Face_index, std::size_t>("f:origin").first;
  auto vertex_origin = m.mesh.add_property_map<Vertex_index, std::size_t>("v:origin").first;
  for(Face_index f : m.mesh.faces()) facet_origin[f] = m.facet_origin[f];
  for(Vertex_index v : m.mesh.vertices()) vertex_origin[v] = m.vertex_origin[v];
  const auto truncated = replace_patches(*truncation, patches, m.mesh, m.mesh.points());
  if(!truncated) return refused();
  for(std::size_t n = 0; n < truncated->facets.size(); ++n) {
    const Face_index f = truncated->facets[n];
    if(f == Mesh::null_face()) continue; // the mesh does not have its patch
    const Shell_truncation_3::New_facet& facet = truncation->new_facets()[n];
    facet_origin[f] = facet.disc == Shell_truncation_3::npos ? origin_of_cut[facet.cut_facet]
                                                             : m.number_of_facet_origins++;
  }
  for(std::size_t n = truncation->number_of_corners(); n < truncated->vertices.size(); ++n)
    if(truncated->vertices[n] != Mesh::null_vertex()) {
      vertex_origin[truncated->vertices[n]] = m.number_of_vertex_origins++;
      m.bbox += m.mesh.point(truncated->vertices[n]).bbox();
    }
  m.mesh.collect_garbage();
  m.facet_origin.resize(m.mesh.number_of_faces());
  m.vertex_origin.resize(m.mesh.number_of_vertices());
  for(Face_index f : m.mesh.faces()) m.facet_origin[f] = facet_origin[f];
  for(Vertex_index v : m.mesh.vertices()) m.vertex_origin[v] = vertex_origin[v];
  m.mesh.remove_property_map(facet_origin);
  m.mesh.remove_property_map(vertex_origin);
  m.truncation = std::move(truncation);
  m.is_embedded.clear();
  return is_closed_surface<ConcurrencyTag>(m) ? Mesh_refusal() : refused();
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_APPLY_TRUNCATION_H
