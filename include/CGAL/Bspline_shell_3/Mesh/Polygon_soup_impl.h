// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Mesh/edge_uses.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Support/Disjoint_sets.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE Shell_status check_soup(const Polygon_soup& soup, Offending_simplices& offenders)
{
  offenders = Offending_simplices();
  if(soup.polygons.empty()) return Shell_status::EMPTY_MESH;
  for(std::size_t n = 0; n < soup.polygons.size(); ++n)
    for(std::size_t v : soup.polygons[n])
      if(v >= soup.points.size() && (offenders.facets.empty() || offenders.facets.back() != n))
        offenders.facets.push_back(n);
  if(!offenders.facets.empty()) return Shell_status::INVALID_PARAMETER;
  constexpr double largest = 1e60; // the limit for meshes
  bool is_in_range = true;
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    for(int a = 0; a < 3; ++a) {
      const double x = soup.points[v][a];
      is_in_range = is_in_range && std::abs(x) <= largest;
      if(!std::isfinite(x)) {
        offenders.vertices.push_back(v);
        break;
      }
    }
  return !offenders.vertices.empty() ? Shell_status::NOT_FINITE
         : is_in_range               ? Shell_status::SUCCESS
                                     : Shell_status::COORDINATES_OUT_OF_RANGE;
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<std::array<std::size_t, 3> > triangles_of_polygon(const Polygon_soup& soup,
                                                                                          std::size_t polygon)
{
  const std::vector<std::size_t>& corners = soup.polygons[polygon];
  std::vector<std::array<std::size_t, 3> > triangles;
  if(corners.size() < 3) return triangles;
  Polygon_soup::Points points;
  for(std::size_t v : corners) points.push_back(soup.points[v]);
  if(corners.size() == 3) triangles.push_back({ 0, 1, 2 });
  else triangles = triangulate_polygon(points);
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                 [&](const std::array<std::size_t, 3>& t) {
                                   return CGAL::collinear(points[t[0]], points[t[1]], points[t[2]]);
                                 }),
                  triangles.end());
  return triangles;
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<std::size_t> merge_points(Polygon_soup& soup)
{
  Polygon_soup::Points& points = soup.points;
  std::vector<std::size_t> sorted(points.size()), first_at(points.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t(0));
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t v, std::size_t w) {
    const Comparison_result order = CGAL::compare_xyz(points[v], points[w]);
    return order == SMALLER || (order == EQUAL && v < w);
  });
  for(std::size_t n = 0; n < sorted.size(); ++n) {
    const bool is_new = n == 0 || points[sorted[n]] != points[sorted[n - 1]];
    first_at[sorted[n]] = is_new ? sorted[n] : first_at[sorted[n - 1]];
  }
  std::vector<std::size_t> first, merged(points.size());
  for(std::size_t v = 0; v < points.size(); ++v) {
    if(first_at[v] == v) {
      merged[v] = first.size();
      points[first.size()] = points[v];
      first.push_back(v);
    } else {
      merged[v] = merged[first_at[v]];
    }
  }
  points.resize(first.size());
  for(auto& polygon : soup.polygons)
    for(std::size_t& v : polygon) v = merged[v];
  return first;
}

// Collects the vertices that are duplicated when a soup is oriented, because their facets do not form one fan, and
// counts reversed facets.
struct Orientation_notes : Polygon_mesh_processing::Default_orientation_visitor
{
  Orientation_notes(std::vector<std::size_t>& copied, std::size_t& turned) : copied(copied), turned(turned) {}
  void duplicated_vertex(std::size_t v, std::size_t) { copied.push_back(v); }
  void polygon_orientation_reversed(std::size_t) { ++turned; }

  std::vector<std::size_t>& copied;
  std::size_t& turned;
};

// Finds the defects that prevent polygons from being a mesh. After some polygons are reversed, the two polygons at an
// edge must traverse it in opposite directions. If the required reversals contradict each other, the surface is
// one-sided.
inline Shell_status diagnose_polygons(const std::vector<Edge_use>& uses, std::size_t number_of_polygons,
                                      std::vector<std::size_t>& offenders)
{
  for_each_edge(uses, [&](auto first, auto last) {
    if(last - first > 2) std::for_each(first, last, [&](const Edge_use& use) { offenders.push_back(use.polygon); });
  });
  if(!offenders.empty()) {
    sort_unique(offenders);
    return Shell_status::NON_MANIFOLD;
  }
  // union-find with parities
  std::vector<std::size_t> parent(number_of_polygons);
  std::vector<char> turned(number_of_polygons, 0); // relative to the parent
  std::iota(parent.begin(), parent.end(), std::size_t(0));
  const auto root = [&](std::size_t p, char& parity) {
    parity = 0;
    for(; parent[p] != p; p = parent[p]) {
      turned[p] = char(turned[p] ^ turned[parent[p]]); // halves the path
      parent[p] = parent[parent[p]];
      parity ^= turned[p];
    }
    return p;
  };
  for_each_edge(uses, [&](auto a, auto last) {
    if(last - a != 2) return;
    const auto b = a + 1;
    char pa, pb;
    const std::size_t ra = root(a->polygon, pa), rb = root(b->polygon, pb);
    const char differ = char(a->is_forward == b->is_forward);
    if(ra == rb) {
      if((pa ^ pb) != differ) {
        offenders.push_back(a->polygon);
        offenders.push_back(b->polygon);
      }
    } else {
      parent[ra] = rb;
      turned[ra] = char(pa ^ pb ^ differ);
    }
  });
  sort_unique(offenders);
  return offenders.empty() ? Shell_status::SUCCESS : Shell_status::NOT_ORIENTABLE;
}

// Returns whether polygons already form a mesh: the two polygons at an edge traverse it in opposite directions, and the
// polygons around a vertex form one fan.
inline bool are_mesh(const std::vector<Edge_use>& uses, const Polygon_soup& soup)
{
  // Corners at the same vertex are in one set if their polygons share an edge.
  std::size_t corners = 0;
  for(const auto& polygon : soup.polygons) corners += polygon.size();
  Disjoint_sets fans(corners);
  bool agree = true;
  for_each_edge(uses, [&](auto first, auto last) {
    if(last - first == 1) return;
    const auto second = first + 1;
    agree = agree && last - first == 2 && first->is_forward != second->is_forward;
    fans.join(first->lower_corner, second->lower_corner);
    fans.join(first->upper_corner, second->upper_corner);
  });
  if(!agree) return false;
  std::vector<char> has_fan(soup.points.size(), 0);
  std::size_t c = 0;
  for(const auto& polygon : soup.polygons)
    for(std::size_t v : polygon) {
      if(fans.root(c) == c) {
        if(has_fan[v]) return false;
        has_fan[v] = 1;
      }
      ++c;
    }
  return true;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status orient_soup(Polygon_soup& soup, Offending_simplices& offenders,
                                                     std::size_t& turned)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  turned = 0;
  const std::vector<Edge_use> uses = edge_uses(soup.polygons, soup.points.size(), offenders.facets);
  if(!offenders.facets.empty()) return Shell_status::DEGENERATE_FACET;
  const Shell_status status = diagnose_polygons(uses, soup.polygons.size(), offenders.facets);
  if(status != Shell_status::SUCCESS) return status;
  if(are_mesh(uses, soup)) return Shell_status::SUCCESS; // the most frequent case
  PMP::orient_polygon_soup(soup.points, soup.polygons,
                           CGAL::parameters::visitor(Orientation_notes(offenders.vertices, turned)));
  sort_unique(offenders.vertices);
  return offenders.vertices.empty() && PMP::is_polygon_soup_a_polygon_mesh(soup.polygons) ? Shell_status::SUCCESS
                                                                                          : Shell_status::NON_MANIFOLD;
}

CGAL_BSPLINE_SHELL_3_INLINE bool triangulate(Polygon_soup& soup)
{
  const auto is_triangle = [](const std::vector<std::size_t>& polygon) { return polygon.size() == 3; };
  if(std::all_of(soup.polygons.begin(), soup.polygons.end(), is_triangle)) return true;
  Polygon_soup::Polygons triangles;
  for(std::vector<std::size_t>& polygon : soup.polygons)
    if(is_triangle(polygon)) triangles.push_back(std::move(polygon));
    else {
      Polygon_soup::Points corners;
      for(std::size_t v : polygon) corners.push_back(soup.points[v]);
      for(const std::array<std::size_t, 3>& t : triangulate_polygon(corners))
        triangles.push_back({ polygon[t[0]], polygon[t[1]], polygon[t[2]] });
    }
  soup.polygons.swap(triangles);
  return Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(soup.polygons);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_IMPL_H
