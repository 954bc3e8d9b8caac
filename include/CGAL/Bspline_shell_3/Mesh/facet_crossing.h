// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_FACET_CROSSING_H
#define CGAL_BSPLINE_SHELL_3_MESH_FACET_CROSSING_H

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/enum.h>

#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns, exactly, how a segment crosses a facet: 1 if it passes through the interior from back to front, -1 if
 * from front to back, and 0 if they are disjoint; nothing if the segment touches an edge or a vertex, ends on the
 * facet, or lies in its plane.
 *
 * \tparam Point_3 a point of a kernel with exact predicates
 */
template <typename Point_3>
std::optional<int> facet_crossing(const Point_3& p, const Point_3& q, const Point_3& a, const Point_3& b,
                                  const Point_3& c)
{
  const Orientation at_p = orientation(a, b, c, p), at_q = orientation(a, b, c, q);
  if(at_p == at_q && at_p != COPLANAR) return 0;
  // The line meets the interior if it passes all three edges on the same side.
  const Orientation ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  const bool left = ab == POSITIVE || bc == POSITIVE || ca == POSITIVE,
             right = ab == NEGATIVE || bc == NEGATIVE || ca == NEGATIVE;
  if(left && right) return 0;
  if(at_p == COPLANAR || at_q == COPLANAR || ab == COPLANAR || bc == COPLANAR || ca == COPLANAR) return std::nullopt;
  return at_q == POSITIVE ? 1 : -1;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_FACET_CROSSING_H
