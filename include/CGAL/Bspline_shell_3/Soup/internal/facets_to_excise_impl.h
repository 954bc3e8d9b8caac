// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_IMPL_H

#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Truncation_report.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/internal/facets_to_excise.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excised_soup_3::Mesh::Face_index> facets_at_obstacles(const Excised_soup_3::Mesh& mesh,
                                                                  const std::vector<Refinement_obstacle>& obstacles)
{
  typedef AABB_face_graph_triangle_primitive<Excised_soup_3::Mesh> Primitive;
  typedef AABB_tree<AABB_traits_3<Exact_predicates_inexact_constructions_kernel, Primitive> > Tree;
  std::vector<Excised_soup_3::Mesh::Face_index> facets;
  Tree tree(faces(mesh).first, faces(mesh).second, mesh);
  for(const Refinement_obstacle& o : obstacles) {
    const Excised_soup_3::Point_3 p(o.point[0], o.point[1], o.point[2]);
    facets.push_back(tree.closest_point_and_primitive(p).second);
  }
  sort_unique(facets);
  return facets;
}

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excised_soup_3::Mesh::Vertex_index> truncated_vertices(const Truncation_report& report)
{
  typedef Excised_soup_3::Mesh Mesh;
  std::vector<Mesh::Vertex_index> truncated;
  for(const Truncation_report::Vertex& v : report.vertices)
    if(v.outcome == Truncation_report::Outcome::TRUNCATED) truncated.emplace_back(Mesh::size_type(v.vertex));
  return truncated;
}

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excised_soup_3::Mesh::Face_index> facets_on_wrong_side(const Excised_soup_3& soup,
                                                                   const std::vector<std::size_t>& listed)
{
  typedef Excised_soup_3::Mesh Mesh;
  const Mesh& mesh = soup.mesh();
  std::vector<std::size_t> component(mesh.number_of_faces());
  const std::size_t size = Polygon_mesh_processing::connected_components(mesh, CGAL::make_property_map(component));
  std::vector<char> is_listed(size, 0);
  for(std::size_t f : listed) is_listed[component[f]] = 1;
  double area[2] = { 0, 0 }; // the sums for the other components, and for those listed
  for(auto f : mesh.faces()) area[std::size_t(is_listed[component[f]])] += Polygon_mesh_processing::face_area(f, mesh);
  const char chosen = area[1] <= area[0] ? 1 : 0;
  std::vector<Mesh::Face_index> facets;
  for(auto f : mesh.faces())
    if(is_listed[component[f]] == chosen) facets.push_back(f);
  return facets;
}

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excised_soup_3::Mesh::Face_index> facets_beside(const Excised_soup_3& soup,
                                                            const std::vector<std::size_t>& triangles)
{
  std::vector<char> has_point(soup.soup().points.size(), 0);
  for(std::size_t t : triangles)
    for(std::size_t v : soup.soup().triangles[t]) has_point[v] = 1;
  std::vector<Excised_soup_3::Mesh::Face_index> facets;
  for(auto f : soup.mesh().faces()) {
    const auto& corners = soup.soup().triangles[soup.triangle_of(f)];
    if(std::any_of(corners.begin(), corners.end(), [&](std::size_t v) { return has_point[v]; })) facets.push_back(f);
  }
  return facets;
}

CGAL_BSPLINE_SHELL_3_INLINE
double share_of_isolated_facets(const Excised_soup_3::Mesh& mesh)
{
  double isolated = 0, total = 0;
  for(auto f : mesh.faces()) {
    const double area = Polygon_mesh_processing::face_area(f, mesh);
    total += area;
    const auto sides = mesh.halfedges_around_face(mesh.halfedge(f));
    if(std::all_of(sides.begin(), sides.end(), [&](auto h) { return mesh.is_border(mesh.opposite(h)); }))
      isolated += area;
  }
  return total > 0 ? isolated / total : 0;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_FACETS_TO_EXCISE_IMPL_H
