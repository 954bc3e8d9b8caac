// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline void sort_and_remove_repetitions(std::vector<std::size_t>& positions)
{
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status check_soup(const Polygon_soup& soup, Offending_simplices& offenders)
{
  offenders = Offending_simplices();
  if(soup.polygons.empty()) return Shell_status::EMPTY_MESH;
  for(std::size_t n = 0; n < soup.polygons.size(); ++n)
    for(std::size_t v : soup.polygons[n])
      if(v >= soup.points.size() && (offenders.facets.empty() || offenders.facets.back() != n)) offenders.facets.push_back(n);
  if(!offenders.facets.empty()) return Shell_status::INVALID_PARAMETER;
  constexpr double largest = 1e60;       // as for meshes
  bool is_in_range = true;
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    for(int a = 0; a < 3; ++a) {
      const double x = soup.points[v][a];
      is_in_range = is_in_range && std::abs(x) <= largest;
      if(!std::isfinite(x)) { offenders.vertices.push_back(v); break; }
    }
  return !offenders.vertices.empty() ? Shell_status::NOT_FINITE : is_in_range ? Shell_status::SUCCESS : Shell_status::COORDINATES_OUT_OF_RANGE;
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<std::array<std::size_t, 3> > triangles_of_polygon(const Polygon_soup& soup, std::size_t polygon)
{
  const std::vector<std::size_t>& corners = soup.polygons[polygon];
  std::vector<std::array<std::size_t, 3> > triangles;
  if(corners.size() < 3) return triangles;
  Polygon_soup::Points points;
  for(std::size_t v : corners) points.push_back(soup.points[v]);
  if(corners.size() == 3) triangles.push_back({ 0, 1, 2 });
  else triangles = triangulate_polygon(points);
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), [&](const std::array<std::size_t, 3>& t) {
    return CGAL::collinear(points[t[0]], points[t[1]], points[t[2]]);
  }), triangles.end());
  return triangles;
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<std::size_t> merge_points(Polygon_soup& soup)
{
  Polygon_soup::Points& points = soup.points;
  std::map<Polygon_soup::Points::value_type, std::size_t> positions;
  std::vector<std::size_t> first, merged;
  merged.reserve(points.size());
  for(std::size_t v = 0; v < points.size(); ++v) {
    const auto inserted = positions.emplace(points[v], first.size());
    if(inserted.second) {
      points[first.size()] = points[v];
      first.push_back(v);
    }
    merged.push_back(inserted.first->second);
  }
  points.resize(first.size());
  for(auto& polygon : soup.polygons)
    for(std::size_t& v : polygon) v = merged[v];
  return first;
}

// notes which vertices are copied when a soup is oriented, those whose facets do not form one fan, and counts facets that are turned round
struct Orientation_notes : Polygon_mesh_processing::Default_orientation_visitor
{
  Orientation_notes(std::vector<std::size_t>& copied, std::size_t& turned) : copied(copied), turned(turned) {}
  void duplicated_vertex(std::size_t v, std::size_t) { copied.push_back(v); }
  void polygon_orientation_reversed(std::size_t) { ++turned; }

  std::vector<std::size_t>& copied;
  std::size_t& turned;
};

// What keeps polygons from being a mesh. Two polygons at an edge must walk it in opposite directions, after some of
// them are turned round; a parity that contradicts itself around the surface makes it one-sided.
inline Shell_status diagnose_polygons(const Polygon_soup::Polygons& polygons, Offending_simplices& offenders)
{
  struct Use { std::size_t polygon; bool forward; };
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Use> > edges;
  for(std::size_t p = 0; p < polygons.size(); ++p) {
    const std::vector<std::size_t>& polygon = polygons[p];
    std::vector<std::size_t> sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    if(polygon.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      offenders.facets.push_back(p);
      continue;
    }
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      edges[std::minmax(a, b)].push_back({ p, a < b });
    }
  }
  if(!offenders.facets.empty()) return Shell_status::DEGENERATE_FACET;
  for(const auto& edge : edges)
    if(edge.second.size() > 2)
      for(const Use& use : edge.second) offenders.facets.push_back(use.polygon);
  if(!offenders.facets.empty()) {
    sort_and_remove_repetitions(offenders.facets);
    return Shell_status::NON_MANIFOLD;
  }
  // union-find with parities
  std::vector<std::size_t> parent(polygons.size());
  std::vector<char> turned(polygons.size(), 0);     // relative to the parent
  for(std::size_t p = 0; p < parent.size(); ++p) parent[p] = p;
  const auto root = [&](std::size_t p, char& parity) {
    parity = 0;
    for(; parent[p] != p; p = parent[p]) {
      turned[p] = char(turned[p] ^ turned[parent[p]]);       // halves the path
      parent[p] = parent[parent[p]];
      parity ^= turned[p];
    }
    return p;
  };
  for(const auto& edge : edges) {
    if(edge.second.size() != 2) continue;
    const Use &a = edge.second[0], &b = edge.second[1];
    char pa, pb;
    const std::size_t ra = root(a.polygon, pa), rb = root(b.polygon, pb);
    const char differ = char(a.forward == b.forward);
    if(ra == rb) {
      if((pa ^ pb) != differ) { offenders.facets.push_back(a.polygon); offenders.facets.push_back(b.polygon); }
    } else {
      parent[ra] = rb;
      turned[ra] = char(pa ^ pb ^ differ);
    }
  }
  sort_and_remove_repetitions(offenders.facets);
  return offenders.facets.empty() ? Shell_status::SUCCESS : Shell_status::NOT_ORIENTABLE;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status orient_soup(Polygon_soup& soup, Offending_simplices& offenders, std::size_t& turned)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  turned = 0;
  const Shell_status status = diagnose_polygons(soup.polygons, offenders);
  if(status != Shell_status::SUCCESS) return status;
  PMP::orient_polygon_soup(soup.points, soup.polygons, CGAL::parameters::visitor(Orientation_notes(offenders.vertices, turned)));
  sort_and_remove_repetitions(offenders.vertices);
  return offenders.vertices.empty() && PMP::is_polygon_soup_a_polygon_mesh(soup.polygons) ? Shell_status::SUCCESS : Shell_status::NON_MANIFOLD;
}

CGAL_BSPLINE_SHELL_3_INLINE bool triangulate(Polygon_soup& soup)
{
  Polygon_soup::Polygons triangles;
  for(std::vector<std::size_t>& polygon : soup.polygons)
    if(polygon.size() == 3) triangles.push_back(std::move(polygon));
    else {
      Polygon_soup::Points corners;
      for(std::size_t v : polygon) corners.push_back(soup.points[v]);
      for(const std::array<std::size_t, 3>& t : triangulate_polygon(corners)) triangles.push_back({ polygon[t[0]], polygon[t[1]], polygon[t[2]] });
    }
  soup.polygons.swap(triangles);
  return Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(soup.polygons);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H
