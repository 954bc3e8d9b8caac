// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/near_duplicates.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
std::size_t number_of_near_duplicates(Polygon_soup::Points points)
{
  typedef std::array<std::int64_t, 3> Cell;
  sort_unique(points);
  Bbox_3 box;
  for(const auto& p : points) box += p.bbox();
  const double distance = near_duplicate_distance * (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  if(!(distance > 0)) return 0;

  // The width of cells is the distance, so points in one cell are near each other, and other near points are in
  // adjacent cells.
  std::vector<std::pair<Cell, std::size_t> > entries(points.size());
  for(std::size_t v = 0; v < points.size(); ++v) {
    Cell& cell = entries[v].first;
    for(int a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor((points[v][a] - box.min_coord(a)) / distance));
    entries[v].second = v;
  }
  std::sort(entries.begin(), entries.end());

  const auto has_neighbor = [&](const std::pair<Cell, std::size_t>& lone) {
    const auto& p = points[lone.second];
    for(int n = 0; n < 27; ++n) {
      const Cell c = { lone.first[0] + n % 3 - 1, lone.first[1] + n / 3 % 3 - 1, lone.first[2] + n / 9 - 1 };
      for(auto e = std::lower_bound(entries.begin(), entries.end(), std::make_pair(c, std::size_t(0)));
          e != entries.end() && e->first == c; ++e) {
        bool is_near = e->second != lone.second;
        for(int a = 0; a < 3; ++a) is_near = is_near && std::abs(p[a] - points[e->second][a]) < distance;
        if(is_near) return true;
      }
    }
    return false;
  };
  // A cell with many points is searched only for single points of its 26 neighbors, so the time remains linear.
  std::size_t number = 0, number_of_cells = 0;
  for(std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    if(++number_of_cells % 1024 == 0) internal::Run::poll();
    while(end < entries.size() && entries[end].first == entries[begin].first) ++end;
    number += end - begin > 1 ? end - begin : std::size_t(has_neighbor(entries[begin]));
  }
  return number;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_IMPL_H
