// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Closing
 *
 * \brief closes an open mesh by triangles that nobody sees: so that it bounds a volume, and a shell can be built around
 * it.
 *
 * Holes get caps without new vertices (`CGAL::Polygon_mesh_processing::triangulate_hole_polyline()`), where the result
 * does not intersect itself, does not fold at the hole's border, and leaves no thin wall or gap. A component with a
 * hole that gets none becomes a slab: it gets a back sheet, a copy of it that faces the other way, moved behind it and
 * beyond the border, and strips that connect both. The distance is the smaller the nearer other parts of the mesh are
 * behind a place, and is halved where the closed mesh would intersect itself.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \param mesh an open mesh of triangles
 * \param offset how far back sheets are behind the mesh, at most about; user units
 * \param[out] report how holes were closed
 * \return the closing, with which the mesh is closed and does not intersect itself; or the reason why there is none:
 *   `SELF_INTERSECTION`, of the mesh itself, or `NOT_CLOSABLE`
 * \pre facets have an area, and each vertex has one fan of them
 * \cgalHeading{Cost} that of a search for self-intersections, for each time that the distance is halved somewhere
 */
template <typename ConcurrencyTag>
Input_mesh_3::Closed close_virtually(const Input_mesh_3::Triangle_mesh& mesh, double offset, Closing_report& report);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Closing/close_virtually_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H
