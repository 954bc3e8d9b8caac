// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/triangles_overlap.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excised_simplices.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

struct Excised_simplices::Tree
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef AABB_traits_3<Kernel, AABB_triangle_primitive_3<Kernel, Triangles::const_iterator> > Traits;

  explicit Tree(Triangles all) : triangles(std::move(all)), tree(triangles.begin(), triangles.end()) { tree.build(); }

  Triangles triangles;
  AABB_tree<Traits> tree;
};

CGAL_BSPLINE_SHELL_3_INLINE Excised_simplices::Excised_simplices(const Excised_soup_3& soup)
{
  const auto& mesh = soup.mesh();
  const auto& points = soup.soup().points;
  Tree::Triangles with_area;
  for(std::size_t t : soup.excised_triangles()) {
    const Soup_triangles::Triangle& c = soup.soup().triangles[t];
    m_triangles.insert(sorted(Triangle{ points[c[0]], points[c[1]], points[c[2]] }));
    if(!CGAL::collinear(points[c[0]], points[c[1]], points[c[2]]))
      with_area.emplace_back(points[c[0]], points[c[1]], points[c[2]]);
    for(std::size_t i = 0; i < 3; ++i) {
      const std::size_t p = c[i], q = c[(i + 1) % 3];
      const auto v = soup.vertex_at(p), w = soup.vertex_at(q);
      m_points.insert(points[p]);
      if(v == mesh.null_vertex()) m_own_points.insert(points[p]);
      const bool are_vertices = v != mesh.null_vertex() && w != mesh.null_vertex();
      if(!are_vertices || mesh.halfedge(v, w) == mesh.null_halfedge())
        m_edges.insert(sorted(Edge{ points[p], points[q] }));
    }
  }
  m_tree = std::make_unique<const Tree>(std::move(with_area));
}

CGAL_BSPLINE_SHELL_3_INLINE Excised_simplices::~Excised_simplices() = default;

CGAL_BSPLINE_SHELL_3_INLINE std::size_t Excised_simplices::number_of_contacts(const Triangle& t) const
{
  if(m_tree->triangles.empty() || CGAL::collinear(t[0], t[1], t[2])) return 0;
  std::vector<Tree::Triangles::const_iterator> near;
  m_tree->tree.all_intersected_primitives(Tree::Kernel::Triangle_3(t[0], t[1], t[2]), std::back_inserter(near));
  std::size_t contacts = 0;
  for(const auto& excised : near) {
    std::vector<Point_3> points(t.begin(), t.end());
    std::array<std::size_t, 3> corners;
    for(int i = 0; i < 3; ++i) {
      const Point_3& p = excised->vertex(i);
      corners[std::size_t(i)] = std::size_t(std::find(points.begin(), points.begin() + 3, p) - points.begin());
      if(corners[std::size_t(i)] < 3) continue;
      corners[std::size_t(i)] = points.size();
      points.push_back(p);
    }
    contacts += triangles_overlap({ 0, 1, 2 }, corners, points);
  }
  return contacts;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISED_SIMPLICES_IMPL_H
