// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief what was changed to make a mesh of polygons.
 */
struct Soup_repairs
{
  std::size_t merged_points = 0;    ///< were at positions where other points are
  std::size_t removed_polygons = 0; ///< had fewer than three different points
  /// had a point twice, as polygons with holes have: they were triangulated, or lost the repetition
  std::size_t split_polygons = 0;
  std::size_t doubled_polygons = 0;  ///< had the points of another polygon
  std::size_t turned_polygons = 0;   ///< were turned round to agree with their neighbors
  std::size_t degenerate_facets = 0; ///< had no area: their edges were collapsed or flipped
  bool turned_components = false;    ///< components were turned inside out to bound a volume

  /// whether there was nothing to do
  bool is_none() const
  {
    return merged_points + removed_polygons + split_polygons + doubled_polygons + turned_polygons + degenerate_facets
             == 0
           && !turned_components;
  }
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief makes a triangle mesh of a polygon soup, if not much is missing: points at equal positions become one,
 * polygons without three points and doubles are removed, the others are turned round where they do not agree with their
 * neighbors, triangulated, and freed of those without an area.
 *
 * Nothing is filled, cut or moved.
 *
 * \param soup the soup
 * \param[out] mesh the mesh, if the status is `SUCCESS`; otherwise it is empty
 * \param[out] repairs what was done
 * \param[out] offenders positions of polygons and points of the soup that are to blame; of points at equal positions,
 *   the first
 * \return whether there is a mesh, or why there is none: `EMPTY_MESH`, `NON_MANIFOLD`, `NOT_ORIENTABLE`,
 *   `DEGENERATE_FACET`, or `NOT_FINITE`, `COORDINATES_OUT_OF_RANGE`, and `INVALID_PARAMETER` if a polygon refers to a
 *   point that does not exist
 */
Shell_status repair_soup(Polygon_soup soup, Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh,
                         Soup_repairs& repairs, Offending_simplices& offenders);
/// \ingroup PkgBsplineShell3Soup
/// turns components of a closed mesh without self-intersections inside out where they do not bound one volume together.
/// \return whether that was necessary, and possible
bool orient_components(Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/repair_soup_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_H
