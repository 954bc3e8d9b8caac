// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H

#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/Remeshing_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Guarded_mesh.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/collapse_short_edges.h>
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include <CGAL/Bspline_shell_3/Editing/internal/flip_edges.h>
#include <CGAL/Bspline_shell_3/Editing/internal/relax_vertices.h>
#include <CGAL/Bspline_shell_3/Editing/internal/split_long_edges.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns what rejected placements between two counts: the shell, only the filter, or nothing, so that the edit ended
// with its iterations.
inline Edit_termination obstacle_between(const Placement_statistics& before, const Placement_statistics& after)
{
  constexpr Placement_verdict filter = Placement_verdict::BASE_FILTER;
  const std::size_t all = after.rejected() - before.rejected();
  const std::size_t by_filter = after.number(filter) - before.number(filter);
  return all > by_filter ? Edit_termination::SHELL : all > 0 ? Edit_termination::FILTER : Edit_termination::ITERATIONS;
}

// Returns the reason why edges may differ from the target length.
// \param obstacle what rejected a split or a collapse in the last iteration
template <typename Guarded>
Edit_termination termination(const Guarded& guarded, Edit_termination obstacle)
{
  const auto is_about_right = [&](auto e) {
    const double length = guarded.relative_length(halfedge(e, guarded.mesh));
    return guarded.frozen.has_edge(e) || (length >= remeshing_tuning.shortest && length <= remeshing_tuning.longest);
  };
  if(std::all_of(edges(guarded.mesh).begin(), edges(guarded.mesh).end(), is_about_right))
    return Edit_termination::TARGET;
  if(guarded.has_ended()) return Edit_termination::VISITOR;
  return obstacle;
}

// Remeshes a mesh in a shell. Edges are processed in an order that depends on lengths and, for equal lengths, on the
// order of the mesh, but never on addresses.
// pre: `check_before_edits()` accepts the mesh
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename Field, typename Threshold>
Edit_status remesh(TriangleMesh& mesh, VertexPointMap vpm, const Bspline_shell_3<Field, Threshold>& shell,
                   const Remeshing_options<TriangleMesh, typename Field::Point_3>& options,
                   Edit_result<Remeshing_report, TriangleMesh>& result)
{
  const auto edit = [&](const auto& oracle, const auto& frozen, const auto& all) {
    typedef Shell_projection_3<Bspline_shell_3<Field, Threshold>, TriangleMesh> Projection;
    const Projection projection(shell, std::make_shared<const typename Projection::Target>(mesh, vpm));
    const auto project = [&](const typename Field::Point_3& p) {
      if(!options.projects) return p;
      const auto image = projection(p);
      return image ? image.point : p;
    };
    Guarded_mesh guarded(mesh, vpm, oracle, frozen, options, all, result);
    Edit_termination obstacle = Edit_termination::ITERATIONS;
    for(unsigned int i = 0; i < options.iterations && !guarded.has_ended(); ++i) {
      if(!options.start_iteration(i)) guarded.end();
      flip_to_larger_angles(guarded);
      const Placement_statistics before = guarded.placements();
      split_long_edges(guarded);
      collapse_short_edges(guarded);
      obstacle = obstacle_between(before, guarded.placements());
      flip_to_regular_valences(guarded);
      for(unsigned int j = 0; j < options.relaxations; ++j) relax_vertices<ConcurrencyTag>(guarded, project);
    }
    flip_to_larger_angles(guarded);
    result.end = termination(guarded, obstacle);
    result.images = guarded.images.all();
    return result.invalid_parameter ? Edit_status::INVALID_PARAMETER : Edit_status::SUCCESS;
  };
  constexpr bool may_repeat = true;
  return edit_under_proof<ConcurrencyTag>(mesh, vpm, shell, may_repeat, options, result, edit);
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template Edit_status remesh<Parallel_if_available_tag>(
  Instance_mesh&, Instance_points, const Certified_bspline_shell_3&,
  const Remeshing_options<Instance_mesh, Instance_kernel::Point_3>&, Edit_result<Remeshing_report, Instance_mesh>&);
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H
