// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_H
#define CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_H

#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns whether further facets can complete the open fan at a border vertex, so that all facets face a common
 * direction and wind around the vertex once.
 *
 * This is the case if and only if there is a \f$g\f$ such that \f$\det(g, e_i, e_{i+1}) > 0\f$ for the directions
 * \f$e_i\f$ to the other vertices, and the fan turns by less than \f$2 \pi\f$ about \f$g\f$. A ramp that spirals
 * farther around the vertex cannot be completed, even if it does not intersect itself and its facets face a common
 * direction.
 *
 * The test is exact. The directions for which \f$\det(g, e_k, e_0)\f$ is positive and those for which it is negative
 * form two convex cones. The number of full turns is constant on each cone, so it suffices to test one direction in
 * each.
 *
 * \param p the vertex
 * \param link the other vertices, in order: the facets are (`p`, `link[n]`, `link[n+1]`), and have positive area
 */
bool is_fan_closable(const Exact_predicates_inexact_constructions_kernel::Point_3& p,
                     const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& link);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/closable_fan_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_H
