// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_IMPL_H

#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/box_intersection_d.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
Component_match match_components(
  const std::vector<Crossing_path>& paths, std::size_t number_of_components, std::size_t number_of_triangles,
  const std::function<std::array<Exact_predicates_inexact_constructions_kernel::Point_3, 3>(std::size_t)>& triangle,
  const std::function<std::size_t(std::size_t)>& component)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  struct Box : Box_intersection_d::Box_d<double, 3>
  {
    Box(const Bbox_3& b, std::size_t n) : Box_intersection_d::Box_d<double, 3>(b), number(n) {}
    std::size_t number;
  };
  struct Count
  {
    int sum = 0;
    bool is_clean = true;             // no edge or vertex is met
    std::vector<std::size_t> crossed; // components
  };
  const auto point = [](const std::array<double, 3>& p) { return Point_3(p[0], p[1], p[2]); };

  std::vector<Box> segments, triangles;
  for(std::size_t n = 0; n < paths.size(); ++n)
    segments.emplace_back(point(paths[n].source).bbox() + point(paths[n].target).bbox(), n);
  Bbox_3 all;
  for(const Box& s : segments) all += s.bbox();
  for(std::size_t n = 0; n < number_of_triangles; ++n) {
    const std::array<Point_3, 3> t = triangle(n);
    const Bbox_3 box = t[0].bbox() + t[1].bbox() + t[2].bbox();
    if(do_overlap(box, all)) triangles.emplace_back(box, n);
  }
  std::vector<Count> counts(paths.size());
  CGAL::box_intersection_d(segments.begin(), segments.end(), triangles.begin(), triangles.end(),
                           [&](const Box& s, const Box& b) {
                             const std::array<Point_3, 3> t = triangle(b.number);
                             const std::optional<int> crossing = facet_crossing(
                               point(paths[s.number].source), point(paths[s.number].target), t[0], t[1], t[2]);
                             Count& count = counts[s.number];
                             count.is_clean = count.is_clean && crossing;
                             if(!crossing || *crossing == 0) return;
                             count.sum += *crossing;
                             count.crossed.push_back(component(b.number));
                           });

  Component_match match;
  match.component_of_shell.assign(number_of_components, Component_match::none);
  for(std::size_t n = 0; n < paths.size(); ++n) {
    const std::size_t k = paths[n].component;
    if(k >= match.crossings.size()) match.crossings.resize(k + 1);
    if(!counts[n].is_clean || match.crossings[k] == 1) continue;
    match.crossings[k] = counts[n].sum;
    for(std::size_t c : counts[n].crossed) match.component_of_shell[c] = k;
  }
  return match;
}

CGAL_BSPLINE_SHELL_3_INLINE
Component_match match_components(const std::vector<Crossing_path>& paths, const Input_mesh_3& mesh)
{
  typedef Input_mesh_3::Face_index Face_index;
  return match_components(
    paths, mesh.number_of_components(), mesh.mesh().number_of_faces(),
    [&](std::size_t n) { return mesh.triangle(Face_index(n)); },
    [&](std::size_t n) { return mesh.component(Face_index(n)); });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_IMPL_H
