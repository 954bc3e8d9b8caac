// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions_2.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef std::pair<Shell_truncation_3::Index, Shell_truncation_3::Index> Truncation_edge; // source and target

// Returns the directed edge from a corner of a triangle to the next one.
inline Truncation_edge edge_of(const Shell_truncation_3::Triangle& t, int corner)
{
  return { t[corner], t[(corner + 1) % 3] };
}

// Returns whether indices and numbers are in range and no two vertices are at the same position.
inline bool are_indices_valid(const Shell_truncation_3& truncation)
{
  typedef Shell_truncation_3::Index Index;
  typedef Shell_truncation_3::Triangle Triangle;
  constexpr Index npos = Shell_truncation_3::npos;
  const std::size_t size = truncation.points().size(), planar = truncation.planar().size();
  if(planar > size || truncation.cuts().size() > planar || size >= npos || truncation.cut_facets().size() >= npos
     || truncation.discs().empty())
    return false;
  const std::size_t corners = truncation.number_of_corners();
  const auto is_finite = [](const auto& p) {
    return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
  };
  if(!std::all_of(truncation.points().begin(), truncation.points().end(), is_finite)
     || !std::all_of(truncation.planar().begin(), truncation.planar().end(), is_finite))
    return false;
  std::unordered_set<Shell_truncation_3::Point, Hash_coordinates> positions;
  for(std::size_t n = 0; n < corners; ++n)
    if(!positions.insert(truncation.points()[n]).second) return false;
  const auto are_different = [](const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; };
  for(const Triangle& t : truncation.cut_facets())
    if(!are_different(t) || !std::all_of(t.begin(), t.end(), [&](Index p) { return p < corners; })) return false;
  for(const Shell_truncation_3::Cut& c : truncation.cuts()) {
    const bool is_on_edge = c.second == npos;
    if(c.center >= corners || c.first >= corners || (!is_on_edge && c.second >= corners)) return false;
    if(!(c.s > 0 && c.s < 1) || !(is_on_edge ? c.t == 0 : c.t > 0)) return false;
    if(!is_on_edge && !(Exact_rational(c.s) + Exact_rational(c.t) < Exact_rational(1))) return false;
  }
  for(const Shell_truncation_3::Core& c : truncation.cores())
    if(c.facet >= truncation.cut_facets().size() || !are_different(c.triangle)
       || !std::all_of(c.triangle.begin(), c.triangle.end(),
                       [&](Index p) { return p < corners || truncation.is_cut(p); }))
      return false;
  std::vector<Index> disc_of(planar, npos); // by cut and inner point
  std::vector<char> is_center(corners, 0);
  for(std::size_t n = 0; n < truncation.discs().size(); ++n) {
    const Shell_truncation_3::Disc& d = truncation.discs()[n];
    if(d.center >= corners || is_center[d.center] || d.rim.size() < 3 || d.facets.size() != d.rim.size()) return false;
    is_center[d.center] = 1;
    for(std::size_t i = 0; i < d.rim.size(); ++i) {
      if(!truncation.is_cut(d.rim[i]) || truncation.cut(d.rim[i]).center != d.center
         || d.facets[i] >= truncation.cut_facets().size())
        return false;
      if(disc_of[d.rim[i] - corners] != npos) return false;
      disc_of[d.rim[i] - corners] = Index(n);
    }
    for(const Triangle& t : d.triangles) {
      if(!are_different(t)) return false;
      for(Index p : t) {
        if(p < corners || p >= size) return false;
        Index& of = disc_of[p - corners];
        if(of == npos && !truncation.is_cut(p)) of = Index(n);
        if(of != n) return false;
      }
    }
  }
  if(std::find(disc_of.begin(), disc_of.end(), npos) != disc_of.end()) return false;
  for(const Shell_truncation_3::Core& c : truncation.cores())
    for(Index p : c.triangle)
      if(p < corners && is_center[p]) return false;
  return true;
}

// Returns whether each cut facet is tiled by its parts, and facets agree on the points on their common edges. The
// argument uses the degree of a map: the triangles cover the facet once if they are positively oriented, and all their
// edges cancel except for a cycle that leads once around the facet.
inline bool do_parts_tile_facets(const Shell_truncation_3& truncation)
{
  typedef Shell_truncation_3::Index Index;
  typedef Shell_truncation_3::Triangle Triangle;
  typedef std::array<Exact_rational, 3> Barycentric;
  // Returns whether a point is a corner or a cut of the facet.
  const auto is_in_facet = [&](const Triangle& facet, Index p) {
    const auto corner = [&](Index q) { return Shell_truncation_3::corner(facet, q); };
    if(p < truncation.number_of_corners()) return corner(p) < 3;
    const Shell_truncation_3::Cut& c = truncation.cut(p);
    if(corner(c.center) == 3 || corner(c.first) == 3 || c.center == c.first) return false;
    return c.second == Shell_truncation_3::npos
           || (corner(c.first) == (corner(c.center) + 1) % 3 && corner(c.second) == (corner(c.center) + 2) % 3);
  };
  const auto orientation = [](const Barycentric& p, const Barycentric& q, const Barycentric& r) {
    return CGAL::sign(Exact_rational((q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1])));
  };
  std::vector<std::vector<Triangle> > parts(truncation.cut_facets().size());
  for(const Shell_truncation_3::Core& c : truncation.cores()) parts[c.facet].push_back(c.triangle);
  for(const Shell_truncation_3::Disc& d : truncation.discs())
    for(std::size_t i = 0; i < d.rim.size(); ++i)
      parts[d.facets[i]].push_back({ d.center, d.rim[i], d.rim[(i + 1) % d.rim.size()] });

  std::set<Truncation_edge> sides; // edges along the sides of facets
  for(std::size_t f = 0; f < truncation.cut_facets().size(); ++f) {
    const Triangle& facet = truncation.cut_facets()[f];
    std::map<Index, Barycentric> at;
    std::set<Truncation_edge> edges;
    for(const Triangle& t : parts[f]) {
      for(int i = 0; i < 3; ++i) {
        if(at.count(t[i]) == 0) {
          if(!is_in_facet(facet, t[i])) return false;
          at.emplace(t[i], truncation.barycentric<Exact_rational>(facet, t[i]));
        }
        if(!edges.insert(edge_of(t, i)).second) return false;
      }
      if(orientation(at[t[0]], at[t[1]], at[t[2]]) != POSITIVE) return false;
    }
    std::map<Index, Index> next;
    for(const auto& [p, q] : edges)
      if(edges.count({ q, p }) == 0 && !next.emplace(p, q).second) return false;
    // Walk once around the facet, along its sides.
    Index p = facet[0];
    std::size_t steps = 0;
    for(int side = 0; side < 3; ++side)
      for(; p != facet[(side + 1) % 3]; ++steps) {
        const auto found = next.find(p);
        if(found == next.end()) return false;
        const Index q = found->second;
        // Along a side, the coordinate of the corner that it leads to increases, and that of the third corner is zero.
        const auto &b = at[p], &c = at[q];
        if(b[(side + 2) % 3] != 0 || c[(side + 2) % 3] != 0 || !(c[(side + 1) % 3] > b[(side + 1) % 3])) return false;
        if(!sides.insert({ p, q }).second) return false;
        p = q;
      }
    if(steps != next.size()) return false;
  }
  for(const auto& [p, q] : sides)
    if((truncation.is_cut(p) || truncation.is_cut(q)) && sides.count({ q, p }) == 0) return false;
  return true;
}

// Returns whether each tip and its disc are mapped onto the same polygon. It is star-shaped around the vertex, and is
// the only border of the disc, whose triangles are positively oriented.
inline bool are_discs_valid(const Shell_truncation_3& truncation)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_2 Point_2;
  const auto at = [&](Shell_truncation_3::Index p) {
    return Point_2(truncation.planar(p)[0], truncation.planar(p)[1]);
  };
  const Point_2 center(0, 0);
  for(const Shell_truncation_3::Disc& d : truncation.discs()) {
    const std::size_t size = d.rim.size();
    // Each edge turns by less than half a turn, and the rim winds around the center once: exactly one edge returns past
    // the first cut.
    std::size_t turns = 0;
    Orientation last = COLLINEAR;
    for(std::size_t i = 0; i < size; ++i) {
      const Point_2 p = at(d.rim[i]), q = at(d.rim[(i + 1) % size]);
      if(CGAL::orientation(center, p, q) != LEFT_TURN) return false;
      const Orientation side = i + 1 == size ? COLLINEAR : CGAL::orientation(center, at(d.rim[0]), q);
      if(last == RIGHT_TURN && side != RIGHT_TURN) ++turns;
      last = side;
    }
    if(turns != 1) return false;
    std::set<Truncation_edge> edges;
    for(const Shell_truncation_3::Triangle& t : d.triangles) {
      if(CGAL::orientation(at(t[0]), at(t[1]), at(t[2])) != LEFT_TURN) return false;
      for(int i = 0; i < 3; ++i) edges.insert(edge_of(t, i));
    }
    std::size_t open = 0;
    for(const auto& [p, q] : edges) open += edges.count({ q, p }) == 0 ? 1 : 0;
    if(open != size) return false;
    for(std::size_t i = 0; i < size; ++i)
      if(edges.count({ d.rim[i], d.rim[(i + 1) % size] }) == 0) return false;
  }
  return true;
}

// Returns whether no two new facets have the same directed edge. The cores have every edge of a rim in reverse, because
// they border on the tips there. So a disc has the edges of its rim in one direction only, and its other edges cancel.
inline bool are_edges_unique(const Shell_truncation_3& truncation)
{
  std::vector<Truncation_edge> edges;
  const auto add = [&](const Shell_truncation_3::Triangle& t) {
    for(int i = 0; i < 3; ++i) edges.push_back(edge_of(t, i));
  };
  for(const Shell_truncation_3::Core& c : truncation.cores()) add(c.triangle);
  for(const Shell_truncation_3::Disc& d : truncation.discs())
    std::for_each(d.triangles.begin(), d.triangles.end(), add);
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

// The parts of each facet tile it, in exact arithmetic on the numbers in `cuts()`. Facets with a common edge have the
// same cuts on it. Hence the cores and tips are one subdivision of the cut facets. The fan of the tip is mapped onto a
// star-shaped polygon. So is the disc: its triangles are positively oriented in the plane, and its only border is the
// rim. No two new facets have the same directed edge. Therefore, replace_patches() succeeds on every mesh that has a
// patch.
CGAL_BSPLINE_SHELL_3_INLINE bool prove_truncation(const Shell_truncation_3& truncation)
{
  return are_indices_valid(truncation) && do_parts_tile_facets(truncation) && are_discs_valid(truncation)
         && are_edges_unique(truncation);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
