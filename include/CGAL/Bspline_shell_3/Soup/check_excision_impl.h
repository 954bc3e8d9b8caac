// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Numbered_complex.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/FPU.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE const char* message(Excision_status status)
{
  switch(status) {
    case Excision_status::VALID: return "The mesh and the excised triangles meet all conditions.";
    case Excision_status::EQUAL_POINTS: return "Two vertices have the same coordinates.";
    case Excision_status::REPEATED_CORNER: return "A triangle has a repeated corner.";
    case Excision_status::REPEATED_TRIANGLE: return "Two triangles have the same corners.";
    case Excision_status::NOT_MANIFOLD:
      return "An edge of the mesh has more than two facets, or a vertex has several fans.";
    case Excision_status::NOT_ORIENTED: return "Two facets of the mesh traverse their edge in the same direction.";
    case Excision_status::DIFFERENT_MESH: return "The facets of the mesh are not the kept triangles.";
    case Excision_status::UNLISTED_PIN:
      return "A vertex or an edge within the mesh belongs to an excised triangle, but is not listed as a pin.";
    case Excision_status::DIFFERENT_BORDER: return "The border of the replacement is not that of the mesh.";
    case Excision_status::MISSING_PIN: return "The replacement does not contain a pinned vertex or edge.";
    case Excision_status::COMMON_FACET: return "A facet of the replacement has the corners of an excised triangle.";
    case Excision_status::COMMON_EDGE:
      return "An edge of the replacement belongs to an excised triangle, although that of the mesh does not.";
    case Excision_status::COMMON_COORDINATES:
      return "A vertex of the replacement has the coordinates of an excised point that is not in the mesh.";
    case Excision_status::MOVED_TIP: return "A truncated vertex belongs to an excised triangle.";
  }
  return "";
}

namespace internal {

// Numbers points such that equal coordinates have equal numbers.
class Point_numbers
{
  typedef Excised_soup_3::Point_3 Point_3;
public:
  explicit Point_numbers(const std::vector<Point_3>& points) : m_points(points), m_sorted(points.size())
  {
    std::iota(m_sorted.begin(), m_sorted.end(), std::size_t(0));
    std::sort(m_sorted.begin(), m_sorted.end(),
              [&](std::size_t v, std::size_t w) { return CGAL::compare_xyz(points[v], points[w]) == SMALLER; });
  }

  // Returns the number of a point with these coordinates, or `none`.
  std::size_t number(const Point_3& p) const
  {
    const auto found = std::lower_bound(m_sorted.begin(), m_sorted.end(), p, [&](std::size_t v, const Point_3& q) {
      return CGAL::compare_xyz(m_points[v], q) == SMALLER;
    });
    return found == m_sorted.end() || m_points[*found] != p ? Excised_soup_3::none : *found;
  }
  // Returns two points with equal coordinates; the same one twice if there are none.
  std::pair<std::size_t, std::size_t> equal_points() const
  {
    for(std::size_t n = 1; n < m_sorted.size(); ++n)
      if(m_points[m_sorted[n]] == m_points[m_sorted[n - 1]]) return { m_sorted[n - 1], m_sorted[n] };
    return { 0, 0 };
  }

private:
  const std::vector<Point_3>& m_points;
  std::vector<std::size_t> m_sorted; // by coordinates
};

// The parts of an excised soup, by numbers of points.
class Excised_parts
{
public:
  typedef Numbered_complex::Facet Facet;
  typedef Numbered_complex::Edge Edge;

  explicit Excised_parts(const Excised_soup_3& soup)
    : m_kept(facets(soup, false)), m_excised(facets(soup, true)), m_border(m_kept.directed_border())
  {
    for(const Edge& e : m_border) m_border_vertices.insert(m_border_vertices.end(), { e.first, e.second });
    sort_unique(m_border_vertices);
  }

  const Numbered_complex& kept() const { return m_kept; } // oriented like the mesh
  const Numbered_complex& excised() const { return m_excised; }
  const std::vector<Edge>& border() const { return m_border; }
  bool is_contact(std::size_t v) const { return m_kept.has_vertex(v) && m_excised.has_vertex(v); }
  bool is_contact(const Edge& e) const
  {
    return m_kept.has_edge(e.first, e.second) && m_excised.has_edge(e.first, e.second);
  }
  bool is_inner(std::size_t v) const
  {
    return !std::binary_search(m_border_vertices.begin(), m_border_vertices.end(), v);
  }
  bool is_inner(const Edge& e) const
  {
    return !std::binary_search(m_border.begin(), m_border.end(), e)
           && !std::binary_search(m_border.begin(), m_border.end(), Edge(e.second, e.first));
  }

private:
  static std::vector<Facet> facets(const Excised_soup_3& soup, bool excised)
  {
    std::vector<Facet> result;
    for(std::size_t t = 0; t < soup.soup().triangles.size(); ++t) {
      if(soup.is_excised(t) != excised) continue;
      Facet facet = soup.soup().triangles[t];
      if(soup.is_reversed(t)) std::swap(facet[0], facet[1]);
      result.push_back(facet);
    }
    return result;
  }

  Numbered_complex m_kept, m_excised;
  std::vector<Edge> m_border; // directed, sorted
  std::vector<std::size_t> m_border_vertices;
};

// Returns whether three numbers are a cyclic permutation of three others.
inline bool is_same_cycle(Numbered_complex::Facet a, const Numbered_complex::Facet& b)
{
  for(int n = 0; n < 3; ++n) {
    if(a == b) return true;
    std::rotate(a.begin(), a.begin() + 1, a.end());
  }
  return false;
}

inline Numbered_complex::Facet corners_of(const Excised_soup_3::Mesh& mesh, Excised_soup_3::Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  return { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) };
}

// Checks an excised soup, condition by condition.
class Excision_check
{
  typedef Excised_soup_3::Mesh Mesh;
  typedef Numbered_complex::Edge Edge;
public:
  explicit Excision_check(const Excised_soup_3& soup) : m_soup(soup) {}

  Excision_verdict run(const std::vector<Mesh::Vertex_index>& truncated)
  {
    if(!check_complex()) return m_verdict;
    const Excised_parts parts(m_soup);
    if(check_manifold(parts.kept()) && check_mesh() && check_pins(parts)) check_tips(parts, truncated);
    return m_verdict;
  }

private:
  bool fail(Excision_status status, std::vector<std::size_t> triangles)
  {
    m_verdict.status = status;
    m_verdict.triangles = std::move(triangles);
    sort_unique(m_verdict.triangles);
    return false;
  }
  // Fails, and lists the triangles that have all of the points.
  bool fail_at(Excision_status status, const std::vector<std::size_t>& points)
  {
    std::vector<std::size_t> triangles;
    for(std::size_t t = 0; t < m_soup.soup().triangles.size(); ++t) {
      const auto& c = m_soup.soup().triangles[t];
      if(std::all_of(points.begin(), points.end(),
                     [&](std::size_t v) { return std::find(c.begin(), c.end(), v) != c.end(); }))
        triangles.push_back(t);
    }
    for(std::size_t v : points)
      if(v < m_soup.soup().points.size() && m_soup.vertex_at(v) != Mesh::null_vertex())
        m_verdict.vertices.push_back(m_soup.vertex_at(v));
    sort_unique(m_verdict.vertices);
    return fail(status, std::move(triangles));
  }

  // All triangles are a simplicial complex: corners are different points, and triangles have different corners.
  bool check_complex()
  {
    const Numbered_complex all(m_soup.soup().triangles);
    if(const auto facet = all.facet_with_repeated_corner()) {
      const auto& triangles = all.facets();
      return fail(Excision_status::REPEATED_CORNER,
                  { std::size_t(std::find(triangles.begin(), triangles.end(), *facet) - triangles.begin()) });
    }
    if(const auto facet = all.repeated_facet())
      return fail_at(Excision_status::REPEATED_TRIANGLE, { facet->begin(), facet->end() });
    const auto [v, w] = Point_numbers(m_soup.soup().points).equal_points();
    return v == w || fail_at(Excision_status::EQUAL_POINTS, { v });
  }

  bool check_manifold(const Numbered_complex& kept)
  {
    if(const auto e = kept.edge_of_several_facets())
      return fail_at(Excision_status::NOT_MANIFOLD, { e->first, e->second });
    if(const auto v = kept.vertex_of_several_fans()) return fail_at(Excision_status::NOT_MANIFOLD, { *v });
    if(const auto e = kept.edge_of_equal_directions())
      return fail_at(Excision_status::NOT_ORIENTED, { e->first, e->second });
    return true;
  }

  // The mesh consists of the kept triangles, bit for bit.
  bool check_mesh()
  {
    const Mesh& mesh = m_soup.mesh();
    std::vector<std::size_t> different;
    std::size_t kept = 0;
    for(std::size_t t = 0; t < m_soup.soup().triangles.size(); ++t) {
      if(m_soup.is_excised(t)) continue;
      ++kept;
      const Mesh::Face_index f = m_soup.facet_of(t);
      if(f == Mesh::null_face() || mesh.is_removed(f) || m_soup.triangle_of(f) != t) {
        different.push_back(t);
        continue;
      }
      Numbered_complex::Facet corners = corners_of(mesh, f), expected = m_soup.soup().triangles[t];
      if(m_soup.is_reversed(t)) std::swap(expected[0], expected[1]);
      bool has_same_points = true;
      for(std::size_t& v : corners) {
        const Mesh::Vertex_index vertex{ Mesh::size_type(v) };
        v = m_soup.point_of(vertex);
        has_same_points = has_same_points && mesh.point(vertex) == m_soup.soup().points[v]
                          && m_soup.vertex_at(v) == vertex;
      }
      if(!has_same_points || !is_same_cycle(corners, expected)) different.push_back(t);
    }
    return (different.empty() && kept == mesh.number_of_faces())
           || fail(Excision_status::DIFFERENT_MESH, std::move(different));
  }

  // Each vertex and edge of the contact is on the border, or a listed pin.
  bool check_pins(const Excised_parts& parts)
  {
    std::vector<std::size_t> vertices;
    std::vector<Edge> edges;
    const Mesh& mesh = m_soup.mesh();
    for(auto v : m_soup.pinned_vertices()) vertices.push_back(m_soup.point_of(v));
    for(auto e : m_soup.pinned_edges())
      edges.push_back(std::minmax(m_soup.point_of(mesh.vertex(e, 0)), m_soup.point_of(mesh.vertex(e, 1))));
    std::sort(vertices.begin(), vertices.end());
    std::sort(edges.begin(), edges.end());
    for(std::size_t v : parts.excised().vertices())
      if(parts.is_contact(v) && parts.is_inner(v) && !std::binary_search(vertices.begin(), vertices.end(), v))
        return fail_at(Excision_status::UNLISTED_PIN, { v });
    for(const Edge& e : parts.excised().edges())
      if(parts.is_contact(e) && parts.is_inner(e) && !std::binary_search(edges.begin(), edges.end(), e))
        return fail_at(Excision_status::UNLISTED_PIN, { e.first, e.second });
    return true;
  }

  bool check_tips(const Excised_parts& parts, const std::vector<Mesh::Vertex_index>& truncated)
  {
    for(auto v : truncated)
      if(parts.is_contact(m_soup.point_of(v))) return fail_at(Excision_status::MOVED_TIP, { m_soup.point_of(v) });
    return true;
  }

  const Excised_soup_3& m_soup;
  Excision_verdict m_verdict;
};

// Checks a mesh that replaces that of an excised soup. Its vertices have the numbers of the points of the soup with
// equal coordinates; all others have further numbers.
class Replacement_check
{
  typedef Excised_soup_3::Mesh Mesh;
  typedef Numbered_complex::Facet Facet;
  typedef Numbered_complex::Edge Edge;
public:
  Replacement_check(const Excised_soup_3& soup, const Mesh& mesh)
    : m_soup(soup), m_mesh(mesh), m_parts(soup), m_size(soup.soup().points.size())
  {}

  Excision_verdict run()
  {
    std::vector<Facet> facets;
    if(!number_vertices() || !number_facets(facets)) return m_verdict;
    const Numbered_complex replacement(std::move(facets));
    if(check_manifold(replacement) && check_border(replacement) && check_pins(replacement)) check_contact(replacement);
    return m_verdict;
  }

private:
  // Fails, and lists the vertices and the excised triangles that have all of these numbers.
  bool fail_at(Excision_status status, const std::vector<std::size_t>& numbers)
  {
    m_verdict.status = status;
    for(std::size_t n : numbers)
      for(std::size_t v = 0; v < m_number.size(); ++v)
        if(m_number[v] == n) m_verdict.vertices.emplace_back(Mesh::size_type(v));
    sort_unique(m_verdict.vertices);
    for(std::size_t t : m_soup.excised_triangles()) {
      const auto& c = m_soup.soup().triangles[t];
      if(std::all_of(numbers.begin(), numbers.end(),
                     [&](std::size_t n) { return std::find(c.begin(), c.end(), n) != c.end(); }))
        m_verdict.triangles.push_back(t);
    }
    return false;
  }

  bool number_vertices()
  {
    const Point_numbers of_soup(m_soup.soup().points);
    std::vector<Mesh::Point> points;
    for(auto v : m_mesh.vertices()) {
      points.push_back(m_mesh.point(v));
      const std::size_t n = of_soup.number(points.back());
      m_number.push_back(n == Excised_soup_3::none ? m_size + std::size_t(v) : n);
    }
    const auto [v, w] = Point_numbers(points).equal_points();
    return v == w || fail_at(Excision_status::EQUAL_POINTS, { m_number[v], m_number[w] });
  }

  bool number_facets(std::vector<Facet>& facets)
  {
    for(auto f : m_mesh.faces()) {
      Facet facet = corners_of(m_mesh, f);
      const auto h = m_mesh.halfedge(f);
      for(std::size_t& v : facet) v = m_number[v];
      if(m_mesh.next(m_mesh.next(m_mesh.next(h))) != h)
        return fail_at(Excision_status::REPEATED_CORNER, { facet.begin(), facet.end() });
      facets.push_back(facet);
    }
    return true;
  }

  bool check_manifold(const Numbered_complex& replacement)
  {
    if(const auto facet = replacement.facet_with_repeated_corner())
      return fail_at(Excision_status::REPEATED_CORNER, { facet->begin(), facet->end() });
    if(const auto facet = replacement.repeated_facet())
      return fail_at(Excision_status::REPEATED_TRIANGLE, { facet->begin(), facet->end() });
    if(const auto e = replacement.edge_of_several_facets())
      return fail_at(Excision_status::NOT_MANIFOLD, { e->first, e->second });
    if(const auto v = replacement.vertex_of_several_fans()) return fail_at(Excision_status::NOT_MANIFOLD, { *v });
    if(const auto e = replacement.edge_of_equal_directions())
      return fail_at(Excision_status::NOT_ORIENTED, { e->first, e->second });
    return true;
  }

  bool check_border(const Numbered_complex& replacement)
  {
    const std::vector<Edge> border = replacement.directed_border();
    if(border == m_parts.border()) return true;
    const auto [there, here] = std::mismatch(m_parts.border().begin(), m_parts.border().end(), border.begin(),
                                             border.end());
    const Edge& e = there != m_parts.border().end() && (here == border.end() || *there < *here) ? *there : *here;
    return fail_at(Excision_status::DIFFERENT_BORDER, { e.first, e.second });
  }

  // Contact on the border is present because the borders are equal.
  bool check_pins(const Numbered_complex& replacement)
  {
    for(std::size_t v : m_parts.excised().vertices())
      if(m_parts.is_contact(v) && !replacement.has_vertex(v)) return fail_at(Excision_status::MISSING_PIN, { v });
    for(const Edge& e : m_parts.excised().edges())
      if(m_parts.is_contact(e) && !replacement.has_edge(e.first, e.second))
        return fail_at(Excision_status::MISSING_PIN, { e.first, e.second });
    return true;
  }

  // The replacement and the excised triangles have nothing in common but the contact. Vertices without facets count.
  bool check_contact(const Numbered_complex& replacement)
  {
    for(const Facet& facet : replacement.facets())
      if(m_parts.excised().has_facet(facet))
        return fail_at(Excision_status::COMMON_FACET, { facet.begin(), facet.end() });
    for(const Edge& e : replacement.edges())
      if(m_parts.excised().has_edge(e.first, e.second) && !m_parts.is_contact(e))
        return fail_at(Excision_status::COMMON_EDGE, { e.first, e.second });
    for(std::size_t n : m_number)
      if(m_parts.excised().has_vertex(n) && !m_parts.is_contact(n))
        return fail_at(Excision_status::COMMON_COORDINATES, { n });
    return true;
  }

  const Excised_soup_3& m_soup;
  const Mesh& m_mesh;
  const Excised_parts m_parts;
  std::size_t m_size;                // number of points of the soup
  std::vector<std::size_t> m_number; // by vertex of the mesh
  Excision_verdict m_verdict;
};

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Excision_verdict
check_excision(const Excised_soup_3& soup, const std::vector<Excised_soup_3::Mesh::Vertex_index>& truncated)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  return internal::Excision_check(soup).run(truncated);
}

CGAL_BSPLINE_SHELL_3_INLINE Excision_verdict check_replacement(const Excised_soup_3& soup,
                                                               const Excised_soup_3::Mesh& mesh)
{
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
  return internal::Replacement_check(soup, mesh).run();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_IMPL_H
