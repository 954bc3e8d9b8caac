// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

inline constexpr double near_duplicate_distance = 1e-6; ///< fraction of the box size

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns the number of points that differ from another point by less than `near_duplicate_distance` in each
 * coordinate.
 *
 * Points at equal positions count as one point.
 *
 * \pre coordinates are finite
 * \cgalHeading{Cost} That of sorting the points.
 */
std::size_t number_of_near_duplicates(Polygon_soup::Points points);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/near_duplicates_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_NEAR_DUPLICATES_H
