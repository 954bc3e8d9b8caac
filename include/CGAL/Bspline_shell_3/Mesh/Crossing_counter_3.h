// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H

#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief counts, exactly, how often a segment passes through a mesh from the back of its facets to their front.
 *
 * The mesh is closed; otherwise the count means nothing. Const member functions may be called from several threads at
 * once, after `build()`.
 */
class Crossing_counter_3
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Kernel::Point_3 Point_3;
  typedef Surface_mesh<Point_3> Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;

  /// \pre `mesh` outlives this object
  explicit Crossing_counter_3(const Triangle_mesh& mesh)
    : m_mesh(&mesh), m_tree(faces(mesh).begin(), faces(mesh).end(), mesh)
  {
    m_tree.build();
  }

  /// the facets that the segment crosses in their interiors, with the sign of each: 1 if it comes out at the front, -1 if it
  /// goes in. Nothing if it touches an edge, a vertex, or a facet that one of its ends lies on: take another segment.
  std::optional<std::vector<std::pair<Face_index, int> > > crossings(const Point_3& p, const Point_3& q) const
  {
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);      // that of exact predicates
    std::vector<Face_index> hit;
    m_tree.all_intersected_primitives(Kernel::Segment_3(p, q), std::back_inserter(hit));
    std::vector<std::pair<Face_index, int> > crossed;
    for(Face_index f : hit) {
      const auto h = m_mesh->halfedge(f);
      const Point_3 &a = m_mesh->point(m_mesh->source(h)), &b = m_mesh->point(m_mesh->target(h)),
                    &c = m_mesh->point(m_mesh->target(m_mesh->next(h)));
      const std::optional<int> crossing = facet_crossing(p, q, a, b, c);
      if(!crossing) return std::nullopt;
      if(*crossing != 0) crossed.emplace_back(f, *crossing);
    }
    return crossed;
  }

private:
  typedef AABB_tree<internal::AABB_traits_3<Kernel, AABB_face_graph_triangle_primitive<Triangle_mesh> > > Tree;

  const Triangle_mesh* m_mesh;
  Tree m_tree;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H
