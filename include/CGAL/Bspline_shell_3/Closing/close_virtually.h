// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Shell/Closing_report.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Closing
/// the closing of an open mesh, or the reason why there is none and the facets that cause it
struct Virtual_closing
{
  Shell_status status = Shell_status::NOT_CLOSABLE;
  std::vector<Mesh_with_origins::Face_index> offending_facets;
  std::shared_ptr<const Shell_closing_3> closing; ///< not null if the status is `SUCCESS`
};

/// \ingroup PkgBsplineShell3Closing
/// a function that returns whether the hole at a point on the border has to be capped; it may be empty
typedef std::function<bool(const std::array<double, 3>&)> Hole_predicate;

/*!
 * \ingroup PkgBsplineShell3Closing
 *
 * \brief computes triangles that close an open mesh, so that it bounds a volume and a shell can be built around it.
 *
 * Holes are triangulated without new vertices (`CGAL::Polygon_mesh_processing::triangulate_hole_polyline()`) or, if
 * this fails, by a fan around one new vertex. Such a *cap* is kept if it causes no self-intersection, does not fold at
 * the hole's border, and leaves no thin wall or gap. A component with an uncapped hole becomes a slab. It gets a *back
 * sheet*, which is a reversed copy of the component, moved behind it and extended beyond its border. Strips connect
 * this sheet to the border. The distance of the back sheet is smaller where other parts of the mesh are close behind,
 * and is halved where the closed mesh would intersect itself.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param mesh an open triangle mesh
 * \param offset approximate upper bound on the distance of back sheets from the mesh, in the units of the coordinates
 * \param[out] report how holes were closed; if the status is `NOT_CLOSABLE`, only which holes could be capped
 * \param requires_cap whether the hole at a point must have a cap; if one of them has none, there is no closing
 * \return the closing, which makes the mesh closed and free of self-intersections, or the reason why there is none:
 *   `SELF_INTERSECTION` of the mesh itself, or `NOT_CLOSABLE`
 * \pre facets have positive area, and each vertex has one fan
 * \cgalHeading{Cost} A search for self-intersections each time the distance is halved somewhere.
 */
template <typename ConcurrencyTag>
Virtual_closing close_virtually(const Mesh_with_origins::Triangle_mesh& mesh, double offset, Closing_report& report,
                                const Hole_predicate& requires_cap = Hole_predicate());

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Closing/close_virtually_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_CLOSE_VIRTUALLY_H
