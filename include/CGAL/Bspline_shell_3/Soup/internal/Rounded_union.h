// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_ROUNDED_UNION_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_ROUNDED_UNION_H

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>
#include <CGAL/Bspline_shell_3/Soup/United_mesh.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Soup/internal/exact_union.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Rounds an exact union to doubles, joins it with the other solids, and finds the origins of its facets.
class Rounded_union
{
  typedef United_mesh::Mesh Mesh;
  typedef United_mesh::Barycentric Barycentric;
  typedef Mesh::Face_index Face_index;
  typedef Mesh::Vertex_index Vertex_index;
  typedef Mesh::Halfedge_index Halfedge_index;
  typedef Mesh::Point Point_3;
  typedef std::array<std::size_t, 3> Triangle;
  typedef Exact_kernel::FT::ET ET;
  typedef std::array<ET, 3> Exact_point;

public:
  Rounded_union(const Mesh& mesh, const Solids& solids, const Exact_mesh& exact, United_mesh& united)
    : m_input(mesh), m_solids(solids), m_exact(exact), m_united(united), m_size(mesh.num_vertices())
  {
    m_united = United_mesh();
    for(Face_index f : mesh.faces()) m_sources.push_back(corners_of(f, mesh));
  }

  // Returns the status, and the sources of the facets that cause a failure.
  template <typename ConcurrencyTag>
  std::pair<Unite_status, std::vector<std::size_t> > compute()
  {
    collect_facets();
    if(!build_mesh() || !CGAL::is_closed(m_united.mesh)) return { Unite_status::NOT_COMPUTED, {} };
    locate_corners();
    flip_bad_facets();
    // A facet is degenerate, or two facets intersect, if points are equal.
    std::vector<std::size_t> bad = sources_of_facets(
      [&](Face_index f) { return Polygon_mesh_processing::is_degenerate_triangle_face(f, m_united.mesh); });
    if(bad.empty() && m_solids.number_of_colors > 0) bad = intersecting_sources<ConcurrencyTag>();
    if(bad.empty()) bad = sources_of_facets([&](Face_index f) { return !faces_like_source(f); });
    if(!bad.empty()) return { Unite_status::ROUNDED_BADLY, std::move(bad) };
    write_corners();
    return { Unite_status::UNITED, {} };
  }

private:
  struct Facet
  {
    std::size_t source;
    Triangle corners; // vertices of the user's mesh, followed by those of the exact union
  };

  static Triangle corners_of(Face_index f, const Mesh& mesh)
  {
    const Halfedge_index h = mesh.halfedge(f);
    return { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) };
  }
  const Point_3& input_point(std::size_t v) const { return m_input.point(Vertex_index(Mesh::size_type(v))); }
  const auto& exact_point(std::size_t v) const
  {
    return m_exact.point(Exact_mesh::Vertex_index(Exact_mesh::size_type(v - m_size)));
  }

  // Lists facets in the order of their sources. A vertex of the union at a vertex of the user's mesh becomes the
  // latter.
  void collect_facets()
  {
    std::vector<char> is_used(m_size, 0);
    for(std::size_t f = 0; f < m_sources.size(); ++f) {
      if(m_solids.color[m_solids.solid_of_facet[f]] == Solids::none) m_facets.push_back({ f, m_sources[f] });
      else
        for(std::size_t v : m_sources[f]) is_used[v] = 1;
    }
    std::unordered_map<std::array<double, 3>, std::size_t, Hash_coordinates> input_vertex;
    for(std::size_t v = 0; v < m_size; ++v)
      if(is_used[v]) input_vertex.emplace(rounded_coordinates(input_point(v)), v);
    for(auto v : m_exact.vertices()) {
      Run::poll();
      const std::array<double, 3> p = rounded_coordinates(m_exact.point(v));
      const auto found = input_vertex.find(p);
      const bool is_in_input = found != input_vertex.end()
                               && m_exact.point(v) == Exact_kernel::Point_3(p[0], p[1], p[2]);
      m_vertex.push_back(is_in_input ? found->second : m_size + std::size_t(v));
      m_rounded.emplace_back(p[0], p[1], p[2]);
    }
    const auto source = *find_property_map<Exact_mesh::Face_index, std::size_t>(m_exact, "f:source");
    for(auto f : m_exact.faces()) {
      Facet facet{ source[f], {} };
      const auto h = m_exact.halfedge(f);
      facet.corners = { m_vertex[m_exact.source(h)], m_vertex[m_exact.target(h)],
                        m_vertex[m_exact.target(m_exact.next(h))] };
      if(!m_solids.faces_outwards) std::swap(facet.corners[1], facet.corners[2]);
      Triangle& t = facet.corners;
      const auto first = std::find(t.begin(), t.end(), m_sources[facet.source][0]);
      if(first != t.end()) std::rotate(t.begin(), first, t.end());
      m_facets.push_back(facet);
    }
    std::stable_sort(m_facets.begin(), m_facets.end(),
                     [](const Facet& f, const Facet& g) { return f.source < g.source; });
  }

  // Returns false if facets do not form a manifold.
  bool build_mesh()
  {
    std::vector<Vertex_index> number(m_size + m_vertex.size());
    for(const Facet& f : m_facets)
      for(std::size_t v : f.corners) number[v] = Vertex_index(0);
    for(std::size_t v = 0; v < number.size(); ++v)
      if(number[v].is_valid()) {
        number[v] = m_united.mesh.add_vertex(v < m_size ? input_point(v) : m_rounded[v - m_size]);
        m_origin.push_back(v);
      }
    for(const Facet& f : m_facets) {
      // The halfedge of the facet leads from its first to its second corner.
      if(m_united.mesh.add_face(number[f.corners[1]], number[f.corners[2]], number[f.corners[0]]) == Mesh::null_face())
        return false;
      m_united.source.push_back(f.source);
    }
    return true;
  }

  // Finds the barycentric coordinates of vertices in sources that are split, and the share of each source that is
  // hidden.
  void locate_corners()
  {
    m_is_split.assign(m_sources.size(), 0);
    m_hidden_share.assign(m_sources.size(), 1);
    for(const Facet& f : m_facets) {
      m_is_split[f.source] = f.corners != m_sources[f.source];
      m_hidden_share[f.source] = m_is_split[f.source] ? 1 : 0;
    }
    std::vector<char> is_cut(m_sources.size(), 0);
    for(Face_index f : m_united.mesh.faces()) {
      Run::poll();
      const std::size_t source = m_united.source[f];
      if(!m_is_split[source]) continue;
      for(Vertex_index v : vertices_of(f)) {
        const auto [at, is_new] = m_location.try_emplace({ source, m_origin[v] });
        if(is_new) at->second = barycentric(m_origin[v], m_sources[source]);
      }
      // The coordinates of each corner have the sum one, up to rounding.
      const United_mesh::Corners c = corners(f);
      m_hidden_share[source] -= CGAL::determinant(c[0][0], c[0][1], c[0][2], c[1][0], c[1][1], c[1][2], c[2][0],
                                                  c[2][1], c[2][2]);
      if(has_side_within_source(f)) is_cut[source] = 1;
    }
    constexpr double least = 1e-16; // 1 - least is less than 1
    for(std::size_t s = 0; s < m_sources.size(); ++s)
      if(m_is_split[s]) m_hidden_share[s] = is_cut[s] ? (std::min)((std::max)(m_hidden_share[s], least), 1 - least) : 0;
  }

  // Returns whether another source begins at an edge that is not along a side of the source. If no facet of a source
  // has such an edge, they cover the source.
  bool has_side_within_source(Face_index f) const
  {
    const United_mesh::Corners c = corners(f);
    Halfedge_index h = m_united.mesh.halfedge(f);
    for(std::size_t i = 0; i < 3; ++i, h = m_united.mesh.next(h)) {
      const Barycentric &p = c[i], &q = c[(i + 1) % 3];
      if(m_united.source[m_united.mesh.face(m_united.mesh.opposite(h))] != m_united.source[f]
         && !((p[0] == 0 && q[0] == 0) || (p[1] == 0 && q[1] == 0) || (p[2] == 0 && q[2] == 0)))
        return true;
    }
    return false;
  }

  std::array<Vertex_index, 3> vertices_of(Face_index f) const
  {
    const Halfedge_index h = m_united.mesh.halfedge(f);
    return { m_united.mesh.source(h), m_united.mesh.target(h), m_united.mesh.target(m_united.mesh.next(h)) };
  }
  United_mesh::Corners corners(Face_index f) const
  {
    United_mesh::Corners result = { Barycentric{ 1, 0, 0 }, Barycentric{ 0, 1, 0 }, Barycentric{ 0, 0, 1 } };
    if(!m_is_split[m_united.source[f]]) return result;
    const auto v = vertices_of(f);
    for(std::size_t i = 0; i < 3; ++i) result[i] = m_location.at({ m_united.source[f], m_origin[v[i]] });
    return result;
  }

  Exact_point exact_coordinates(std::size_t v) const
  {
    if(v < m_size) {
      const Point_3& p = input_point(v);
      return { ET(p.x()), ET(p.y()), ET(p.z()) };
    }
    const auto& p = CGAL::exact(exact_point(v));
    return { p.x(), p.y(), p.z() };
  }

  // Returns exact coordinates, each rounded. On an edge, the coordinates are therefore the same in both facets.
  Barycentric barycentric(std::size_t vertex, const Triangle& source) const
  {
    for(std::size_t i = 0; i < 3; ++i)
      if(source[i] == vertex) return { double(i == 0), double(i == 1), double(i == 2) };
    const std::size_t axis = main_axis(
      facet_normal(input_point(source[0]), input_point(source[1]), input_point(source[2])).direction);
    const std::array<Exact_point, 3> t = { exact_coordinates(source[0]), exact_coordinates(source[1]),
                                           exact_coordinates(source[2]) };
    const Exact_point p = exact_coordinates(vertex);
    const auto area = [axis](const Exact_point& a, const Exact_point& b, const Exact_point& c) {
      const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
      return ET((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
    };
    const ET whole = area(t[0], t[1], t[2]);
    Barycentric b;
    for(std::size_t i = 0; i < 3; ++i) b[i] = rounded(ET(area(p, t[(i + 1) % 3], t[(i + 2) % 3]) / whole));
    return b;
  }

  // Returns whether a facet has the orientation of its source, in barycentric coordinates, and has turned little.
  bool faces_like_source(Face_index f) const
  {
    const Triangle& s = m_sources[m_united.source[f]];
    if(!m_is_split[m_united.source[f]]) return true;
    const auto v = vertices_of(f);
    return is_positive(corners(f))
           && is_turned_little(m_united.mesh.point(v[0]), m_united.mesh.point(v[1]), m_united.mesh.point(v[2]), s);
  }
  static bool is_positive(const United_mesh::Corners& c)
  {
    const auto point = [](const Barycentric& b) { return Point_3(b[0], b[1], b[2]); };
    return CGAL::orientation(Point_3(0, 0, 0), point(c[0]), point(c[1]), point(c[2])) == POSITIVE;
  }
  bool is_turned_little(const Point_3& p, const Point_3& q, const Point_3& r, const Triangle& source) const
  {
    constexpr double least_cosine = 0.985; // 10 degrees: far less than facets of a union turn at an edge
    if(CGAL::collinear(p, q, r)) return false;
    const auto m = facet_normal(p, q, r).direction;
    const auto n = facet_normal(input_point(source[0]), input_point(source[1]), input_point(source[2])).direction;
    return dot(m, n) >= least_cosine * norm(m) * norm(n);
  }

  // Flips the longest edge of facets that are degenerate or turned, if both new facets are better.
  void flip_bad_facets()
  {
    Mesh& mesh = m_united.mesh;
    for(Face_index f : mesh.faces()) {
      if(faces_like_source(f)) continue;
      Halfedge_index h = mesh.halfedge(f);
      const auto length = [&](Halfedge_index e) {
        return CGAL::squared_distance(mesh.point(mesh.source(e)), mesh.point(mesh.target(e)));
      };
      for(Halfedge_index e : mesh.halfedges_around_face(mesh.halfedge(f)))
        if(length(e) > length(h)) h = e;
      const Halfedge_index o = mesh.opposite(h);
      const Face_index g = mesh.face(o);
      if(m_united.source[f] != m_united.source[g]) continue;
      // The facets (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a).
      const Vertex_index a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)),
                         d = mesh.target(mesh.next(o));
      const std::size_t source = m_united.source[f];
      const auto is_good = [&](Vertex_index p, Vertex_index q, Vertex_index r) {
        const auto at = [&](Vertex_index v) { return m_location.at({ source, m_origin[v] }); };
        return is_positive({ at(p), at(q), at(r) })
               && is_turned_little(mesh.point(p), mesh.point(q), mesh.point(r), m_sources[source]);
      };
      if(mesh.halfedge(c, d) == Mesh::null_halfedge() && is_good(c, d, b) && is_good(d, c, a))
        CGAL::Euler::flip_edge(h, mesh);
    }
  }

  template <typename Predicate>
  std::vector<std::size_t> sources_of_facets(const Predicate& is_bad) const
  {
    std::vector<std::size_t> sources;
    for(Face_index f : m_united.mesh.faces()) {
      Run::poll();
      if(is_bad(f)) sources.push_back(m_united.source[f]);
    }
    sort_unique(sources);
    return sources;
  }

  template <typename ConcurrencyTag>
  std::vector<std::size_t> intersecting_sources() const
  {
    constexpr unsigned int max_pairs = 1000;
    std::vector<std::size_t> sources;
    const auto pairs = intersecting_facets<ConcurrencyTag>(m_united.mesh, embedded_fans<ConcurrencyTag>(m_united.mesh),
                                                           max_pairs);
    for(const auto& [f, g] : pairs) sources.insert(sources.end(), { m_united.source[f], m_united.source[g] });
    sort_unique(sources);
    return sources;
  }

  void write_corners()
  {
    for(Face_index f : m_united.mesh.faces()) m_united.corners.push_back(corners(f));
    m_united.hidden_share = std::move(m_hidden_share);
    m_united.coplanar_pairs = m_solids.coplanar_pairs;
  }

  const Mesh& m_input;
  const Solids& m_solids;
  const Exact_mesh& m_exact;
  United_mesh& m_united;
  std::size_t m_size;              // number of vertices of the user's mesh
  std::vector<Triangle> m_sources; // facets of the user's mesh
  std::vector<Facet> m_facets;
  std::vector<std::size_t> m_vertex;  // by vertex of the exact union: its number in m_facets
  std::vector<Point_3> m_rounded;     // by vertex of the exact union
  std::vector<std::size_t> m_origin;  // by vertex of the result: its number in m_facets
  std::vector<char> m_is_split;       // by facet of the user's mesh: whether parts of it are in the result
  std::vector<double> m_hidden_share; // by facet of the user's mesh
  std::map<std::pair<std::size_t, std::size_t>, Barycentric> m_location; // by source and number of a vertex
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_ROUNDED_UNION_H
