// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_EDGE_USES_H
#define CGAL_BSPLINE_SHELL_3_MESH_EDGE_USES_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// An edge of a polygon. If `is_forward`, the polygon traverses it from the lower vertex to the upper vertex. Corners
// are numbered polygon by polygon.
struct Edge_use
{
  std::size_t lower, upper, polygon, lower_corner, upper_corner;
  bool is_forward;

  // Returns the first corner of the polygon's side.
  std::size_t first_corner() const { return is_forward ? lower_corner : upper_corner; }
  bool has_same_edge(const Edge_use& other) const { return lower == other.lower && upper == other.upper; }
  bool operator<(const Edge_use& other) const
  {
    return std::tie(lower, upper, polygon) < std::tie(other.lower, other.upper, other.polygon);
  }
};

// Returns the edges of all polygons, sorted. Polygons with fewer than three corners or with a repeated vertex are
// offenders.
inline std::vector<Edge_use> edge_uses(const Polygon_soup::Polygons& polygons, std::size_t number_of_points,
                                       std::vector<std::size_t>& offenders)
{
  std::vector<std::size_t> sorted;
  for(std::size_t p = 0; p < polygons.size(); ++p) {
    sorted = polygons[p];
    std::sort(sorted.begin(), sorted.end());
    if(sorted.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) offenders.push_back(p);
  }
  if(!offenders.empty()) return {};
  // Sorts by the lower vertex first, which few edges share.
  const auto for_each_side = [&](const auto& f) {
    std::size_t first = 0; // first corner of the polygon
    for(std::size_t p = 0; p < polygons.size(); ++p) {
      const std::vector<std::size_t>& polygon = polygons[p];
      for(std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = (i + 1) % polygon.size(), a = polygon[i], b = polygon[next];
        f(a < b ? Edge_use{ a, b, p, first + i, first + next, true }
                : Edge_use{ b, a, p, first + next, first + i, false });
      }
      first += polygon.size();
    }
  };
  std::vector<std::size_t> begin(number_of_points + 1, 0);
  for_each_side([&](const Edge_use& use) { ++begin[use.lower + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Edge_use> uses(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for_each_side([&](const Edge_use& use) { uses[next[use.lower]++] = use; });
  for(std::size_t v = 0; v < number_of_points; ++v)
    std::sort(uses.begin() + std::ptrdiff_t(begin[v]), uses.begin() + std::ptrdiff_t(begin[v + 1]));
  return uses;
}

// Calls f(first, last) for the uses of each edge.
template <typename Function>
inline void for_each_edge(const std::vector<Edge_use>& uses, const Function& f)
{
  std::size_t number = 0;
  for(auto first = uses.begin(), last = first; first != uses.end(); first = last) {
    if(++number % 1024 == 0) Run::poll();
    while(last != uses.end() && last->has_same_edge(*first)) ++last;
    f(first, last);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_EDGE_USES_H
