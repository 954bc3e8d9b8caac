// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H
#define CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief how often the fan of facets at a vertex winds around an axis that all of them face: once, unless the surface folds
 * through itself at the vertex. Facets that face the field one by one may still wind twice.
 *
 * Exact: each facet turns by less than half a turn, so that counting the edges that come back past the first one, by
 * orientation predicates alone, counts the turns.
 *
 * \param p the vertex; of a kernel with exact predicates
 * \param on_axis a point on the axis, in the direction that the facets face from `p`
 * \param link the other vertices of the facets, in cyclic order: the facets are (`p`, `link[n]`, `link[n+1]`)
 * \return the number of turns; 0 if some facet does not face the axis
 */
template <typename Point_3>
std::size_t link_winding_number(const Point_3& p, const Point_3& on_axis, const std::vector<Point_3>& link)
{
  std::size_t turns = 0;
  Orientation last = COLLINEAR;
  for(std::size_t n = 0; n < link.size(); ++n) {
    const Point_3& next = link[(n + 1) % link.size()];
    if(CGAL::orientation(p, on_axis, link[n], next) != POSITIVE) return 0;
    const Orientation side = n + 1 == link.size() ? COLLINEAR : CGAL::orientation(p, on_axis, link[0], next);
    if(last == NEGATIVE && side != NEGATIVE) ++turns;
    last = side;
  }
  return turns;
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the same, `link_winding_number()`, for the facets at a vertex of a mesh.
 *
 * \tparam TriangleMesh a model of `HalfedgeGraph` with an internal vertex point map; points of a kernel with exact predicates
 * \param mesh the mesh
 * \param v a vertex that is not on a border
 * \param on_axis a point on the axis, in the direction that the facets face from `v`
 */
template <typename TriangleMesh, typename Point_3>
std::size_t fan_winding_number(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v,
                               const Point_3& on_axis)
{
  const auto vpm = get(CGAL::vertex_point, mesh);
  std::vector<Point_3> link;
  for(auto h : CGAL::halfedges_around_target(v, mesh)) link.push_back(get(vpm, source(h, mesh)));
  std::reverse(link.begin(), link.end());       // halfedges_around_target() walks against the facets' turn
  return link_winding_number(get(vpm, v), on_axis, link);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H
