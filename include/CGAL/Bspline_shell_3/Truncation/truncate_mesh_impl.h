// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Disc_search.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Tip.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Truncation_tuning.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/assemble_truncation.h>
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <typename ConcurrencyTag>
class Mesh_truncator
{
  typedef Truncation_mesh Mesh;
  typedef Mesh::Vertex_index Vertex_index;
  typedef Mesh::Face_index Face_index;
  typedef Truncation_report::Outcome Outcome;
public:
  Mesh_truncator(const Mesh_with_origins& input,
                 const std::function<double(const std::array<double, 3>&)>& largest_radius, Truncation_report& report)
    : m_input(input), m_mesh(input.mesh), m_largest_radius(largest_radius), m_report(report)
  {}

  std::shared_ptr<const Shell_truncation_3> operator()(double least_margin)
  {
    find_tips(least_margin);
    if(!m_tips.empty()) shrink_tips();
    for_each_chunk<ConcurrencyTag>(m_tips.size(), 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) find_disc(m_tips[n]);
    });
    std::shared_ptr<const Shell_truncation_3> truncation = replace_tips();
    std::sort(m_report.vertices.begin(), m_report.vertices.end(),
              [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return truncation;
  }

private:
  struct Replaced_tip : Tip
  {
    using Tip::Tip;
    std::optional<Tip_disc> disc; // the disc that replaces it, if one is found
  };

  // If a disc intersects other facets, or its own facets by rounding, its radius is halved.
  std::shared_ptr<const Shell_truncation_3> replace_tips()
  {
    for(int round = 0;; ++round) {
      drop_tips([](const Replaced_tip& tip) { return !tip.disc; }, Outcome::NO_DISC);
      if(m_tips.empty()) return nullptr;
      std::vector<Tip_disc> discs;
      for(const Replaced_tip& tip : m_tips) discs.push_back(*tip.disc);
      auto truncation = std::make_shared<const Shell_truncation_3>(
        assemble_truncation(m_mesh, std::vector<Tip>(m_tips.begin(), m_tips.end()), discs));
      if(!truncation->is_valid()) {
        drop_tips([](const Replaced_tip&) { return true; }, Outcome::NO_SPACE);
        return nullptr;
      }
      const std::unordered_set<std::size_t> intersecting = intersecting_tips(*truncation);
      if(intersecting.empty()) {
        for(const Replaced_tip& tip : m_tips) note(tip, Outcome::TRUNCATED);
        return truncation;
      }
      for(std::size_t n : intersecting) {
        m_tips[n].radius /= 2;
        m_tips[n].disc.reset();
        if(round < truncation_tuning.max_halvings) find_disc(m_tips[n]);
      }
    }
  }

  void note(const Replaced_tip& tip, Outcome outcome)
  {
    Truncation_report::Vertex v;
    v.vertex = m_input.vertex_origin[tip.vertex];
    v.point = { tip.center.x(), tip.center.y(), tip.center.z() };
    v.outcome = outcome;
    v.radius = 0;
    v.margin_before = v.margin_after = tip.margin;
    if(outcome == Outcome::TRUNCATED) {
      v.radius = tip.radius;
      v.margin_after = tip.disc->margin;
      v.triangles = tip.disc->triangles.size();
    }
    m_report.vertices.push_back(v);
  }

  // Returns whether the vertex is on the border of an open mesh.
  bool closes(Vertex_index v) const
  {
    for(Face_index f : m_mesh.faces_around_target(m_mesh.halfedge(v)))
      if(m_input.part_of_facet(m_input.facet_origin[f]) == Surface_part::CLOSING) return true;
    return false;
  }

  void find_tips(double least_margin)
  {
    const std::vector<Vertex_index> vertices(m_mesh.vertices().begin(), m_mesh.vertices().end());
    constexpr std::size_t chunk = 256;
    const std::vector<Vertex_index> sharp = collect_from_chunks<ConcurrencyTag, Vertex_index>(
      vertices.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Vertex_index>& found) {
        for(std::size_t n = begin; n < end; ++n) {
          if(m_mesh.is_isolated(vertices[n])) continue;
          const std::optional<double> margin = bounded_vertex_cone_margin(m_mesh, vertices[n], least_margin);
          if(!margin || *margin < least_margin) found.push_back(vertices[n]);
        }
      });
    for(Vertex_index v : sharp) {
      if(m_input.vertex_origin[v] >= m_input.user_vertices) continue;
      Replaced_tip tip(m_mesh, v);
      if(!vertex_cone(m_mesh, v)) tip.margin = 0;
      if(closes(v)) note(tip, Outcome::ON_BORDER);
      else if(tip.largest_margin() < truncation_tuning.least_gain * tip.margin) note(tip, Outcome::FOLDED_EDGE);
      else m_tips.push_back(std::move(tip));
    }
  }

  // Reduces the radii so that no ball meets a facet that is not at its vertex, or another ball.
  void shrink_tips()
  {
    m_tree.insert(faces(m_mesh).begin(), faces(m_mesh).end(), m_mesh);
    m_tree.build();
    const double largest = (std::max)({ std::abs(m_input.bbox.xmin()), std::abs(m_input.bbox.xmax()),
                                        std::abs(m_input.bbox.ymin()), std::abs(m_input.bbox.ymax()),
                                        std::abs(m_input.bbox.zmin()), std::abs(m_input.bbox.zmax()) });
    for(Replaced_tip& tip : m_tips) {
      Run::poll();
      double r = (std::min)(m_largest_radius({ tip.center.x(), tip.center.y(), tip.center.z() }),
                            truncation_tuning.radius_per_edge * tip.shortest_edge());
      std::vector<Face_index> near;
      m_tree.all_intersected_primitives(box_around(tip.center, 2 * r), std::back_inserter(near));
      for(Face_index f : near) {
        if(std::find(tip.facets.begin(), tip.facets.end(), f) != tip.facets.end()) continue;
        const auto t = m_input.triangle(f);
        const Truncation_kernel::Triangle_3 triangle(t[0], t[1], t[2]);
        r = (std::min)(r, truncation_tuning.radius_per_gap * std::sqrt(CGAL::squared_distance(tip.center, triangle)));
      }
      tip.radius = r;
    }
    const double smallest = truncation_tuning.least_radius * largest;
    drop_tips([smallest](const Replaced_tip& tip) { return !(tip.radius > smallest); }, Outcome::NO_SPACE);
  }

  static Bbox_3 box_around(const Tip::Point_3& p, double r)
  {
    return Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
  }

  static void find_disc(Replaced_tip& tip)
  {
    Run::poll();
    tip.disc = Disc_search(tip)();
    if(tip.disc && !(tip.disc->margin >= truncation_tuning.least_gain * tip.margin)) tip.disc.reset();
  }

  template <typename Predicate>
  void drop_tips(const Predicate& is_dropped, Outcome outcome)
  {
    for(const Replaced_tip& tip : m_tips)
      if(is_dropped(tip)) note(tip, outcome);
    m_tips.erase(std::remove_if(m_tips.begin(), m_tips.end(), is_dropped), m_tips.end());
  }

  // Returns the tips whose new facets intersect others; all tips if the truncation does not fit the mesh.
  std::unordered_set<std::size_t> intersecting_tips(const Shell_truncation_3& truncation) const
  {
    Mesh truncated(m_mesh);
    const auto applied = replace_patches(truncation, truncated, truncated.points());
    std::unordered_set<std::size_t> tips;
    // In a mesh with self-intersections, vertices may have equal positions.
    if(!applied || std::count(applied->facets.begin(), applied->facets.end(), Mesh::null_face()) > 0) {
      for(std::size_t n = 0; n < m_tips.size(); ++n) tips.insert(n);
      return tips;
    }
    std::unordered_map<Face_index, std::size_t> number;
    std::vector<Face_index> range;
    for(std::size_t n = 0; n < applied->facets.size(); ++n) {
      number.emplace(applied->facets[n], n);
      range.push_back(applied->facets[n]);
    }
    std::unordered_set<Face_index> cut, near;
    std::vector<Face_index> boxed;
    for(const Tip& tip : m_tips) cut.insert(tip.facets.begin(), tip.facets.end());
    for(const Tip& tip : m_tips)
      m_tree.all_intersected_primitives(box_around(tip.center, tip.radius), std::back_inserter(boxed));
    for(Face_index f : cut) {
      const auto t = m_input.triangle(f);
      m_tree.all_intersected_primitives(t[0].bbox() + t[1].bbox() + t[2].bbox(), std::back_inserter(boxed));
    }
    for(Face_index f : boxed)
      if(cut.count(f) == 0 && near.insert(f).second) range.push_back(f);
    std::vector<std::pair<Face_index, Face_index> > pairs;
    Polygon_mesh_processing::self_intersections<Sequential_tag>(range, truncated, std::back_inserter(pairs));
    for(const auto& pair : pairs)
      for(Face_index f : { pair.first, pair.second }) {
        const auto found = number.find(f);
        if(found == number.end()) continue;
        const Shell_truncation_3::New_facet& facet = truncation.new_facets()[found->second];
        if(facet.disc != Shell_truncation_3::npos) {
          tips.insert(facet.disc);
          continue;
        }
        for(std::size_t d = 0; d < truncation.discs().size(); ++d) {
          const auto& of_disc = truncation.discs()[d].facets;
          if(std::find(of_disc.begin(), of_disc.end(), facet.cut_facet) != of_disc.end()) tips.insert(d);
        }
      }
    return tips;
  }

  const Mesh_with_origins& m_input;
  const Mesh& m_mesh;
  const std::function<double(const std::array<double, 3>&)>& m_largest_radius;
  Truncation_report& m_report;
  std::vector<Replaced_tip> m_tips;
  AABB_tree<internal::AABB_traits_3<Truncation_kernel, AABB_face_graph_triangle_primitive<Mesh> > > m_tree;
};

} // namespace internal

template <typename ConcurrencyTag>
std::shared_ptr<const Shell_truncation_3> truncate_mesh(
  const Mesh_with_origins& mesh, const std::function<double(const std::array<double, 3>&)>& largest_radius,
  double least_margin, Truncation_report& report)
{
  report = Truncation_report();
  return internal::Mesh_truncator<ConcurrencyTag>(mesh, largest_radius, report)(least_margin);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_IMPL_H
