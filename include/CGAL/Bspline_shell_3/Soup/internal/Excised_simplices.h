// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The vertices, edges and triangles that only excised triangles have, by coordinates.
class Excised_simplices
{
public:
  typedef Excised_soup_3::Mesh::Point Point_3;
  typedef std::array<Point_3, 3> Triangle;

  explicit Excised_simplices(const Excised_soup_3& soup);
  ~Excised_simplices();
  Excised_simplices(const Excised_simplices&) = delete;
  Excised_simplices& operator=(const Excised_simplices&) = delete;

  bool has_own_point(const Point_3& p) const { return m_own_points.count(p) > 0; }
  bool has_point(const Point_3& p) const { return m_points.count(p) > 0; } // also points that the mesh has
  bool has_edge(const Point_3& p, const Point_3& q) const { return m_edges.count(sorted(Edge{ p, q })) > 0; }
  bool has_triangle(const Triangle& t) const { return m_triangles.count(sorted(t)) > 0; }

  // Returns the number of excised triangles with an area that a triangle meets outside of common vertices and edges.
  std::size_t number_of_contacts(const Triangle& t) const;

private:
  typedef std::array<Point_3, 2> Edge;
  struct Tree;

  template <typename Simplex>
  static Simplex sorted(Simplex simplex)
  {
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  }

  std::set<Point_3> m_own_points, m_points;
  std::set<Edge> m_edges;
  std::set<Triangle> m_triangles;
  std::unique_ptr<const Tree> m_tree; // of excised triangles with an area
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/internal/Excised_simplices_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_H
