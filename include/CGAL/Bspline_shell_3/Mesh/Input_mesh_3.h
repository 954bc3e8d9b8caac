// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief a copy of a user's mesh that satisfies the requirements of a shell: triangles with `double` coordinates, each
 * with its facet of origin.
 *
 * Other coordinates are rounded to `double`s, and all statements refer to the rounded mesh. Elements are numbered in
 * spatial order, so that passes over them use the processor's cache well.
 */
class Input_mesh_3
{
public:
  typedef Mesh_with_origins::Triangle_mesh Triangle_mesh;
  typedef Mesh_with_origins::Face_index Face_index;

  /// defects that the caller accepts
  struct Tolerated_defects
  {
    bool self_intersections = false;
    bool singular_vertices = false;
    bool orientation = false; ///< components may fail to bound a volume together; `faces_outwards()` is then undefined
  };

  Input_mesh_3() = default;

  /// copies, triangulates, closes, truncates, and checks a mesh.
  /// \tparam FaceGraph a model of `FaceListGraph`
  /// \tparam VertexPointMap a model of `ReadablePropertyMap` from its vertices to points of a \cgal kernel
  /// \param mesh the mesh
  /// \param vpm its points
  /// \param tolerated defects that are not checked
  /// \param closing closes the mesh if it is open; if it is null, open meshes are rejected
  /// \param truncation replaces the patches that the mesh has; may be null. Self-intersections of a mesh with patches
  ///   are not tolerated.
  template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
  Shell_status build(const FaceGraph& mesh, VertexPointMap vpm, const Tolerated_defects& tolerated,
                     std::shared_ptr<const Shell_closing_3> closing = nullptr,
                     std::shared_ptr<const Shell_truncation_3> truncation = nullptr)
  {
    return build<ConcurrencyTag>(copy_mesh<ConcurrencyTag>(mesh, vpm), tolerated, std::move(closing),
                                 std::move(truncation));
  }

  /// takes a mesh that was validated, closed, and truncated, unless it was rejected. Finds its components, and checks
  /// its orientation and its vertices.
  /// \param mesh the mesh
  /// \param tolerated defects that are not checked
  template <typename ConcurrencyTag>
  Shell_status take(Mesh_with_origins mesh, const Tolerated_defects& tolerated);

  /// returns the status of the last call of `build()` or `take()`. Unless it is `SUCCESS`, the mesh is empty.
  Shell_status status() const { return m_mesh.refusal.status; }
  const Triangle_mesh& mesh() const { return m_mesh.mesh; }
  /// returns the closing of the user's mesh, or null if that mesh is closed. Its triangles follow those of the mesh,
  /// and count as facets of origin.
  const std::shared_ptr<const Shell_closing_3>& closing() const { return m_mesh.closing; }
  /// returns the truncation of the user's mesh, which has been applied to this mesh, or null if no tip is replaced
  const std::shared_ptr<const Shell_truncation_3>& truncation() const { return m_mesh.truncation; }
  /// returns the facet of the user's mesh (position in `faces(mesh)`) that a triangle is part of. Larger numbers denote
  /// triangles of the closing, followed by triangles of discs: see `part_of_facet()`.
  std::size_t facet_of_origin(Face_index f) const { return m_mesh.facet_origin[f]; }
  /// returns the part of the surface that a facet of origin belongs to
  Surface_part part_of_facet(std::size_t facet) const { return m_mesh.part_of_facet(facet); }
  /// returns the number of facets of origin, including triangles of the closing and of discs
  std::size_t number_of_facets_of_origin() const { return m_mesh.number_of_facet_origins; }
  /// returns the smallest box around the facets
  const Bbox_3& bbox() const { return m_mesh.bbox; }
  /// returns the length of the longest side of the box
  double unit() const { return m_mesh.unit(); }
  std::size_t number_of_components() const { return m_number_of_components; }
  /// returns the connected component of a triangle. Components are numbered in the order of their first facets in the
  /// user's mesh.
  std::size_t component(Face_index f) const { return m_component[f]; }
  /// returns `false` if the facets face the bounded side; the field then increases inwards. For a self-intersecting
  /// mesh, returns whether its volume is positive.
  bool faces_outwards() const { return m_outwards; }
  const Offending_simplices& offending_simplices() const { return m_mesh.refusal.offending_simplices; }
  /// returns the vertex of the user's mesh (position in `vertices(mesh)`) for a vertex of this mesh. Larger numbers
  /// denote vertices of the closing, followed by vertices of discs.
  std::size_t vertex_of_origin(Triangle_mesh::Vertex_index v) const { return m_mesh.vertex_origin[v]; }
  std::array<Mesh_with_origins::Kernel::Point_3, 3> triangle(Face_index f) const { return m_mesh.triangle(f); }

private:
  template <typename ConcurrencyTag>
  Shell_status build(Mesh_with_origins mesh, const Tolerated_defects& tolerated,
                     std::shared_ptr<const Shell_closing_3> closing,
                     std::shared_ptr<const Shell_truncation_3> truncation);

  Mesh_with_origins m_mesh;
  std::vector<std::size_t> m_component; // by facet
  std::size_t m_number_of_components = 0;
  bool m_outwards = true;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
