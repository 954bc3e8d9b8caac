// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_H
#define CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_H

#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// The facets at a vertex: each is the triangle of `apex` and the two points of a wing.
struct Vertex_fan
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  Point_3 apex;
  boost::container::small_vector<std::pair<Point_3, Point_3>, 8> wings;
};

template <typename TriangleMesh>
Vertex_fan vertex_fan(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  const auto vpm = get(CGAL::vertex_point, mesh);
  const auto point = [&](auto w) {
    const auto& p = get(vpm, w);
    return Vertex_fan::Point_3(p.x(), p.y(), p.z());
  };
  Vertex_fan fan;
  fan.apex = point(v);
  for(auto h : CGAL::halfedges_around_target(v, mesh))
    fan.wings.emplace_back(point(target(next(h, mesh), mesh)), point(source(h, mesh)));
  return fan;
}

std::optional<Exact_predicates_inexact_constructions_kernel::Vector_3> cone_direction(const Vertex_fan& fan);
// Returns the direction without rounding; its largest component is 1 or -1.
std::optional<std::array<Exact_rational, 3> > exact_cone_direction(const Vertex_fan& fan);
double cone_margin(const Vertex_fan& fan);
std::optional<double> bounded_cone_margin(const Vertex_fan& fan, double bound);

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns a direction that all facets at a vertex face, if there is one: a \f$g\f$ with \f$n_i \cdot g > 0\f$
 * for the normals \f$n_i\f$ of all incident facets.
 *
 * Without such a direction, the vertex is *singular*: no field can increase across all of its facets. Existence is
 * decided exactly. First, the kernel's orientation predicate tests the mean of the normals; if it is not such a
 * direction, a linear program is solved in rational arithmetic.
 *
 * \tparam TriangleMesh a model of `HalfedgeGraph` with an internal vertex point map; the coordinates of its points are
 *   of type `double`
 * \pre all facets at `v` are non-degenerate triangles, and `v` is not on a border
 * \return a unit vector (rounded), or nothing for a singular vertex
 */
template <typename TriangleMesh>
std::optional<Exact_predicates_inexact_constructions_kernel::Vector_3> vertex_cone(
  const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  CGAL_precondition(!CGAL::is_border(v, mesh));
  return internal::cone_direction(internal::vertex_fan(mesh, v));
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the axis of a cone of unit vectors \f$n_i\f$: the direction of the unit vector \f$g\f$ with the
 * largest \f$\min_i n_i \cdot g\f$. Its length is this minimum if it is positive. If the axis is zero, up to rounding,
 * no direction has positive products with all vectors.
 *
 * The axis is the point of the convex hull nearest to the origin, and the center of the smallest ball around the
 * vectors. It is computed in `double`s, to about 1e-12.
 *
 * \pre there is at least one vector
 */
std::array<double, 3> cone_axis(
  const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& unit_vectors);

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the cone margin of a vertex: the length of `cone_axis()` of the unit normals of its facets. It is one
 * in a plane, small at sharp cones, and zero at singular vertices; `vertex_cone()` decides exactly whether it is zero.
 */
template <typename TriangleMesh>
double vertex_cone_margin(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  return internal::cone_margin(internal::vertex_fan(mesh, v));
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the minimum of `vertex_cone_margin()` and `bound`. If it is `bound`, this is much faster than
 * computing the margin, because one direction that all facets face may prove it.
 *
 * \pre as for `vertex_cone()`
 * \return the minimum; nothing at a singular vertex, as decided by `vertex_cone()`
 */
template <typename TriangleMesh>
std::optional<double> bounded_vertex_cone_margin(const TriangleMesh& mesh,
                                                 typename boost::graph_traits<TriangleMesh>::vertex_descriptor v,
                                                 double bound)
{
  return internal::bounded_cone_margin(internal::vertex_fan(mesh, v), bound);
}

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_H
