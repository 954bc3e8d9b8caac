// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FIND_REJECTED_FACETS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FIND_REJECTED_FACETS_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether an edge has length zero, or a facet has such an edge.
template <typename TriangleMesh, typename VertexPointMap>
bool is_zero(typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h, const TriangleMesh& mesh,
             VertexPointMap vpm)
{
  return get(vpm, source(h, mesh)) == get(vpm, target(h, mesh));
}
template <typename TriangleMesh, typename VertexPointMap>
bool has_zero_edge(typename boost::graph_traits<TriangleMesh>::face_descriptor f, const TriangleMesh& mesh,
                   VertexPointMap vpm)
{
  const auto h = halfedge(f, mesh);
  return is_zero(h, mesh, vpm) || is_zero(next(h, mesh), mesh, vpm) || is_zero(prev(h, mesh), mesh, vpm);
}

// Returns the facets that the oracle rejects, and the facets at vertices whose facets are all accepted, but do not wind
// around the vertex once. Skips frozen facets, fans with a frozen facet, fans at a border and, on request, facets with
// an edge of length zero.
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Oracle>
Frozen_facets<TriangleMesh> find_rejected_facets(const TriangleMesh& mesh, VertexPointMap vpm, const Oracle& oracle,
                                                 const Frozen_facets<TriangleMesh>& frozen, bool are_zero_edges_allowed,
                                                 Offending_simplices& offenders)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Oracle::Point_3 Point;
  constexpr std::size_t chunk = 256;
  const auto point = [vpm](auto v) -> decltype(auto) { return converted<Point>(get(vpm, v)); };
  const std::vector<typename Graph_traits::vertex_descriptor> all(vertices(mesh).begin(), vertices(mesh).end());
  const auto number = get(dynamic_vertex_property_t<std::size_t>(), mesh);
  for(std::size_t n = 0; n < all.size(); ++n) put(number, all[n], n);
  std::vector<typename Oracle::Sample> samples(all.size());
  for_each_chunk<ConcurrencyTag>(all.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) samples[n] = oracle.sample(point(all[n]));
  });
  const std::vector<typename Graph_traits::face_descriptor> facets(faces(mesh).begin(), faces(mesh).end());
  std::vector<char> is_good(facets.size(), 1);
  for_each_chunk<ConcurrencyTag>(facets.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      if(frozen.has_facet(facets[n]) || frozen.closes(facets[n])
         || (are_zero_edges_allowed && has_zero_edge(facets[n], mesh, vpm)))
        continue;
      const auto h = halfedge(facets[n], mesh);
      const auto p = source(h, mesh), q = target(h, mesh), r = target(next(h, mesh), mesh);
      is_good[n] = oracle(point(p), point(q), point(r),
                          { samples[get(number, p)], samples[get(number, q)], samples[get(number, r)] })
                   == Placement_verdict::ACCEPTED;
    }
  });
  Frozen_facets<TriangleMesh> rejected(mesh);
  for(std::size_t n = 0; n < facets.size(); ++n)
    if(!is_good[n]) {
      offenders.facets.push_back(n);
      rejected.freeze(facets[n]);
    }
  const auto folded = collect_from_chunks<ConcurrencyTag, std::size_t>(
    all.size(), chunk, [&](std::size_t begin, std::size_t end, auto& found) {
      std::vector<Point> link;
      for(std::size_t n = begin; n < end; ++n) {
        const auto v = all[n];
        if(halfedge(v, mesh) == Graph_traits::null_halfedge() || frozen.has_vertex(v) || rejected.has_vertex(v))
          continue;
        if(CGAL::is_border(v, mesh) || frozen.is_fixed(v)) continue;
        link.clear();
        bool is_degenerate = false;
        for(auto h : CGAL::halfedges_around_target(v, mesh)) {
          link.push_back(point(source(h, mesh)));
          is_degenerate = is_degenerate || is_zero(h, mesh, vpm) || is_zero(prev(h, mesh), mesh, vpm);
        }
        if(is_degenerate) continue;
        std::reverse(link.begin(), link.end());
        if(oracle.winding_number(point(v), samples[n], link) != 1) found.push_back(n);
      }
    });
  offenders.vertices.insert(offenders.vertices.end(), folded.begin(), folded.end());
  for(std::size_t n : folded)
    for(auto f : CGAL::faces_around_target(halfedge(all[n], mesh), mesh)) rejected.freeze(f);
  return rejected;
}

// Facets with an edge of length zero vanish. If a frozen vertex keeps the edge, they are frozen instead.
template <typename TriangleMesh, typename VertexPointMap>
void freeze_zero_edges(const TriangleMesh& mesh, VertexPointMap vpm, Frozen_facets<TriangleMesh>& frozen)
{
  for(bool has_grown = true; has_grown;) {
    has_grown = false;
    for(auto e : edges(mesh)) {
      const auto h = halfedge(e, mesh);
      if(!frozen.has_end_of(e) || !is_zero(h, mesh, vpm)) continue;
      for(auto f : { face(h, mesh), face(opposite(h, mesh), mesh) }) has_grown = frozen.freeze(f) || has_grown;
    }
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_FIND_REJECTED_FACETS_H
