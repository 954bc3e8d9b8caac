// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>

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

inline constexpr double near_duplicate_distance = 1e-6;      ///< of the longest side of the box

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns the number of points that have another, different point closer than `near_duplicate_distance`, in each
 * coordinate.
 *
 * Points at equal positions count as one.
 *
 * \pre coordinates are finite
 * \cgalHeading{Cost} that of sorting the points
 */
inline std::size_t number_of_near_duplicates(Polygon_soup::Points points)
{
  typedef std::array<std::int64_t, 3> Cell;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Bbox_3 box;
  for(const auto& p : points) box += p.bbox();
  const double distance = near_duplicate_distance * (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  if(!(distance > 0)) return 0;

  // Cells have twice the distance as their width, so that at most eight are near a point.
  const auto cell_at = [&](std::size_t v, const std::array<double, 3>& shift) {
    Cell cell;
    for(int a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(
        std::floor((points[v][a] - box.min_coord(a) + shift[a] * distance) / (2 * distance)));
    return cell;
  };
  std::vector<std::pair<Cell, std::size_t> > entries(points.size());
  for(std::size_t v = 0; v < points.size(); ++v) entries[v] = { cell_at(v, { 0, 0, 0 }), v };
  std::sort(entries.begin(), entries.end());

  const auto has_neighbor = [&](std::size_t v) {
    const Cell first = cell_at(v, { -1, -1, -1 }), last = cell_at(v, { 1, 1, 1 });
    for(Cell c = first; c[0] <= last[0]; ++c[0])
      for(c[1] = first[1]; c[1] <= last[1]; ++c[1])
        for(c[2] = first[2]; c[2] <= last[2]; ++c[2])
          for(auto e = std::lower_bound(entries.begin(), entries.end(), std::make_pair(c, std::size_t(0)));
              e != entries.end() && e->first == c; ++e) {
            bool is_near = e->second != v;
            for(int a = 0; a < 3; ++a) is_near = is_near && std::abs(points[v][a] - points[e->second][a]) < distance;
            if(is_near) return true;
          }
    return false;
  };
  std::size_t number = 0;
  for(std::size_t v = 0; v < points.size(); ++v) number += has_neighbor(v);
  return number;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H
