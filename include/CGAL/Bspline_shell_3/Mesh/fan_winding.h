// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H
#define CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief Returns how often the fan of facets at a vertex winds around an axis that all of them face. The number is one
 * unless the surface folds through itself at the vertex: even if each facet has a positive slope, the fan may wind
 * twice.
 *
 * The result is exact. Each facet turns by less than half a turn, so that each turn has one edge that returns past the
 * first one. Orientation predicates count these edges.
 *
 * \param p the vertex, a point of a kernel with exact predicates
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

namespace internal {

// Returns the other vertices of the facets at `v`, in the cyclic order of the facets.
template <typename TriangleMesh>
auto vertex_link(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  const auto vpm = get(CGAL::vertex_point, mesh);
  std::vector<typename boost::property_traits<std::decay_t<decltype(vpm)> >::value_type> link;
  constexpr std::size_t usual = 8;
  link.reserve(usual);
  for(auto h : CGAL::halfedges_around_target(v, mesh)) link.push_back(get(vpm, source(h, mesh)));
  std::reverse(link.begin(), link.end()); // halfedges_around_target() visits the facets in reverse order
  return link;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief Returns whether all facets at a vertex face the mean of their normals and wind around it once. The projection
 * of the fan along the mean is then one-to-one, so that two facets have only the vertex or an edge in common.
 *
 * `true` is exact; `false` may only mean that the facets face another direction.
 *
 * \tparam TriangleMesh a model of `HalfedgeGraph` with an internal vertex point map, whose points have `double`
 *   coordinates and a kernel with exact predicates
 * \pre the facets at `v` are non-degenerate triangles, and form a single fan; `v` is not on a border
 */
template <typename TriangleMesh>
bool is_fan_embedded(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  CGAL_precondition(!CGAL::is_border(v, mesh));
  const auto link = internal::vertex_link(mesh, v);
  const auto& p = get(get(CGAL::vertex_point, mesh), v);
  std::array<double, 3> mean = {};
  double reach = 0;
  for(std::size_t n = 0; n < link.size(); ++n) {
    const auto normal = facet_normal(p, link[n], link[n + 1 < link.size() ? n + 1 : 0]).direction;
    const double length = internal::norm(normal);
    for(std::size_t a = 0; a < 3; ++a) mean[a] += normal[a] / length;
    for(int a = 0; a < 3; ++a) reach = (std::max)(reach, std::abs(link[n][a] - p[a]));
  }
  // If normals cancel, `on_axis` is `p`, which no facet faces.
  const std::array<double, 3> axis = internal::scaled_to_unit(mean);
  typedef std::decay_t<decltype(p)> Point_3;
  const Point_3 on_axis(p.x() + reach * axis[0], p.y() + reach * axis[1], p.z() + reach * axis[2]);
  return link_winding_number(p, on_axis, link) == 1;
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief Returns `is_fan_embedded()` for each vertex of a mesh, by index; 0 for border vertices and isolated vertices.
 *
 * \tparam Mesh a `CGAL::Surface_mesh` whose points have `double` coordinates and a kernel with exact predicates
 * \pre all facets are non-degenerate triangles, and the facets at a vertex form a single fan
 */
template <typename ConcurrencyTag, typename Mesh>
std::vector<char> embedded_fans(const Mesh& mesh)
{
  typedef typename Mesh::Vertex_index Vertex_index;
  constexpr std::size_t chunk = 1024;
  std::vector<char> is_embedded(mesh.num_vertices(), 0);
  internal::for_each_chunk<ConcurrencyTag>(is_embedded.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const Vertex_index v(static_cast<typename Vertex_index::size_type>(n));
      is_embedded[n] = !mesh.is_removed(v) && !mesh.is_isolated(v) && !mesh.is_border(v) && is_fan_embedded(mesh, v);
    }
  });
  return is_embedded;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_FAN_WINDING_H
