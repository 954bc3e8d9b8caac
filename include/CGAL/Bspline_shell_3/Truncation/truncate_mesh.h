// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
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
 * \brief finds vertices whose facets face no common direction, or hardly one, and discs that may replace their tips
 * (`Shell_truncation_3`).
 *
 * The facets at such a vertex are cut within a ball that meets no others. Of discs without further points, with one,
 * and on the ball's sphere, the one is taken whose vertices have the largest margins, among those that are embedded.
 * The truncated mesh is free of self-intersections, which is tested exactly. Vertices on the border of an open mesh,
 * and those at folded edges, where no disc leaves more room, are not truncated.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \param input a mesh without self-intersections, or one whose construction has come so far that it is known to have
 *   none
 * \param largest_radius of the ball around a vertex with these coordinates; user units, positive. It is smaller where
 *   edges are short, and other facets near
 * \param least_margin vertices with a smaller `vertex_cone_margin()` are truncated, if that makes it at least twice as
 *   large
 * \param[out] report where the mesh is truncated, and where that was not possible
 * \return the truncation, or null if no vertex is truncated
 * \cgalHeading{Cost} linear in the number of vertices; for each that is truncated, some milliseconds, and the search
 *   for self-intersections nearby
 */
template <typename ConcurrencyTag>
std::shared_ptr<const Shell_truncation_3> truncate_mesh(
  const Input_mesh_3& input, const std::function<double(const std::array<double, 3>&)>& largest_radius,
  double least_margin, Truncation_report& report);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_TRUNCATE_MESH_H
