// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a triangle mesh of a polygon soup, with the origin of each of its facets and vertices.
 *
 * Polygons are triangulated, and oriented like their neighbors if possible. Where the soup is not manifold, they are
 * separated by duplicating vertices. Points at equal positions remain separate; if they represent the same vertex,
 * merge them first (`CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup()`).
 */
class Soup_mesh_3
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Surface_mesh<Kernel::Point_3> Mesh;

  Soup_mesh_3() = default;
  /// \pre coordinates are finite, and polygons refer only to points of the soup
  explicit Soup_mesh_3(const Polygon_soup& soup);

  const Mesh& mesh() const { return m_mesh; }
  /// returns the polygon of which a triangle is part
  std::size_t polygon_of(Mesh::Face_index f) const { return m_polygon[f]; }
  /// returns the point from which a vertex was made, directly or as a copy
  std::size_t point_of(Mesh::Vertex_index v) const { return m_point[v]; }
  /// returns the polygons that are not in the mesh because they have no area, ascending
  const std::vector<std::size_t>& polygons_left_out() const { return m_left_out; }

private:
  Mesh m_mesh;
  std::vector<std::size_t> m_polygon, m_point, m_left_out;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_MESH_3_H
