// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_STATE_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_STATE_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Triangle_edges.h>
#include <CGAL/Bspline_shell_3/Support/Disjoint_sets.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Triangles of a soup, some of which are excised. Triangles are never restored.
struct Excision_state
{
  Soup_triangles soup;
  Triangle_edges edges;
  std::vector<double> area;             // by triangle
  std::vector<Excision_reason> reasons; // by triangle
  std::vector<char> is_reversed;        // by triangle
  std::vector<std::size_t> changed;     // points of triangles that were excised last

  Excision_state(Soup_triangles triangles, std::vector<Excision_reason> excised, std::vector<char> reversed)
    : soup(std::move(triangles)), edges(soup), reasons(std::move(excised)), is_reversed(std::move(reversed))
  {
    for(const auto& c : soup.triangles)
      area.push_back(std::sqrt(CGAL::squared_area(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]])));
  }

  std::size_t size() const { return reasons.size(); }
  bool is_kept(std::size_t triangle) const { return reasons[triangle] == Excision_reason::KEPT; }
  void excise(std::size_t triangle, Excision_reason reason)
  {
    if(!is_kept(triangle)) return;
    reasons[triangle] = reason;
    const auto& c = soup.triangles[triangle];
    changed.insert(changed.end(), c.begin(), c.end());
  }
  // Returns the first and the second point of a side in the orientation of the mesh.
  std::pair<std::size_t, std::size_t> ends(std::size_t corner) const
  {
    const auto& c = soup.triangles[corner / 3];
    const std::size_t v = c[corner % 3], w = c[(corner + 1) % 3];
    return is_reversed[corner / 3] ? std::make_pair(w, v) : std::make_pair(v, w);
  }
};

// Sets of triangles that are connected by edges.
struct Triangle_sets
{
  std::vector<std::size_t> set_of; // by triangle; a member of the set represents it
  std::vector<double> area;        // by representing triangle
};

// Returns the connected sets of the chosen triangles, connected by edges with at most `most` of them.
template <typename Predicate>
Triangle_sets connected_triangles(const Excision_state& state, const Predicate& is_chosen, std::size_t most)
{
  Disjoint_sets sets(state.size());
  state.edges.for_each_edge(is_chosen, [&](const std::vector<Triangle_side>& sides) {
    if(sides.size() > most) return;
    for(const Triangle_side& side : sides) sets.join(side.triangle(), sides.front().triangle());
  });
  Triangle_sets result;
  result.area.assign(state.size(), 0);
  for(std::size_t t = 0; t < state.size(); ++t) {
    result.set_of.push_back(sets.root(t));
    if(is_chosen(t)) result.area[result.set_of[t]] += state.area[t];
  }
  return result;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_STATE_H
