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
 * \brief makes a closed mesh around a polygon soup that a certified shell can be built for: `CGAL::alpha_wrap_3()`,
 * without singular vertices.
 *
 * Wraps of thin parts and around the rims of holes may have vertices whose facets face no common direction. Then the
 * wrap is made again, with `alpha` and `offset` larger by a quarter, until eight were made.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \param soup the soup
 * \param alpha the size of the cavities and gaps that the wrap enters, user units
 * \param offset how far the wrap's vertices are from the soup, user units
 * \param max_bytes that a wrap may take, about
 * \param[out] wrap the mesh
 * \param[out] report what was needed
 * \return `EMPTY_MESH` if the soup has no triangle, `GRID_TOO_FINE` if the offset is too small for its coordinates,
 *   `MEMORY_LIMIT_EXCEEDED`; otherwise what is wrong with the last wrap that was tried, or `SUCCESS`
 * \cgalHeading{Cost} grows with the number of balls of radius `alpha` that cover the soup
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
