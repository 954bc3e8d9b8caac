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

// the facets at a vertex: each is the triangle of `apex` and the two points of a wing
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
// the same, not rounded; its largest component is 1 or -1
std::optional<std::array<Exact_rational, 3> > exact_cone_direction(const Vertex_fan& fan);
double cone_margin(const Vertex_fan& fan);
std::optional<double> bounded_cone_margin(const Vertex_fan& fan, double bound);

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief a direction that all facets at a vertex face, if there is one: \f$g\f$ with \f$n_i \cdot g > 0\f$ for the
 * normals \f$n_i\f$ of all incident facets.
 *
 * Without such a direction the vertex is *singular*: no field can satisfy the acute angle condition there. The answer
 * is exact: a candidate is confirmed by the kernel's orientation predicate, and where the mean of the normals is none,
 * a linear program is solved in rational arithmetic.
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
 * \brief the direction that unit vectors have most in common: that of the largest \f$\min_i n_i \cdot g\f$ over unit
 * vectors \f$g\f$. Its length is that minimum, if it is positive; none have a direction in common if it is (nearly)
 * zero.
 *
 * It is the point of their convex hull nearest to the origin, and so the center of the smallest ball around them.
 * Computed in `double`s, to about 1e-12.
 *
 * \pre there is at least one
 */
std::array<double, 3> cone_axis(
  const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& unit_vectors);

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief how much room the facets at a vertex leave for a common direction: the length of `cone_axis()` of their unit
 * normals; one on a plane, zero at a singular vertex. Whether it is zero, `vertex_cone()` decides exactly.
 */
template <typename TriangleMesh>
double vertex_cone_margin(const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::vertex_descriptor v)
{
  return internal::cone_margin(internal::vertex_fan(mesh, v));
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief `vertex_cone_margin()`, or a bound that it does not fall below: much faster where it does not, as any
 * direction that the facets face may show that.
 *
 * \pre as for `vertex_cone()`
 * \return the smaller one of both; nothing at a singular vertex, as `vertex_cone()` decides
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
