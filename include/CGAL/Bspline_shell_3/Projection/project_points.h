// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECT_POINTS_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECT_POINTS_H

#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <CGAL/tags.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell onto a mesh, along integral curves.
 *
 * If the same mesh is used several times, construct a `Shell_projection_3` or a `Shell_map_3` instead: they keep the
 * search tree that this function builds in each call.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam PointRange a random access range of points
 * \tparam TriangleMesh a model of `FaceListGraph`
 * \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
 * \param points the points
 * \param target a triangle mesh
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{vertex point map of the target}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{tolerance}
 *       \cgalParamDescription{tolerance of the tracing, as for `Gradient_flow_3`, in the units of the coordinates}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{`Gradient_flow_3::default_tolerance()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return the `Projected_point` of each point
 * \cgalHeading{Cost} A few microseconds of processor time per point.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Shell, typename PointRange,
          typename TriangleMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
std::vector<Projected_point<TriangleMesh, typename Shell::Point_3> > project_points(
  const Shell& shell, const PointRange& points, const TriangleMesh& target,
  const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const Shell_projection_3<Shell, TriangleMesh> projection(shell, target, np);
  return projection.template project<ConcurrencyTag>(points, visitor);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECT_POINTS_H
