// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/FPU.h>

#include <iterator>

namespace CGAL {
namespace Bspline_shells {

class Crossing_counter_3::Tree
  : public AABB_tree<internal::AABB_traits_3<Exact_predicates_inexact_constructions_kernel, AABB_face_graph_triangle_primitive<Triangle_mesh> > >
{
public:
  explicit Tree(const Triangle_mesh& mesh)
    : AABB_tree(faces(mesh).begin(), faces(mesh).end(), mesh)
  {
    build();
  }
};

CGAL_BSPLINE_SHELL_3_INLINE Crossing_counter_3::Crossing_counter_3(const Triangle_mesh& mesh)
  : m_mesh(&mesh), m_tree(std::make_shared<const Tree>(mesh))
{}

CGAL_BSPLINE_SHELL_3_INLINE std::optional<std::vector<std::pair<Crossing_counter_3::Face_index, int> > >
Crossing_counter_3::crossings(const Point_3& p, const Point_3& q) const
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);      // that of exact predicates
  std::vector<Face_index> hit;
  m_tree->all_intersected_primitives(Exact_predicates_inexact_constructions_kernel::Segment_3(p, q), std::back_inserter(hit));
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

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H
