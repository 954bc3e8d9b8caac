// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_IMPL_H

#include <CGAL/Bspline_shell_3/Closing/close_virtually.h>
#include <CGAL/Bspline_shell_3/Closing/internal/Back_sheet.h>
#include <CGAL/Bspline_shell_3/Closing/internal/Hole_caps.h>
#include <CGAL/Bspline_shell_3/Closing/internal/assemble_closing.h>
#include <CGAL/Bspline_shell_3/Mesh/closable_fan.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns the facets at border vertices whose fans face a common direction, but cannot be completed so that they wind
// once.
inline std::vector<Closing_mesh::Face_index> facets_at_spirals(const Closing_mesh& mesh)
{
  std::vector<Closing_mesh::Face_index> facets;
  for(Closing_mesh::Halfedge_index border : mesh.halfedges()) {
    if(!mesh.is_border(border)) continue;
    const Closing_mesh::Vertex_index v = mesh.target(border);
    std::vector<Closing_kernel::Point_3> link{ mesh.point(mesh.source(border)) };
    std::vector<Closing_mesh::Face_index> around;
    Vertex_fan fan;
    fan.apex = mesh.point(v);
    for(auto h = mesh.opposite(border); !mesh.is_border(h); h = mesh.opposite(mesh.prev(h))) {
      around.push_back(mesh.face(h));
      link.push_back(mesh.point(mesh.target(mesh.next(h))));
      fan.wings.emplace_back(link[link.size() - 2], link.back());
    }
    // If the facets at a vertex face no common direction, the vertex is singular with every closing.
    if(!is_fan_closable(mesh.point(v), link) && cone_direction(fan))
      facets.insert(facets.end(), around.begin(), around.end());
  }
  return facets;
}

// Closes a mesh by caps and, where caps do not meet the requirements, by back sheets.
template <typename ConcurrencyTag>
class Virtual_closer
{
  typedef Closing_mesh::Face_index Face_index;
  typedef Hole_caps::Facet_pairs Facet_pairs;
public:
  Virtual_closer(const Closing_mesh& mesh, double offset) : m_mesh(mesh), m_offset(offset), m_caps(mesh) {}

  // Returns some of the intersecting pairs, which suffice to proceed. The search is sequential, so that the result does
  // not depend on the number of threads.
  static Facet_pairs intersections(const Closing_mesh& mesh)
  {
    constexpr unsigned int most_pairs = 10000;
    Facet_pairs pairs;
    Polygon_mesh_processing::self_intersections<Sequential_tag>(mesh, std::back_inserter(pairs),
                                                                CGAL::parameters::maximum_number(most_pairs));
    return pairs;
  }

  // Replaces caps until none intersects a facet. Attempts with different requirements begin with these caps.
  void cap_holes()
  {
    while(m_caps.replace(intersections(m_caps.capped_mesh()))) Run::poll();
  }

  // Replaces caps until all of them meet the requirements.
  void improve_caps(const Hole_caps::Requirements& requirements)
  {
    while(m_caps.replace(requirements)) cap_holes();
  }

  // Returns whether a closing was found; otherwise, `offending_facets()` are those of the last attempt.
  bool close(const Hole_caps::Requirements& requirements)
  {
    improve_caps(requirements);
    Back_sheet back(m_caps.capped_mesh(), m_offset);
    // Each round halves distances only at some vertices, so a mesh with successively narrower parts needs many rounds.
    constexpr int most_rounds = 40;
    for(int round = 0; round < most_rounds; ++round) {
      Run::poll();
      Assembled_closing assembled = assemble_closing(m_mesh, m_caps, back);
      Closing_mesh whole(m_mesh);
      const auto attached = assembled.closing.attach(whole, whole.points());
      if(!attached) break;
      const Facet_pairs found = intersections(whole);
      if(found.empty()) {
        m_closing = std::make_shared<const Shell_closing_3>(std::move(assembled.closing));
        m_least_gap = (std::min)(m_caps.least_gap(), back.least_gap());
        m_report = Closing_report();
        m_caps.describe(m_report);
        back.describe(m_report);
        m_report.triangles = m_closing->triangles().size();
        if(!improves(back, *m_closing, assembled.points, whole, attached->vertices)) break;
        continue;
      }
      std::vector<Back_sheet::Triangle> intersecting;
      m_offending_facets.clear();
      for(const auto& pair : found)
        for(Face_index f : { pair.first, pair.second })
          if(m_caps.is_cap(f)) intersecting.push_back(assembled.triangles[std::size_t(f) - m_mesh.number_of_faces()]);
          else m_offending_facets.push_back(f);
      if(m_offending_facets.empty()) m_offending_facets = facets_at(back, intersecting);
      if(!back.move_closer(intersecting)) break;
    }
    return bool(m_closing);
  }

  // Changes a back sheet that has no intersections where it is folded, or where the cone margin of a vertex is too
  // small. Returns whether it was changed.
  bool improves(Back_sheet& back, const Shell_closing_3& closing, const std::vector<std::size_t>& points,
                const Closing_mesh& whole, const std::vector<Closing_mesh::Vertex_index>& added) const
  {
    constexpr double least_margin = 0.05, least_distance = 1. / 16;
    const std::vector<Back_sheet::Triangle> folded = back.folded_triangles();
    if(!folded.empty()) return back.move_closer(folded);
    bool has_changed = false;
    std::vector<Back_sheet::Triangle> steep;
    const auto examine = [&](Closing_mesh::Vertex_index v, std::size_t n) {
      if(length(cone_axis_at(whole, v)) >= least_margin) return;
      if(back.make_steeper(n)) has_changed = true;
      else if(back.distance(n) > least_distance * m_offset) steep.push_back({ n, n, n });
    };
    for(auto v : m_mesh.vertices())
      if(!m_mesh.is_isolated(v) && m_mesh.is_border(v)) examine(v, std::size_t(v));
    for(std::size_t n = 0; n < added.size(); ++n) examine(added[n], points[closing.number_of_border_points() + n]);
    return has_changed || (!steep.empty() && back.move_closer(steep));
  }

  const std::shared_ptr<const Shell_closing_3>& closing() const { return m_closing; }
  const Closing_report& report() const { return m_report; }
  // Returns the smallest gap of the closed mesh that is due to the closing.
  double least_gap() const { return m_least_gap; }
  // Lists the holes, and whether each has a cap, after the last attempt.
  void describe_holes(Closing_report& report) const { m_caps.describe(report); }
  // Returns the facets of the mesh that intersected others in the last attempt. If only triangles of the closing did,
  // these are the facets at their vertices.
  const std::vector<Face_index>& offending_facets() const { return m_offending_facets; }

private:
  std::vector<Face_index> facets_at(const Back_sheet& back, const std::vector<Back_sheet::Triangle>& triangles) const
  {
    std::vector<Face_index> facets;
    for(const Back_sheet::Triangle& t : triangles)
      for(std::size_t n : t) {
        const std::size_t v = back.original(n);
        if(v >= m_mesh.number_of_vertices()) continue; // the apex of a cap
        for(Face_index f : m_mesh.faces_around_target(m_mesh.halfedge(Closing_mesh::Vertex_index(std::uint32_t(v)))))
          if(f != Closing_mesh::null_face()) facets.push_back(f);
      }
    return facets;
  }

  const Closing_mesh& m_mesh;
  double m_offset;
  Hole_caps m_caps;
  std::vector<Face_index> m_offending_facets;
  std::shared_ptr<const Shell_closing_3> m_closing;
  Closing_report m_report;
  double m_least_gap = 0;
};

} // namespace internal

template <typename ConcurrencyTag>
Virtual_closing close_virtually(const Mesh_with_origins::Triangle_mesh& mesh, double offset, Closing_report& report,
                                const Hole_predicate& requires_cap)
{
  typedef internal::Virtual_closer<ConcurrencyTag> Closer;
  Virtual_closing closed;
  report = Closing_report();
  for(const auto& pair : Closer::intersections(mesh)) {
    closed.offending_facets.push_back(pair.first);
    closed.offending_facets.push_back(pair.second);
  }
  if(!closed.offending_facets.empty()) {
    closed.status = Shell_status::SELF_INTERSECTION;
    return closed;
  }
  closed.offending_facets = internal::facets_at_spirals(mesh);
  if(!closed.offending_facets.empty()) return closed;
  // Tries caps that leave ample room first. If some holes then have no cap, caps that leave less room may be better.
  const internal::Hole_caps::Requirements good = { 0.1, 2 * offset }, fair = { 0.02, 0 };
  Closer strict(mesh, offset);
  strict.cap_holes();
  Closer loose(strict);
  if(requires_cap) {
    Closer capped(strict);
    capped.improve_caps(fair);
    Closing_report holes;
    capped.describe_holes(holes);
    const auto is_missing = [&](const Closing_report::Hole& hole) {
      return !hole.is_capped && requires_cap(hole.point);
    };
    if(std::any_of(holes.holes.begin(), holes.holes.end(), is_missing)) {
      report = holes;
      return closed;
    }
  }
  const Closer* best = &strict;
  if(!strict.close(good) || strict.report().sheets > 0)
    if(loose.close(fair) && !(strict.least_gap() >= loose.least_gap())) best = &loose;
  if(!best->closing()) {
    loose.describe_holes(report);
    closed.offending_facets = best->offending_facets();
    return closed;
  }
  report = best->report();
  closed.status = Shell_status::SUCCESS;
  closed.closing = best->closing();
  return closed;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_IMPL_H
