// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SPLIT_LONG_EDGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SPLIT_LONG_EDGES_H

#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/move_to_level.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <optional>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the point at which an edge may be split: its midpoint, or a point nearby. The midpoint is rounded, and
// rounding may move it out of a thin shell.
template <typename Guarded>
std::optional<typename Guarded::Point> place_to_split_at(typename Guarded::halfedge_descriptor h, Guarded& guarded)
{
  typedef typename Guarded::Point Point;
  const auto q = guarded.quadrilateral(h);
  const Point &a = guarded.point(q.a), &b = guarded.point(q.b), &c = guarded.point(q.c), &d = guarded.point(q.d);
  const typename Guarded::Link link = { b, c, a, d };
  const Point p = CGAL::midpoint(a, b);
  // If the longest edge of a facet must not be split, its other edges could be split forever, as the new edges may be
  // as long.
  if((std::max)(CGAL::squared_distance(p, c), CGAL::squared_distance(p, d))
     > remeshing_tuning.largest_new_edge * remeshing_tuning.largest_new_edge * CGAL::squared_distance(a, b))
    return std::nullopt;
  // The oracle limits its effort for a whole star, and large facets may need more. Four facets around a vertex, less
  // than half a turn each, wind once in any case.
  const auto is_accepted = [&](const Point& x) {
    return guarded.accepts(x, link)
           || (guarded.accepts(x, b, c) && guarded.accepts(x, c, a) && guarded.accepts(x, a, d)
               && guarded.accepts(x, d, b));
  };
  if(is_accepted(p)) return p;
  const auto moved = move_to_mean_level(guarded.oracle.shell().field(), p, a, b);
  if(guarded.is_constrained(edge(h, guarded.mesh)) || !moved || !is_accepted(*moved)) return std::nullopt;
  return *moved;
}

// Splits edges, the relatively longest first.
template <typename Guarded>
void split_long_edges(Guarded& guarded)
{
  typedef typename Guarded::Edge_queue Queue;
  auto& mesh = guarded.mesh;
  Queue queue;
  const auto add = [&](typename Guarded::halfedge_descriptor h) {
    if(guarded.is_kept(edge(h, mesh))) return;
    const double length = guarded.relative_length(h);
    if(length > remeshing_tuning.longest) queue.insert(typename Queue::value_type(edge(h, mesh), -length, h));
  };
  for(auto e : edges(mesh)) add(halfedge(e, mesh));
  while(!queue.empty() && guarded.go_on()) {
    const auto h = queue.right.begin()->info;
    queue.right.erase(queue.right.begin());
    if(const auto p = place_to_split_at(h, guarded))
      for(auto g : CGAL::halfedges_around_target(guarded.split(h, *p), mesh)) add(g);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SPLIT_LONG_EDGES_H
