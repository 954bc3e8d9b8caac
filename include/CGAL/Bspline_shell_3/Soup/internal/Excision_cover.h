// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_COVER_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_COVER_H

#include <CGAL/Bspline_shell_3/Mesh/triangles_overlap.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_state.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef std::pair<std::size_t, std::size_t> Triangle_pair;

// Returns all pairs of kept triangles that meet outside of their common vertices and edges, sorted. All pairs are
// needed, so their number is not limited.
// \pre kept triangles have a positive area
inline std::vector<Triangle_pair> overlapping_triangles(const Excision_state& state)
{
  const Soup_triangles& soup = state.soup;
  typedef Box_intersection_d::Box_with_info_d<double, 3, std::size_t> Box;
  constexpr std::size_t most_candidates = 1 << 20; // pairs of boxes, 16 MB
  constexpr std::size_t chunk = 1024;
  constexpr std::ptrdiff_t cutoff = 2000; // fewer boxes are compared one by one, along an axis
  std::vector<Box> boxes;
  for(std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if(!state.is_kept(t)) continue;
    const auto& c = soup.triangles[t];
    boxes.emplace_back(soup.points[c[0]].bbox() + soup.points[c[1]].bbox() + soup.points[c[2]].bbox(), t);
  }
  std::vector<Triangle_pair> pairs, candidates;
  const auto examine = [&] {
    const std::vector<Triangle_pair> found = collect_from_chunks<Parallel_if_available_tag, Triangle_pair>(
      candidates.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Triangle_pair>& overlapping) {
        for(std::size_t n = begin; n < end; ++n)
          if(triangles_overlap(soup.triangles[candidates[n].first], soup.triangles[candidates[n].second], soup.points))
            overlapping.push_back(candidates[n]);
      });
    pairs.insert(pairs.end(), found.begin(), found.end());
    candidates.clear();
  };
  CGAL::box_self_intersection_d<Sequential_tag>(
    boxes.begin(), boxes.end(),
    [&](const Box& a, const Box& b) {
      candidates.push_back(std::minmax(a.info(), b.info()));
      if(candidates.size() == most_candidates) examine();
    },
    cutoff);
  examine();
  sort_unique(pairs);
  return pairs;
}

// Returns the cost of excising each triangle: its area, and once more for each side at which this makes a border. So
// triangles that stick out of the surface go first.
inline std::vector<double> excision_costs(const Excision_state& state)
{
  std::vector<double> cost = state.area;
  state.edges.for_each_edge([&](std::size_t t) { return state.is_kept(t); },
                            [&](const std::vector<Triangle_side>& sides) {
                              if(sides.size() < 2) return;
                              for(const Triangle_side& side : sides)
                                cost[side.triangle()] += state.area[side.triangle()];
                            });
  return cost;
}

// Returns triangles that include one of each pair, and cost as little as a greedy choice achieves. The next triangle is
// the one with the least cost per remaining pair. Finally, triangles are removed whose pairs all have both triangles in
// the cover, the largest first.
inline std::vector<std::size_t> small_cover(const std::vector<Triangle_pair>& pairs, const std::vector<double>& cost_of)
{
  std::vector<std::vector<std::size_t> > others(cost_of.size());
  for(const Triangle_pair& pair : pairs) {
    others[pair.first].push_back(pair.second);
    others[pair.second].push_back(pair.first);
  }
  std::vector<std::size_t> remaining(cost_of.size()), cover;
  std::vector<char> is_covering(cost_of.size(), 0);
  typedef std::pair<double, std::size_t> Entry; // cost and triangle
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
  const auto push = [&](std::size_t t) {
    if(remaining[t] > 0) queue.emplace(cost_of[t] / double(remaining[t]), t);
  };
  for(std::size_t t = 0; t < cost_of.size(); ++t) {
    remaining[t] = others[t].size();
    push(t);
  }
  while(!queue.empty()) {
    Run::poll();
    const auto [cost, t] = queue.top();
    queue.pop();
    if(is_covering[t] || remaining[t] == 0) continue;
    if(cost < cost_of[t] / double(remaining[t])) { // some of its pairs were covered meanwhile
      push(t);
      continue;
    }
    is_covering[t] = 1;
    cover.push_back(t);
    for(std::size_t u : others[t])
      if(!is_covering[u]) --remaining[u];
  }
  std::sort(cover.begin(), cover.end(),
            [&](std::size_t t, std::size_t u) { return cost_of[t] != cost_of[u] ? cost_of[t] > cost_of[u] : t < u; });
  for(std::size_t t : cover)
    is_covering[t] = !std::all_of(others[t].begin(), others[t].end(), [&](std::size_t u) { return is_covering[u]; });
  cover.erase(std::remove_if(cover.begin(), cover.end(), [&](std::size_t t) { return !is_covering[t]; }), cover.end());
  std::sort(cover.begin(), cover.end());
  return cover;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_COVER_H
