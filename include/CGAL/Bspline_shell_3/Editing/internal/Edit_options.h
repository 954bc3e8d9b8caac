// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_OPTIONS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_OPTIONS_H

#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/closing_argument.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The options of an edit. Types of arguments are erased, so that edits are compiled once for each mesh type.
template <typename TriangleMesh>
struct Edit_options
{
  Edge_constraints<TriangleMesh> constraints;
  std::shared_ptr<const Shell_closing_3> closing; // closes the mesh if it is open; may be null
  double border_tolerance = 0;                    // the border is not simplified if it is 0
  bool freezes_rejected_facets = false;
  double max_seconds = std::numeric_limits<double>::infinity();
  // stores the locations on the mesh to which points are projected; empty if none are requested
  std::function<void(const std::vector<std::array<double, 3> >&)> locate;
};

// Reads named parameters. Projections are compiled only if `locate_vertices` is among them.
template <typename ConcurrencyTag, typename Options, typename TriangleMesh, typename VertexPointMap, typename Shell,
          typename NamedParameters, typename Result>
Options edit_options(const TriangleMesh& mesh, VertexPointMap vpm, const Shell& shell, const NamedParameters& np,
                     Result& result)
{
  namespace P = CGAL::parameters;
  Options options;
  options.closing = closing_argument(np, shell.closing());
  options.freezes_rejected_facets = P::choose_parameter(P::get_parameter(np, parameter_tags::freeze_rejected_facets),
                                                        options.freezes_rejected_facets);
  options.max_seconds = P::choose_parameter(P::get_parameter(np, internal_np::maximum_running_time),
                                            options.max_seconds);
  if constexpr(!P::is_default_parameter<NamedParameters, internal_np::edge_is_constrained_t>::value)
    options.constraints = Edge_constraints<TriangleMesh>(P::get_parameter(np, internal_np::edge_is_constrained));
  if constexpr(!P::is_default_parameter<NamedParameters, parameter_tags::locate_vertices_t>::value)
    if(P::get_parameter(np, parameter_tags::locate_vertices))
      options.locate = [&mesh, vpm, &shell, &result](const std::vector<std::array<double, 3> >& points) {
        const auto closing = result.removed_border_edges > 0 ? result.closing : nullptr;
        for(const auto& image :
            project_points<ConcurrencyTag>(shell, points, mesh, parameters::vertex_point_map(vpm).closing(closing)))
          result.locations.push_back(image.location);
      };
  return options;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_EDIT_OPTIONS_H
