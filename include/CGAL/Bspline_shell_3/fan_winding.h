// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FAN_WINDING_H
#define CGAL_BSPLINE_SHELL_3_FAN_WINDING_H

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief how often the fan of facets at a vertex winds around an axis that all of them face: once, unless the surface folds
 * through itself at the vertex. Facets that face the field one by one may still wind twice.
 *
 * Exact: each facet turns by less than half a turn, so that counting the edges that come back past the first one, by
 * orientation predicates alone, counts the turns.
 *
 * \tparam TriangleMesh a model of `HalfedgeGraph` with an internal vertex point map; points of a kernel with exact predicates
 * \param mesh the mesh
 * \param v a vertex that is not on a border
 * \param on_axis a point on the axis, in the direction that the facets face from `v`
 * \return the number of turns; 0 if some facet does not face the axis
 */
template <typename TriangleMesh, typename Point_3>
std::size_t fan_winding_number(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v,
                               const Point_3& on_axis)
{
  const auto vpm = get(CGAL::vertex_point, mesh);
  const Point_3& p = get(vpm, v);
  // sources of the halfedges to v, in the order in which the facets turn: facet (v, target(next), source)
  std::vector<Point_3> link;
  for(auto h : CGAL::halfedges_around_target(v, mesh)) {
    const Point_3& q = get(vpm, target(next(h, mesh), mesh));
    const Point_3& r = get(vpm, source(h, mesh));
    if(CGAL::orientation(p, on_axis, q, r) != POSITIVE) return 0;
    link.push_back(r);
  }
  std::size_t turns = 0;
  // halfedges_around_target() walks against the facets' turn: link[i] to link[i-1] is a facet's step
  Orientation last = COLLINEAR;
  for(std::size_t n = link.size(); n-- > 0; ) {
    const Orientation side = n == 0 ? COLLINEAR : CGAL::orientation(p, on_axis, link[0], link[n]);
    if(last == NEGATIVE && side != NEGATIVE) ++turns;
    last = side;
  }
  return turns;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FAN_WINDING_H
