// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_TRUNCATED_FOR_EDIT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_TRUNCATED_FOR_EDIT_H

#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/boost/graph/iterator.h>

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Truncates a mesh as in its shell, and stores the original positions of the elements of the truncated mesh.
template <typename TriangleMesh>
class Mesh_truncated_for_edit
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
public:
  // Returns false if the truncation fails; the mesh must not be used then.
  // \param all the vertices in the order of `vertices(mesh)`; removed vertices are replaced by vertices nearby
  template <typename VertexPointMap>
  bool truncate(const Shell_truncation_3& truncation, TriangleMesh& mesh, VertexPointMap vpm,
                std::vector<vertex_descriptor>& all)
  {
    const auto in_mesh = truncation.match(mesh, vpm);
    const auto none_there = boost::graph_traits<TriangleMesh>::null_halfedge();
    const auto is_there = [&](std::size_t f) { return in_mesh[f] != none_there; };
    std::unordered_map<vertex_descriptor, std::size_t> disc_of; // by center
    for(std::size_t d = 0; d < truncation.discs().size(); ++d) {
      const std::size_t f = truncation.discs()[d].facets.front();
      if(!is_there(f)) continue;
      auto h = in_mesh[f];
      for(int i = 0; truncation.cut_facets()[f][i] != truncation.discs()[d].center; ++i) h = next(h, mesh);
      disc_of.emplace(source(h, mesh), d);
    }
    if(disc_of.empty()) return true;
    for(face_descriptor f : faces(mesh)) m_facets.emplace(f, m_facets.size());
    for(vertex_descriptor v : vertices(mesh)) m_vertices.emplace(v, m_vertices.size());
    std::vector<std::size_t> cut(in_mesh.size(), none), center(truncation.discs().size(), none);
    for(std::size_t f = 0; f < in_mesh.size(); ++f)
      if(is_there(f)) cut[f] = m_facets.at(face(in_mesh[f], mesh));
    for(const auto& pair : disc_of) center[pair.second] = m_vertices.at(pair.first);
    const auto truncated = truncation.apply(mesh, vpm);
    if(!truncated) return false;
    for(vertex_descriptor& v : all) {
      const auto found = disc_of.find(v);
      if(found != disc_of.end()) v = truncated->vertices[truncation.discs()[found->second].rim.front()];
    }
    for(std::size_t n = 0; n < truncated->facets.size(); ++n) {
      const face_descriptor f = truncated->facets[n];
      if(f == boost::graph_traits<TriangleMesh>::null_face()) continue;
      const auto d = truncation.disc_of_new_facet(n);
      m_facets[f] = d == Shell_truncation_3::npos ? cut[truncation.cores()[n].facet] : none;
      if(d == Shell_truncation_3::npos) continue;
      m_center_of_facet[f] = center[d];
      for(auto p : truncation.new_facet(n)) m_vertices[truncated->vertices[p]] = center[d];
    }
    return true;
  }

  bool is_truncated() const { return !m_facets.empty(); }

  // Converts positions in the current `faces(mesh)` to those before the truncation. Parts of a facet have its position,
  // and triangles of discs have `no_facet`.
  std::vector<std::size_t> facets_before(const TriangleMesh& mesh, const std::vector<std::size_t>& positions) const
  {
    const std::vector<face_descriptor> now(faces(mesh).begin(), faces(mesh).end());
    std::vector<std::size_t> result;
    for(std::size_t n : positions) result.push_back(m_facets.at(now[n]));
    return result;
  }

  // Converts the positions of offending simplices in the same way, without duplicates. Discs are represented by the
  // vertices that they replace.
  Offending_simplices before(const TriangleMesh& mesh, const Offending_simplices& now) const
  {
    const std::vector<face_descriptor> facets(faces(mesh).begin(), faces(mesh).end());
    const std::vector<vertex_descriptor> all(vertices(mesh).begin(), vertices(mesh).end());
    Offending_simplices result = now;
    result.facets.clear();
    result.vertices.clear();
    for(std::size_t n : now.facets) {
      const std::size_t before = m_facets.at(facets[n]);
      if(before != none) result.facets.push_back(before);
      else result.vertices.push_back(m_center_of_facet.at(facets[n]));
    }
    for(std::size_t n : now.vertices) result.vertices.push_back(m_vertices.at(all[n]));
    for(auto* numbers : { &result.facets, &result.vertices }) {
      sort_unique(*numbers);
    }
    return result;
  }

private:
  static constexpr std::size_t none = Edit_report::no_facet;

  std::unordered_map<face_descriptor, std::size_t> m_facets, m_center_of_facet;
  std::unordered_map<vertex_descriptor, std::size_t> m_vertices;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_TRUNCATED_FOR_EDIT_H
