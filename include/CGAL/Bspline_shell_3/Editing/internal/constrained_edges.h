// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CONSTRAINED_EDGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CONSTRAINED_EDGES_H

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Whether a property map may contain constrained edges.
template <typename TriangleMesh, typename EdgeIsConstrainedMap>
constexpr bool may_have_constrained_edges = !std::is_same<
  EdgeIsConstrainedMap,
  Static_boolean_property_map<typename boost::graph_traits<TriangleMesh>::edge_descriptor, false> >::value;

template <typename TriangleMesh, typename EdgeIsConstrainedMap>
std::size_t number_of_constrained_edges(typename boost::graph_traits<TriangleMesh>::vertex_descriptor v,
                                        const TriangleMesh& mesh, const EdgeIsConstrainedMap& edge_is_constrained)
{
  std::size_t number = 0;
  if constexpr(may_have_constrained_edges<TriangleMesh, EdgeIsConstrainedMap>)
    for(auto h : CGAL::halfedges_around_target(v, mesh))
      if(get(edge_is_constrained, edge(h, mesh))) ++number;
  return number;
}

// When an edge is collapsed, two sides of each of its facets become one. Returns whether both sides of a facet are
// constrained.
template <typename TriangleMesh, typename EdgeIsConstrainedMap>
bool would_join_constrained_edges(typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h,
                                  const TriangleMesh& mesh, const EdgeIsConstrainedMap& edge_is_constrained)
{
  for(auto g : { h, opposite(h, mesh) })
    if(get(edge_is_constrained, edge(next(g, mesh), mesh)) && get(edge_is_constrained, edge(prev(g, mesh), mesh)))
      return true;
  return false;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_CONSTRAINED_EDGES_H
