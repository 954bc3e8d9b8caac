// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Stores the origins of vertex copies.
struct Origins_of_copies : Polygon_mesh_processing::Default_orientation_visitor
{
  explicit Origins_of_copies(std::vector<std::size_t>& origins) : origins(origins) {}
  void duplicated_vertex(std::size_t v, std::size_t copy)
  {
    if(origins.size() <= copy) origins.resize(copy + 1);
    origins[copy] = origins[v];
  }

  std::vector<std::size_t>& origins;
};

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Soup_mesh_3::Soup_mesh_3(const Polygon_soup& soup)
{
  const Polygon_soup::Points& points = soup.points;
  Polygon_soup::Points used;
  Polygon_soup::Polygons triangles;
  constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
  std::vector<std::size_t> number(points.size(), none);
  for(std::size_t n = 0; n < soup.polygons.size(); ++n) {
    const std::vector<std::size_t>& polygon = soup.polygons[n];
    const std::vector<std::array<std::size_t, 3> > parts = internal::triangles_of_polygon(soup, n);
    if(parts.empty()) m_left_out.push_back(n);
    for(const std::array<std::size_t, 3>& t : parts) {
      triangles.emplace_back();
      for(std::size_t i : t) {
        std::size_t& v = number[polygon[i]];
        if(v == none) {
          v = used.size();
          used.push_back(points[polygon[i]]);
          m_point.push_back(polygon[i]);
        }
        triangles.back().push_back(v);
      }
      m_polygon.push_back(n);
    }
  }
  Polygon_mesh_processing::orient_polygon_soup(used, triangles,
                                               CGAL::parameters::visitor(internal::Origins_of_copies(m_point)));
  Polygon_mesh_processing::polygon_soup_to_polygon_mesh(used, triangles, m_mesh);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_IMPL_H
