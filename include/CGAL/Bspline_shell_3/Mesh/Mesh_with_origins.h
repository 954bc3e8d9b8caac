// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_MESH_WITH_ORIGINS_H
#define CGAL_BSPLINE_SHELL_3_MESH_MESH_WITH_ORIGINS_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/copy_in_morton_order.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the reason why a mesh is rejected, with the facets or vertices of the user's mesh that cause it. The status is
 * `SUCCESS` if the mesh is not rejected.
 */
struct Mesh_refusal
{
  Shell_status status = Shell_status::SUCCESS;
  Offending_simplices offending_simplices;

  explicit operator bool() const { return status != Shell_status::SUCCESS; } ///< returns whether the mesh is rejected
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief a copy of a user's mesh, which may be closed and truncated, and the origins of its elements.
 *
 * The origin of an element is its position in `faces(mesh)` or `vertices(mesh)` of the user's mesh. Larger numbers
 * denote elements of the closing, followed by elements of discs.
 */
struct Mesh_with_origins
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
  typedef Surface_mesh<Kernel::Point_3> Triangle_mesh;
  typedef Triangle_mesh::Vertex_index Vertex_index;
  typedef Triangle_mesh::Face_index Face_index;

  Mesh_refusal refusal = { Shell_status::NOT_BUILT, {} };
  Triangle_mesh mesh;
  std::vector<std::size_t> facet_origin, vertex_origin; ///< by facet, by vertex
  std::size_t user_facets = 0, user_vertices = 0;       ///< numbers of elements of the user's mesh
  /// numbers of elements of the user's mesh, the closing and the discs
  std::size_t number_of_facet_origins = 0, number_of_vertex_origins = 0;
  std::vector<char> is_embedded; ///< by vertex, whether its fan is proved to be embedded; empty if this is unknown
  Bbox_3 bbox;                   ///< the smallest box around the facets
  std::shared_ptr<const Shell_closing_3> closing;       ///< null if the user's mesh is closed
  std::shared_ptr<const Shell_truncation_3> truncation; ///< null if no tip is replaced

  /// returns the length of the longest side of the box
  double unit() const { return (std::max)({ bbox.x_span(), bbox.y_span(), bbox.z_span() }); }
  /// returns the part of the surface that a facet of origin belongs to
  Surface_part part_of_facet(std::size_t origin) const
  {
    return part(origin, user_facets, closing ? closing->triangles().size() : 0);
  }
  std::array<Kernel::Point_3, 3> triangle(Face_index f) const
  {
    const Triangle_mesh::Halfedge_index h = mesh.halfedge(f);
    return { mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))) };
  }

  /// \name Refusals
  /// The mesh is rejected because of its facets or vertices with these origins. Only elements of the user's mesh are
  /// listed. If all elements are of the closing or of discs, the status is `NOT_CLOSABLE` or `NOT_TRUNCATABLE`.
  /// @{
  Mesh_refusal refuse_facets(Shell_status status, std::vector<std::size_t> origins) const
  {
    status = restrict_to_user(status, origins, user_facets, closing ? closing->triangles().size() : 0);
    return { status, { std::move(origins), {} } };
  }
  Mesh_refusal refuse_vertices(Shell_status status, std::vector<std::size_t> origins) const
  {
    status = restrict_to_user(status, origins, user_vertices,
                              closing ? closing->points().size() - closing->number_of_border_points() : 0);
    return { status, { {}, std::move(origins) } };
  }
  // These functions accept the mesh if there are no origins.
  Mesh_refusal refuse_facets_if_any(Shell_status status, std::vector<std::size_t> origins) const
  {
    return origins.empty() ? Mesh_refusal() : refuse_facets(status, std::move(origins));
  }
  Mesh_refusal refuse_vertices_if_any(Shell_status status, std::vector<std::size_t> origins) const
  {
    return origins.empty() ? Mesh_refusal() : refuse_vertices(status, std::move(origins));
  }
  /// @}

private:
  static Surface_part part(std::size_t origin, std::size_t of_user, std::size_t of_closing)
  {
    if(origin < of_user) return Surface_part::MESH;
    return origin - of_user < of_closing ? Surface_part::CLOSING : Surface_part::DISC;
  }
  static Shell_status restrict_to_user(Shell_status status, std::vector<std::size_t>& origins, std::size_t of_user,
                                       std::size_t of_closing)
  {
    if(origins.empty()) return status;
    sort_unique(origins);
    const Surface_part first = part(origins.front(), of_user, of_closing);
    origins.erase(std::lower_bound(origins.begin(), origins.end(), of_user), origins.end());
    if(first == Surface_part::MESH) return status;
    return first == Surface_part::CLOSING ? Shell_status::NOT_CLOSABLE : Shell_status::NOT_TRUNCATABLE;
  }
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief copies a mesh, with its coordinates rounded to `double`s and its elements in spatial order.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam VertexPointMap a model of `ReadablePropertyMap` from its vertices to points of a \cgal kernel
 * \param mesh the mesh
 * \param vpm its points
 * \return the copy, which may have polygons, or the reason why the mesh is rejected
 */
template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
Mesh_with_origins copy_mesh(const FaceGraph& mesh, VertexPointMap vpm)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  Mesh_with_origins copy;
  copy.refusal.status = Shell_status::EMPTY_MESH;
  if(CGAL::is_empty(mesh) || faces(mesh).begin() == faces(mesh).end()) return copy;
  std::vector<std::array<double, 3> > points;
  points.reserve(vertices(mesh).size());
  for(auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    const std::array<double, 3> point = internal::rounded_coordinates(p);
    const bool is_finite = std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
    if(!is_finite) copy.refusal.offending_simplices.vertices.push_back(points.size());
    points.push_back(point);
  }
  copy.refusal.status = Shell_status::NOT_FINITE;
  if(!copy.refusal.offending_simplices.vertices.empty()) return copy;
  copy.refusal.status = Shell_status::TOO_MANY_FACETS;
  if(!internal::triangulated_size(mesh).has_numbers()) return copy;

  copy.refusal.status = Shell_status::SUCCESS;
  copy.number_of_vertex_origins = copy.user_vertices = points.size();
  internal::Positions_of_origin origin = internal::copy_in_morton_order<ConcurrencyTag>(mesh, std::move(points),
                                                                                        copy.mesh);
  copy.facet_origin = std::move(origin.faces);
  copy.vertex_origin = std::move(origin.vertices);
  copy.number_of_facet_origins = copy.user_facets = copy.facet_origin.size();
  for(auto v : copy.mesh.vertices())
    if(!copy.mesh.is_isolated(v)) copy.bbox += copy.mesh.point(v).bbox();
  return copy;
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template Mesh_with_origins copy_mesh<Parallel_if_available_tag>(
  const Mesh_with_origins::Triangle_mesh&,
  boost::property_map<Mesh_with_origins::Triangle_mesh, vertex_point_t>::const_type);
#endif

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_MESH_WITH_ORIGINS_H
