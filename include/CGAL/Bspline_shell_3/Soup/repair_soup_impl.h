// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/helpers.h>

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

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Shell_status
repair_soup(Polygon_soup soup, Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh,
            Soup_repairs& repairs, Offending_simplices& offenders)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  repairs = Soup_repairs();
  mesh.clear();
  const Shell_status checked = internal::check_soup(soup, offenders);
  if(checked != Shell_status::SUCCESS) return checked;
  const std::size_t points = soup.points.size();
  const std::vector<std::size_t> first = internal::merge_points(soup);
  repairs.merged_points = points - soup.points.size();

  Polygon_soup::Polygons polygons;
  std::vector<std::size_t> origin;
  std::unordered_set<std::vector<std::size_t>, boost::hash<std::vector<std::size_t> > > known;
  known.reserve(soup.polygons.size());
  polygons.reserve(soup.polygons.size());
  origin.reserve(soup.polygons.size());
  for(std::size_t n = 0; n < soup.polygons.size(); ++n) {
    internal::Run::poll();
    const std::vector<std::vector<std::size_t> > parts = internal::simple_polygons(soup, n);
    if(parts.empty()) ++repairs.removed_polygons;
    else if(parts.size() > 1 || parts.front().size() < soup.polygons[n].size()) ++repairs.split_polygons;
    for(const std::vector<std::size_t>& part : parts)
      if(known.insert(internal::canonical_cycle(part)).second) {
        polygons.push_back(part);
        origin.push_back(n);
      } else ++repairs.duplicate_polygons;
  }
  soup.polygons.swap(polygons);
  if(soup.polygons.empty()) return Shell_status::EMPTY_MESH;

  const Shell_status status = internal::orient_soup(soup, offenders, repairs.reversed_polygons);
  if(status != Shell_status::SUCCESS) {
    for(std::size_t& f : offenders.facets) f = origin[f];
    for(std::size_t& v : offenders.vertices) v = first[v];
    offenders.facets.erase(std::unique(offenders.facets.begin(), offenders.facets.end()), offenders.facets.end());
    return status;
  }
  if(!internal::triangulate(soup)) return Shell_status::DEGENERATE_FACET;
  internal::Run::poll();
  PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.polygons);
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  internal::Run::poll();
  const auto has_no_area = [&](auto f) { return PMP::is_degenerate_triangle_face(f, mesh); };
  repairs.degenerate_facets = std::size_t(std::count_if(mesh.faces().begin(), mesh.faces().end(), has_no_area));
  if(repairs.degenerate_facets > 0) {
    PMP::remove_degenerate_faces(mesh);
    mesh.collect_garbage();
    if(mesh.number_of_faces() == 0) return Shell_status::EMPTY_MESH;
    if(std::any_of(mesh.faces().begin(), mesh.faces().end(), has_no_area)) {
      mesh.clear();
      return Shell_status::DEGENERATE_FACET;
    }
  }
  return Shell_status::SUCCESS;
}

CGAL_BSPLINE_SHELL_3_INLINE bool orient_components(
  Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  if(!CGAL::is_closed(mesh) || PMP::does_bound_a_volume(mesh)) return false;
  PMP::orient_to_bound_a_volume(mesh);
  return true;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H
