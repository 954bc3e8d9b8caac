// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H

#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

class Input_mesh_3;

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
Component_match match_components(
  const std::vector<Crossing_path>& paths, std::size_t number_of_components, std::size_t number_of_triangles,
  const std::function<std::array<Exact_predicates_inexact_constructions_kernel::Point_3, 3>(std::size_t)>& triangle,
  const std::function<std::size_t(std::size_t)>& component);

/// \ingroup PkgBsplineShell3Certificate
/// matches the components of a mesh in the package's representation, which are numbered in the order of their first
/// facets
Component_match match_components(const std::vector<Crossing_path>& paths, const Input_mesh_3& mesh);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Certificate/match_components_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_MATCH_COMPONENTS_H
