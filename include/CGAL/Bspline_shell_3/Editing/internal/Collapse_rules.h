// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H

#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
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

// Determines from constrained edges and frozen facets which edges may be collapsed, and to which positions. Vertices of
// constrained edges do not move. If constrained edges are not protected, they are collapsed at vertices where exactly
// two of them meet.
//
// `Merges` is whether constrained edges may be unprotected, which requires a writable map.
template <typename TriangleMesh, typename VertexPointMap, typename EdgeIsConstrainedMap, bool Merges>
class Collapse_rules
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  static constexpr bool has_constraints =
    !std::is_same<EdgeIsConstrainedMap, Surface_mesh_simplification::No_constrained_edge_map<TriangleMesh> >::value;

public:
  Collapse_rules(const TriangleMesh& mesh, VertexPointMap vpm, EdgeIsConstrainedMap constrained, bool protects,
                 Frozen_facets<TriangleMesh>& frozen)
    : m_mesh(mesh), m_vpm(vpm), m_constrained(constrained), m_protects(protects || !Merges), m_frozen(frozen)
  {}

  // Returns whether CGAL must not consider an edge at all. CGAL collapses edges of length zero without calling the
  // placement, so constrained edges at the same vertices are not collapsed before them.
  bool is_kept(edge_descriptor e) const
  {
    return m_frozen.has_edge(e)
           || (get(m_constrained, e)
               && (m_protects || has_zero_edge(source(e, m_mesh)) || has_zero_edge(target(e, m_mesh))));
  }

  template <typename Profile>
  Allowed_places<Point> allowed_places(const Profile& profile) const
  {
    Allowed_places<Point> allowed;
    const vertex_descriptor v0 = profile.v0(), v1 = profile.v1();
    if(m_frozen.has_vertex(v0) || m_frozen.has_vertex(v1)) return allowed;
    if(m_frozen.is_fixed(v0) && m_frozen.is_fixed(v1)) return allowed;
    // Edges that close the mesh are not keys of the map.
    if(m_frozen.is_fixed(v0)) {
      if(number_of_constrained_edges(v1) == 0) allowed.places.push_back(profile.p0());
      return allowed;
    }
    if(m_frozen.is_fixed(v1)) {
      if(number_of_constrained_edges(v0) == 0) allowed.places.push_back(profile.p1());
      return allowed;
    }
    const std::size_t number_0 = number_of_constrained_edges(v0), number_1 = number_of_constrained_edges(v1);
    allowed.are_all = number_0 == 0 && number_1 == 0;
    if(allowed.are_all) return allowed;
    const bool is_along = !m_protects && is_constrained(profile.v0_v1());
    // Two sides of a facet become one: at most one of them may be constrained.
    if(is_along
       && (are_both_constrained(profile.vL_v0(), profile.v1_vL())
           || are_both_constrained(profile.vR_v1(), profile.v0_vR())))
      return allowed;
    if(is_along ? number_1 == 2 : number_1 == 0) allowed.places.push_back(profile.p0());
    if(is_along ? number_0 == 2 : number_0 == 0) allowed.places.push_back(profile.p1());
    return allowed;
  }

  // Edges that vanish are no longer constrained. An edge that replaces two edges is constrained if one of these was.
  template <typename Profile>
  void before_collapse(const Profile& profile)
  {
    if constexpr(Merges)
      if(!m_protects) {
        m_is_left_constrained = release(profile.vL_v0(), profile.v1_vL());
        m_is_right_constrained = release(profile.vR_v1(), profile.v0_vR());
        if(is_constrained(profile.v0_v1())) put(m_constrained, edge(profile.v0_v1(), m_mesh), false);
      }
  }
  template <typename Profile>
  void after_collapse(const Profile& profile, vertex_descriptor v)
  {
    m_frozen.replace(v == profile.v0() ? profile.v1() : profile.v0(), v);
    if constexpr(Merges) {
      if(m_is_left_constrained) constrain(v, profile.vL());
      if(m_is_right_constrained) constrain(v, profile.vR());
      m_is_left_constrained = m_is_right_constrained = false;
    }
  }

private:
  bool is_constrained(halfedge_descriptor h) const { return get(m_constrained, edge(h, m_mesh)); }
  bool are_both_constrained(halfedge_descriptor g, halfedge_descriptor h) const
  {
    return is_constrained(g) && is_constrained(h);
  }

  std::size_t number_of_constrained_edges(vertex_descriptor v) const
  {
    std::size_t number = 0;
    if constexpr(has_constraints)
      for(halfedge_descriptor h : CGAL::halfedges_around_target(v, m_mesh)) number += is_constrained(h) ? 1 : 0;
    return number;
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
      if(is_constrained(side)) {
        put(m_constrained, edge(side, m_mesh), false);
        was_constrained = true;
      }
    return was_constrained;
  }
  void constrain(vertex_descriptor v, vertex_descriptor w)
  {
    put(m_constrained, edge(halfedge(v, w, m_mesh).first, m_mesh), true);
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_vpm;
  EdgeIsConstrainedMap m_constrained;
  bool m_protects;
  Frozen_facets<TriangleMesh>& m_frozen;
  bool m_is_left_constrained = false, m_is_right_constrained = false; // during a collapse
};

// The edges that CGAL must not consider, as a property map.
template <typename Rules, typename Edge>
struct Kept_edges_map
{
  typedef Edge key_type;
  typedef bool value_type;
  typedef bool reference;
  typedef boost::readable_property_map_tag category;

  const Rules* rules;

  friend bool get(const Kept_edges_map& map, const key_type& e) { return map.rules->is_kept(e); }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_RULES_H
