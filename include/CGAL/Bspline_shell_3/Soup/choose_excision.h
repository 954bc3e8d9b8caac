// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_H
#define CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// the requirements that the mesh of an excised soup meets
struct Excision_parameters
{
  /// Vertices on the border, and pins, have at least this cone margin. The closing adds facets to the fan of a border
  /// vertex, which reduces its margin. A default of 0.1 leaves room for this reduction.
  double least_cone_margin = 0.1;
  /// A piece that excision separates is excised as well if its area is less than this fraction of the area of the
  /// largest piece of its component. Otherwise, each small piece would need its own closing.
  double largest_fragment = 0.01;
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns the different triangles of a polygon soup. Points at equal positions are merged, and polygons are
 * triangulated. Triangles with fewer than three different corners are left out; triangles without area are not.
 *
 * \pre coordinates are finite, and polygons refer only to points of the soup
 */
Soup_triangles different_triangles(Polygon_soup soup);

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief excises triangles of small total area, so that the others form an oriented manifold mesh without
 * self-intersections. Its border can be closed at each vertex.
 *
 * Triangles are excised, in this order,
 * - if they have no area;
 * - if they intersect others (one of each two triangles, preferably the one with fewer neighbors);
 * - at edges with more than two triangles (all but two);
 * - at edges where orientations contradict each other (the smaller triangle);
 * - at vertices with several fans (all but that of the largest piece);
 * - at border vertices and pins whose cone margin is too small;
 * - in small pieces that are no longer connected to their component.
 *
 * Components without such defects are kept.
 *
 * \param soup the triangles, as returned by `different_triangles()`
 * \cgalHeading{Cost} That of finding all pairs of triangles that intersect
 */
Excised_soup_3 choose_excision(Soup_triangles soup, const Excision_parameters& parameters = {});

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief excises further triangles, and then those at vertices and in pieces that are defective without them.
 *
 * \param soup a result of `choose_excision()` or of this function
 * \param triangles triangles to excise
 * \param reason their reason
 */
Excised_soup_3 excise_also(const Excised_soup_3& soup, const std::vector<std::size_t>& triangles,
                           Excision_reason reason, const Excision_parameters& parameters = {});

/// \ingroup PkgBsplineShell3Soup
/// reverses the given facets of the mesh of an excised soup, which are whole connected components
Excised_soup_3 reverse_facets(const Excised_soup_3& soup, const std::vector<Excised_soup_3::Mesh::Face_index>& facets);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/choose_excision_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_CHOOSE_EXCISION_H
