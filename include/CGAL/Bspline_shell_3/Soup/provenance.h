// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_H
#define CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// how `certified_shell_of_soup_3()` changed a polygon
enum class Polygon_change : unsigned char
{
  NONE,           ///< it is part of the mesh, perhaps triangulated or reversed
  WELDED,         ///< it is part of the mesh, but corners were moved to other points, or sides were split at points
  DUPLICATE,      ///< it has the corners of an earlier polygon, which represents it
  NO_AREA,        ///< its corners are collinear, so it is not part of the mesh
  PARTLY_HIDDEN,  ///< parts of it are within a solid of the union, or overlap other polygons
  HIDDEN,         ///< all of it is
  PARTLY_EXCISED, ///< some of its triangles are excised
  EXCISED,        ///< all of its triangles are excised
  WRAPPED         ///< the mesh is a proxy, which encloses it
};

/// \ingroup PkgBsplineShell3Soup
/// returns the name that reports use
inline const char* name(Polygon_change change)
{
  switch(change) {
    case Polygon_change::NONE: return "unchanged";
    case Polygon_change::WELDED: return "welded";
    case Polygon_change::DUPLICATE: return "duplicate";
    case Polygon_change::NO_AREA: return "no area";
    case Polygon_change::PARTLY_HIDDEN: return "partly hidden";
    case Polygon_change::HIDDEN: return "hidden";
    case Polygon_change::PARTLY_EXCISED: return "partly excised";
    case Polygon_change::EXCISED: return "excised";
    case Polygon_change::WRAPPED: return "wrapped";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns how each polygon of a soup was changed. If several values apply, it is the last one.
 *
 * \param soup the soup
 * \param result the result of `certified_shell_of_soup_3(soup)`
 * \pre `result` has a shell
 */
std::vector<Polygon_change> provenance(const Polygon_soup& soup, const Shell_of_soup_3& result);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/provenance_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_PROVENANCE_H
