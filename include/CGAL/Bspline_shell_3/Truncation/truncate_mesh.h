// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Shell/Truncation_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <functional>
#include <memory>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Truncation
 *
 * \brief finds singular vertices and vertices with a small cone margin, and discs that can replace their tips
 * (`Shell_truncation_3`).
 *
 * The facets at such a vertex are cut within a ball that meets no other facets. Candidates are discs without inner
 * points, discs with one inner point, and parts of the ball's sphere. Of the embedded candidates, the disc with the
 * largest margin is taken. The truncated mesh is free of self-intersections, which is tested exactly. Vertices on the
 * border of an open mesh are not truncated. Neither are vertices at folded edges, where no disc has a larger margin.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param mesh a closed triangle mesh without self-intersections
 * \param largest_radius returns a positive upper bound on the radius of the ball around a vertex with these
 *   coordinates, in their units. The radius is smaller if edges are short or other facets are near.
 * \param least_margin vertices with a smaller `vertex_cone_margin()` are truncated if this at least doubles the margin
 * \param[out] report vertices that are truncated, and vertices where truncation was not possible
 * \return the truncation, or null if no vertex is truncated
 * \cgalHeading{Cost} Linear in the number of vertices; for each truncated vertex, some milliseconds and a search for
 *   self-intersections nearby.
 */
template <typename ConcurrencyTag>
std::shared_ptr<const Shell_truncation_3> truncate_mesh(
  const Mesh_with_origins& mesh, const std::function<double(const std::array<double, 3>&)>& largest_radius,
  double least_margin, Truncation_report& report);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H
