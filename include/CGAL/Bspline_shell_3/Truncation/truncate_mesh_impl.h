// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Disc_search.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Tip.h>
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
    std::vector<std::optional<Tip_disc> > discs = find_discs();
    // If a disc intersects other facets, or its own facets by rounding, its radius is halved.
    constexpr int most_rounds = 8;
    for(int round = 0; !m_tips.empty(); ++round) {
      drop_tips([&](std::size_t n) { return !discs[n]; }, discs, Outcome::NO_DISC);
      if(m_tips.empty()) break;
      std::vector<Tip_disc> found;
      for(const auto& d : discs) found.push_back(*d);
      auto truncation = std::make_shared<const Shell_truncation_3>(assemble_truncation(m_mesh, m_tips, found));
      if(!truncation->is_valid()) {
        drop_tips([](std::size_t) { return true; }, discs, Outcome::NO_SPACE);
        break;
      }
      const std::unordered_set<std::size_t> intersecting = intersecting_tips(*truncation);
      if(intersecting.empty()) {
        for(std::size_t n = 0; n < m_tips.size(); ++n) {
          note(m_tips[n], Outcome::TRUNCATED);
          m_report.vertices.back().margin_after = found[n].margin;
          m_report.vertices.back().triangles = found[n].triangles.size();
        }
        sort_report();
        return truncation;
      }
      for(std::size_t n : intersecting) {
        m_tips[n].radius /= 2;
        discs[n].reset();
        if(round < most_rounds) discs[n] = disc(m_tips[n]);
      }
    }
    sort_report();
    return nullptr;
  }

private:
  void note(const Tip& tip, Outcome outcome)
  {
    Truncation_report::Vertex v;
    v.vertex = m_input.vertex_origin[tip.vertex];
    v.point = { tip.center.x(), tip.center.y(), tip.center.z() };
    v.outcome = outcome;
    v.radius = outcome == Outcome::TRUNCATED ? tip.radius : 0;
    v.margin_before = v.margin_after = tip.margin;
    m_report.vertices.push_back(v);
  }

  void sort_report()
  {
    std::sort(m_report.vertices.begin(), m_report.vertices.end(),
              [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
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
    std::vector<char> is_tip(vertices.size(), 0);
    constexpr std::size_t chunk = 256;
    internal::for_each_chunk<ConcurrencyTag>(vertices.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        if(m_mesh.is_isolated(vertices[n])) continue;
        const std::optional<double> margin = bounded_vertex_cone_margin(m_mesh, vertices[n], least_margin);
        is_tip[n] = !margin || *margin < least_margin;
      }
    });
    for(std::size_t n = 0; n < vertices.size(); ++n) {
      if(!is_tip[n]) continue;
      Tip tip(m_mesh, vertices[n]);
      if(!vertex_cone(m_mesh, vertices[n])) tip.margin = 0;
      if(m_input.vertex_origin[vertices[n]] >= m_input.user_vertices) continue;
      if(closes(vertices[n])) note(tip, Outcome::ON_BORDER);
      else if(tip.largest_margin() < least_gain * tip.margin) note(tip, Outcome::FOLDED_EDGE);
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
    for(Tip& tip : m_tips) {
      Run::poll();
      constexpr double part_of_edge = 1. / 3;
      double r = (std::min)(m_largest_radius({ tip.center.x(), tip.center.y(), tip.center.z() }),
                            part_of_edge * tip.shortest_edge());
      std::vector<Face_index> near;
      m_tree.all_intersected_primitives(box_around(tip.center, 2 * r), std::back_inserter(near));
      for(Face_index f : near) {
        if(std::find(tip.facets.begin(), tip.facets.end(), f) != tip.facets.end()) continue;
        const auto t = m_input.triangle(f);
        r = (std::min)(r, std::sqrt(CGAL::squared_distance(tip.center, Truncation_kernel::Triangle_3(t[0], t[1], t[2])))
                            / 2);
      }
      tip.radius = r;
    }
    // Least radius for which the directions of the disc's edges have about five digits.
    const double smallest = 1e-11 * largest;
    std::vector<Tip> tips;
    for(Tip& tip : m_tips) {
      if(tip.radius > smallest) tips.push_back(std::move(tip));
      else note(tip, Outcome::NO_SPACE);
    }
    m_tips.swap(tips);
  }

  static Bbox_3 box_around(const Tip::Point_3& p, double r)
  {
    return Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
  }

  static std::optional<Tip_disc> disc(const Tip& tip)
  {
    Run::poll();
    std::optional<Tip_disc> found = Disc_search(tip)();
    if(found && !(found->margin >= least_gain * tip.margin)) found.reset();
    return found;
  }

  std::vector<std::optional<Tip_disc> > find_discs() const
  {
    std::vector<std::optional<Tip_disc> > discs(m_tips.size());
    internal::for_each_chunk<ConcurrencyTag>(m_tips.size(), 1, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) discs[n] = disc(m_tips[n]);
    });
    return discs;
  }

  template <typename Predicate>
  void drop_tips(const Predicate& is_dropped, std::vector<std::optional<Tip_disc> >& discs, Outcome outcome)
  {
    std::vector<Tip> tips;
    std::vector<std::optional<Tip_disc> > kept;
    for(std::size_t n = 0; n < m_tips.size(); ++n) {
      if(is_dropped(n)) {
        note(m_tips[n], outcome);
        continue;
      }
      tips.push_back(std::move(m_tips[n]));
      kept.push_back(std::move(discs[n]));
    }
    m_tips.swap(tips);
    discs.swap(kept);
  }

  // Returns the tips whose new facets intersect others; all tips if the truncation does not fit the mesh.
  std::unordered_set<std::size_t> intersecting_tips(const Shell_truncation_3& truncation) const
  {
    Mesh truncated(m_mesh);
    const auto applied = truncation.apply(truncated, truncated.points());
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
        const auto disc = truncation.disc_of_new_facet(found->second);
        if(disc != Shell_truncation_3::npos) {
          tips.insert(disc);
          continue;
        }
        const auto facet = truncation.cores()[found->second].facet;
        for(std::size_t d = 0; d < truncation.discs().size(); ++d) {
          const auto& of_disc = truncation.discs()[d].facets;
          if(std::find(of_disc.begin(), of_disc.end(), facet) != of_disc.end()) tips.insert(d);
        }
      }
    return tips;
  }

  // A smaller increase of the margin is not worth the cost.
  static constexpr double least_gain = 2;

  const Mesh_with_origins& m_input;
  const Mesh& m_mesh;
  const std::function<double(const std::array<double, 3>&)>& m_largest_radius;
  Truncation_report& m_report;
  std::vector<Tip> m_tips;
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
