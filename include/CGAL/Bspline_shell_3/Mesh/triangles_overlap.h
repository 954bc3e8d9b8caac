// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_TRIANGLES_OVERLAP_H
#define CGAL_BSPLINE_SHELL_3_MESH_TRIANGLES_OVERLAP_H

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns, exactly, whether two triangles meet outside of their common vertices and edges.
 *
 * \tparam Point_3 a point of a kernel with exact predicates
 * \param s,t indices of three points; equal indices are common vertices
 * \param points the points
 * \pre the triangles are not degenerate
 */
template <typename Point_3>
bool triangles_overlap(std::array<std::size_t, 3> s, std::array<std::size_t, 3> t, const std::vector<Point_3>& points)
{
  typedef typename Kernel_traits<Point_3>::Kernel Kernel;
  typedef typename Kernel::Segment_3 Segment_3;
  typedef typename Kernel::Triangle_3 Triangle_3;
  // The common vertices are moved to the front.
  std::size_t common = 0;
  for(std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(t.begin() + std::ptrdiff_t(common), t.end(), s[i]);
    if(found == t.end()) continue;
    std::swap(s[i], s[common]);
    std::swap(*found, t[common]);
    ++common;
  }
  const Point_3 &p = points[s[0]], &q = points[s[1]], &r = points[s[2]];
  const Point_3 &u = points[t[0]], &v = points[t[1]], &w = points[t[2]];
  switch(common) {
    case 0: return CGAL::do_intersect(Triangle_3(p, q, r), Triangle_3(u, v, w));
    case 1: // a common segment that begins at the vertex ends on the opposite edge of one triangle
      return CGAL::do_intersect(Segment_3(q, r), Triangle_3(u, v, w))
             || CGAL::do_intersect(Segment_3(v, w), Triangle_3(p, q, r));
    case 2: return CGAL::coplanar(p, q, r, w) && CGAL::coplanar_orientation(p, q, r, w) == POSITIVE;
    default: return true;
  }
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_TRIANGLES_OVERLAP_H
