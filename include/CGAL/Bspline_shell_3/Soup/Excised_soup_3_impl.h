// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE Excised_soup_3::Excised_soup_3(Soup_triangles soup, std::vector<Excision_reason> reasons,
                                                           std::vector<char> is_reversed)
  : m_soup(std::move(soup)), m_reasons(std::move(reasons)), m_is_reversed(std::move(is_reversed))
{
  CGAL_precondition(m_reasons.size() == m_soup.triangles.size());
  CGAL_precondition(m_is_reversed.size() == m_soup.triangles.size());
  for(std::size_t t = 0; t < m_reasons.size(); ++t)
    if(this->is_excised(t)) m_excised.push_back(t);
  if(build_mesh()) find_pins();
  count();
}

// Returns false, and leaves the mesh empty, if the kept triangles are not an oriented manifold.
CGAL_BSPLINE_SHELL_3_INLINE bool Excised_soup_3::build_mesh()
{
  m_facet_of.assign(m_soup.triangles.size(), Mesh::null_face());
  m_vertex_at.assign(m_soup.points.size(), Mesh::null_vertex());
  std::vector<std::size_t> number(m_soup.points.size(), none); // by point: its vertex
  Polygon_soup::Polygons kept;
  for(std::size_t t = 0; t < m_soup.triangles.size(); ++t) {
    if(is_excised(t)) continue;
    Triangle corners = m_soup.triangles[t];
    if(is_reversed(t)) std::swap(corners[1], corners[2]);
    for(std::size_t& v : corners) {
      if(number[v] == none) {
        number[v] = m_point_of.size();
        m_point_of.push_back(v);
      }
      v = number[v];
    }
    kept.emplace_back(corners.begin(), corners.end());
    m_triangle_of.push_back(t);
  }
  if(!Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(kept)) {
    m_triangle_of.clear();
    m_point_of.clear();
    return false;
  }
  m_mesh.reserve(Mesh::size_type(m_point_of.size()), Mesh::size_type(3 * kept.size()), Mesh::size_type(kept.size()));
  for(std::size_t v : m_point_of) m_vertex_at[v] = m_mesh.add_vertex(m_soup.points[v]);
  for(std::size_t f = 0; f < kept.size(); ++f) {
    const std::vector<std::size_t>& k = kept[f];
    typedef Mesh::Vertex_index Vertex;
    m_facet_of[m_triangle_of[f]] = m_mesh.add_face(Vertex(Mesh::size_type(k[0])), Vertex(Mesh::size_type(k[1])),
                                                   Vertex(Mesh::size_type(k[2])));
  }
  return true;
}

CGAL_BSPLINE_SHELL_3_INLINE void Excised_soup_3::find_pins()
{
  for(std::size_t t : m_excised) {
    const Triangle& corners = m_soup.triangles[t];
    for(std::size_t i = 0; i < 3; ++i) {
      const Mesh::Vertex_index v = m_vertex_at[corners[i]], w = m_vertex_at[corners[(i + 1) % 3]];
      if(v == Mesh::null_vertex()) continue;
      if(!m_mesh.is_border(v)) m_pinned_vertices.push_back(v);
      if(w == Mesh::null_vertex()) continue;
      const Mesh::Halfedge_index h = m_mesh.halfedge(v, w);
      if(h != Mesh::null_halfedge() && !m_mesh.is_border(m_mesh.edge(h))) m_pinned_edges.push_back(m_mesh.edge(h));
    }
  }
  sort_unique(m_pinned_vertices);
  sort_unique(m_pinned_edges);
}

CGAL_BSPLINE_SHELL_3_INLINE void Excised_soup_3::count()
{
  double area = 0, excised = 0;
  for(std::size_t t = 0; t < m_reasons.size(); ++t) {
    const Triangle& c = m_soup.triangles[t];
    const double of_triangle = std::sqrt(
      CGAL::squared_area(m_soup.points[c[0]], m_soup.points[c[1]], m_soup.points[c[2]]));
    area += of_triangle;
    if(is_excised(t)) excised += of_triangle;
    else if(is_reversed(t)) ++m_report.reversed;
    ++m_report.triangles_with[std::size_t(m_reasons[t])];
  }
  m_report.triangles = m_reasons.size();
  m_report.excised = m_excised.size();
  m_report.excised_area = area > 0 ? excised / area : 0;
  m_report.pinned_vertices = m_pinned_vertices.size();
  m_report.pinned_edges = m_pinned_edges.size();
  m_report.duplicates = m_soup.duplicates.size();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_IMPL_H
