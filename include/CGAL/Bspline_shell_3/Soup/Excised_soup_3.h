// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Excision_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

struct Excised_soup_access;

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the distinct triangles of a polygon soup. Corners with the same point index are the same vertex.
 */
struct Soup_triangles
{
  typedef std::array<std::size_t, 3> Triangle;

  Polygon_soup::Points points;         ///< distinct points
  std::vector<Triangle> triangles;     ///< three distinct points each; no two triangles have the same three
  std::vector<std::size_t> point_of;   ///< for each point, the first point of the soup at this position
  std::vector<std::size_t> polygon_of; ///< for each triangle, the polygon of the soup that contains it
  /// for each omitted triangle, its polygon, and the earlier triangle with the same corners, which represents it
  std::vector<std::pair<std::size_t, std::size_t> > duplicates;
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a polygon soup in two parts: a mesh, and the *excised* triangles.
 *
 * The mesh consists of the kept triangles. Its vertices are the points of these triangles, bit for bit. The *contact*
 * consists of all vertices and edges that belong to both parts. A *pin* is a vertex or an edge of the contact that is
 * not on the border of the mesh.
 *
 * Another mesh can replace this mesh if it has the same border and pins, and no other vertex, edge, or facet in common
 * with the excised triangles (`check_replacement()`). The excised triangles remain where they are.
 */
class Excised_soup_3
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Surface_mesh<Kernel::Point_3> Mesh;
  typedef Kernel::Point_3 Point_3;
  typedef Soup_triangles::Triangle Triangle;

  static constexpr std::size_t none = std::size_t(-1); ///< an index that refers to no element

  Excised_soup_3() = default;
  /// divides a soup into the mesh of the kept triangles and the excised triangles. If the kept triangles are not an
  /// oriented manifold, there is no mesh.
  /// \param soup the triangles
  /// \param reasons for each triangle, why it is excised, or `Excision_reason::KEPT`
  /// \param is_reversed for each triangle, whether the facet of the mesh has the opposite orientation
  /// \pre triangles refer only to points of the soup; both vectors have one entry per triangle
  Excised_soup_3(Soup_triangles soup, std::vector<Excision_reason> reasons, std::vector<char> is_reversed);

  /// returns whether the kept triangles form a mesh with at least one facet
  explicit operator bool() const { return m_mesh.number_of_faces() > 0; }
  const Soup_triangles& soup() const { return m_soup; } ///< all triangles, in the order and orientation of the input
  /// returns, for each triangle, why it is excised, or `Excision_reason::KEPT`
  const std::vector<Excision_reason>& reasons() const { return m_reasons; }
  /// returns whether a triangle is excised
  bool is_excised(std::size_t triangle) const { return m_reasons[triangle] != Excision_reason::KEPT; }
  /// returns whether the facet of a triangle has the opposite orientation
  bool is_reversed(std::size_t triangle) const { return m_is_reversed[triangle] != 0; }
  /// returns the indices of the excised triangles, in ascending order
  const std::vector<std::size_t>& excised_triangles() const { return m_excised; }

  const Mesh& mesh() const { return m_mesh; } ///< the kept triangles as a mesh; its facets have their order
  std::size_t triangle_of(Mesh::Face_index f) const { return m_triangle_of[f]; }
  std::size_t point_of(Mesh::Vertex_index v) const { return m_point_of[v]; } ///< the position in `soup().points`
  /// returns the vertex at a point; `Mesh::null_vertex()` if all triangles at the point are excised
  Mesh::Vertex_index vertex_at(std::size_t point) const { return m_vertex_at[point]; }
  /// returns the facet of a triangle; `Mesh::null_face()` if the triangle is excised
  Mesh::Face_index facet_of(std::size_t triangle) const { return m_facet_of[triangle]; }

  /// returns the vertices of the mesh that are not on its border, but belong to excised triangles, ascending
  const std::vector<Mesh::Vertex_index>& pinned_vertices() const { return m_pinned_vertices; }
  /// returns the edges of the mesh that are not on its border, but belong to excised triangles, ascending. Their
  /// vertices are also pinned, unless they are on the border.
  const std::vector<Mesh::Edge_index>& pinned_edges() const { return m_pinned_edges; }

  const Excision_report& report() const { return m_report; }

private:
  friend struct internal::Excised_soup_access;

  bool build_mesh();
  void find_pins();
  void count();

  Soup_triangles m_soup;
  std::vector<Excision_reason> m_reasons;
  std::vector<char> m_is_reversed;
  std::vector<std::size_t> m_excised, m_triangle_of, m_point_of;
  Mesh m_mesh;
  std::vector<Mesh::Vertex_index> m_vertex_at, m_pinned_vertices;
  std::vector<Mesh::Face_index> m_facet_of;
  std::vector<Mesh::Edge_index> m_pinned_edges;
  Excision_report m_report;
};

namespace internal {

// Changes parts of an excised soup, which then may be invalid. It serves tests of `check_excision()`.
struct Excised_soup_access
{
  static Excised_soup_3::Mesh& mesh(Excised_soup_3& soup) { return soup.m_mesh; }
  static std::vector<Excised_soup_3::Mesh::Vertex_index>& pinned_vertices(Excised_soup_3& soup)
  {
    return soup.m_pinned_vertices;
  }
  static std::vector<Excised_soup_3::Mesh::Edge_index>& pinned_edges(Excised_soup_3& soup)
  {
    return soup.m_pinned_edges;
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISED_SOUP_3_H
