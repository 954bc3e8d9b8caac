// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_H
#define CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_H

#include <CGAL/Bspline_shell_3/Soup/Unite_report.h>
#include <CGAL/Bspline_shell_3/Soup/United_mesh.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief makes the boundary of a union from a mesh that intersects itself because closed parts are pushed into each
 * other.
 *
 * A *part* is a connected component. A part that faces the side of the outermost parts bounds a *solid*. A part that
 * faces the other side is a *cavity* of the innermost solid that contains it. The result is the boundary of the union
 * of all solids, where the mesh may face inwards or outwards. A part within another solid is *hidden*, and is removed,
 * unless it is a cavity that no other solid fills. In particular, a box in a box is removed if both face outwards.
 *
 * Solids that neither intersect nor contain a part of another solid are unchanged. The union of the others is computed
 * by \cgal's corefinement in exact arithmetic. The solids are first colored such that those of one color are apart and
 * form one operand. Hence the number of operations is the number of colors minus one. The exact result is rounded to
 * `double`s. It is rejected if two points become equal, or if facets intersect, become degenerate, or turn by more than
 * 10 degrees. A facet that is degenerate or turned is first combined with its neighbor in the same source if their
 * common edge can be flipped.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param mesh a mesh
 * \param[out] united the boundary of the union; unspecified if the report has a failure
 * \return a report with the outcome
 * \pre `mesh` consists of triangles, and has no garbage
 */
template <typename ConcurrencyTag = Parallel_if_available_tag>
Unite_report unite_parts(const United_mesh::Mesh& mesh, United_mesh& united);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/unite_parts_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_UNITE_PARTS_H
