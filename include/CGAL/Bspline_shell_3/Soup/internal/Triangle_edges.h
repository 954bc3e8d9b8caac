// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_TRIANGLE_EDGES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_TRIANGLE_EDGES_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A side of a triangle: the edge from its corner `corner % 3` to the next one, where `corner / 3` is the triangle.
struct Triangle_side
{
  std::size_t lower, upper, corner;

  std::size_t triangle() const { return corner / 3; }
  bool has_same_edge(const Triangle_side& other) const { return lower == other.lower && upper == other.upper; }
  bool operator<(const Triangle_side& other) const
  {
    return std::tie(lower, upper, corner) < std::tie(other.lower, other.upper, other.corner);
  }
};

// The edges of a soup of triangles, and the corners at each point.
class Triangle_edges
{
public:
  Triangle_edges() = default;
  explicit Triangle_edges(const Soup_triangles& soup)
  {
    m_first.assign(soup.points.size() + 1, 0);
    for(const auto& triangle : soup.triangles)
      for(std::size_t v : triangle) ++m_first[v + 1];
    std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
    m_corners.resize(m_first.back());
    std::vector<std::size_t> next(m_first.begin(), m_first.end() - 1);
    for(std::size_t t = 0; t < soup.triangles.size(); ++t)
      for(std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = soup.triangles[t][i], w = soup.triangles[t][(i + 1) % 3];
        m_corners[next[v]++] = 3 * t + i;
        m_sides.push_back({ (std::min)(v, w), (std::max)(v, w), 3 * t + i });
      }
    Run::poll();
    std::sort(m_sides.begin(), m_sides.end());
  }

  // Calls f(corner) for each corner at a point.
  template <typename Function>
  void for_each_corner(std::size_t point, const Function& f) const
  {
    for(std::size_t n = m_first[point]; n < m_first[point + 1]; ++n) f(m_corners[n]);
  }

  // Calls f(sides) for each edge, with its sides of triangles that satisfy a predicate.
  template <typename Predicate, typename Function>
  void for_each_edge(const Predicate& is_chosen, const Function& f) const
  {
    std::vector<Triangle_side> sides;
    for(auto first = m_sides.begin(), last = first; first != m_sides.end(); first = last) {
      sides.clear();
      for(; last != m_sides.end() && last->has_same_edge(*first); ++last)
        if(is_chosen(last->triangle())) sides.push_back(*last);
      if(!sides.empty()) f(sides);
    }
    Run::poll();
  }

private:
  std::vector<Triangle_side> m_sides;          // sorted
  std::vector<std::size_t> m_first, m_corners; // by point: the first of its corners
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_TRIANGLE_EDGES_H
