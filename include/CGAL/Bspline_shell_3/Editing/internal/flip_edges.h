// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FLIP_EDGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FLIP_EDGES_H

#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/triangle_quality.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the worse quality of the facets at an edge.
template <typename Guarded>
double quality_at_edge(typename Guarded::halfedge_descriptor h, const Guarded& guarded)
{
  const auto q = guarded.quadrilateral(h);
  return (std::min)(triangle_quality(guarded.point(q.a), guarded.point(q.b), guarded.point(q.c)),
                    triangle_quality(guarded.point(q.b), guarded.point(q.a), guarded.point(q.d)));
}

// Flips an edge if the facets become better than `least`. Returns whether it is flipped.
template <typename Guarded>
bool flip_if_better(typename Guarded::halfedge_descriptor h, double least, Guarded& guarded)
{
  typedef typename Guarded::Point Point;
  const auto& mesh = guarded.mesh;
  const auto q = guarded.quadrilateral(h);
  if(guarded.frozen.has_edge(edge(h, mesh)) || guarded.is_constrained(edge(h, mesh)) || degree(q.a, mesh) <= 3
     || degree(q.b, mesh) <= 3 || halfedge(q.c, q.d, mesh).second)
    return false;
  const Point &a = guarded.point(q.a), &b = guarded.point(q.b), &c = guarded.point(q.c), &d = guarded.point(q.d);
  if(!((std::min)(triangle_quality(a, d, c), triangle_quality(d, b, c)) > least)) return false;
  // Sharp edges remain, and no facets are created across them.
  if(unit_normal_or_zero(a, b, c) * unit_normal_or_zero(b, a, d) < remeshing_tuning.least_cosine) return false;
  if(!guarded.accepts(a, d, c) || !guarded.accepts(d, b, c)) return false;
  guarded.flip(h);
  return true;
}

template <typename Guarded>
void flip_to_regular_valences(Guarded& guarded)
{
  const auto& mesh = guarded.mesh;
  const auto deviation = [&](auto v, int change) { return std::abs(int(degree(v, mesh)) + change - 6); };
  for(auto e : edges(mesh)) {
    if(!guarded.go_on()) return;
    const auto h = halfedge(e, mesh);
    const auto q = guarded.quadrilateral(h);
    const int before = deviation(q.a, 0) + deviation(q.b, 0) + deviation(q.c, 0) + deviation(q.d, 0);
    const int after = deviation(q.a, -1) + deviation(q.b, -1) + deviation(q.c, 1) + deviation(q.d, 1);
    if(after < before)
      flip_if_better(h, (std::min)(quality_at_edge(h, guarded), remeshing_tuning.regular_quality), guarded);
  }
}

// Repeats passes until no edge is flipped, up to a limit. Later passes would change almost nothing.
template <typename Guarded>
void flip_to_larger_angles(Guarded& guarded)
{
  const auto& mesh = guarded.mesh;
  for(int pass = 0; pass < remeshing_tuning.max_flip_passes; ++pass) {
    std::size_t flipped = 0;
    for(auto e : edges(mesh)) {
      if(!guarded.go_on()) return;
      const auto h = halfedge(e, mesh);
      flipped += flip_if_better(h, remeshing_tuning.least_gain * quality_at_edge(h, guarded), guarded);
    }
    if(flipped == 0) return;
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FLIP_EDGES_H
