// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_GUARDED_MESH_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_GUARDED_MESH_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/Remeshing_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Vertex_images.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/property_map.h>
#include <CGAL/squared_distance_3.h>

#include <boost/bimap.hpp>
#include <boost/bimap/multiset_of.hpp>
#include <boost/bimap/unordered_set_of.hpp>
#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A mesh during remeshing, with the operations that change it. Operations and verdicts of the oracle are counted. The
// caller chooses where to apply an operation. It must not change constrained or frozen elements, and the user's filter
// and the oracle must accept all facets after the change.
//
// Fans that wind once then continue to do so. At a vertex that moves or is new, the oracle counts the turns. At other
// vertices, one or two facets are replaced by one or two facets between the same two edges. They turn by less than a
// full turn before and after, and by the same angle up to full turns. (For collapses, see Shell_filter.)
template <typename TriangleMesh_, typename VertexPointMap, typename Oracle>
class Guarded_mesh
{
  typedef boost::graph_traits<TriangleMesh_> Graph_traits;
public:
  typedef TriangleMesh_ TriangleMesh;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename Oracle::Point_3 Point;
  typedef std::vector<Point> Link; // points around a vertex or an edge, in the direction in which facets turn

  // Edges, each with a halfedge, in ascending order of priority. Edges of equal priority are in the order of insertion,
  // never in that of addresses.
  typedef boost::bimap<boost::bimaps::unordered_set_of<edge_descriptor, std::hash<edge_descriptor> >,
                       boost::bimaps::multiset_of<double>, boost::bimaps::with_info<halfedge_descriptor> >
    Edge_queue;

  // The facets (a, b, c) and (b, a, d) at a halfedge from a to b.
  struct Quadrilateral
  {
    vertex_descriptor a, b, c, d;
  };

  TriangleMesh& mesh;
  const Oracle& oracle;
  const Frozen_facets<TriangleMesh>& frozen;
  const Edge_constraints<TriangleMesh>& constraints;
  Vertex_images<TriangleMesh> images;

  // pre: `options` outlives this object
  Guarded_mesh(TriangleMesh& mesh, VertexPointMap vpm, const Oracle& oracle, const Frozen_facets<TriangleMesh>& frozen,
               const Remeshing_options<TriangleMesh, Point>& options,
               const std::vector<vertex_descriptor>& original_vertices, Remeshing_report& report)
    : mesh(mesh), oracle(oracle), frozen(frozen), constraints(options.constraints), images(mesh, original_vertices),
      m_vpm(vpm), m_options(options), m_report(report)
  {}

  // Once the edit is ended, by the caller or by the option `go_on`, go_on() returns false, and no operation may follow.
  // Throws Run::Ended if the run has ended.
  void end() { m_goes_on = false; }
  bool has_ended() const { return !m_goes_on; }
  bool go_on()
  {
    Run::poll();
    m_goes_on = m_goes_on && m_options.go_on();
    return m_goes_on;
  }

  // Returns a reference or a point, depending on the map.
  decltype(auto) point(vertex_descriptor v) const { return converted<Point>(get(m_vpm, v)); }
  // Returns the target length of an edge between two points.
  double target_length(const Point& p, const Point& q) const { return m_options.target_length(CGAL::midpoint(p, q)); }
  // Returns the length of an edge, divided by the target length.
  double relative_length(halfedge_descriptor h) const
  {
    const Point &p = point(source(h, mesh)), &q = point(target(h, mesh));
    return std::sqrt(CGAL::squared_distance(p, q)) / target_length(p, q);
  }

  // Constraints

  bool is_constrained(edge_descriptor e) const { return get(constraints, e); }
  bool is_constrained(vertex_descriptor v) const
  {
    return m_options.is_vertex_constrained && m_options.is_vertex_constrained(v);
  }
  // Returns whether an edge must be neither split nor collapsed.
  bool is_kept(edge_descriptor e) const
  {
    return frozen.has_edge(e) || (m_options.protects_constraints && is_constrained(e));
  }
  // Returns whether a vertex must be neither moved nor removed.
  bool is_fixed(vertex_descriptor v) const
  {
    return frozen.has_vertex(v) || frozen.is_fixed(v) || is_constrained(v) || constraints.degree(v, mesh) > 0;
  }
  // Returns whether constrained edges pass through a vertex, so that it may be removed with one of them.
  bool is_passed(vertex_descriptor v) const
  {
    return !m_options.protects_constraints && !frozen.is_fixed(v) && !is_constrained(v)
           && constraints.degree(v, mesh) == 2;
  }

  // Verdicts

  // May be called concurrently; the verdict is not counted.
  Placement_verdict verdict(const Point& p, const Link& link) const
  {
    for(std::size_t n = 0; n < link.size(); ++n)
      if(!permits(p, link[n], link[(n + 1) % link.size()])) return Placement_verdict::BASE_FILTER;
    typename Oracle::Memory none;
    return oracle(p, link, none);
  }
  void count(Placement_verdict verdict) { ++m_report.placements.by_verdict[std::size_t(verdict)]; }
  const Placement_statistics& placements() const { return m_report.placements; }
  // Returns whether the filter and the oracle accept the star of a point.
  bool accepts(const Point& p, const Link& link) { return is_accepted(verdict(p, link)); }
  bool accepts(const Point& p, const Point& q, const Point& r)
  {
    return is_accepted(permits(p, q, r) ? oracle(p, q, r) : Placement_verdict::BASE_FILTER);
  }

  // Neighborhoods

  // Returns the next halfedge to the same target, in the direction in which facets turn.
  halfedge_descriptor turn(halfedge_descriptor h) const { return prev(opposite(h, mesh), mesh); }
  Quadrilateral quadrilateral(halfedge_descriptor h) const
  {
    return { source(h, mesh), target(h, mesh), target(next(h, mesh), mesh),
             target(next(opposite(h, mesh), mesh), mesh) };
  }

  // Operations

  // Splits an edge and its two facets. Returns the new vertex.
  vertex_descriptor split(halfedge_descriptor h, const Point& p)
  {
    const bool was_constrained = is_constrained(edge(h, mesh));
    const halfedge_descriptor half = Euler::split_edge(h, mesh);
    const vertex_descriptor v = target(half, mesh);
    set_point(v, p);
    images.add_vertex(v);
    // New edges may have any value in a map until it is set.
    put(constraints, edge(half, mesh), was_constrained);
    put(constraints, edge(Euler::split_face(half, next(h, mesh), mesh), mesh), false);
    put(constraints, edge(Euler::split_face(opposite(h, mesh), next(opposite(half, mesh), mesh), mesh), mesh), false);
    ++m_report.splits;
    return v;
  }
  // Collapses an edge. Returns the vertex that is kept.
  vertex_descriptor collapse(halfedge_descriptor h, const Point& p)
  {
    put(constraints, edge(h, mesh), false);
    images.collapse(source(h, mesh), target(h, mesh));
    const vertex_descriptor v = Euler::collapse_edge(edge(h, mesh), mesh, constraints);
    set_point(v, p);
    ++m_report.collapses;
    return v;
  }
  void flip(halfedge_descriptor h)
  {
    Euler::flip_edge(h, mesh);
    ++m_report.flips;
  }
  void move(vertex_descriptor v, const Point& p)
  {
    set_point(v, p);
    ++m_report.moves;
  }

private:
  void set_point(vertex_descriptor v, const Point& p)
  {
    put(m_vpm, v, converted<typename boost::property_traits<VertexPointMap>::value_type>(p));
  }
  bool permits(const Point& p, const Point& q, const Point& r) const
  {
    return !m_options.permits_facet || m_options.permits_facet(p, q, r);
  }
  bool is_accepted(Placement_verdict verdict)
  {
    count(verdict);
    return verdict == Placement_verdict::ACCEPTED;
  }

  VertexPointMap m_vpm;
  const Remeshing_options<TriangleMesh, Point>& m_options;
  bool m_goes_on = true;
  Remeshing_report& m_report;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_GUARDED_MESH_H
