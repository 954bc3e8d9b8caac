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
 * \brief whether the open fan of facets at a border vertex can be completed so that all facets at it face a common
 * direction, and wind once around it.
 *
 * That is so if and only if some \f$g\f$ has \f$\det(g, e_i, e_{i+1}) > 0\f$ for the directions \f$e_i\f$ to the other
 * vertices, and the fan turns by less than
 * \f$2 \pi\f$ about it. A ramp that spirals around the vertex by more cannot be completed, although it does not
 *   intersect itself and faces one way.
 *
 * Exact: the directions where \f$\det(g, e_k, e_0)\f$ is positive, and those where it is negative, form two convex
 * cones, on each of which the number of full turns is the same everywhere; so one direction of each decides.
 *
 * \param p the vertex
 * \param link the other vertices, in order: the facets are (`p`, `link[n]`, `link[n+1]`), and have an area
 */
bool is_fan_closable(const Exact_predicates_inexact_constructions_kernel::Point_3& p,
                     const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& link);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/closable_fan_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_CLOSABLE_FAN_H
