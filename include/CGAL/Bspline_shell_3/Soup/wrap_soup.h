// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_H

#include <CGAL/Bspline_shell_3/Soup/Proxy_report.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief makes a closed mesh around a polygon soup that is suitable for a certified shell: the result of
 * `CGAL::alpha_wrap_3()`, without singular vertices.
 *
 * Wraps of thin parts and around the rims of holes may have singular vertices. In this case, the wrap is repeated with
 * `alpha` and `offset` increased by 25 %, at most seven times.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \param soup the soup
 * \param alpha size of the cavities and gaps that the wrap enters, in the units of the coordinates
 * \param offset distance of the wrap's vertices from the soup, in the units of the coordinates
 * \param max_bytes approximate memory limit of a wrap
 * \param[out] wrap the mesh
 * \param[out] report the number of wraps, their time, and the final parameters
 * \return `EMPTY_MESH` if the soup has no triangles, `GRID_TOO_FINE` if the offset is too small for its coordinates,
 *   `MEMORY_LIMIT_EXCEEDED`; otherwise, the defect of the last wrap, or `SUCCESS`
 * \cgalHeading{Cost} Grows with the number of balls of radius `alpha` that cover the soup.
 */
template <typename ConcurrencyTag>
Shell_status wrap_soup(const Soup_mesh_3& soup, double alpha, double offset, double max_bytes, Soup_mesh_3::Mesh& wrap,
                       Proxy_report& report);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/wrap_soup_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WRAP_SOUP_H
