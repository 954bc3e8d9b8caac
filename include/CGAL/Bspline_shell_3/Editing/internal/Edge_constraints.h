// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDGE_CONSTRAINTS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDGE_CONSTRAINTS_H

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <typename Map>
constexpr bool is_writable_map =
  std::is_convertible<typename boost::property_traits<Map>::category, boost::writable_property_map_tag>::value
  && !std::is_const<std::remove_reference_t<typename boost::property_traits<Map>::reference> >::value;

// The caller's property map of constrained edges, of erased type, so that edits are compiled once for each mesh type.
template <typename TriangleMesh>
class Edge_constraints
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;

public:
  typedef typename Graph_traits::edge_descriptor key_type;
  typedef bool value_type;
  typedef bool reference;
  typedef boost::read_write_property_map_tag category;

  Edge_constraints() = default; // no edge is constrained
  // All copies share one copy of the map.
  template <typename Map>
  explicit Edge_constraints(const Map& map)
  {
    const auto shared = std::make_shared<Map>(map);
    m_get = [shared](key_type e) { return bool(get(*shared, e)); };
    if constexpr(is_writable_map<Map>) m_put = [shared](key_type e, bool value) { put(*shared, e, value); };
  }

  bool may_constrain() const { return bool(m_get); }
  // Only a map that is writable is changed.
  bool is_writable() const { return bool(m_put); }

  friend bool get(const Edge_constraints& constraints, key_type e) { return constraints.m_get && constraints.m_get(e); }
  friend void put(const Edge_constraints& constraints, key_type e, bool value)
  {
    if(constraints.m_put) constraints.m_put(e, value);
  }

  // Returns the number of constrained edges at a vertex.
  std::size_t degree(vertex_descriptor v, const TriangleMesh& mesh) const
  {
    std::size_t number = 0;
    if(may_constrain())
      for(halfedge_descriptor h : CGAL::halfedges_around_target(v, mesh)) number += m_get(edge(h, mesh)) ? 1 : 0;
    return number;
  }

  // When an edge is collapsed, two sides of each of its facets become one. Returns whether both sides of a facet are
  // constrained.
  bool are_joined_by_collapse(halfedge_descriptor h, const TriangleMesh& mesh) const
  {
    for(halfedge_descriptor g : { h, opposite(h, mesh) })
      if(get(*this, edge(next(g, mesh), mesh)) && get(*this, edge(prev(g, mesh), mesh))) return true;
    return false;
  }

private:
  std::function<bool(key_type)> m_get;
  std::function<void(key_type, bool)> m_put;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDGE_CONSTRAINTS_H
