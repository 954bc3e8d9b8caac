// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SOUP_COMPONENTS_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SOUP_COMPONENTS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The connected components of triangles that share points.
class Soup_components
{
public:
  typedef std::array<double, 3> Point;
  typedef std::array<std::size_t, 3> Triangle;

  Soup_components(std::size_t number_of_points, const std::vector<Triangle>& triangles) : m_parent(number_of_points)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
    for(const Triangle& t : triangles)
      for(std::size_t i = 0; i < 3; ++i) m_parent[component(t[i])] = component(t[(i + 1) % 3]);
  }

  // Returns the component of a point: the index of one of the component's points.
  std::size_t component(std::size_t point)
  {
    while(m_parent[point] != point) point = m_parent[point] = m_parent[m_parent[point]];
    return point;
  }

  // Removes the components that are not marked. `is_kept` is indexed by components.
  void keep(const std::vector<char>& is_kept, std::vector<Point>& points, std::vector<Triangle>& triangles)
  {
    std::vector<std::size_t> number(points.size());
    std::size_t kept = 0;
    for(std::size_t v = 0; v < points.size(); ++v) {
      number[v] = kept;
      if(is_kept[component(v)]) points[kept++] = points[v];
    }
    points.resize(kept);
    const auto is_removed = [&](const Triangle& t) { return !is_kept[component(t[0])]; };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_removed), triangles.end());
    for(Triangle& t : triangles)
      for(std::size_t& v : t) v = number[v];
  }

  // Removes the components that have an edge with only one triangle.
  void remove_open(std::vector<Point>& points, std::vector<Triangle>& triangles)
  {
    typedef std::array<std::size_t, 2> Halfedge;
    std::vector<Halfedge> halfedges, opposites, border;
    for(const Triangle& t : triangles)
      for(std::size_t i = 0; i < 3; ++i) {
        halfedges.push_back({ t[i], t[(i + 1) % 3] });
        opposites.push_back({ t[(i + 1) % 3], t[i] });
      }
    std::sort(halfedges.begin(), halfedges.end());
    std::sort(opposites.begin(), opposites.end());
    std::set_difference(halfedges.begin(), halfedges.end(), opposites.begin(), opposites.end(),
                        std::back_inserter(border));
    std::vector<char> is_closed(points.size(), 1);
    for(const Halfedge& h : border) is_closed[component(h[0])] = 0;
    keep(is_closed, points, triangles);
  }

private:
  std::vector<std::size_t> m_parent;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SOUP_COMPONENTS_H
