// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_VALIDATE_MESH_H
#define CGAL_BSPLINE_SHELL_3_MESH_VALIDATE_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the origins of the facets at border edges.
inline std::vector<std::size_t> facets_at_border(const Mesh_with_origins& m)
{
  std::vector<std::size_t> facets;
  for(auto h : m.mesh.halfedges())
    if(m.mesh.is_border(h) && !m.mesh.is_border(m.mesh.opposite(h)))
      facets.push_back(m.facet_origin[m.mesh.face(m.mesh.opposite(h))]);
  return facets;
}

inline Mesh_refusal check_range(const Mesh_with_origins& m)
{
  // Squares of cross products, and determinants, must be far from overflow and underflow.
  constexpr double largest = 1e60, smallest = 1e-60;
  const Mesh_refusal refusal = { Shell_status::COORDINATES_OUT_OF_RANGE, {} };
  for(int a = 0; a < 3; ++a)
    if((std::max)(std::abs((m.bbox.min)(a)), std::abs((m.bbox.max)(a))) > largest) return refusal;
  // If the box is a point, all facets are degenerate: their status is more specific.
  return m.unit() > 0 && m.unit() < smallest ? refusal : Mesh_refusal();
}

// Each vertex must have one fan.
inline Mesh_refusal check_fans(const Mesh_with_origins& m)
{
  std::vector<Mesh_with_origins::Triangle_mesh::Halfedge_index> pinched;
  Polygon_mesh_processing::non_manifold_vertices(m.mesh, std::back_inserter(pinched));
  std::vector<std::size_t> vertices; // one halfedge per fan
  for(auto h : pinched) vertices.push_back(m.vertex_origin[m.mesh.target(h)]);
  return m.refuse_vertices_if_any(Shell_status::NON_MANIFOLD, std::move(vertices));
}

template <typename ConcurrencyTag>
Mesh_refusal check_areas(const Mesh_with_origins& m)
{
  constexpr std::size_t chunk = 4096;
  return m.refuse_facets_if_any(
    Shell_status::DEGENERATE_FACET,
    collect_from_chunks<ConcurrencyTag, std::size_t>(
      m.mesh.number_of_faces(), chunk, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
        for(std::size_t n = begin; n < end; ++n)
          if(Polygon_mesh_processing::is_degenerate_triangle_face(
               Mesh_with_origins::Face_index(static_cast<unsigned int>(n)), m.mesh))
            found.push_back(m.facet_origin[n]);
      }));
}

// Returns false for a polygon of two edges.
inline bool triangulate_facet(Mesh_with_origins::Face_index f, Mesh_with_origins& m)
{
  std::vector<Mesh_with_origins::Triangle_mesh::Halfedge_index> halfedges; // each leads to a vertex of the polygon
  std::vector<Mesh_with_origins::Kernel::Point_3> points;
  for(auto h : m.mesh.halfedges_around_face(m.mesh.halfedge(f))) {
    halfedges.push_back(h);
    points.push_back(m.mesh.point(m.mesh.target(h)));
  }
  if(points.size() < 3) return false;
  std::vector<std::array<std::size_t, 3> > triangles = triangulate_polygon(points);
  triangles.pop_back(); // the remaining facet
  for(const auto& t : triangles) {
    halfedges[t[2]] = CGAL::Euler::split_face(halfedges[t[0]], halfedges[t[2]], m.mesh);
    m.facet_origin.push_back(m.facet_origin[f]); // the triangle that is cut off
  }
  return true;
}

inline Mesh_refusal triangulate_facets(Mesh_with_origins& m)
{
  std::vector<std::size_t> degenerate;
  for(unsigned int n = 0, polygons = m.mesh.number_of_faces(); n < polygons; ++n) {
    const Mesh_with_origins::Face_index f(n);
    if(!CGAL::is_triangle(m.mesh.halfedge(f), m.mesh) && !triangulate_facet(f, m))
      degenerate.push_back(m.facet_origin[f]);
  }
  return m.refuse_facets_if_any(Shell_status::DEGENERATE_FACET, std::move(degenerate));
}

// Triangulates the facets of a copied mesh. The mesh is accepted if its facets have positive areas, its vertices have
// one fan each, and it is closed or may be open.
template <typename ConcurrencyTag>
Mesh_refusal validate_mesh(Mesh_with_origins& m, bool may_be_open)
{
  Mesh_refusal refusal = check_range(m);
  if(!refusal && !may_be_open) refusal = m.refuse_facets_if_any(Shell_status::OPEN_MESH, facets_at_border(m));
  if(!refusal) refusal = check_fans(m);
  if(!refusal) refusal = triangulate_facets(m);
  if(!refusal) refusal = check_areas<ConcurrencyTag>(m);
  // The numbers must suffice for a closing with as many facets as the mesh, and two per border edge.
  if(!refusal && !CGAL::is_closed(m.mesh)
     && !Mesh_size{ 2 * std::size_t(m.mesh.number_of_vertices()), 4 * std::size_t(m.mesh.number_of_edges()) }
           .has_numbers())
    refusal.status = Shell_status::TOO_MANY_FACETS;
  return refusal;
}

// Returns whether a mesh that was closed or truncated satisfies the requirements of all later steps.
template <typename ConcurrencyTag>
bool is_closed_surface(const Mesh_with_origins& m)
{
  return !check_range(m) && CGAL::is_closed(m.mesh) && CGAL::is_triangle_mesh(m.mesh) && !check_fans(m)
         && !check_areas<ConcurrencyTag>(m);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_VALIDATE_MESH_H
