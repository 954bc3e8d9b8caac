// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H

#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Simplified_border.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The positions that constraints and frozen facets allow for the vertex of a collapsed edge.
template <typename Point>
struct Allowed_places
{
  bool are_all = false;
  std::vector<Point> places; // unless all are allowed
};

// Determines from constrained edges, frozen facets, and the border of the mesh which edges may be collapsed, and to
// which positions. Vertices of constrained edges do not move. If constrained edges are not protected, they are
// collapsed at vertices where exactly two of them meet. Vertices on the border do not move. If the border is
// simplified, its edges are collapsed at vertices without constrained edges.
template <typename TriangleMesh, typename VertexPointMap>
class Collapse_rules
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;

public:
  // pre: `protects`, or the map of constrained edges is writable
  // \param border_tolerance 0 if the border is not simplified
  Collapse_rules(const TriangleMesh& mesh, VertexPointMap vpm, const Edge_constraints<TriangleMesh>& constraints,
                 bool protects, double border_tolerance, Frozen_facets<TriangleMesh>& frozen)
    : m_mesh(mesh), m_vpm(vpm), m_constraints(constraints), m_protects(protects),
      m_border(mesh, vpm, frozen, border_tolerance), m_frozen(frozen)
  {}

  // Returns whether CGAL must not consider an edge at all. CGAL collapses edges of length zero without calling the
  // placement, so constrained edges and edges on the border at the same vertices are not collapsed before them. It does
  // not collapse an edge between two vertices of edges that it must not consider.
  bool is_kept(edge_descriptor e) const
  {
    if(m_frozen.is_frozen(e)) return true;
    const bool is_at_closing = m_frozen.is_at_closing(e);
    const bool is_constrained_edge = is_constrained_on_mesh(halfedge(e, m_mesh));
    if(!is_at_closing && !is_constrained_edge) return false;
    return (is_at_closing && !m_border.may_change_at(e)) || (is_constrained_edge && m_protects)
           || has_zero_edge(source(e, m_mesh)) || has_zero_edge(target(e, m_mesh));
  }
  std::size_t number_of_closing_facets() const { return m_frozen.number_of_closing_facets(); }
  // Returns these edges as a property map.
  struct Kept_edges
  {
    typedef edge_descriptor key_type;
    typedef bool value_type;
    typedef bool reference;
    typedef boost::readable_property_map_tag category;

    const Collapse_rules* rules;

    friend bool get(const Kept_edges& kept, edge_descriptor e) { return kept.rules->is_kept(e); }
  };
  Kept_edges kept_edges() const { return { this }; }

  template <typename Profile>
  Allowed_places<Point> allowed_places(const Profile& profile) const
  {
    Allowed_places<Point> allowed;
    const vertex_descriptor v0 = profile.v0(), v1 = profile.v1();
    if(m_frozen.has_vertex(v0) || m_frozen.has_vertex(v1)) return allowed;
    if(m_frozen.is_fixed(v0) && m_frozen.is_fixed(v1)) {
      if(!has_constraint(v1) && m_border.may_merge(profile.v1_v0())) allowed.places.push_back(profile.p0());
      if(!has_constraint(v0) && m_border.may_merge(profile.v0_v1())) allowed.places.push_back(profile.p1());
      return allowed;
    }
    // Edges that close the mesh are not keys of the map.
    if(m_frozen.is_fixed(v0)) {
      if(m_constraints.degree(v1, m_mesh) == 0) allowed.places.push_back(profile.p0());
      return allowed;
    }
    if(m_frozen.is_fixed(v1)) {
      if(m_constraints.degree(v0, m_mesh) == 0) allowed.places.push_back(profile.p1());
      return allowed;
    }
    const std::size_t number_0 = m_constraints.degree(v0, m_mesh), number_1 = m_constraints.degree(v1, m_mesh);
    allowed.are_all = number_0 == 0 && number_1 == 0;
    if(allowed.are_all) return allowed;
    const bool is_along = !m_protects && is_constrained(profile.v0_v1());
    if(is_along && m_constraints.are_joined_by_collapse(profile.v0_v1(), m_mesh)) return allowed;
    if(is_along ? number_1 == 2 : number_1 == 0) allowed.places.push_back(profile.p0());
    if(is_along ? number_0 == 2 : number_0 == 0) allowed.places.push_back(profile.p1());
    return allowed;
  }

  // Edges that vanish are no longer constrained. An edge that replaces two edges is constrained if one of these was.
  template <typename Profile, typename OptionalPoint>
  void before_collapse(const Profile& profile, const OptionalPoint& placement)
  {
    if(m_frozen.is_fixed(profile.v0()) && m_frozen.is_fixed(profile.v1())) {
      m_border.merge(*placement == profile.p1() ? profile.v0_v1() : profile.v1_v0());
      for(halfedge_descriptor h : { profile.v0_v1(), profile.v1_v0() }) m_frozen.remove(face(h, m_mesh));
    }
    if(m_protects) return;
    m_is_left_constrained = release(profile.vL_v0(), profile.v1_vL());
    m_is_right_constrained = release(profile.vR_v1(), profile.v0_vR());
    if(is_constrained(profile.v0_v1())) put(m_constraints, edge(profile.v0_v1(), m_mesh), false);
  }
  template <typename Profile>
  void after_collapse(const Profile& profile, vertex_descriptor v)
  {
    const vertex_descriptor w = v == profile.v0() ? profile.v1() : profile.v0();
    m_frozen.replace(w, v);
    m_border.replace(w, v);
    if(m_is_left_constrained) constrain(v, profile.vL());
    if(m_is_right_constrained) constrain(v, profile.vR());
    m_is_left_constrained = m_is_right_constrained = false;
  }

private:
  bool is_constrained(halfedge_descriptor h) const { return get(m_constraints, edge(h, m_mesh)); }

  // Returns whether the mesh has a constrained edge at a border vertex.
  bool has_constraint(vertex_descriptor v) const
  {
    if(!m_constraints.may_constrain()) return false;
    const auto around = CGAL::halfedges_around_target(v, m_mesh);
    return std::any_of(around.begin(), around.end(), [&](halfedge_descriptor h) { return is_constrained_on_mesh(h); });
  }
  // Edges that close the mesh are not keys of the map.
  bool is_constrained_on_mesh(halfedge_descriptor h) const
  {
    return !m_frozen.closes(edge(h, m_mesh)) && is_constrained(h);
  }

  bool has_zero_edge(vertex_descriptor v) const
  {
    const auto around = CGAL::halfedges_around_target(v, m_mesh);
    return std::any_of(around.begin(), around.end(),
                       [&](halfedge_descriptor h) { return get(m_vpm, source(h, m_mesh)) == get(m_vpm, v); });
  }

  // Removes constraints of two edges. Returns whether one of them was constrained.
  bool release(halfedge_descriptor g, halfedge_descriptor h)
  {
    bool was_constrained = false;
    for(halfedge_descriptor side : { g, h })
      if(is_constrained_on_mesh(side)) {
        put(m_constraints, edge(side, m_mesh), false);
        was_constrained = true;
      }
    return was_constrained;
  }
  void constrain(vertex_descriptor v, vertex_descriptor w)
  {
    put(m_constraints, edge(halfedge(v, w, m_mesh).first, m_mesh), true);
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_vpm;
  Edge_constraints<TriangleMesh> m_constraints;
  bool m_protects;
  Simplified_border<TriangleMesh, VertexPointMap> m_border;
  Frozen_facets<TriangleMesh>& m_frozen;
  bool m_is_left_constrained = false, m_is_right_constrained = false; // during a collapse
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H
