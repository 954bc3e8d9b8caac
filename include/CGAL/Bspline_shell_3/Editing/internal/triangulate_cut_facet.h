// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGULATE_CUT_FACET_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGULATE_CUT_FACET_H

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The triangles into which a facet is cut. There are none if rounding makes points equal, or moves them to edges.
struct Cut_facet_triangulation
{
  typedef std::array<double, 3> Weights; // barycentric coordinates

  std::vector<Weights> crossings;                                // points where chords cross; their numbers follow
  std::vector<std::array<std::size_t, 3> > triangles;            // numbers of points, oriented as the facet
  std::vector<std::pair<std::size_t, std::size_t> > chord_parts; // edges of triangles on chords
};

// Returns a constrained Delaunay triangulation of a facet.
// \param lengths lengths of the edges from corners 0, 1, and 2
// \param points points in the facet, among them its corners. Points on edges have a coordinate that is exactly 0 and
//   others whose exact sum is 1.
// \param chords pairs of numbers of points that are to be joined by edges
inline Cut_facet_triangulation triangulate_cut_facet(const std::array<double, 3>& lengths,
                                                     const std::vector<Cut_facet_triangulation::Weights>& points,
                                                     const std::vector<std::pair<std::size_t, std::size_t> >& chords)
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
  struct Number
  {
    std::size_t value = std::size_t(-1);
  };
  typedef Triangulation_vertex_base_with_info_2<Number, Kernel> Vertex_base;
  typedef Triangulation_data_structure_2<Vertex_base, Constrained_triangulation_face_base_2<Kernel> > Structure;
  typedef Constrained_Delaunay_triangulation_2<Kernel, Structure, Exact_predicates_tag> Triangulation;
  typedef typename Triangulation::Vertex_handle Vertex_handle;

  // The triangulation is computed in a linear image of the facet where coordinates are exact, so that points on edges
  // are on the hull. The image is a right triangle, with the corner opposite the longest edge at the origin. The scales
  // are powers of two.
  std::size_t o = 2;
  for(std::size_t i = 0; i < 2; ++i)
    if(lengths[(i + 1) % 3] >= lengths[(o + 1) % 3]) o = i;
  const std::size_t a = (o + 1) % 3, b = (o + 2) % 3;
  const double shape = lengths[o] / lengths[b]; // edges from o to a, and from b to o
  const int exponent = std::isfinite(shape) && shape > 0 ? int(std::lround(std::log2(shape))) : 0;
  const double width = std::ldexp(1., exponent);

  Triangulation triangulation;
  std::vector<Vertex_handle> handles;
  Cut_facet_triangulation result;
  for(std::size_t n = 0; n < points.size(); ++n) {
    handles.push_back(triangulation.insert(Kernel::Point_2(width * points[n][a], points[n][b])));
    if(triangulation.number_of_vertices() != n + 1) return result;
    handles.back()->info().value = n;
  }
  for(const auto& chord : chords) triangulation.insert_constraint(handles[chord.first], handles[chord.second]);

  for(auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    if(v->info().value < points.size()) continue;
    v->info().value = points.size() + result.crossings.size();
    Cut_facet_triangulation::Weights w;
    w[a] = v->point().x() / width;
    w[b] = v->point().y();
    w[o] = 1 - w[a] - w[b];
    result.crossings.push_back(w);
  }
  // Rounding may move a point or a crossing near an edge onto it, or beyond it. The hull then has another number of
  // points.
  const auto on_hull = std::count_if(points.begin(), points.end(),
                                     [](const auto& w) { return w[0] == 0 || w[1] == 0 || w[2] == 0; });
  if(triangulation.number_of_faces() + std::size_t(on_hull) + 2 != 2 * triangulation.number_of_vertices())
    return Cut_facet_triangulation();
  for(auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
    result.triangles.push_back({ f->vertex(0)->info().value, f->vertex(1)->info().value, f->vertex(2)->info().value });
  for(auto e = triangulation.finite_edges_begin(); e != triangulation.finite_edges_end(); ++e)
    if(triangulation.is_constrained(*e))
      result.chord_parts.emplace_back(e->first->vertex((e->second + 1) % 3)->info().value,
                                      e->first->vertex((e->second + 2) % 3)->info().value);
  return result;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGULATE_CUT_FACET_H
