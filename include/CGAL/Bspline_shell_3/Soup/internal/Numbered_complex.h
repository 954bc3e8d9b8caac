// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_NUMBERED_COMPLEX_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_NUMBERED_COMPLEX_H

#include <CGAL/Bspline_shell_3/Support/Disjoint_sets.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Triangles given by numbers of their vertices, as sorted lists of their vertices, edges, and corners. It is used by
// exact checks, and shares no code with the algorithms that they check.
class Numbered_complex
{
public:
  typedef std::array<std::size_t, 3> Facet;
  typedef std::pair<std::size_t, std::size_t> Edge; // ascending, unless it is directed

  explicit Numbered_complex(std::vector<Facet> facets) : m_facets(std::move(facets))
  {
    for(const Facet& facet : m_facets)
      for(std::size_t i = 0; i < 3; ++i) {
        m_vertices.push_back(facet[i]);
        m_edges.push_back(std::minmax(facet[i], facet[(i + 1) % 3]));
        m_directed.emplace_back(facet[i], facet[(i + 1) % 3]);
      }
    for(Facet facet : m_facets) {
      std::sort(facet.begin(), facet.end());
      m_sorted.push_back(facet);
    }
    std::sort(m_sorted.begin(), m_sorted.end());
    std::sort(m_directed.begin(), m_directed.end());
    sort_unique(m_vertices);
    sort_unique(m_edges);
  }

  const std::vector<Facet>& facets() const { return m_facets; }
  const std::vector<std::size_t>& vertices() const { return m_vertices; }
  const std::vector<Edge>& edges() const { return m_edges; }
  bool has_vertex(std::size_t v) const { return std::binary_search(m_vertices.begin(), m_vertices.end(), v); }
  bool has_edge(std::size_t v, std::size_t w) const
  {
    return std::binary_search(m_edges.begin(), m_edges.end(), Edge(std::minmax(v, w)));
  }
  // Returns whether there is a facet with these vertices, in any order.
  bool has_facet(Facet facet) const
  {
    std::sort(facet.begin(), facet.end());
    return std::binary_search(m_sorted.begin(), m_sorted.end(), facet);
  }

  // Returns a facet with equal corners.
  std::optional<Facet> facet_with_repeated_corner() const
  {
    for(const Facet& f : m_facets)
      if(f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return f;
    return std::nullopt;
  }
  std::optional<Facet> repeated_facet() const
  {
    const auto found = std::adjacent_find(m_sorted.begin(), m_sorted.end());
    return found == m_sorted.end() ? std::nullopt : std::make_optional(*found);
  }
  // Returns an edge that several facets traverse in the same direction.
  std::optional<Edge> edge_of_equal_directions() const
  {
    const auto found = std::adjacent_find(m_directed.begin(), m_directed.end());
    return found == m_directed.end() ? std::nullopt : std::make_optional(*found);
  }
  // Returns an edge with more than two facets.
  std::optional<Edge> edge_of_several_facets() const
  {
    for(const Edge& e : m_edges)
      if(uses(e.first, e.second) + uses(e.second, e.first) > 2) return e;
    return std::nullopt;
  }
  // Returns a vertex whose facets are not connected by edges at it.
  std::optional<std::size_t> vertex_of_several_fans() const
  {
    typedef std::pair<std::size_t, std::size_t> Place; // a vertex, and the position of a facet
    std::vector<std::pair<Edge, std::size_t> > edges;  // each edge with the position of a facet
    std::vector<Place> places;
    for(std::size_t f = 0; f < m_facets.size(); ++f)
      for(std::size_t i = 0; i < 3; ++i) {
        edges.emplace_back(std::minmax(m_facets[f][i], m_facets[f][(i + 1) % 3]), f);
        places.emplace_back(m_facets[f][i], f);
      }
    std::sort(edges.begin(), edges.end());
    std::sort(places.begin(), places.end());
    const auto position = [&](std::size_t v, std::size_t f) {
      return std::size_t(std::lower_bound(places.begin(), places.end(), Place(v, f)) - places.begin());
    };
    Disjoint_sets fans(places.size());
    for(std::size_t n = 1; n < edges.size(); ++n) {
      if(edges[n].first != edges[n - 1].first) continue;
      for(std::size_t v : { edges[n].first.first, edges[n].first.second })
        fans.join(position(v, edges[n].second), position(v, edges[n - 1].second));
    }
    for(std::size_t n = 1; n < places.size(); ++n)
      if(places[n].first == places[n - 1].first && fans.root(n) != fans.root(n - 1)) return places[n].first;
    return std::nullopt;
  }
  // Returns the edges of one facet, directed as in this facet, sorted.
  std::vector<Edge> directed_border() const
  {
    std::vector<Edge> border;
    for(const Edge& e : m_directed)
      if(uses(e.second, e.first) == 0) border.push_back(e);
    return border;
  }

private:
  // Returns the number of facets that traverse an edge in this direction.
  std::size_t uses(std::size_t from, std::size_t to) const
  {
    const auto range = std::equal_range(m_directed.begin(), m_directed.end(), Edge(from, to));
    return std::size_t(range.second - range.first);
  }

  std::vector<Facet> m_facets, m_sorted; // m_sorted has sorted facets with sorted vertices
  std::vector<std::size_t> m_vertices;
  std::vector<Edge> m_edges, m_directed;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_NUMBERED_COMPLEX_H
