// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/edge_uses.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/triangles_overlap.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Soup/coordinate_unit.h>
#include <CGAL/Bspline_shell_3/Soup/find_close_points.h>
#include <CGAL/Bspline_shell_3/Soup/tidy_polygons.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>
#include <CGAL/Bspline_shell_3/Support/Disjoint_sets.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Calls f(piece) for the triangles into which points on the sides of a triangle split it. `on_side[i]` are the points
// on the side that begins at `corners[i]`, in the direction of that side.
template <typename Function>
void split_triangle(const std::array<std::size_t, 3>& corners, const std::array<std::vector<std::size_t>, 3>& on_side,
                    const Function& f)
{
  const auto are_fewer = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  const std::size_t i = std::size_t(std::max_element(on_side.begin(), on_side.end(), are_fewer) - on_side.begin());
  if(on_side[i].empty()) {
    f(corners);
    return;
  }
  // The middle point is joined to the opposite corner.
  const auto middle = on_side[i].begin() + std::ptrdiff_t(on_side[i].size() / 2);
  const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
  split_triangle({ corners[i], *middle, corners[last] }, { { { on_side[i].begin(), middle }, {}, on_side[last] } }, f);
  split_triangle({ *middle, corners[next], corners[last] }, { { { middle + 1, on_side[i].end() }, on_side[next], {} } },
                 f);
}

// Closes cracks in rounds. Each round makes all changes that no check has refused, *clusters* of points that become one
// point and *insertions* of points in border edges, and then checks them. Changes that fail are refused in later
// rounds; if none fails, the round is the last one.
class Soup_welder
{
  typedef Polygon_soup::Polygons Polygons;
  typedef std::array<std::size_t, 3> Triangle;
public:
  // \param soup result of `tidy_polygons()`
  // \param distance largest distance that is bridged
  // \param is_reduced whether it is reduced to a fraction of adjacent edges
  Soup_welder(const Polygon_soup& soup, double distance, bool is_reduced)
    : m_soup(soup), m_distance(distance), m_is_reduced(is_reduced), m_cluster(soup.points.size()),
      m_size(soup.points.size(), 1), m_is_refused(soup.points.size(), 0)
  {
    std::iota(m_cluster.begin(), m_cluster.end(), std::size_t(0));
    find_border();
  }

  // Returns false if nothing can be changed.
  bool weld()
  {
    constexpr std::size_t most_rounds = 50; // a few are usual; each takes linear time
    if(m_border_points.empty() || !find_clusters()) return false;
    m_tested = m_polygons;
    for(std::size_t round = 0; round < most_rounds; ++round) {
      if(!make_changes()) return false;
      if(is_unchanged()) return false;
      if(check_topology() && check_normals() && check_intersections()) return true;
    }
    return false;
  }

  // Calls f(polygon, number, change) for the polygons, in the order of their numbers in the soup.
  template <typename Function>
  void for_each_polygon(const Function& f) const
  {
    for(std::size_t n = 0, k = 0; n < m_soup.polygons.size(); ++n) {
      const bool is_active = k < m_active.size() && m_active[k] == n;
      if(is_active && is_changed(k)) {
        const Weld_change change = m_current[k].size() > m_polygons[k].size() ? Weld_change::SPLIT : Weld_change::MOVED;
        for_each_piece(k, [&](const Triangle& piece, const Triangle&) {
          f(std::vector<std::size_t>(piece.begin(), piece.end()), n, change);
        });
      } else f(m_soup.polygons[n], n, Weld_change::NONE);
      if(is_active) ++k;
    }
  }

  std::size_t border_edges_before() const { return m_border_edges_before; }
  std::size_t border_edges_after() const { return m_border_edges_after; }
  std::size_t welded_points() const
  {
    return std::size_t(
      std::count_if(m_border_points.begin(), m_border_points.end(), [&](std::size_t p) { return vertex(p) != p; }));
  }
  std::size_t split_edges() const
  {
    std::size_t number = 0;
    for(std::size_t i = 0; i < m_insertions.size(); ++i)
      if(i == 0 || m_insertions[i].corner != m_insertions[i - 1].corner) ++number;
    return number;
  }
  std::size_t undone_clusters() const
  {
    std::size_t number = m_impossible_clusters;
    for(std::size_t p : m_border_points)
      if(m_size[p] > 1 && m_is_refused[p]) ++number;
    return number;
  }

private:
  // A point that is inserted in a side of a polygon.
  struct Insertion
  {
    std::size_t corner; // number of the corner, among those of active polygons, at which the side begins
    double position;    // along the side, from 0 to 1
    std::size_t point;

    bool operator<(const Insertion& other) const
    {
      return std::tie(corner, position, point) < std::tie(other.corner, other.position, other.point);
    }
  };
  static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();

  // Returns the point that replaces another one.
  std::size_t vertex(std::size_t p) const { return m_is_refused[m_cluster[p]] ? p : m_cluster[p]; }
  bool is_cluster(std::size_t p) const { return m_size[p] > 1 && !m_is_refused[p]; }
  bool is_changed(std::size_t k) const { return m_current[k] != m_polygons[k]; }
  bool is_unchanged() const { return m_current == m_polygons; }

  // Finds the edges with one polygon, and the *active* polygons, which have a point on such an edge.
  void find_border()
  {
    std::vector<std::size_t> invalid; // none: the soup is tidy
    std::vector<std::size_t> border_corners;
    std::vector<char> is_on_border(m_soup.points.size(), 0);
    for_each_edge(edge_uses(m_soup.polygons, m_soup.points.size(), invalid), [&](auto first, auto last) {
      if(last - first > 1) return;
      is_on_border[first->lower] = is_on_border[first->upper] = 1;
      border_corners.push_back(first->first_corner());
    });
    m_border_edges_before = m_border_edges_after = border_corners.size();
    for(std::size_t p = 0; p < is_on_border.size(); ++p)
      if(is_on_border[p]) m_border_points.push_back(p);
    std::sort(border_corners.begin(), border_corners.end());
    m_largest.assign(m_soup.points.size(), m_distance);
    auto next = border_corners.begin();
    for(std::size_t n = 0, corner = 0; n < m_soup.polygons.size(); ++n) {
      const auto& polygon = m_soup.polygons[n];
      if(std::any_of(polygon.begin(), polygon.end(), [&](std::size_t p) { return is_on_border[p]; })) {
        m_active.push_back(n);
        m_polygons.push_back(polygon);
        m_first_corner.push_back(m_is_border_side.size());
        double shortest = std::numeric_limits<double>::infinity();
        for(std::size_t i = 0; i < polygon.size(); ++i) {
          m_is_border_side.push_back(next != border_corners.end() && *next == corner + i);
          if(m_is_border_side.back()) ++next;
          shortest = (std::min)(shortest, length(polygon[i], polygon[(i + 1) % polygon.size()]));
        }
        for(std::size_t p : polygon) m_largest[p] = (std::min)(m_largest[p], reduced(shortest));
      }
      corner += polygon.size();
    }
  }

  double length(std::size_t p, std::size_t q) const
  {
    return std::sqrt(CGAL::squared_distance(m_soup.points[p], m_soup.points[q]));
  }
  double reduced(double edge_length) const
  {
    constexpr double fraction = 1. / 8; // part of an edge: changes are small in relation to facets
    return m_is_reduced ? (std::min)(m_distance, fraction * edge_length) : m_distance;
  }

  // Finds the sets of points that are connected by close pairs. Returns false if there are too many pairs.
  bool find_clusters()
  {
    const auto pairs = find_close_points(m_soup.points, m_border_points, m_distance);
    if(!pairs) return false;
    Disjoint_sets sets(m_soup.points.size());
    for(const auto& [p, q] : *pairs) sets.join(p, q);
    std::vector<std::pair<std::size_t, std::size_t> > members; // root of the set, and point
    for(std::size_t p : m_border_points) members.emplace_back(sets.root(p), p);
    std::sort(members.begin(), members.end());
    for(auto first = members.begin(), last = first; first != members.end(); first = last) {
      double largest = m_distance;
      for(; last != members.end() && last->first == first->first; ++last)
        largest = (std::min)(largest, m_largest[last->second]);
      if(last - first == 1) continue;
      if(!has_diameter(first, last, largest)) {
        ++m_impossible_clusters;
        continue;
      }
      m_size[first->second] = std::size_t(last - first);
      m_largest[first->second] = largest;
      for(auto member = first; member != last; ++member) m_cluster[member->second] = first->second;
    }
    // No two points of a cluster may belong to one polygon.
    std::vector<std::size_t> clusters;
    for(const auto& polygon : m_polygons) {
      clusters.clear();
      for(std::size_t p : polygon) clusters.push_back(m_cluster[p]);
      std::sort(clusters.begin(), clusters.end());
      for(auto c = clusters.begin(); (c = std::adjacent_find(c, clusters.end())) != clusters.end(); ++c)
        m_is_refused[*c] = 1;
    }
    return true;
  }

  // Returns whether no two points are farther apart than `largest`.
  template <typename Iterator>
  bool has_diameter(Iterator first, Iterator last, double largest) const
  {
    constexpr std::ptrdiff_t most = 256; // all pairs are compared; few vertices have as many facets
    if(last - first > most) return false;
    for(auto p = first; p != last; ++p)
      for(auto q = first; q != p; ++q)
        if(length(p->second, q->second) > largest) return false;
    return true;
  }

  // Makes all changes that are not refused. Returns false if there are too many candidates.
  bool make_changes()
  {
    m_current = m_polygons;
    for(auto& polygon : m_current)
      for(std::size_t& p : polygon) p = vertex(p);
    if(!find_insertions()) return false;
    m_raw_corner.clear();
    m_is_inserted.clear();
    auto next = m_insertions.begin();
    std::vector<std::size_t> with_insertions;
    for(std::size_t k = 0; k < m_current.size(); ++k) {
      with_insertions.clear();
      for(std::size_t i = 0; i < m_current[k].size(); ++i) {
        const std::size_t corner = m_first_corner[k] + i;
        const auto add = [&](std::size_t p, bool is_inserted) {
          with_insertions.push_back(p);
          m_raw_corner.push_back(corner);
          m_is_inserted.push_back(is_inserted);
        };
        add(m_current[k][i], false);
        for(; next != m_insertions.end() && next->corner == corner; ++next) add(next->point, true);
      }
      if(with_insertions.size() > m_current[k].size()) m_current[k] = with_insertions;
    }
    return true;
  }

  // Finds the border vertices that are close to a border edge.
  bool find_insertions()
  {
    m_insertions.clear();
    std::vector<std::pair<std::size_t, std::size_t> > sides;
    std::vector<std::size_t> corners, polygons, vertices, invalid;
    for_each_edge(edge_uses(m_current, m_soup.points.size(), invalid), [&](auto first, auto last) {
      if(last - first > 1 || !m_is_border_side[first->first_corner()]) return;
      sides.push_back(first->is_forward ? std::make_pair(first->lower, first->upper)
                                        : std::make_pair(first->upper, first->lower));
      corners.push_back(first->first_corner());
      polygons.push_back(first->polygon);
      vertices.push_back(first->lower);
      vertices.push_back(first->upper);
    });
    if(sides.empty()) return true;
    sort_unique(vertices);
    const auto pairs = find_points_close_to_segments(m_soup.points, vertices, sides, m_distance);
    if(!pairs) return false;
    std::set<std::pair<std::size_t, std::size_t> > inserted; // polygon, point
    for(const auto& [s, p] : *pairs) {
      const auto& polygon = m_current[polygons[s]];
      if(std::find(polygon.begin(), polygon.end(), p) != polygon.end()) continue;
      const std::optional<double> position = position_on_side(sides[s], p);
      if(position && m_refused_insertions.count({ corners[s], p }) == 0 && inserted.insert({ polygons[s], p }).second)
        m_insertions.push_back({ corners[s], *position, p });
    }
    std::sort(m_insertions.begin(), m_insertions.end());
    return true;
  }

  // Returns the position of the projection of a point to a side; nothing unless the point is close to the side, but not
  // to its ends.
  std::optional<double> position_on_side(const std::pair<std::size_t, std::size_t>& side, std::size_t p) const
  {
    const auto& source = m_soup.points[side.first];
    const auto along = m_soup.points[side.second] - source, to_point = m_soup.points[p] - source;
    const double squared_length = along.squared_length(), side_length = std::sqrt(squared_length);
    const double largest = (std::min)(m_largest[p], reduced(side_length));
    const double position = (to_point * along) / squared_length;
    const bool is_close = CGAL::cross_product(along, to_point).squared_length() <= largest * largest * squared_length;
    const bool is_inside = (std::min)(position, 1 - position) * side_length > largest;
    return is_close && is_inside ? std::optional<double>(position) : std::nullopt;
  }

  void refuse_cluster(std::size_t p)
  {
    if(!is_cluster(p)) return;
    m_is_refused[p] = 1;
    m_has_refused = true;
  }
  void refuse_insertion(std::size_t corner, std::size_t point)
  {
    m_refused_insertions.insert({ corner, point });
    m_has_refused = true;
  }
  // Refuses the changes of a polygon.
  void refuse_changes(std::size_t k)
  {
    for(std::size_t p : m_polygons[k])
      if(vertex(p) != p) refuse_cluster(vertex(p));
    for(std::size_t corner = m_first_corner[k]; corner < m_first_corner[k] + m_polygons[k].size(); ++corner)
      for(std::size_t p : points_on_side(corner)) refuse_insertion(corner, p);
  }

  std::vector<std::size_t> points_on_side(std::size_t corner) const
  {
    std::vector<std::size_t> points;
    for(auto i = std::lower_bound(m_insertions.begin(), m_insertions.end(), Insertion{ corner, 0, 0 });
        i != m_insertions.end() && i->corner == corner; ++i)
      points.push_back(i->point);
    return points;
  }

  // Checks edges, vertices and corners of polygons. Returns whether all changes are allowed.
  bool check_topology()
  {
    m_has_refused = false;
    std::vector<std::size_t> invalid;
    std::vector<std::size_t> vertex_of; // by number of corners
    for(const auto& polygon : m_current) vertex_of.insert(vertex_of.end(), polygon.begin(), polygon.end());
    Disjoint_sets fans(vertex_of.size());
    m_border_edges_after = 0;
    for_each_edge(edge_uses(m_current, m_soup.points.size(), invalid), [&](auto first, auto last) {
      const bool has_border_side = std::any_of(
        first, last, [&](const Edge_use& use) { return m_is_border_side[m_raw_corner[use.first_corner()]]; });
      if(has_border_side && last - first == 1) ++m_border_edges_after;
      if(has_border_side && last - first > 1 && (last - first > 2 || first->is_forward == (first + 1)->is_forward))
        refuse_edge(first, last, vertex_of);
      for(auto use = first; use != last; ++use) {
        fans.join(first->lower_corner, use->lower_corner);
        fans.join(first->upper_corner, use->upper_corner);
      }
    });
    std::vector<std::size_t> number_of_fans(m_soup.points.size(), 0);
    for(std::size_t c = 0; c < vertex_of.size(); ++c)
      if(fans.root(c) == c) ++number_of_fans[vertex_of[c]];
    // If all polygons of a cluster or of an inserted point are one fan, this closes a border edge between them.
    for(std::size_t c = 0; c < vertex_of.size(); ++c)
      if(m_is_inserted[c] && number_of_fans[vertex_of[c]] != 1) refuse_insertion(m_raw_corner[c], vertex_of[c]);
    if(!m_has_refused) // insertions may be the reason
      for(std::size_t p : m_border_points)
        if(number_of_fans[p] > 1) refuse_cluster(p);
    if(!m_has_refused) check_doubles();
    return !m_has_refused;
  }

  // Refuses changes that make an edge with too many polygons or with polygons of equal orientation. If points were
  // inserted, they are the reason.
  template <typename Iterator>
  void refuse_edge(Iterator first, Iterator last, const std::vector<std::size_t>& vertex_of)
  {
    bool has_insertion = false;
    for(auto use = first; use != last; ++use)
      for(std::size_t c : { use->lower_corner, use->upper_corner })
        if(m_is_inserted[c]) {
          refuse_insertion(m_raw_corner[c], vertex_of[c]);
          has_insertion = true;
        }
    if(has_insertion) return;
    refuse_cluster(first->lower);
    refuse_cluster(first->upper);
  }

  // Refuses changes that give two polygons the same corners.
  void check_doubles()
  {
    std::unordered_map<std::vector<std::size_t>, std::size_t, boost::hash<std::vector<std::size_t> > > known;
    known.reserve(m_current.size());
    for(std::size_t k = 0; k < m_current.size(); ++k) {
      const auto [other, is_new] = known.emplace(canonical_cycle(m_current[k]), k);
      if(is_new) continue;
      refuse_changes(k);
      refuse_changes(other->second);
    }
  }

  // Returns the triangles of a polygon of the soup, as positions of their corners in the polygon.
  std::vector<Triangle> triangles(const std::vector<std::size_t>& polygon) const
  {
    if(polygon.size() == 3) return { { 0, 1, 2 } };
    Polygon_soup::Points corners;
    for(std::size_t p : polygon) corners.push_back(m_soup.points[p]);
    return triangulate_polygon(corners);
  }
  bool is_degenerate(const Triangle& t) const
  {
    return CGAL::collinear(m_soup.points[t[0]], m_soup.points[t[1]], m_soup.points[t[2]]);
  }

  // Calls f(piece, triangle) for the triangles of a changed polygon, each with the triangle in the soup from which it
  // was made.
  template <typename Function>
  void for_each_piece(std::size_t k, const Function& f) const
  {
    const auto& polygon = m_polygons[k];
    for(const Triangle& t : triangles(polygon)) {
      Triangle before, after;
      std::array<std::vector<std::size_t>, 3> on_side;
      for(std::size_t i = 0; i < 3; ++i) {
        before[i] = polygon[t[i]];
        after[i] = vertex(before[i]);
        if(t[(i + 1) % 3] == (t[i] + 1) % polygon.size()) on_side[i] = points_on_side(m_first_corner[k] + t[i]);
      }
      split_triangle(after, on_side, [&](const Triangle& piece) { f(piece, before); });
    }
  }

  // Refuses changes that turn the normal of a facet too much.
  bool check_normals()
  {
    m_has_refused = false;
    for(std::size_t k = 0; k < m_current.size(); ++k) {
      if(k % 1024 == 0) Run::poll();
      if(!is_changed(k)) continue;
      bool is_allowed = true;
      for_each_piece(k, [&](const Triangle& after, const Triangle& before) {
        is_allowed = is_allowed && (is_degenerate(before) || (!is_degenerate(after) && !turns(before, after)));
      });
      if(!is_allowed) refuse_changes(k);
    }
    return !m_has_refused;
  }
  bool turns(const Triangle& before, const Triangle& after) const
  {
    constexpr double squared_cosine = 0.969846310392954; // squared cosine of 10 degrees
    const auto normal = [&](const Triangle& t) {
      return facet_normal(m_soup.points[t[0]], m_soup.points[t[1]], m_soup.points[t[2]]).direction;
    };
    const auto m = normal(before), n = normal(after);
    const auto dot = [](const auto& u, const auto& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
    return !(dot(m, n) > 0 && dot(m, n) * dot(m, n) > squared_cosine * dot(m, m) * dot(n, n));
  }

  // Refuses changes after which polygons intersect that do not intersect in the soup.
  bool check_intersections()
  {
    struct Facet
    {
      Triangle corners;
      std::size_t polygon;
      std::size_t active; // its number among active polygons; `none` if it is not active
      bool is_tested;
    };
    m_has_refused = false;
    std::vector<Facet> facets;
    for(std::size_t n = 0, k = 0; n < m_soup.polygons.size(); ++n) {
      const bool is_active = k < m_active.size() && m_active[k] == n;
      const bool is_tested = is_active && m_current[k] != m_tested[k];
      const auto add = [&](const Triangle& t) {
        if(!is_degenerate(t)) facets.push_back({ t, n, is_active ? k : none, is_tested });
      };
      if(is_active && is_changed(k)) for_each_piece(k, [&](const Triangle& after, const Triangle&) { add(after); });
      else
        for(const Triangle& t : triangles(m_soup.polygons[n])) add(corners_at(m_soup.polygons[n], t));
      if(is_active) ++k;
    }
    std::vector<Numbered_box> tested, all;
    for(std::size_t f = 0; f < facets.size(); ++f) {
      Bbox_3 box;
      for(std::size_t p : facets[f].corners) box += m_soup.points[p].bbox();
      all.emplace_back(box, f);
      if(facets[f].is_tested) tested.emplace_back(box, f);
    }
    std::size_t number = 0;
    CGAL::box_intersection_d<Sequential_tag>(
      tested.begin(), tested.end(), all.begin(), all.end(), [&](const Numbered_box& a, const Numbered_box& b) {
        if(++number % 1024 == 0) Run::poll();
        const Facet &f = facets[a.info()], &g = facets[b.info()];
        if(f.polygon == g.polygon || (g.is_tested && g.polygon < f.polygon)) return;
        if(!triangles_overlap(f.corners, g.corners, m_soup.points) || overlap_in_soup(f.polygon, g.polygon)) return;
        refuse_changes(f.active);
        if(g.active != none) refuse_changes(g.active);
      });
    m_tested = m_current;
    return !m_has_refused;
  }
  bool overlap_in_soup(std::size_t m, std::size_t n) const
  {
    for(const Triangle& t : triangles(m_soup.polygons[m]))
      for(const Triangle& u : triangles(m_soup.polygons[n])) {
        const Triangle a = corners_at(m_soup.polygons[m], t), b = corners_at(m_soup.polygons[n], u);
        if(!is_degenerate(a) && !is_degenerate(b) && triangles_overlap(a, b, m_soup.points)) return true;
      }
    return false;
  }
  static Triangle corners_at(const std::vector<std::size_t>& polygon, const Triangle& positions)
  {
    return { polygon[positions[0]], polygon[positions[1]], polygon[positions[2]] };
  }

  const Polygon_soup& m_soup;
  double m_distance;
  bool m_is_reduced;

  std::vector<std::size_t> m_border_points;
  std::size_t m_border_edges_before = 0, m_border_edges_after = 0;
  std::vector<double> m_largest; // largest distances that are bridged at points

  std::vector<std::size_t> m_active;       // numbers of active polygons in the soup
  Polygons m_polygons;                     // active polygons
  std::vector<std::size_t> m_first_corner; // numbers of their first corners
  std::vector<char> m_is_border_side;      // whether the side that begins at a corner is on the border

  std::vector<std::size_t> m_cluster; // first points of the clusters of points
  std::vector<std::size_t> m_size;    // numbers of points of clusters, by first point
  std::vector<char> m_is_refused;     // whether clusters are refused, by first point
  std::size_t m_impossible_clusters = 0;
  std::set<std::pair<std::size_t, std::size_t> > m_refused_insertions; // corner and point
  bool m_has_refused = false;

  // The changes of a round, the active polygons after them, and the last ones that were tested for intersections.
  std::vector<Insertion> m_insertions;
  Polygons m_current, m_tested;
  // For each corner of `m_current`, the corner in `m_polygons` at which its side begins, and whether it was inserted.
  std::vector<std::size_t> m_raw_corner;
  std::vector<char> m_is_inserted;
};

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Welded_soup weld_soup(const Polygon_soup& soup, const Weld_parameters& parameters)
{
  constexpr double units = 4;           // each of two points may be off by two units
  constexpr double fraction = 1. / 100; // part of the thickness: the shell must separate parts that are not welded
  Welded_soup result;
  Polygon_soup tidy = soup;
  Soup_repairs repairs;
  const internal::Tidy_origins origin = internal::tidy_polygons(tidy, repairs);
  Weld_report& report = result.report;
  report.unit = coordinate_unit(tidy.points);
  Bbox_3 box;
  for(const auto& p : tidy.points) box += p.bbox();
  const double box_size = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  const double thickness = parameters.thickness.value_or(parameters.relative_thickness * box_size);
  const double usual = (std::min)(units * report.unit, fraction * thickness);
  report.tolerance = (std::max)(0., parameters.tolerance.value_or(usual));
  report.is_too_coarse = !parameters.tolerance && usual < report.unit;

  internal::Soup_welder welder(tidy, report.tolerance, !parameters.tolerance);
  const bool is_changed = !report.is_too_coarse && welder.weld();
  report.border_edges_before = report.border_edges_after = welder.border_edges_before();
  report.undone_clusters = welder.undone_clusters();
  if(!is_changed) {
    result.soup = soup;
    result.provenance.polygon_of.resize(soup.polygons.size());
    std::iota(result.provenance.polygon_of.begin(), result.provenance.polygon_of.end(), std::size_t(0));
    result.provenance.change.assign(soup.polygons.size(), Weld_change::NONE);
    return result;
  }
  report.border_edges_after = welder.border_edges_after();
  report.welded_points = welder.welded_points();
  report.split_edges = welder.split_edges();
  result.soup.points = soup.points;
  welder.for_each_polygon([&](std::vector<std::size_t> polygon, std::size_t number, Weld_change change) {
    for(std::size_t& p : polygon) p = origin.point_of[p];
    result.soup.polygons.push_back(std::move(polygon));
    result.provenance.polygon_of.push_back(origin.polygon_of[number]);
    result.provenance.change.push_back(change);
  });
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_IMPL_H
