// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_IMPL_H

#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_holes.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/property_map.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE
Excision_holes::Excision_holes(const Excised_soup_3& soup) : m_mesh(soup.mesh())
{
  std::vector<char> is_excised(soup.soup().points.size(), 0); // by point: whether an excised triangle has it
  for(std::size_t t : soup.excised_triangles())
    for(std::size_t v : soup.soup().triangles[t]) is_excised[v] = 1;
  std::vector<std::size_t> component(m_mesh.number_of_faces());
  std::vector<char> is_open(Polygon_mesh_processing::connected_components(m_mesh, CGAL::make_property_map(component)),
                            0);
  // Border vertices that are in no excised triangle were on the border before.
  for(auto h : m_mesh.halfedges())
    if(m_mesh.is_border(h) && !is_excised[soup.point_of(m_mesh.target(h))])
      is_open[component[m_mesh.face(m_mesh.opposite(h))]] = 1;
  std::vector<char> is_known(m_mesh.number_of_halfedges(), 0);
  for(auto border : m_mesh.halfedges()) {
    if(is_known[border] || !m_mesh.is_border(border)) continue;
    const bool is_hole = !is_open[component[m_mesh.face(m_mesh.opposite(border))]];
    for(auto h : m_mesh.halfedges_around_face(border)) {
      is_known[h] = 1;
      const auto& p = m_mesh.point(m_mesh.target(h));
      if(is_hole) m_halfedge_at[{ p.x(), p.y(), p.z() }] = h;
    }
  }
}

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excision_holes::Mesh::Face_index> Excision_holes::facets_without_cap(const Closing_report& report) const
{
  std::vector<Mesh::Face_index> facets;
  for(const Closing_report::Hole& hole : report.holes) {
    const auto found = m_halfedge_at.find(hole.point);
    if(hole.is_capped || found == m_halfedge_at.end()) continue;
    for(auto h : m_mesh.halfedges_around_face(found->second))
      for(auto f : m_mesh.faces_around_target(h))
        if(f != Mesh::null_face()) facets.push_back(f);
  }
  return facets;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_HOLES_IMPL_H
