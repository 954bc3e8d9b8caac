// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_H
#define CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_H

#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief points, and polygons as indices of points.
 */
struct Polygon_soup
{
  typedef std::vector<Exact_predicates_inexact_constructions_kernel::Point_3> Points;
  typedef std::vector<std::vector<std::size_t> > Polygons;
  Points points;
  Polygons polygons;
};

namespace internal {

// Returns `SUCCESS`, `EMPTY_MESH`, `NOT_FINITE`, or `COORDINATES_OUT_OF_RANGE`; `INVALID_PARAMETER` if a polygon refers
// to a point that does not exist.
Shell_status check_soup(const Polygon_soup& soup, Offending_simplices& offenders);
// Returns the first index of a point in a polygon that is too large.
// \pre `check_soup()` found such polygons
inline Invalid_parameter invalid_position(const Polygon_soup& soup, const Offending_simplices& offenders)
{
  Invalid_parameter invalid;
  for(std::size_t v : soup.polygons[offenders.facets.front()])
    invalid.check("polygons", double(v), { 0, double(soup.points.size()), true, false });
  return invalid;
}
// Merges points at equal positions. Returns the index of the first point of each group, ascending.
std::vector<std::size_t> merge_points(Polygon_soup& soup);
// Returns the triangles of a polygon that have a positive area, as positions of its corners in the polygon.
std::vector<std::array<std::size_t, 3> > triangles_of_polygon(const Polygon_soup& soup, std::size_t polygon);
// Reverses polygons for a consistent orientation, and counts the reversed polygons. On failure, `offenders` lists the
// elements that prevent the soup from being a mesh.
Shell_status orient_soup(Polygon_soup& soup, Offending_simplices& offenders, std::size_t& turned);
// Triangulates a soup that is a mesh; returns false if triangles would share edges that polygons do not share.
bool triangulate(Polygon_soup& soup);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_POLYGON_SOUP_H
