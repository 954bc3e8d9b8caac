// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_TIDY_POLYGONS_H
#define CGAL_BSPLINE_SHELL_3_SOUP_TIDY_POLYGONS_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_set>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Splits a polygon that has a repeated point. Returns no polygons for a polygon with fewer than three points.
inline std::vector<std::vector<std::size_t> > simple_polygons(const Polygon_soup& soup, std::size_t n)
{
  typedef std::vector<std::size_t> Polygon;
  Polygon polygon = soup.polygons[n];
  // The most frequent case.
  if(polygon.size() == 3 && polygon[0] != polygon[1] && polygon[1] != polygon[2] && polygon[2] != polygon[0])
    return { polygon };
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while(polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  Polygon different = polygon;
  sort_unique(different);
  if(different.size() < 3) return {};
  if(different.size() == polygon.size()) return { polygon };
  std::vector<Polygon> parts;
  for(const std::array<std::size_t, 3>& t : triangles_of_polygon(soup, n))
    parts.push_back({ soup.polygons[n][t[0]], soup.polygons[n][t[1]], soup.polygons[n][t[2]] });
  return parts;
}

// Returns the same sequence for all polygons with the same cycle of points, in either direction.
inline std::vector<std::size_t> canonical_cycle(std::vector<std::size_t> polygon)
{
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  if(polygon[1] > polygon.back()) std::reverse(polygon.begin() + 1, polygon.end());
  return polygon;
}

// The original numbers of the points and polygons of a soup; for points at equal positions, that of the first.
struct Tidy_origins
{
  std::vector<std::size_t> point_of, polygon_of;
};

// Merges points at equal positions, splits polygons with a repeated point, and removes duplicates and polygons with
// fewer than three points.
// \pre `check_soup()` returned `SUCCESS`
inline Tidy_origins tidy_polygons(Polygon_soup& soup, Soup_repairs& repairs)
{
  Tidy_origins origin;
  const std::size_t points = soup.points.size();
  origin.point_of = merge_points(soup);
  repairs.merged_points = points - soup.points.size();

  Polygon_soup::Polygons polygons;
  std::unordered_set<std::vector<std::size_t>, boost::hash<std::vector<std::size_t> > > known;
  known.reserve(soup.polygons.size());
  polygons.reserve(soup.polygons.size());
  origin.polygon_of.reserve(soup.polygons.size());
  for(std::size_t n = 0; n < soup.polygons.size(); ++n) {
    Run::poll();
    const std::vector<std::vector<std::size_t> > parts = simple_polygons(soup, n);
    if(parts.empty()) ++repairs.removed_polygons;
    else if(parts.size() > 1 || parts.front().size() < soup.polygons[n].size()) ++repairs.split_polygons;
    for(const std::vector<std::size_t>& part : parts)
      if(known.insert(canonical_cycle(part)).second) {
        polygons.push_back(part);
        origin.polygon_of.push_back(n);
      } else ++repairs.duplicate_polygons;
  }
  soup.polygons.swap(polygons);
  return origin;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_TIDY_POLYGONS_H
