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
 * \brief the changes that were made to obtain a mesh from polygons.
 */
struct Soup_repairs
{
  std::size_t merged_points = 0;    ///< points merged into others at the same position
  std::size_t removed_polygons = 0; ///< polygons with fewer than three different points
  /// polygons with a repeated point, such as polygons with holes, which were triangulated, or from which the repetition
  /// was removed
  std::size_t split_polygons = 0;
  std::size_t duplicate_polygons = 0; ///< polygons with the points of another polygon
  std::size_t reversed_polygons = 0;  ///< polygons reversed to have the orientation of their neighbors
  std::size_t degenerate_facets = 0;  ///< facets without area, whose edges were collapsed or flipped
  bool reversed_components = false;   ///< whether components were reversed to bound a volume

  /// returns whether no change was made
  bool is_none() const
  {
    return merged_points + removed_polygons + split_polygons + duplicate_polygons + reversed_polygons
               + degenerate_facets
             == 0
           && !reversed_components;
  }
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief makes a triangle mesh from a polygon soup if small repairs suffice.
 *
 * Points at equal positions are merged. Polygons with fewer than three points and duplicate polygons are removed. The
 * others are oriented consistently and triangulated; triangles without area are removed. Nothing is filled, cut, or
 * moved.
 *
 * \param soup the soup
 * \param[out] mesh the mesh if the status is `SUCCESS`; otherwise empty
 * \param[out] repairs changes that were made
 * \param[out] offenders positions of the polygons and points of the soup that cause the failure; for points at equal
 *   positions, that of the first
 * \return `SUCCESS`, or the reason why there is no mesh: `EMPTY_MESH`, `NON_MANIFOLD`, `NOT_ORIENTABLE`,
 *   `DEGENERATE_FACET`, `NOT_FINITE`, `COORDINATES_OUT_OF_RANGE`, or `INVALID_PARAMETER` if a polygon refers to a point
 *   that does not exist
 */
Shell_status repair_soup(Polygon_soup soup, Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh,
                         Soup_repairs& repairs, Offending_simplices& offenders);
/// \ingroup PkgBsplineShell3Soup
/// reverses components of a closed mesh without self-intersections that do not bound one volume together
/// \return whether this was necessary and possible
bool orient_components(Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/repair_soup_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_H
