// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_cover.h>
#include <CGAL/Bspline_shell_3/Soup/internal/excise_at_edges.h>
#include <CGAL/Bspline_shell_3/Soup/internal/excise_at_points.h>

#include <CGAL/FPU.h>
#include <CGAL/Kernel/global_functions_3.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Excises the pieces of a component that are much smaller than its largest piece. Returns whether there are any.
inline bool excise_fragments(Excision_state& state, const Triangle_sets& components, double largest_fragment)
{
  const Triangle_sets pieces = connected_triangles(
    state, [&](std::size_t t) { return state.is_kept(t); }, 2);
  std::vector<double> largest(state.size(), 0); // by component: the area of its largest piece
  for(std::size_t t = 0; t < state.size(); ++t) {
    double& area = largest[components.set_of[t]];
    area = (std::max)(area, pieces.area[pieces.set_of[t]]);
  }
  bool has_fragments = false;
  for(std::size_t t = 0; t < state.size(); ++t)
    if(state.is_kept(t) && pieces.area[pieces.set_of[t]] < largest_fragment * largest[components.set_of[t]]) {
      state.excise(t, Excision_reason::FRAGMENT);
      has_fragments = true;
    }
  return has_fragments;
}

// Excises triangles until the mesh meets all requirements.
// \param points points of triangles that were excised last
// \pre each edge has at most two kept triangles, of consistent orientation
inline Excised_soup_3 excise_until_stable(Excision_state& state, std::vector<std::size_t> points,
                                          const Excision_parameters& parameters)
{
  const Triangle_sets components = connected_triangles(
    state, [](std::size_t) { return true; }, std::size_t(-1));
  Point_excision at_points(state, parameters.least_cone_margin);
  do {
    at_points.run(points);
    excise_fragments(state, components, parameters.largest_fragment);
    points = std::move(state.changed);
    state.changed.clear();
  } while(!points.empty());
  return Excised_soup_3(std::move(state.soup), std::move(state.reasons), std::move(state.is_reversed));
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Soup_triangles different_triangles(Polygon_soup soup)
{
  typedef Soup_triangles::Triangle Triangle;
  Soup_triangles result;
  result.point_of = internal::merge_points(soup);
  result.points = std::move(soup.points);
  std::unordered_map<Triangle, std::size_t, boost::hash<Triangle> > known; // by sorted corners
  const auto add = [&](const Triangle& triangle, std::size_t polygon) {
    Triangle sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    if(std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return;
    const auto [same, is_new] = known.emplace(sorted, result.triangles.size());
    if(!is_new) {
      result.duplicates.emplace_back(polygon, same->second);
      return;
    }
    result.triangles.push_back(triangle);
    result.polygon_of.push_back(polygon);
  };
  for(std::size_t n = 0; n < soup.polygons.size(); ++n) {
    const std::vector<std::size_t>& polygon = soup.polygons[n];
    if(polygon.size() == 3) add({ polygon[0], polygon[1], polygon[2] }, n);
    if(polygon.size() <= 3) continue;
    Polygon_soup::Points corners;
    for(std::size_t v : polygon) corners.push_back(result.points[v]);
    for(const auto& t : triangulate_polygon(corners)) add({ polygon[t[0]], polygon[t[1]], polygon[t[2]] }, n);
  }
  return result;
}

CGAL_BSPLINE_SHELL_3_INLINE Excised_soup_3 choose_excision(Soup_triangles soup, const Excision_parameters& parameters)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  const std::size_t size = soup.triangles.size();
  internal::Excision_state state(std::move(soup), std::vector<Excision_reason>(size, Excision_reason::KEPT),
                                 std::vector<char>(size, 0));
  for(std::size_t t = 0; t < size; ++t) {
    const auto& c = state.soup.triangles[t];
    const auto& points = state.soup.points;
    if(CGAL::collinear(points[c[0]], points[c[1]], points[c[2]])) state.excise(t, Excision_reason::NO_AREA);
  }
  for(std::size_t t : internal::small_cover(internal::overlapping_triangles(state), internal::excision_costs(state)))
    state.excise(t, Excision_reason::INTERSECTING);
  internal::excise_at_non_manifold_edges(state);
  internal::orient_or_excise(state);
  std::vector<std::size_t> all(state.soup.points.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return internal::excise_until_stable(state, std::move(all), parameters);
}

CGAL_BSPLINE_SHELL_3_INLINE Excised_soup_3 excise_also(const Excised_soup_3& soup,
                                                       const std::vector<std::size_t>& triangles,
                                                       Excision_reason reason, const Excision_parameters& parameters)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  std::vector<char> is_reversed(soup.soup().triangles.size());
  for(std::size_t t = 0; t < is_reversed.size(); ++t) is_reversed[t] = soup.is_reversed(t);
  internal::Excision_state state(soup.soup(), soup.reasons(), std::move(is_reversed));
  for(std::size_t t : triangles) state.excise(t, reason);
  return internal::excise_until_stable(state, std::exchange(state.changed, {}), parameters);
}

CGAL_BSPLINE_SHELL_3_INLINE Excised_soup_3 reverse_facets(const Excised_soup_3& soup,
                                                          const std::vector<Excised_soup_3::Mesh::Face_index>& facets)
{
  std::vector<char> is_reversed(soup.soup().triangles.size());
  for(std::size_t t = 0; t < is_reversed.size(); ++t) is_reversed[t] = soup.is_reversed(t);
  for(auto f : facets) is_reversed[soup.triangle_of(f)] = char(!is_reversed[soup.triangle_of(f)]);
  return Excised_soup_3(soup.soup(), soup.reasons(), std::move(is_reversed));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_IMPL_H
