// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_EDGES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_EDGES_H

#include <CGAL/Bspline_shell_3/Soup/internal/Excision_state.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the unit vector in a triangle that is perpendicular to a side and leads to the opposite corner; zero if
// rounding leaves no such vector.
inline std::array<double, 3> direction_from_side(const Soup_triangles& soup, const Triangle_side& side)
{
  const auto& p = soup.points[side.lower];
  const auto e = soup.points[side.upper] - p;
  const auto u = soup.points[soup.triangles[side.triangle()][(side.corner + 2) % 3]] - p;
  const auto d = u - (u * e) / e.squared_length() * e;
  const double length = std::sqrt(d.squared_length());
  if(!(length > 0)) return {};
  return { d.x() / length, d.y() / length, d.z() / length };
}

// Chooses the two of several triangles at an edge that remain: one of them is in the set of largest area, the other one
// too if possible, and the angle between them is as large as possible.
inline std::pair<std::size_t, std::size_t> flattest_pair(const Excision_state& state,
                                                         const std::vector<Triangle_side>& sides,
                                                         const Triangle_sets& pieces)
{
  const auto piece = [&](std::size_t n) { return pieces.set_of[sides[n].triangle()]; };
  std::size_t largest = 0;
  for(std::size_t n = 1; n < sides.size(); ++n)
    if(pieces.area[piece(n)] > pieces.area[piece(largest)]) largest = n;
  std::vector<std::size_t> first, second; // candidates
  for(std::size_t n = 0; n < sides.size(); ++n)
    if(piece(n) == piece(largest)) first.push_back(n);
  if(first.size() >= 2) second = first;
  else {
    second.resize(sides.size());
    std::iota(second.begin(), second.end(), std::size_t(0));
  }
  std::vector<std::array<double, 3> > direction;
  for(const Triangle_side& side : sides) direction.push_back(direction_from_side(state.soup, side));
  std::pair<std::size_t, std::size_t> best;
  double least = 2; // more than each product of unit vectors
  for(std::size_t m : first)
    for(std::size_t n : second) {
      if(m == n) continue;
      const double product = std::inner_product(direction[m].begin(), direction[m].end(), direction[n].begin(), 0.);
      if(!(product < least)) continue;
      least = product;
      best = { m, n };
    }
  return best;
}

// Excises triangles until each edge has at most two.
inline void excise_at_non_manifold_edges(Excision_state& state)
{
  const auto is_kept = [&](std::size_t t) { return state.is_kept(t); };
  const Triangle_sets pieces = connected_triangles(state, is_kept, 2);
  state.edges.for_each_edge(is_kept, [&](const std::vector<Triangle_side>& sides) {
    if(sides.size() <= 2) return;
    const auto [m, n] = flattest_pair(state, sides, pieces);
    for(std::size_t k = 0; k < sides.size(); ++k)
      if(k != m && k != n) state.excise(sides[k].triangle(), Excision_reason::NON_MANIFOLD);
  });
}

// Sets of triangles that are joined step by step, with the orientation of each triangle relative to its set.
class Oriented_sets
{
public:
  explicit Oriented_sets(std::size_t size) : m_parent(size), m_differs(size, 0)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  // Returns a member of the set of `n`, and whether the orientations of both differ.
  std::pair<std::size_t, bool> root(std::size_t n)
  {
    bool differs = false;
    for(; m_parent[n] != n; n = m_parent[n]) {
      m_differs[n] = char(m_differs[n] ^ m_differs[m_parent[n]]); // halves the path
      m_parent[n] = m_parent[m_parent[n]];
      differs ^= m_differs[n] != 0;
    }
    return { n, differs };
  }
  // Returns false if the required relation contradicts earlier ones.
  bool join(std::size_t m, std::size_t n, bool differ)
  {
    const auto [a, of_m] = root(m);
    const auto [b, of_n] = root(n);
    if(a == b) return (of_m ^ of_n) == differ;
    m_parent[a] = b;
    m_differs[a] = char(of_m ^ of_n ^ differ);
    return true;
  }

private:
  std::vector<std::size_t> m_parent;
  std::vector<char> m_differs; // relative to the parent
};

// Orients triangles consistently. Each connected set keeps the orientation that most of its area has. Where
// orientations contradict each other, the smaller triangle at the edge is excised. Large triangles are connected first,
// so that contradictions are found at small ones.
// \pre each edge has at most two kept triangles
inline void orient_or_excise(Excision_state& state)
{
  struct Edge
  {
    double area; // the sum for both triangles
    std::size_t first, second;
    bool is_contradiction;
  };
  std::vector<Edge> edges;
  state.edges.for_each_edge([&](std::size_t t) { return state.is_kept(t); },
                            [&](const std::vector<Triangle_side>& sides) {
                              if(sides.size() != 2) return;
                              const std::size_t t = sides[0].triangle(), u = sides[1].triangle();
                              edges.push_back({ state.area[t] + state.area[u], t, u,
                                                state.ends(sides[0].corner) == state.ends(sides[1].corner) });
                            });
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.area > f.area; });
  Oriented_sets sets(state.size());
  for(const Edge& e : edges) {
    if(!state.is_kept(e.first) || !state.is_kept(e.second)) continue;
    if(!sets.join(e.first, e.second, e.is_contradiction))
      state.excise(state.area[e.first] < state.area[e.second] ? e.first : e.second, Excision_reason::NOT_ORIENTABLE);
  }
  std::vector<double> agreeing_area(state.size(), 0); // by root: the difference of both orientations
  for(std::size_t t = 0; t < state.size(); ++t) {
    const auto [root, differs] = sets.root(t);
    if(state.is_kept(t)) agreeing_area[root] += differs ? -state.area[t] : state.area[t];
  }
  for(std::size_t t = 0; t < state.size(); ++t) {
    const auto [root, differs] = sets.root(t);
    if(differs == (agreeing_area[root] >= 0)) state.is_reversed[t] = char(!state.is_reversed[t]);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_EDGES_H
