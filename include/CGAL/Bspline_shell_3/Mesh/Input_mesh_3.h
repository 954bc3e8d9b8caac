// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/copy_in_morton_order.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

class Crossing_counter_3;

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief Copy of a user's mesh, checked against the requirements of a shell: triangles with `double` coordinates, each
 * with its facet of origin.
 *
 * Other coordinates are rounded to `double`s, and all statements refer to the rounded mesh. Elements are numbered in
 * spatial order, so that passes over them use the processor's cache well.
 */
class Input_mesh_3
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Surface_mesh<Kernel::Point_3> Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;

  /// Defects that the caller accepts.
  struct Tolerated_defects
  {
    bool self_intersections = false;
    bool singular_vertices = false;
    bool orientation = false; // components may fail to bound a volume together; `faces_outwards()` has no meaning then
  };

  /// Closing of an open mesh, or the reason why there is none and the facets that cause it.
  struct Closed
  {
    Shell_status status = Shell_status::NOT_CLOSABLE;
    std::vector<Face_index> offending_facets;
    std::shared_ptr<const Shell_closing_3> closing; // not null on success
  };
  /// Closes an open triangle mesh that has no degenerate facets and whose vertices have one fan each.
  typedef std::function<Closed(const Triangle_mesh&)> Closer;

  /// Returns a closer that always returns `closing`; an empty function if it is null.
  static Closer closer(std::shared_ptr<const Shell_closing_3> closing)
  {
    if(!closing) return Closer();
    return [closing](const Triangle_mesh&) {
      Closed closed;
      closed.status = Shell_status::SUCCESS;
      closed.closing = closing;
      return closed;
    };
  }

  /// Finds the vertices to be truncated; returns null if there are none. The mesh is closed and, unless they are
  /// tolerated, has no self-intersections. Its components and orientation are not determined yet.
  typedef std::function<std::shared_ptr<const Shell_truncation_3>(const Input_mesh_3&)> Truncator;

  /// Returns a truncator that always returns `truncation`; an empty function if it is null.
  static Truncator truncator(std::shared_ptr<const Shell_truncation_3> truncation)
  {
    if(!truncation) return Truncator();
    return [truncation](const Input_mesh_3&) { return truncation; };
  }

  Input_mesh_3() = default;

  /// Copies, triangulates and checks the mesh.
  /// \tparam FaceGraph a model of `FaceListGraph`
  /// \tparam VertexPointMap a model of `ReadablePropertyMap` from its vertices to points of a \cgal kernel
  /// \param mesh the mesh
  /// \param vpm its points
  /// \param tolerated defects that are not checked
  /// \param closer called if the mesh is open; without it, open meshes are rejected
  /// \param truncator called to find the vertices to be truncated; without it, none are truncated
  template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
  Shell_status build(const FaceGraph& mesh, VertexPointMap vpm, const Tolerated_defects& tolerated,
                     const Closer& closer = Closer(), const Truncator& truncator = Truncator())
  {
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
    m_status = Shell_status::NOT_BUILT;
    m_offenders = Offending_simplices();
    Shell_status status = copy<ConcurrencyTag>(mesh, vpm);
    m_closing.reset();
    m_truncation.reset();
    if(status == Shell_status::SUCCESS) status = check<ConcurrencyTag>(tolerated, closer, truncator);
    if(status != Shell_status::SUCCESS) {
      m_mesh.clear();
      m_closing.reset();
      m_truncation.reset();
      m_components = 0;
    }
    return m_status = status;
  }

  /// Status of the last call of `build()`. Unless it is `SUCCESS`, the mesh is empty.
  Shell_status status() const { return m_status; }
  const Triangle_mesh& mesh() const { return m_mesh; }
  /// Closing of the user's mesh, or null if that mesh is closed. Its triangles follow those of the mesh, and count as
  /// facets of origin.
  const std::shared_ptr<const Shell_closing_3>& closing() const { return m_closing; }
  /// Truncation of the user's mesh, which has been applied to this mesh; null if no tip is replaced.
  const std::shared_ptr<const Shell_truncation_3>& truncation() const { return m_truncation; }
  /// Returns the facet of the user's mesh (position in `faces(mesh)`) that a triangle is part of. Larger numbers denote
  /// triangles of the closing, followed by triangles of discs: see `part_of_facet()`.
  std::size_t facet_of_origin(Face_index f) const { return m_origin[f]; }
  /// Returns the part of the surface that a facet of origin belongs to.
  Surface_part part_of_facet(std::size_t facet) const
  {
    if(facet < m_user_facets) return Surface_part::MESH;
    const std::size_t closing = m_closing ? m_closing->triangles().size() : 0;
    return facet - m_user_facets < closing ? Surface_part::CLOSING : Surface_part::DISC;
  }
  /// Number of facets of origin, including triangles of the closing and of discs.
  std::size_t number_of_facets_of_origin() const { return m_number_of_facets; }
  /// Smallest box around the facets.
  Bbox_3 bbox() const { return m_bbox; }
  /// Length of the longest side of the box: the paper's unit.
  double unit() const { return (std::max)({ m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span() }); }
  std::size_t number_of_components() const { return m_components; }
  /// Returns the connected component of a triangle. Components are numbered in the order of their first facets in the
  /// user's mesh.
  std::size_t component(Face_index f) const { return m_component[f]; }
  /// `false` if the facets face the bounded side; the field then increases inwards. For a self-intersecting mesh:
  /// whether its volume is positive.
  bool faces_outwards() const { return m_outwards; }
  const Offending_simplices& offending_simplices() const { return m_offenders; }
  /// Returns the vertex of the user's mesh (position in `vertices(mesh)`) for a vertex of this mesh. Larger numbers
  /// denote vertices of the closing, followed by vertices of discs.
  std::size_t vertex_of_origin(Triangle_mesh::Vertex_index v) const { return m_vertex_origin[v]; }
  /// Returns whether a vertex belongs to the user's mesh.
  bool is_of_user(Triangle_mesh::Vertex_index v) const { return m_vertex_origin[v] < m_user_vertices; }

  std::array<Kernel::Point_3, 3> triangle(Face_index f) const
  {
    Triangle_mesh::Halfedge_index h = m_mesh.halfedge(f);
    return { m_mesh.point(m_mesh.source(h)), m_mesh.point(m_mesh.target(h)),
             m_mesh.point(m_mesh.target(m_mesh.next(h))) };
  }

private:
  template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
  Shell_status copy(const FaceGraph& mesh, VertexPointMap vpm);
  template <typename ConcurrencyTag>
  Shell_status check(const Tolerated_defects& tolerated, const Closer& closer, const Truncator& truncator);
  std::vector<std::size_t> facets_at_border() const;
  Shell_status check_border();
  Shell_status check_fans();
  template <typename ConcurrencyTag>
  Shell_status close(const Closer& closer);
  template <typename ConcurrencyTag>
  Shell_status truncate(const Truncator& truncator, const Tolerated_defects& tolerated);
  template <typename ConcurrencyTag>
  Shell_status triangulate();
  bool triangulate(Face_index f);
  Shell_status check_range() const;
  template <typename ConcurrencyTag>
  Shell_status check_areas();
  template <typename ConcurrencyTag>
  bool is_surface();
  template <typename ConcurrencyTag>
  Shell_status check_intersections();
  void find_components();
  template <typename ConcurrencyTag>
  Shell_status check_orientation();
  template <typename ConcurrencyTag>
  std::optional<std::vector<std::size_t> > components_around_front(Face_index f,
                                                                   const Crossing_counter_3& counter) const;
  Shell_status check_volume();
  template <typename ConcurrencyTag>
  Shell_status check_vertices();
  Shell_status refuse_facets(Shell_status status, std::vector<std::size_t>& facets);
  Shell_status refuse_vertices(Shell_status status, std::vector<std::size_t>& vertices);

  static constexpr unsigned int max_pairs = 1000;

  Shell_status m_status = Shell_status::NOT_BUILT;
  Triangle_mesh m_mesh;
  std::vector<std::size_t> m_origin, m_vertex_origin, m_component;
  std::vector<char> m_is_embedded; // by vertex, whether its fan is proved embedded; empty if unknown
  Bbox_3 m_bbox;
  std::size_t m_number_of_facets = 0, m_number_of_vertices = 0, m_components = 0;
  std::size_t m_user_facets = 0, m_user_vertices = 0;
  std::shared_ptr<const Shell_closing_3> m_closing;
  std::shared_ptr<const Shell_truncation_3> m_truncation;
  bool m_outwards = true;
  Offending_simplices m_offenders;
};

template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
Shell_status Input_mesh_3::copy(const FaceGraph& mesh, VertexPointMap vpm)
{
  m_mesh.clear();
  if(CGAL::is_empty(mesh) || faces(mesh).begin() == faces(mesh).end()) return Shell_status::EMPTY_MESH;
  std::vector<std::array<double, 3> > points;
  points.reserve(vertices(mesh).size());
  for(auto v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    const std::array<double, 3> point = internal::rounded_coordinates(p);
    const bool is_finite = std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
    if(!is_finite) m_offenders.vertices.push_back(points.size());
    points.push_back(point);
  }
  if(!m_offenders.vertices.empty()) return Shell_status::NOT_FINITE;

  if(!internal::triangulated_size(mesh).has_numbers()) return Shell_status::TOO_MANY_FACETS;
  m_number_of_vertices = m_user_vertices = points.size();
  internal::Positions_of_origin origin = internal::copy_in_morton_order<ConcurrencyTag>(mesh, std::move(points),
                                                                                        m_mesh);
  m_origin = std::move(origin.faces);
  m_vertex_origin = std::move(origin.vertices);
  m_number_of_facets = m_user_facets = m_origin.size();
  m_bbox = Bbox_3();
  for(auto v : m_mesh.vertices())
    if(!m_mesh.is_isolated(v)) m_bbox += m_mesh.point(v).bbox();
  return check_range();
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template Shell_status Input_mesh_3::copy<Parallel_if_available_tag>(
  const Input_mesh_3::Triangle_mesh&, boost::property_map<Input_mesh_3::Triangle_mesh, vertex_point_t>::const_type);
#endif

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
