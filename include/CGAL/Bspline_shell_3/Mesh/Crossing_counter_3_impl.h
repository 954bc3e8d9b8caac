// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/FPU.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <mutex>

namespace CGAL {
namespace Bspline_shells {

class Crossing_counter_3::Facets
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
  typedef AABB_tree<internal::AABB_traits_3<Kernel, AABB_face_graph_triangle_primitive<Triangle_mesh> > > Tree;

public:
  explicit Facets(const Triangle_mesh& mesh) : m_mesh(mesh) {}

  // Returns the facets that a segment meets, in their order.
  template <typename ConcurrencyTag>
  std::vector<Face_index> met(const Point_3& p, const Point_3& q) const
  {
    const Kernel::Segment_3 segment(p, q);
    if(m_queries++ < most_scans) {
      const Bbox_3 box = segment.bbox();
      constexpr std::size_t chunk = 4096;
      return internal::collect_from_chunks<ConcurrencyTag, Face_index>(
        m_mesh.num_faces(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Face_index>& met) {
          for(std::size_t n = begin; n < end; ++n) {
            const Face_index f(static_cast<Triangle_mesh::size_type>(n));
            if(m_mesh.is_removed(f)) continue;
            const std::array<Point_3, 3> t = corners(f);
            if(do_overlap(box, t[0].bbox() + t[1].bbox() + t[2].bbox())
               && do_intersect(segment, Kernel::Triangle_3(t[0], t[1], t[2])))
              met.push_back(f);
          }
        });
    }
    std::call_once(m_is_built, [&] {
      m_tree = std::make_unique<Tree>(faces(m_mesh).begin(), faces(m_mesh).end(), m_mesh);
      m_tree->build();
    });
    std::vector<Face_index> met;
    m_tree->all_intersected_primitives(segment, std::back_inserter(met));
    std::sort(met.begin(), met.end());
    return met;
  }

  std::array<Point_3, 3> corners(Face_index f) const
  {
    const auto h = m_mesh.halfedge(f);
    return { m_mesh.point(m_mesh.source(h)), m_mesh.point(m_mesh.target(h)),
             m_mesh.point(m_mesh.target(m_mesh.next(h))) };
  }

private:
  static constexpr std::size_t most_scans = 32; // these take about as long as building a tree
  const Triangle_mesh& m_mesh;
  mutable std::atomic<std::size_t> m_queries{ 0 };
  mutable std::once_flag m_is_built;
  mutable std::unique_ptr<Tree> m_tree;
};

CGAL_BSPLINE_SHELL_3_INLINE Crossing_counter_3::Crossing_counter_3(const Triangle_mesh& mesh)
  : m_facets(std::make_shared<const Facets>(mesh))
{}

template <typename ConcurrencyTag>
std::optional<std::vector<std::pair<Crossing_counter_3::Face_index, int> > > Crossing_counter_3::crossings(
  const Point_3& p, const Point_3& q) const
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  std::vector<std::pair<Face_index, int> > crossed;
  for(Face_index f : m_facets->met<ConcurrencyTag>(p, q)) {
    const std::array<Point_3, 3> t = m_facets->corners(f);
    const std::optional<int> crossing = facet_crossing(p, q, t[0], t[1], t[2]);
    if(!crossing) return std::nullopt;
    if(*crossing != 0) crossed.emplace_back(f, *crossing);
  }
  return crossed;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_IMPL_H
