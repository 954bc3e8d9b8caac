// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXACT_UNION_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXACT_UNION_H

#include <CGAL/Bspline_shell_3/Soup/Unite_report.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Solid_finder.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <list>
#include <map>
#include <new>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef Exact_predicates_exact_constructions_kernel Exact_kernel;
typedef Surface_mesh<Exact_kernel::Point_3> Exact_mesh;
typedef Exact_mesh::Property_map<Exact_mesh::Face_index, std::size_t> Exact_sources; // facets of the user's mesh

inline Exact_sources sources_of(Exact_mesh& mesh)
{
  return mesh.add_property_map<Exact_mesh::Face_index, std::size_t>("f:source", Solids::none).first;
}

// Passes on the source of a facet to its parts, and to their copies in the result. Ends a union when its run ends: the
// exception passes through CGAL, whose objects for the union are local.
struct Source_visitor : Polygon_mesh_processing::Corefinement::Default_visitor<Exact_mesh>
{
  void before_subface_creations(Exact_mesh::Face_index f, Exact_mesh& mesh) { source = sources.at(&mesh)[f]; }
  void after_subface_created(Exact_mesh::Face_index f, Exact_mesh& mesh) { sources.at(&mesh)[f] = source; }
  void after_face_copy(Exact_mesh::Face_index from, const Exact_mesh& mesh, Exact_mesh::Face_index to,
                       Exact_mesh& result)
  {
    sources.at(&result)[to] = sources.at(&mesh)[from];
  }
  void progress_filtering_intersections(double) const { Run::poll(); }
  void triangulating_faces_step() const { Run::poll(); }
  void intersection_of_coplanar_faces_step() const { Run::poll(); }
  void edge_face_intersections_step() const { Run::poll(); }

  std::map<const Exact_mesh*, Exact_sources> sources;
  std::size_t source = Solids::none; // source of the facet that is being split
};

// Appends facets of the user's mesh, such that they face outwards.
template <typename Mesh>
void add_solids(const Mesh& mesh, const Solids& solids, std::size_t color, Exact_mesh& operand)
{
  const Exact_sources sources = sources_of(operand);
  std::vector<Exact_mesh::Vertex_index> copy(mesh.num_vertices());
  std::size_t n = 0;
  for(auto f : mesh.faces()) {
    const std::size_t source = n++;
    if(solids.color[solids.solid_of_facet[source]] != color) continue;
    std::vector<Exact_mesh::Vertex_index> corners;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      if(!copy[v].is_valid()) {
        const auto& p = mesh.point(v);
        copy[v] = operand.add_vertex(Exact_kernel::Point_3(p.x(), p.y(), p.z()));
      }
      corners.push_back(copy[v]);
    }
    if(!solids.faces_outwards) std::reverse(corners.begin(), corners.end());
    sources[operand.add_face(corners)] = source;
  }
}

inline bool has_equal_points(const Exact_mesh& mesh)
{
  std::vector<Exact_kernel::Point_3> points;
  for(auto v : mesh.vertices()) points.push_back(mesh.point(v));
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

// Computes the union of solids with colors, each facet with its source. Operands are combined in a balanced tree.
// Coordinates are evaluated after each operation, because their expressions would grow otherwise.
// \return `UNITED`, `CONTACT`, or `NOT_COMPUTED`
// \pre there are colors
template <typename Mesh>
Unite_status exact_union(const Mesh& mesh, const Solids& solids, Exact_mesh& result)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  try {
    std::list<Exact_mesh> queue;
    for(std::size_t color = 0; color < solids.number_of_colors; ++color) {
      queue.emplace_back();
      add_solids(mesh, solids, color, queue.back());
    }
    while(queue.size() > 1) {
      Exact_mesh first(std::move(queue.front()));
      queue.pop_front();
      Exact_mesh second(std::move(queue.front()));
      queue.pop_front();
      queue.emplace_back();
      Exact_mesh& both = queue.back();
      Source_visitor visitor;
      for(Exact_mesh* m : { &first, &second, &both }) visitor.sources[m] = sources_of(*m);
      if(!PMP::corefine_and_compute_union(first, second, both, CGAL::parameters::visitor(visitor)))
        return Unite_status::CONTACT;
      for(auto v : both.vertices()) {
        Run::poll();
        CGAL::exact(both.point(v));
      }
      if(has_equal_points(both)) return Unite_status::CONTACT;
    }
    result = std::move(queue.front());
  } catch(const std::bad_alloc&) {
    throw;
  } catch(const std::exception&) { // exceptions of CGAL; its conditions are proved, so they are unexpected
    return Unite_status::NOT_COMPUTED;
  }
  return Unite_status::UNITED;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXACT_UNION_H
