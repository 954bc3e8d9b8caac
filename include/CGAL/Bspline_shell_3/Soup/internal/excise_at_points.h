// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_POINTS_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_POINTS_H

#include <CGAL/Bspline_shell_3/Mesh/closable_fan.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_state.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Kept triangles around a point, in the order of their common edges.
struct Triangle_fan
{
  std::vector<std::size_t> triangles, link; // triangle n is (point, link[n], link[n+1])
  bool is_closed = false;                   // whether the last point of the link is its first one
  double area = 0;
};

// Returns the fans of kept triangles at a point.
// \pre each edge has at most two kept triangles, of consistent orientation
inline std::vector<Triangle_fan> fans_at(std::size_t point, const Excision_state& state)
{
  struct Wing
  {
    std::size_t from, to, triangle;
    bool operator<(const Wing& other) const { return from < other.from; }
  };
  std::vector<Wing> wings;
  state.edges.for_each_corner(point, [&](std::size_t corner) {
    const std::size_t t = corner / 3;
    if(!state.is_kept(t)) return;
    const auto& c = state.soup.triangles[t];
    std::size_t from = c[(corner + 1) % 3], to = c[(corner + 2) % 3];
    if(state.is_reversed[t]) std::swap(from, to);
    wings.push_back({ from, to, t });
  });
  std::sort(wings.begin(), wings.end());
  const auto wing_from = [&](std::size_t v) {
    const auto found = std::lower_bound(wings.begin(), wings.end(), Wing{ v, 0, 0 });
    return found == wings.end() || found->from != v ? wings.size() : std::size_t(found - wings.begin());
  };
  std::vector<char> has_previous(wings.size(), 0), is_used(wings.size(), 0);
  for(const Wing& wing : wings)
    if(const std::size_t next = wing_from(wing.to); next < wings.size()) has_previous[next] = 1;
  std::vector<Triangle_fan> fans;
  const auto follow = [&](std::size_t n, bool is_closed) {
    fans.emplace_back();
    Triangle_fan& fan = fans.back();
    fan.is_closed = is_closed;
    fan.link.push_back(wings[n].from);
    for(; n < wings.size() && !is_used[n]; n = wing_from(wings[n].to)) {
      is_used[n] = 1;
      fan.triangles.push_back(wings[n].triangle);
      fan.link.push_back(wings[n].to);
      fan.area += state.area[wings[n].triangle];
    }
  };
  for(std::size_t n = 0; n < wings.size(); ++n)
    if(!has_previous[n]) follow(n, false);
  for(std::size_t n = 0; n < wings.size(); ++n)
    if(!is_used[n]) follow(n, true);
  return fans;
}

// Excises triangles at points of three kinds: the kept triangles form several fans; no closing completes the fan to a
// regular vertex; or a vertex that must not move is nearly singular.
class Point_excision
{
public:
  Point_excision(Excision_state& state, double least_cone_margin)
    : m_state(state), m_pieces(connected_triangles(
                        state, [&](std::size_t t) { return state.is_kept(t); }, 2)),
      m_least_cone_margin(least_cone_margin), m_waits(state.soup.points.size(), 0)
  {}

  // Examines points, and all points of triangles that are excised.
  void run(const std::vector<std::size_t>& points)
  {
    add(points);
    while(!m_queue.empty()) {
      Run::poll();
      const std::size_t point = m_queue.front();
      m_queue.pop_front();
      m_waits[point] = 0;
      m_state.changed.clear();
      examine(point);
      add(m_state.changed);
    }
    m_state.changed.clear();
  }

private:
  void add(const std::vector<std::size_t>& points)
  {
    for(std::size_t v : points) {
      if(m_waits[v]) continue;
      m_waits[v] = 1;
      m_queue.push_back(v);
    }
  }

  void examine(std::size_t point)
  {
    const std::vector<Triangle_fan> fans = fans_at(point, m_state);
    if(fans.empty()) return;
    if(fans.size() > 1) {
      const auto largest = std::max_element(fans.begin(), fans.end(), [&](const auto& a, const auto& b) {
        return std::make_pair(area_of_piece(a), a.area) < std::make_pair(area_of_piece(b), b.area);
      });
      for(const Triangle_fan& fan : fans)
        if(&fan != &*largest) excise(fan, Excision_reason::NON_MANIFOLD);
      return;
    }
    const Triangle_fan& fan = fans.front();
    if(!fan.is_closed) {
      if(!is_closable(point, fan)) excise(fan, Excision_reason::STEEP_BORDER);
    } else if(is_in_contact(point) && !is_regular(point, fan)) excise(fan, Excision_reason::SINGULAR_PIN);
  }

  void excise(const Triangle_fan& fan, Excision_reason reason)
  {
    for(std::size_t t : fan.triangles) m_state.excise(t, reason);
  }

  // Returns the area of the piece to which a fan belonged at first. A large triangle may stick out of fine facets.
  double area_of_piece(const Triangle_fan& fan) const { return m_pieces.area[m_pieces.set_of[fan.triangles.front()]]; }

  bool is_in_contact(std::size_t point) const
  {
    bool has_excised = false;
    m_state.edges.for_each_corner(point, [&](std::size_t corner) { has_excised |= !m_state.is_kept(corner / 3); });
    return has_excised;
  }

  // Returns whether the cone margin is large enough.
  bool is_regular(std::size_t point, const Triangle_fan& fan) const
  {
    const auto& points = m_state.soup.points;
    Vertex_fan cone;
    cone.apex = points[point];
    for(std::size_t n = 0; n + 1 < fan.link.size(); ++n)
      cone.wings.emplace_back(points[fan.link[n]], points[fan.link[n + 1]]);
    const auto margin = bounded_cone_margin(cone, m_least_cone_margin);
    return margin && *margin >= m_least_cone_margin;
  }

  bool is_closable(std::size_t point, const Triangle_fan& fan) const
  {
    if(!is_regular(point, fan)) return false;
    std::vector<Excised_soup_3::Point_3> link;
    for(std::size_t v : fan.link) link.push_back(m_state.soup.points[v]);
    return is_fan_closable(m_state.soup.points[point], link);
  }

  Excision_state& m_state;
  Triangle_sets m_pieces; // before any excision at points
  double m_least_cone_margin;
  std::deque<std::size_t> m_queue;
  std::vector<char> m_waits; // by point: whether it is in the queue
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISE_AT_POINTS_H
