// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_LEVEL_SET_SOUP_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_LEVEL_SET_SOUP_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>
#include <CGAL/Bspline_shell_3/Surface/Level_set_status.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Soup_components.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Tetrahedral_subdivision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Marching tetrahedra. Leaves that the level set is proved to miss are skipped. The topology depends only on the signs
// of the nodes. A sign depends on the node, not on the leaf that evaluates it; a node on the level counts as above. The
// triangles of each tetrahedron thus fit those of its neighbors, and the surface is a closed manifold unless a
// tetrahedron has no neighbor. Vertices lie on edges. An edge is owned by the first selected leaf around it, which
// numbers its edges consecutively. Other leaves find a vertex by the owner and the edge in it.
//
// `Cells` is `Field_cells` or `Shell_cells`.
template <typename Cells>
class Level_set_soup
{
  typedef typename Cells::Index Index;
  typedef Tetrahedral_subdivision<typename Cells::Hierarchy> Subdivision;
  typedef typename Subdivision::Surroundings Surroundings;
  typedef typename Subdivision::Node Node;
  typedef typename Subdivision::Node_in_space Node_in_space;
  typedef std::uint64_t Edge; // two nodes of a leaf

public:
  typedef std::array<double, 3> Point;
  typedef std::array<std::size_t, 3> Triangle;

  template <typename ConcurrencyTag, typename Cell_filter>
  static Level_set_status extract(const Cells& cells, int n, Cell_filter& filter, bool skip_open,
                                  std::vector<Point>& points, std::vector<Triangle>& triangles)
  {
    Level_set_soup soup(cells, n);
    soup.template find_candidates<ConcurrencyTag>(filter);
    const bool leaves = soup.template find_vertices<ConcurrencyTag>();
    if(leaves && !skip_open) return Level_set_status::LEVEL_SET_LEAVES_CELLS;
    if(soup.m_edges.empty()) return Level_set_status::LEVEL_SET_EMPTY;
    soup.template place_vertices<ConcurrencyTag>(points);
    triangles = soup.template make_triangles<ConcurrencyTag>();
    if(leaves) Soup_components(points.size(), triangles).remove_open(points, triangles);
    return triangles.empty() ? Level_set_status::LEVEL_SET_LEAVES_CELLS : Level_set_status::SUCCESS;
  }

private:
  // The state of a leaf is its index among the candidates, which are the selected leaves that the level set may
  // intersect, or one of these constants. A leaf that is `above` (`below`) is proved to be entirely so.
  static constexpr Index above = Cells::npos, below = Cells::npos - 1, not_selected = Cells::npos - 2;
  static constexpr std::size_t chunk = 256;

  Level_set_soup(const Cells& cells, int n) : m_cells(cells), m_subdivision(cells.hierarchy(), n), m_last(2 * n) {}

  static bool is_candidate(Index state) { return state < not_selected; }

  // Returns the field minus the threshold on a leaf.
  Enclosed_tricubic function(Index c) const { return m_cells.function(c); }
  Tricubic_cell_3 cell(Index c, const Enclosed_tricubic& f) const
  {
    return Tricubic_cell_3(m_cells.corner(c), m_cells.width(c), f.coefficients.data(), f.radius);
  }

  template <typename ConcurrencyTag, typename Cell_filter>
  void find_candidates(Cell_filter& filter)
  {
    m_state.assign(m_cells.number_of_cells(), not_selected);
    for_each_chunk<ConcurrencyTag>(m_state.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c) {
        if(!m_cells.is_leaf(Index(c))) continue;
        const Level_range range = function(Index(c)).range();
        m_state[c] = range.min > 0 ? above : range.max < 0 ? below : not_selected;
      }
    });
    for(Index c = 0; c < m_state.size(); ++c)
      if(m_state[c] == not_selected && m_cells.is_leaf(c) && filter(c)) {
        m_state[c] = Index(m_candidates.size());
        m_candidates.push_back(c);
      }
  }

  // The polynomials on the two sides of a face differ in their last bits, and one of them may contradict the proof for
  // the other leaf. The sign is therefore that of the first leaf around the node with a proof or, if there is none,
  // that of the value in the first leaf.
  bool is_above(Index c, const Enclosed_tricubic& f, const Node& v) const
  {
    if(std::all_of(v.begin(), v.end(), [&](int i) { return i > 0 && i < m_last; }))
      return !(cell(c, f).value(position(c, v)) < 0);
    const Node_in_space at = m_subdivision.in_space(c, v);
    Index proved = not_selected, first = Cells::npos;
    m_subdivision.visit_leaves_around(at, at, [&](Index n) {
      if(m_state[n] == above || m_state[n] == below) {
        proved = m_state[n];
        return true;
      }
      if(first == Cells::npos) first = n;
      return false;
    });
    if(proved != not_selected) return proved == above;
    return !(cell(first, first == c ? f : function(first)).value(position(first, m_subdivision.in_leaf(first, at)))
             < 0);
  }

  bool is_above(std::size_t candidate, const Node& v) const
  {
    return m_is_above[candidate * m_subdivision.number_of_nodes() + m_subdivision.number(v)] != 0;
  }

  Edge edge(const Node& v, const Node& w) const
  {
    const auto numbers = std::minmax({ m_subdivision.number(v), m_subdivision.number(w) });
    return Edge(numbers.first) * m_subdivision.number_of_nodes() + numbers.second;
  }
  std::array<Node, 2> nodes(Edge e) const
  {
    return { m_subdivision.node(std::size_t(e / m_subdivision.number_of_nodes())),
             m_subdivision.node(std::size_t(e % m_subdivision.number_of_nodes())) };
  }

  // Returns the candidate that owns an edge of a candidate, and the edge in it.
  std::pair<Index, Edge> owner(std::size_t candidate, Edge e) const
  {
    const Index c = m_candidates[candidate];
    const std::array<Node, 2> vw = nodes(e);
    const Node_in_space v = m_subdivision.in_space(c, vw[0]), w = m_subdivision.in_space(c, vw[1]);
    std::pair<Index, Edge> result;
    m_subdivision.visit_leaves_around(v, w, [&](Index n) {
      if(!is_candidate(m_state[n])) return false;
      result = { m_state[n], n == c ? e : edge(m_subdivision.in_leaf(n, v), m_subdivision.in_leaf(n, w)) };
      return true;
    });
    return result;
  }

  // Returns the edges of a candidate with a vertex, ascending.
  std::vector<Edge> cut_edges(std::size_t candidate, const Surroundings& surroundings) const
  {
    std::vector<Edge> edges;
    m_subdivision.visit_tetrahedra(surroundings, [&](const std::array<Node, 4>& corners, int, bool) {
      for(int i = 0; i < 4; ++i)
        for(int j = 0; j < i; ++j)
          if(is_above(candidate, corners[i]) != is_above(candidate, corners[j]))
            edges.push_back(edge(corners[i], corners[j]));
    });
    sort_unique(edges);
    return edges;
  }

  // Finds signs and the edges with a vertex. Returns whether the level set leaves the selected leaves.
  template <typename ConcurrencyTag>
  bool find_vertices()
  {
    const std::size_t size = m_candidates.size(), nodes = m_subdivision.number_of_nodes();
    std::vector<char> leaves((size + chunk - 1) / chunk, 0);
    m_is_above.resize(size * nodes);
    m_first_edge.assign(size + 1, 0);
    m_edges = collect_from_chunks<ConcurrencyTag, Edge>(
      size, chunk, [&](std::size_t begin, std::size_t end, std::vector<Edge>& own) {
        for(std::size_t n = begin; n < end; ++n) {
          const Index c = m_candidates[n];
          const Surroundings surroundings(m_subdivision, c);
          const Enclosed_tricubic f = function(c);
          char* const signs = &m_is_above[n * nodes];
          std::fill(signs, signs + nodes, char(is_above(c, f, Node{ 0, 0, 0 })));
          m_subdivision.visit_nodes(surroundings,
                                    [&](const Node& v) { signs[m_subdivision.number(v)] = is_above(c, f, v); });
          if(!is_cut(n)) continue;
          const std::size_t before = own.size();
          for(Edge e : cut_edges(n, surroundings))
            if(owner(n, e).first == n) own.push_back(e);
          m_first_edge[n + 1] = own.size() - before;
          if(leaves_at_a_face(n, surroundings)) leaves[begin / chunk] = 1;
        }
      });
    for(std::size_t n = 0; n < size; ++n) m_first_edge[n + 1] += m_first_edge[n];
    return std::find(leaves.begin(), leaves.end(), 1) != leaves.end();
  }

  bool is_cut(std::size_t candidate) const
  {
    const auto begin = m_is_above.begin() + std::ptrdiff_t(candidate * m_subdivision.number_of_nodes());
    const auto end = begin + std::ptrdiff_t(m_subdivision.number_of_nodes());
    return std::find(begin, end, char(*begin == 0)) != end;
  }

  // Returns whether a triangle on a face of the leaf is cut (its nodes have both signs) and has no candidate behind it.
  bool leaves_at_a_face(std::size_t candidate, const Surroundings& surroundings) const
  {
    bool leaves = false;
    m_subdivision.visit_tetrahedra(surroundings, [&](const std::array<Node, 4>& corners, int axis, bool positive) {
      if(corners[1][axis] != (positive ? m_last : 0)) return;
      const bool sign = is_above(candidate, corners[1]);
      if(is_above(candidate, corners[2]) == sign && is_above(candidate, corners[3]) == sign) return;
      const Index c = m_candidates[candidate];
      const Index behind = m_subdivision.leaf_behind(m_subdivision.in_space(c, corners[1]),
                                                     m_subdivision.in_space(c, corners[2]),
                                                     m_subdivision.in_space(c, corners[3]), axis, positive);
      leaves = leaves || behind == Cells::npos || !is_candidate(m_state[behind]);
    });
    return leaves;
  }

  template <typename ConcurrencyTag>
  void place_vertices(std::vector<Point>& points) const
  {
    points.resize(m_edges.size());
    for_each_chunk<ConcurrencyTag>(m_candidates.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        if(m_first_edge[n] == m_first_edge[n + 1]) continue;
        const Enclosed_tricubic f = function(m_candidates[n]);
        for(std::size_t e = m_first_edge[n]; e < m_first_edge[n + 1]; ++e) points[e] = vertex(n, f, m_edges[e]);
      }
    });
  }

  Point vertex(std::size_t candidate, const Enclosed_tricubic& f, Edge e) const
  {
    const Index c = m_candidates[candidate];
    const Tricubic_cell_3 cell = this->cell(c, f);
    const std::array<Node, 2> ends = nodes(e);
    const Point p = position(c, ends[0]), q = position(c, ends[1]);
    const auto at = [&](double t) {
      return Point{ p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2]) };
    };
    const double t = root([&](double t) { return cell.value(at(t)); }, is_above(candidate, ends[0]), f.radius);
    // At the ends of edges, the vertices of many edges would coincide. A distance of about a thousand roundings of the
    // coordinates keeps all points apart and prevents triangles from collapsing, even after rounding of the points.
    double reach = 0, length = 0;
    for(int a = 0; a < 3; ++a) {
      reach = (std::max)({ reach, std::abs(p[a]), std::abs(q[a]) });
      length = (std::max)(length, std::abs(q[a] - p[a]));
    }
    const double margin = (std::min)(0.25, 1024 * std::numeric_limits<double>::epsilon() * reach / length);
    return at((std::min)((std::max)(t, margin), 1 - margin));
  }

  // Returns a zero of f in [0, 1], up to the tolerance on values or to the last bits, by regula falsi (Illinois
  // variant) with some bisections. If an end has the wrong sign or is zero, it is on the level up to rounding, and is
  // returned.
  template <typename Function>
  static double root(const Function& f, bool is_above_at_0, double tolerance)
  {
    constexpr int max_steps = 120;
    double low = is_above_at_0 ? 1 : 0, high = 1 - low, f_low = f(low), f_high = f(high);
    if(!(f_low < 0)) return low;
    if(!(f_high > 0)) return high;
    int last = 0;
    double t = 0.5;
    for(int step = 1; step <= max_steps; ++step) {
      if(!(std::abs(high - low) > 2 * std::numeric_limits<double>::epsilon())) break;
      t = low + (high - low) * (f_low / (f_low - f_high));
      if(step % 4 == 0 || !((std::min)(low, high) < t && t < (std::max)(low, high))) t = low + (high - low) / 2;
      const double f_t = f(t);
      if(std::abs(f_t) <= tolerance) break;
      if(f_t < 0) {
        low = t;
        f_low = f_t;
        if(last < 0) f_high /= 2;
        last = -1;
      } else {
        high = t;
        f_high = f_t;
        if(last > 0) f_low /= 2;
        last = 1;
      }
    }
    return t;
  }

  template <typename ConcurrencyTag>
  std::vector<Triangle> make_triangles() const
  {
    const auto cut = [&](std::size_t begin, std::size_t end, std::vector<Triangle>& found) {
      for(std::size_t n = begin; n < end; ++n) {
        if(!is_cut(n)) continue;
        const Surroundings surroundings(m_subdivision, m_candidates[n]);
        const std::vector<Edge> edges = cut_edges(n, surroundings);
        std::vector<std::size_t> vertices;
        for(Edge e : edges) vertices.push_back(vertex_number(owner(n, e)));
        const auto crossing = [&](const Node& v, const Node& w) {
          return vertices[std::size_t(std::lower_bound(edges.begin(), edges.end(), edge(v, w)) - edges.begin())];
        };
        m_subdivision.visit_tetrahedra(surroundings, [&](const std::array<Node, 4>& corners, int, bool) {
          cut_tetrahedron(n, corners, crossing, found);
        });
      }
    };
    return collect_from_chunks<ConcurrencyTag, Triangle>(m_candidates.size(), chunk, cut);
  }

  template <typename Crossing>
  void cut_tetrahedron(std::size_t candidate, const std::array<Node, 4>& corners, const Crossing& crossing_of,
                       std::vector<Triangle>& triangles) const
  {
    // First the corners below, then those above. Every swap reverses the orientation of the tetrahedron.
    int order[4], below_count = 0, above_count = 0, above_corner[4];
    bool is_direct = true;
    for(int i = 0; i < 4; ++i) {
      if(is_above(candidate, corners[i])) {
        above_corner[above_count++] = i;
      } else {
        order[below_count++] = i;
        if(above_count % 2) is_direct = !is_direct;
      }
    }
    if(below_count == 0 || above_count == 0) return;
    std::copy(above_corner, above_corner + above_count, order + below_count);

    const auto crossing = [&](int i, int j) { return crossing_of(corners[order[i]], corners[order[j]]); };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if(is_direct) triangles.push_back({ a, b, c });
      else triangles.push_back({ a, c, b });
    };
    if(below_count == 1) {
      add(crossing(0, 1), crossing(0, 2), crossing(0, 3));
    } else if(below_count == 3) {
      add(crossing(0, 3), crossing(1, 3), crossing(2, 3));
    } else {
      const std::size_t a = crossing(0, 2), b = crossing(0, 3), c = crossing(1, 3), d = crossing(1, 2);
      add(a, b, c);
      add(a, c, d);
    }
  }

  std::size_t vertex_number(const std::pair<Index, Edge>& owned_edge) const
  {
    const auto begin = m_edges.begin() + std::ptrdiff_t(m_first_edge[owned_edge.first]);
    const auto end = m_edges.begin() + std::ptrdiff_t(m_first_edge[owned_edge.first + 1]);
    return std::size_t(std::lower_bound(begin, end, owned_edge.second) - m_edges.begin());
  }

  Point position(Index c, const Node& v) const
  {
    Point p = m_cells.corner(c);
    for(int a = 0; a < 3; ++a) p[a] += v[a] * m_cells.width(c) / m_last;
    return p;
  }

  const Cells& m_cells;
  const Subdivision m_subdivision;
  const int m_last;                      // largest coordinate of nodes in a leaf
  std::vector<Index> m_state;            // by leaf
  std::vector<Index> m_candidates;       // leaves of the candidates, ascending
  std::vector<char> m_is_above;          // by candidate and node
  std::vector<Edge> m_edges;             // edges with a vertex, by owner and ascending: vertex e is on m_edges[e]
  std::vector<std::size_t> m_first_edge; // by candidate: the first edge that it owns
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_LEVEL_SET_SOUP_H
