// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H

#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/collapse_short_edges.h>
#include <CGAL/Bspline_shell_3/Editing/internal/flip_edges.h>
#include <CGAL/Bspline_shell_3/Editing/internal/relax_vertices.h>
#include <CGAL/Bspline_shell_3/Editing/internal/split_long_edges.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Remeshes a mesh, as remesh_in_shell() describes it. Edges are processed in an order that depends on lengths and, for
// equal lengths, on the order of the mesh, never on addresses.
// \tparam Guarded a `Guarded_mesh`
// \param project moves a point to the surface
// \return the reason why edges may differ from the target length
template <typename ConcurrencyTag, typename Guarded, typename Projection, typename Visitor>
Edit_termination remesh(Guarded& guarded, unsigned int iterations, unsigned int relaxations, const Projection& project,
                        Visitor& visitor)
{
  bool has_rejected = false; // whether the oracle rejected a split or a collapse in the last iteration
  for(unsigned int i = 0; i < iterations && !guarded.has_ended(); ++i) {
    if(!visitor.start_iteration(i)) guarded.end();
    flip_to_larger_angles(guarded);
    const std::size_t rejected_before = guarded.rejected();
    split_long_edges(guarded);
    collapse_short_edges(guarded);
    has_rejected = guarded.rejected() > rejected_before;
    flip_to_regular_valences(guarded);
    for(unsigned int j = 0; j < relaxations; ++j) relax_vertices<ConcurrencyTag>(guarded, project);
  }
  flip_to_larger_angles(guarded);

  const auto& mesh = guarded.mesh;
  const auto is_about_right = [&](auto e) {
    const double length = guarded.relative_length(halfedge(e, mesh));
    return guarded.frozen.has_edge(e) || (length >= remeshing_tuning.shortest && length <= remeshing_tuning.longest);
  };
  if(std::all_of(edges(mesh).begin(), edges(mesh).end(), is_about_right)) return Edit_termination::TARGET;
  if(guarded.has_ended()) return Edit_termination::VISITOR;
  return has_rejected ? Edit_termination::SHELL : Edit_termination::ITERATIONS;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESH_H
