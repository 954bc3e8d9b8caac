// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SIMPLIFIED_BORDER_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SIMPLIFIED_BORDER_H

#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Mesh/count_removed_border_points.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The border of a mesh that is closed for an edit, while it is simplified within a tolerance. For each border edge, it
// stores the points of the border vertices that the edge replaces. A border vertex may be merged into a neighbor along
// the border if the points that the new edge would replace are within the tolerance of it.
template <typename TriangleMesh, typename VertexPointMap>
class Simplified_border
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
public:
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;

  // pre: `frozen` contains the facets that close the mesh, and outlives this object
  // \param tolerance 0 if the border is not simplified
  Simplified_border(const TriangleMesh& mesh, VertexPointMap vpm, const Frozen_facets<TriangleMesh>& frozen,
                    double tolerance)
    : m_mesh(mesh), m_vpm(vpm), m_frozen(frozen), m_tolerance(tolerance)
  {}

  // Returns whether an end of an edge is on the border, and the border may change.
  bool may_change_at(edge_descriptor e) const
  {
    return !is_fixed() && (has_vertex(source(e, m_mesh)) || has_vertex(target(e, m_mesh)));
  }

  // Returns whether the source of a border edge may be merged into its target.
  bool may_merge(halfedge_descriptor h) const
  {
    if(is_fixed() || !is_on_border(h) || is_joined_by_collapse(h)) return false;
    const halfedge_descriptor other = other_on_border(h);
    return are_near_segment(replaced_points(other, h), coordinates(source(other, m_mesh)),
                            coordinates(target(h, m_mesh)), m_tolerance);
  }

  // Must be called before the source of a border edge is merged into its target.
  void merge(halfedge_descriptor h)
  {
    const halfedge_descriptor other = other_on_border(h);
    Points points = replaced_points(other, h);
    m_replaced.erase(source(h, m_mesh));
    m_replaced[m_frozen.closes(face(h, m_mesh)) ? target(h, m_mesh) : source(other, m_mesh)] = std::move(points);
  }

  // Must be called when an edge collapse has put `v` in the place of `w`.
  void replace(vertex_descriptor w, vertex_descriptor v)
  {
    const auto found = m_replaced.find(w);
    if(found == m_replaced.end()) return;
    Points points = std::move(found->second);
    m_replaced.erase(found);
    m_replaced[v] = std::move(points);
  }

private:
  typedef std::vector<std::array<double, 3> > Points;

  std::array<double, 3> coordinates(vertex_descriptor v) const { return rounded_coordinates(get(m_vpm, v)); }

  bool is_fixed() const { return !(m_tolerance > 0); }

  bool has_vertex(vertex_descriptor v) const
  {
    const auto around = CGAL::halfedges_around_target(v, m_mesh);
    return std::any_of(around.begin(), around.end(), [&](halfedge_descriptor h) { return is_on_border(h); });
  }

  bool is_on_border(halfedge_descriptor h) const
  {
    return m_frozen.closes(face(h, m_mesh)) != m_frozen.closes(face(opposite(h, m_mesh), m_mesh));
  }

  // A collapse removes the two facets at an edge, and joins the two other sides of each. Returns whether both of these
  // sides are on the border: the hole or the component would vanish.
  bool is_joined_by_collapse(halfedge_descriptor h) const
  {
    for(halfedge_descriptor g : { h, opposite(h, m_mesh) })
      if(is_on_border(next(g, m_mesh)) && is_on_border(prev(g, m_mesh))) return true;
    return false;
  }

  // Returns the other border edge at the source of a border edge, as a halfedge to this vertex.
  halfedge_descriptor other_on_border(halfedge_descriptor h) const
  {
    halfedge_descriptor to = prev(h, m_mesh);
    while(!is_on_border(to)) to = prev(opposite(to, m_mesh), m_mesh);
    return to;
  }

  // Returns the points that one edge instead of two border edges would replace, in any order.
  // pre: the target of `g` is the source of `h`
  Points replaced_points(halfedge_descriptor g, halfedge_descriptor h) const
  {
    Points points = { coordinates(source(h, m_mesh)) };
    for(halfedge_descriptor side : { g, h }) {
      const auto found = m_replaced.find(m_frozen.closes(face(side, m_mesh)) ? target(side, m_mesh)
                                                                             : source(side, m_mesh));
      if(found != m_replaced.end()) points.insert(points.end(), found->second.begin(), found->second.end());
    }
    return points;
  }

  const TriangleMesh& m_mesh;
  VertexPointMap m_vpm;
  const Frozen_facets<TriangleMesh>& m_frozen;
  double m_tolerance;
  // The points that the border edge from a vertex replaces. The mesh is on the left of the edge.
  std::unordered_map<vertex_descriptor, Points> m_replaced;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SIMPLIFIED_BORDER_H
