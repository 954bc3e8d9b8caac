// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_SHORT_EDGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_SHORT_EDGES_H

#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/triangle_quality.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the link of an edge: the remaining part of the link of its target, followed by that of its source.
template <typename Guarded>
typename Guarded::Link link_of_edge(typename Guarded::halfedge_descriptor h, const Guarded& guarded)
{
  typename Guarded::Link link;
  for(auto end : { h, opposite(h, guarded.mesh) })
    for(auto g = guarded.turn(end); guarded.turn(g) != end; g = guarded.turn(g))
      link.push_back(guarded.point(source(g, guarded.mesh)));
  return link;
}

// Returns how sharp the mesh is at a vertex: 1 minus the length of the mean normal of its facets.
template <typename Guarded>
double sharpness(typename Guarded::vertex_descriptor v, const Guarded& guarded)
{
  const auto& mesh = guarded.mesh;
  typename Kernel_traits<typename Guarded::Point>::Kernel::Vector_3 sum(0, 0, 0);
  double facets = 0;
  for(auto h : CGAL::halfedges_around_target(v, mesh)) {
    sum = sum
          + unit_normal_or_zero(guarded.point(source(h, mesh)), guarded.point(v),
                                guarded.point(target(next(h, mesh), mesh)));
    facets += 1;
  }
  return 1 - std::sqrt(sum.squared_length()) / facets;
}

// Returns the position for a collapse of the edge: the end where the mesh is sharper, the other end, or the midpoint.
// The halfedge is reversed if necessary, so that its target is the vertex to keep.
template <typename Guarded>
std::optional<typename Guarded::Point> place_to_collapse_to(typename Guarded::halfedge_descriptor& h, Guarded& guarded)
{
  typedef typename Guarded::Point Point;
  const auto& mesh = guarded.mesh;
  if(!Euler::does_satisfy_link_condition(edge(h, mesh), mesh)) return std::nullopt;
  const bool is_constrained = guarded.is_constrained(edge(h, mesh));
  const auto must_stay = [&](auto v) { return is_constrained ? !guarded.is_passed(v) : guarded.is_fixed(v); };
  const bool is_source_fixed = must_stay(source(h, mesh)), is_target_fixed = must_stay(target(h, mesh));
  if(is_source_fixed && is_target_fixed) return std::nullopt;
  if(is_source_fixed || (!is_target_fixed && sharpness(source(h, mesh), guarded) > sharpness(target(h, mesh), guarded)))
    h = opposite(h, mesh);
  if(guarded.constraints.are_joined_by_collapse(h, mesh)) return std::nullopt;
  // Euler::collapse_edge() keeps the target of the edge's halfedge, which must therefore be `h`.
  if(halfedge(edge(h, mesh), mesh) != h) return std::nullopt;
  const typename Guarded::Link link = link_of_edge(h, guarded);
  const Point &a = guarded.point(source(h, mesh)), &b = guarded.point(target(h, mesh));
  const std::array<Point, 3> places = { { b, a, CGAL::midpoint(a, b) } };
  const std::size_t number = is_source_fixed || is_target_fixed || is_constrained ? 1 : places.size();
  // The facets at both ends of the edge, except for its own two facets.
  double before = remeshing_tuning.regular_quality;
  const std::size_t size_at_b = degree(target(h, mesh), mesh) - 2;
  for(std::size_t n = 0; n < link.size(); ++n)
    before = (std::min)(before, triangle_quality(n < size_at_b ? b : a, link[n], link[(n + 1) % link.size()]));
  for(std::size_t n = 0; n < number; ++n) {
    const Point& p = places[n];
    const bool is_short = std::all_of(link.begin(), link.end(), [&](const Point& q) {
      return std::sqrt(CGAL::squared_distance(p, q)) <= remeshing_tuning.longest * guarded.target_length(p, q);
    });
    if(is_short && star_quality(p, link) >= before && guarded.accepts(p, link)) return p;
  }
  return std::nullopt;
}

// Collapses edges, the relatively shortest first.
template <typename Guarded>
void collapse_short_edges(Guarded& guarded)
{
  typedef typename Guarded::Edge_queue Queue;
  auto& mesh = guarded.mesh;
  Queue queue;
  const auto add = [&](typename Guarded::halfedge_descriptor h) {
    const auto e = edge(h, mesh);
    queue.left.erase(e);
    if(guarded.frozen.has_end_of(e) || guarded.is_kept(e)) return;
    const double length = guarded.relative_length(h);
    if(length < remeshing_tuning.shortest) queue.insert(typename Queue::value_type(e, length, h));
  };
  for(auto e : edges(mesh)) add(halfedge(e, mesh));
  while(!queue.empty() && guarded.go_on()) {
    auto h = queue.right.begin()->info;
    queue.right.erase(queue.right.begin());
    const auto p = place_to_collapse_to(h, guarded);
    if(!p) continue;
    // The collapse also removes one of the two other edges of each facet at the edge.
    for(auto g : { h, opposite(h, mesh) })
      for(auto side : { next(g, mesh), prev(g, mesh) }) queue.left.erase(edge(side, mesh));
    for(auto g : CGAL::halfedges_around_target(guarded.collapse(h, *p), mesh)) add(g);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_SHORT_EDGES_H
