// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H

#include <CGAL/Bspline_shell_3/Mesh/facet_crossing.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief the component of a shell in which each component of a mesh lies.
 */
struct Component_match
{
  static constexpr std::size_t none = Certificate_witness::none;

  /// by component of the mesh: the component of the shell that contains it; `none` if there is none, or if it is
  /// unknown
  std::vector<std::size_t> component_of_shell;
  /// by component of the shell: how often its paths cross the mesh from the back to the front, counted with
  /// signs; empty if all paths of the component are degenerate
  std::vector<std::optional<int> > crossings;

  /// returns whether the components of the mesh and of the shell match one-to-one. The verdict is undecided if the
  /// shell has no paths, or if the crossings of one of its components are unknown.
  Verdict verdict() const
  {
    bool is_known = !crossings.empty();
    for(const std::optional<int>& count : crossings) {
      if(count && *count != 1) return Verdict::REFUTED;
      is_known = is_known && count;
    }
    if(!is_known) return Verdict::UNDECIDED;
    const bool has_other = std::find(component_of_shell.begin(), component_of_shell.end(), none)
                           != component_of_shell.end();
    return has_other ? Verdict::REFUTED : Verdict::PROVED;
  }
};

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief matches the components of a closed mesh and of a shell, by crossings of the mesh with paths through the shell.
 *
 * Along a path, the field increases from below the inner threshold to above the outer threshold, and so do its
 * differences from the two thresholds. Hence the part of the path between the thresholds is connected, and lies in one
 * component of the shell. A mesh between the thresholds can meet the path only there. Each component of the mesh in
 * that component of the shell that faces along the gradient is crossed at least once, counted with signs. If the count
 * is one, there is therefore exactly one such component: the one that is crossed.
 *
 * Crossings are decided exactly. If a path meets an edge or a vertex of the mesh, another path through the same
 * component is used if there is one. If the counts of paths through one component differ, the mesh is not between the
 * thresholds; in this case, a count of one is preferred.
 *
 * \pre the third claim of the certificate holds in the components of the shell
 *
 * \param paths paths through the components of the shell, in any order
 * \param number_of_components number of components of the mesh
 * \param number_of_triangles number of triangles of the mesh
 * \param triangle a function that returns the three vertices of the `n`-th triangle, as points of
 *   `Exact_predicates_inexact_constructions_kernel`
 * \param component a function that returns the index of the component of the mesh to which the `n`-th triangle belongs
 *
 * \cgalHeading{Cost} That of `CGAL::box_intersection_d()` for paths and triangles.
 */
template <typename TriangleFunction, typename ComponentFunction>
Component_match match_components(const std::vector<Crossing_path>& paths, std::size_t number_of_components,
                                 std::size_t number_of_triangles, const TriangleFunction& triangle,
                                 const ComponentFunction& component)
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

/// \ingroup PkgBsplineShell3Certificate
/// matches the components of a mesh in the package's representation, which are numbered in the order of their first
/// facets
/// \tparam Mesh `Input_mesh_3`
template <typename Mesh>
Component_match match_components(const std::vector<Crossing_path>& paths, const Mesh& mesh)
{
  typedef typename Mesh::Face_index Face_index;
  return match_components(
    paths, mesh.number_of_components(), mesh.mesh().number_of_faces(),
    [&](std::size_t n) { return mesh.triangle(Face_index(n)); },
    [&](std::size_t n) { return mesh.component(Face_index(n)); });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H
