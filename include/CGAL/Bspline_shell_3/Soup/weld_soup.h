// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Weld_report.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// how `weld_soup()` changed a polygon
enum class Weld_change : unsigned char
{
  NONE,
  MOVED, ///< corners were moved to other points of the soup
  SPLIT  ///< it is part of a polygon that was split at points of the soup; its corners may be moved, too
};

/// \ingroup PkgBsplineShell3Soup
/// the polygons from which the polygons of a welded soup were made
struct Weld_provenance
{
  std::vector<std::size_t> polygon_of; ///< original polygons of the polygons
  std::vector<Weld_change> change;     ///< how the polygons were changed
};

/// \ingroup PkgBsplineShell3Soup
/// the result of `weld_soup()`
struct Welded_soup
{
  Polygon_soup soup; ///< has the points of the original soup; if nothing was changed, also its polygons
  Weld_provenance provenance;
  Weld_report report;
};

/// \ingroup PkgBsplineShell3Soup
/// the distances that `weld_soup()` bridges
struct Weld_parameters
{
  double relative_thickness = 0.01; ///< thickness of the shell, as a fraction of the longest side of the bounding box
  std::optional<double> thickness;  ///< used instead of `relative_thickness`, in the units of the coordinates
  std::optional<double> tolerance;  ///< used instead of the default distance, in the units of the coordinates
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief closes the cracks between polygons whose corners were rounded to different points.
 *
 * Border vertices that are close to each other become one, namely the first of them. Then border edges are split at
 * border vertices that are close to them, together with their triangles. No point is created.
 *
 * *Close* means a distance of at most four units in which the coordinates are stored (`coordinate_unit()`). This
 * distance is reduced to 1/8 of the shortest edge of the adjacent polygons, and to 1/100 of the thickness. If the unit
 * is larger than 1/100 of the thickness, nothing is welded.
 *
 * A group of vertices, or a vertex and an edge, is left as it is
 * - if two vertices of the group are farther apart, even if each is close to others, or belong to one polygon;
 * - if no border edge would be closed, or an edge would have three polygons, or two of equal orientation;
 * - if the polygons at a vertex would not form one fan, or two polygons would have the same corners;
 * - if the normal of a facet would turn by 10 degrees or more;
 * - if facets of polygons that do not intersect in the soup would then intersect.
 *
 * \param soup the soup
 * \param parameters the distances
 * \return the welded soup. Points keep their indices. Polygons of more than three corners that change are triangulated.
 *   If nothing changes, it is the soup.
 * \pre `repair_soup()` returns neither `NOT_FINITE`, `COORDINATES_OUT_OF_RANGE`, nor `INVALID_PARAMETER`
 * \cgalHeading{Cost} That of sorting the polygons if there are no cracks; otherwise, that of finding the facets that
 *   intersect changed facets
 */
Welded_soup weld_soup(const Polygon_soup& soup, const Weld_parameters& parameters);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/weld_soup_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WELD_SOUP_H
