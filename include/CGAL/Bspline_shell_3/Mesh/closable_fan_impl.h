// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/closable_fan.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether a fan turns by less than 2 pi about an axis that all its facets face. `side(n)` is the side of the
// first edge on which edge n lies; the fan passes its first edge again where `side(n)` is no longer negative.
template <typename Side>
bool turns_less_than_once(std::size_t size, const Side& side)
{
  Orientation last = POSITIVE;
  for(std::size_t n = 1; n < size; ++n) {
    const Orientation next = side(n);
    if(last == NEGATIVE && next != NEGATIVE) return false;
    last = next;
  }
  return true;
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE
bool is_fan_closable(const Exact_predicates_inexact_constructions_kernel::Point_3& p,
                     const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& link)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef Simple_cartesian<Exact_rational> Exact;
  internal::Vertex_fan fan;
  fan.apex = p;
  for(std::size_t n = 0; n + 1 < link.size(); ++n) fan.wings.emplace_back(link[n], link[n + 1]);

  // In most cases, the direction that is easiest to compute suffices.
  if(const auto g = internal::cone_direction(fan)) {
    const Point_3 s = p + std::sqrt((link[0] - p).squared_length()) * *g;
    bool is_faced = true;
    for(const auto& w : fan.wings) is_faced = is_faced && CGAL::orientation(p, s, w.first, w.second) == POSITIVE;
    if(is_faced && internal::turns_less_than_once(link.size(), [&](std::size_t n) {
         return CGAL::orientation(p, s, link[0], link[n]);
       }))
      return true;
  } else return false;

  const auto exact = [&](const Point_3& q) {
    return Exact::Vector_3(Exact_rational(q.x()) - Exact_rational(p.x()), Exact_rational(q.y()) - Exact_rational(p.y()),
                           Exact_rational(q.z()) - Exact_rational(p.z()));
  };
  const Exact::Vector_3 first = exact(link.front());
  const auto is_closable_about = [&](const internal::Vertex_fan& bounded) {
    const auto g = internal::exact_cone_direction(bounded);
    if(!g) return false;
    const Exact::Vector_3 axis((*g)[0], (*g)[1], (*g)[2]);
    return internal::turns_less_than_once(
      link.size(), [&](std::size_t n) { return CGAL::orientation(axis, first, exact(link[n])); });
  };
  // The axis is restricted so that the fan ends more than half a turn after its first edge, or less.
  internal::Vertex_fan beyond = fan, before = fan;
  beyond.wings.emplace_back(link.back(), link.front());
  before.wings.emplace_back(link.front(), link.back());
  // The last case applies if these two edges are collinear.
  return is_closable_about(beyond) || is_closable_about(before) || is_closable_about(fan);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_IMPL_H
