// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions_2.h>
#include <CGAL/Union_find.h>
#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <cmath>
#include <map>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

typedef std::array<Exact_rational, 3> Exact_barycentric;

// Returns the orientation of three points in a facet.
inline Sign orientation_in_facet(const Exact_barycentric& p, const Exact_barycentric& q, const Exact_barycentric& r)
{
  return CGAL::sign(Exact_rational((q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1])));
}

// Returns the barycentric coordinates of a point in a planar triangle. If the triangle is too small to compute them,
// returns the coordinates of its first corner.
inline std::array<double, 3> barycentric_in_plane(const std::array<std::array<double, 2>, 3>& t,
                                                  const std::array<double, 2>& p)
{
  const auto area = [](const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  const double whole = area(t[0], t[1], t[2]);
  if(!(whole > 0)) return { 1, 0, 0 };
  const double u = area(t[0], p, t[2]) / whole, v = area(t[0], t[1], p) / whole;
  return { 1 - u - v, u, v };
}

// Maps corners to the plane by two of their barycentric coordinates.
inline std::array<std::array<double, 2>, 3> in_plane(const std::array<std::array<double, 3>, 3>& corners)
{
  return { { { corners[0][1], corners[0][2] }, { corners[1][1], corners[1][2] }, { corners[2][1], corners[2][2] } } };
}

// Corrects the barycentric coordinates of a point that is outside a triangle by rounding only.
inline std::array<double, 3> clamped(std::array<double, 3> barycentric)
{
  double sum = 0;
  for(double& x : barycentric) sum += x = (std::max)(x, 0.);
  for(double& x : barycentric) x /= sum;
  return barycentric;
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE
Shell_truncation_3::Shell_truncation_3(std::vector<Point> points, std::vector<Triangle> cut_facets,
                                       std::vector<Cut> cuts, std::vector<Core> cores, std::vector<Disc> discs,
                                       std::vector<Planar_point> planar)
  : m_points(std::move(points)), m_cut_facets(std::move(cut_facets)), m_cuts(std::move(cuts)),
    m_cores(std::move(cores)), m_discs(std::move(discs)), m_planar(std::move(planar))
{
  m_is_valid = are_indices_valid() && do_parts_tile_facets() && are_discs_valid();
  if(!m_is_valid) return;
  index();
  m_is_valid = are_edges_unique();
}

// Returns whether numbers are in range and no two vertices are at the same position.
CGAL_BSPLINE_SHELL_3_INLINE bool Shell_truncation_3::are_indices_valid() const
{
  const std::size_t size = m_points.size(), corners = number_of_corners();
  if(m_planar.size() > size || m_cuts.size() > m_planar.size() || size >= npos || m_cut_facets.size() >= npos
     || m_discs.empty())
    return false;
  for(const Point& p : m_points)
    for(double x : p)
      if(!std::isfinite(x)) return false;
  for(const Planar_point& p : m_planar)
    for(double x : p)
      if(!std::isfinite(x)) return false;
  std::unordered_map<Point, Index, internal::Hash_coordinates> corner_at;
  for(std::size_t n = 0; n < corners; ++n)
    if(!corner_at.emplace(m_points[n], Index(n)).second) return false;
  const auto are_different = [](const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; };
  for(const Triangle& t : m_cut_facets)
    if(!are_different(t) || !std::all_of(t.begin(), t.end(), [&](Index p) { return p < corners; })) return false;
  for(const Cut& c : m_cuts) {
    const bool is_on_edge = c.second == npos;
    if(c.center >= corners || c.first >= corners || (!is_on_edge && c.second >= corners)) return false;
    if(!(c.s > 0 && c.s < 1) || !(is_on_edge ? c.t == 0 : c.t > 0)) return false;
    if(!is_on_edge && !(Exact_rational(c.s) + Exact_rational(c.t) < Exact_rational(1))) return false;
  }
  for(const Core& c : m_cores)
    if(c.facet >= m_cut_facets.size() || !are_different(c.triangle)
       || !std::all_of(c.triangle.begin(), c.triangle.end(), [&](Index p) { return p < corners || is_cut(p); }))
      return false;
  std::vector<Index> disc_of(m_planar.size(), npos); // by cut and inner point
  std::vector<char> is_center(corners, 0);
  for(std::size_t n = 0; n < m_discs.size(); ++n) {
    const Disc& d = m_discs[n];
    if(d.center >= corners || is_center[d.center] || d.rim.size() < 3 || d.facets.size() != d.rim.size()) return false;
    is_center[d.center] = 1;
    for(std::size_t i = 0; i < d.rim.size(); ++i) {
      if(!is_cut(d.rim[i]) || m_cuts[d.rim[i] - corners].center != d.center || d.facets[i] >= m_cut_facets.size())
        return false;
      if(disc_of[d.rim[i] - corners] != npos) return false;
      disc_of[d.rim[i] - corners] = Index(n);
    }
    for(const Triangle& t : d.triangles) {
      if(!are_different(t)) return false;
      for(Index p : t) {
        if(p < corners || p >= size) return false;
        Index& of = disc_of[p - corners];
        if(of == npos && !is_cut(p)) of = Index(n);
        if(of != n) return false;
      }
    }
  }
  if(std::find(disc_of.begin(), disc_of.end(), npos) != disc_of.end()) return false;
  for(const Core& c : m_cores)
    for(Index p : c.triangle)
      if(p < corners && is_center[p]) return false;
  return true;
}

// Returns whether each cut facet is tiled by its parts, and facets agree on the points on their common edges. The
// argument uses the degree of a map: the triangles cover the facet once if they are positively oriented, and all their
// edges cancel except for a cycle that leads once around the facet.
CGAL_BSPLINE_SHELL_3_INLINE bool Shell_truncation_3::do_parts_tile_facets() const
{
  typedef std::pair<Index, Index> Edge;
  const auto coordinates = [&](const Triangle& facet, Index p, internal::Exact_barycentric& b) {
    const auto corner = [&](Index q) { return std::find(facet.begin(), facet.end(), q) - facet.begin(); };
    b = { 0, 0, 0 };
    if(p < number_of_corners()) {
      if(corner(p) == 3) return false;
      b[corner(p)] = 1;
      return true;
    }
    const Cut& c = m_cuts[p - number_of_corners()];
    if(corner(c.center) == 3 || corner(c.first) == 3 || c.center == c.first) return false;
    if(c.second != npos && corner(c.second) != (corner(c.center) + 2) % 3) return false;
    if(c.second != npos && corner(c.first) != (corner(c.center) + 1) % 3) return false;
    const Exact_rational s(c.s), t(c.t);
    b[corner(c.center)] = 1 - s - t;
    b[corner(c.first)] = s;
    if(c.second != npos) b[corner(c.second)] = t;
    return true;
  };
  std::vector<std::vector<Triangle> > parts(m_cut_facets.size());
  for(const Core& c : m_cores) parts[c.facet].push_back(c.triangle);
  for(const Disc& d : m_discs)
    for(std::size_t i = 0; i < d.rim.size(); ++i)
      parts[d.facets[i]].push_back({ d.center, d.rim[i], d.rim[(i + 1) % d.rim.size()] });

  std::map<Edge, Index> sides; // edges along the sides of facets
  for(std::size_t f = 0; f < m_cut_facets.size(); ++f) {
    const Triangle& facet = m_cut_facets[f];
    std::map<Index, internal::Exact_barycentric> at;
    std::map<Edge, char> edges;
    for(const Triangle& t : parts[f]) {
      for(int i = 0; i < 3; ++i) {
        if(at.count(t[i]) == 0 && !coordinates(facet, t[i], at[t[i]])) return false;
        if(!edges.emplace(Edge(t[i], t[(i + 1) % 3]), 0).second) return false;
      }
      if(internal::orientation_in_facet(at[t[0]], at[t[1]], at[t[2]]) != POSITIVE) return false;
    }
    std::map<Index, Index> next;
    for(const auto& e : edges)
      if(edges.count(Edge(e.first.second, e.first.first)) == 0 && !next.emplace(e.first.first, e.first.second).second)
        return false;
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
        if(!sides.emplace(Edge(p, q), Index(f)).second) return false;
        p = q;
      }
    if(steps != next.size()) return false;
  }
  for(const auto& side : sides) {
    const Edge& e = side.first;
    if((is_cut(e.first) || is_cut(e.second)) && sides.count(Edge(e.second, e.first)) == 0) return false;
  }
  return true;
}

// Returns whether each tip and its disc are mapped onto the same polygon. It is star-shaped around the vertex, and is
// the only border of the disc, whose triangles are positively oriented.
CGAL_BSPLINE_SHELL_3_INLINE bool Shell_truncation_3::are_discs_valid() const
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_2 Point_2;
  typedef std::pair<Index, Index> Edge;
  const auto at = [&](Index p) { return Point_2(planar(p)[0], planar(p)[1]); };
  const Point_2 center(0, 0);
  for(const Disc& d : m_discs) {
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
    std::map<Edge, char> edges;
    for(const Triangle& t : d.triangles) {
      if(CGAL::orientation(at(t[0]), at(t[1]), at(t[2])) != LEFT_TURN) return false;
      for(int i = 0; i < 3; ++i) edges.emplace(Edge(t[i], t[(i + 1) % 3]), 0);
    }
    std::size_t open = 0;
    for(const auto& e : edges) open += edges.count(Edge(e.first.second, e.first.first)) == 0 ? 1 : 0;
    if(open != size) return false;
    for(std::size_t i = 0; i < size; ++i)
      if(edges.count(Edge(d.rim[i], d.rim[(i + 1) % size])) == 0) return false;
  }
  return true;
}

// Returns whether no two new facets have the same directed edge. The cores have every edge of a rim in reverse, because
// they border on the tips there. So a disc has the edges of its rim in one direction only, and its other edges cancel.
CGAL_BSPLINE_SHELL_3_INLINE bool Shell_truncation_3::are_edges_unique() const
{
  std::vector<std::pair<Index, Index> > edges;
  for(std::size_t n = 0; n < number_of_new_facets(); ++n) {
    const Triangle t = new_facet(n);
    for(int i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

CGAL_BSPLINE_SHELL_3_INLINE std::array<double, 3> Shell_truncation_3::barycentric_in(Index facet, Index point) const
{
  const Triangle& t = m_cut_facets[facet];
  const auto corner = [&](Index p) { return std::size_t(std::find(t.begin(), t.end(), p) - t.begin()); };
  std::array<double, 3> b = {};
  if(point < number_of_corners()) b[corner(point)] = 1;
  else {
    const Cut& c = m_cuts[point - number_of_corners()];
    b[corner(c.center)] = 1 - c.s - c.t;
    b[corner(c.first)] = c.s;
    if(c.second != npos) b[corner(c.second)] = c.t;
  }
  return b;
}

CGAL_BSPLINE_SHELL_3_INLINE void Shell_truncation_3::index()
{
  for(std::size_t n = 0; n < m_discs.size(); ++n)
    for(std::size_t i = 0; i < m_discs[n].triangles.size(); ++i) m_disc_triangles.emplace_back(Index(n), Index(i));
  m_cells.resize(m_cut_facets.size());
  for(std::size_t n = 0; n < m_cores.size(); ++n) {
    Cell cell = { Index(n), npos, npos, {} };
    for(int i = 0; i < 3; ++i) cell.corners[i] = barycentric_in(m_cores[n].facet, m_cores[n].triangle[i]);
    m_cells[m_cores[n].facet].push_back(cell);
  }
  for(std::size_t n = 0; n < m_discs.size(); ++n) {
    const Disc& d = m_discs[n];
    for(std::size_t i = 0; i < d.rim.size(); ++i) {
      const Index f = d.facets[i];
      m_cells[f].push_back({ npos,
                             Index(n),
                             Index(i),
                             { barycentric_in(f, d.center), barycentric_in(f, d.rim[i]),
                               barycentric_in(f, d.rim[(i + 1) % d.rim.size()]) } });
    }
  }
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<Shell_truncation_3::Index> Shell_truncation_3::patches() const
{
  Union_find<Index> sets;
  std::vector<Union_find<Index>::handle> set;
  for(std::size_t f = 0; f < m_cut_facets.size(); ++f) set.push_back(sets.make_set(Index(f)));
  for(const Disc& d : m_discs)
    for(Index f : d.facets) sets.unify_sets(set[d.facets.front()], set[f]);
  std::vector<Index> patch_of;
  for(std::size_t f = 0; f < m_cut_facets.size(); ++f) patch_of.push_back(*sets.find(set[f]));
  return patch_of;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_truncation_3::Piece Shell_truncation_3::piece(const Place& place) const
{
  typedef std::array<double, 3> Barycentric;
  const auto least = [](const Barycentric& b) { return (std::min)({ b[0], b[1], b[2] }); };
  // The part that contains the place or is nearest to it.
  Piece result = { nullptr, 0 };
  Barycentric in_part = {};
  for(const Cell& cell : m_cells[place.facet]) {
    const Barycentric b = internal::barycentric_in_plane(internal::in_plane(cell.corners),
                                                         { place.barycentric[1], place.barycentric[2] });
    if(result.part != nullptr && !(least(b) > least(in_part))) continue;
    result.part = &cell;
    in_part = b;
  }
  result.new_facet = result.part->new_facet;
  if(result.part->new_facet != npos) return result;

  const Disc& d = m_discs[result.part->disc];
  const Planar_point x = planar_point(*result.part, internal::clamped(in_part));
  const auto first = std::lower_bound(m_disc_triangles.begin(), m_disc_triangles.end(),
                                      Disc_triangle(result.part->disc, 0));
  Barycentric in_triangle = {};
  for(std::size_t i = 0; i < d.triangles.size(); ++i) {
    const Triangle& t = d.triangles[i];
    const Barycentric b = internal::barycentric_in_plane({ { planar(t[0]), planar(t[1]), planar(t[2]) } }, x);
    if(i > 0 && !(least(b) > least(in_triangle))) continue;
    result.new_facet = m_cores.size() + std::size_t(first - m_disc_triangles.begin()) + i;
    in_triangle = b;
  }
  return result;
}

// Returns the planar position of a point in a triangle of a tip.
CGAL_BSPLINE_SHELL_3_INLINE Shell_truncation_3::Planar_point Shell_truncation_3::planar_point(
  const Cell& part, const std::array<double, 3>& barycentric) const
{
  const Disc& d = m_discs[part.disc];
  const Planar_point &p = planar(d.rim[part.edge]), &q = planar(d.rim[(part.edge + 1) % d.rim.size()]);
  return { barycentric[1] * p[0] + barycentric[2] * q[0], barycentric[1] * p[1] + barycentric[2] * q[1] };
}

// Applies the affine map of a piece.
CGAL_BSPLINE_SHELL_3_INLINE std::array<double, 3> Shell_truncation_3::mapped(
  const Piece& piece, const std::array<double, 3>& barycentric) const
{
  const std::array<double, 3> in_part = internal::barycentric_in_plane(internal::in_plane(piece.part->corners),
                                                                       { barycentric[1], barycentric[2] });
  if(piece.part->new_facet != npos) return in_part;
  const Triangle t = new_facet(piece.new_facet);
  return internal::barycentric_in_plane({ { planar(t[0]), planar(t[1]), planar(t[2]) } },
                                        planar_point(*piece.part, in_part));
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_truncation_3::Place Shell_truncation_3::image(const Place& place) const
{
  CGAL_precondition(is_valid());
  const Piece p = piece(place);
  return { Index(p.new_facet), internal::clamped(mapped(p, place.barycentric)) };
}

CGAL_BSPLINE_SHELL_3_INLINE std::array<std::array<double, 3>, 3> Shell_truncation_3::derivative(
  const Place& place) const
{
  CGAL_precondition(is_valid());
  const Piece p = piece(place);
  return { { mapped(p, { 1, 0, 0 }), mapped(p, { 0, 1, 0 }), mapped(p, { 0, 0, 1 }) } };
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_truncation_3::Place Shell_truncation_3::preimage(const Place& place) const
{
  CGAL_precondition(is_valid());
  typedef std::array<double, 3> Barycentric;
  const auto combined = [](const Barycentric& weights, const std::array<Barycentric, 3>& corners) {
    Barycentric b = {};
    for(int i = 0; i < 3; ++i)
      for(int a = 0; a < 3; ++a) b[a] += weights[i] * corners[i][a];
    return internal::clamped(b);
  };
  const Triangle t = new_facet(place.facet);
  const Index disc = disc_of_new_facet(place.facet);
  if(disc == npos) {
    const Index f = m_cores[place.facet].facet;
    return { f, combined(place.barycentric,
                         { barycentric_in(f, t[0]), barycentric_in(f, t[1]), barycentric_in(f, t[2]) }) };
  }
  const Disc& d = m_discs[disc];
  Planar_point x = {};
  for(int i = 0; i < 3; ++i)
    for(int a = 0; a < 2; ++a) x[a] += place.barycentric[i] * planar(t[i])[a];
  std::size_t edge = 0;
  Barycentric in_tip = {};
  for(std::size_t i = 0; i < d.rim.size(); ++i) {
    const Barycentric b = internal::barycentric_in_plane(
      { { Planar_point{}, planar(d.rim[i]), planar(d.rim[(i + 1) % d.rim.size()]) } }, x);
    if(i > 0 && !((std::min)({ b[0], b[1], b[2] }) > (std::min)({ in_tip[0], in_tip[1], in_tip[2] }))) continue;
    edge = i;
    in_tip = b;
  }
  const Index f = d.facets[edge];
  return { f, combined(internal::clamped(in_tip), { barycentric_in(f, d.center), barycentric_in(f, d.rim[edge]),
                                                    barycentric_in(f, d.rim[(edge + 1) % d.rim.size()]) }) };
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
