// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_UNITED_MESH_H
#define CGAL_BSPLINE_SHELL_3_SOUP_UNITED_MESH_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the boundary of the union of a mesh's parts, with the origin of each facet.
 *
 * Each facet lies in one facet of the input, its *source*, up to the rounding of coordinates. Facets are in the order
 * of their sources. Vertices of the input precede new ones, and keep their order and coordinates.
 */
struct United_mesh
{
  typedef Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3> Mesh;
  typedef std::array<double, 3> Barycentric;
  /// barycentric coordinates of the corners `source(h)`, `target(h)`, and `target(next(h))` of a facet with halfedge
  /// `h`. They refer to the corners of the source in the same order.
  typedef std::array<Barycentric, 3> Corners;

  Mesh mesh;
  std::vector<std::size_t> source; ///< by facet: position in `faces(input)`
  /// by facet. A vertex has the same coordinates in all facets with the same source. On an edge of the input, it also
  /// has the same coordinates in both sources, except that these may list them in different orders.
  std::vector<Corners> corners;
  /// by facet of the input: the fraction of its area that contributes nothing to the result. It is 1 if and only if the
  /// facet is not a source, and 0 if and only if all of the facet is in the result, perhaps in parts.
  std::vector<double> hidden_share;
  /// pairs of facets of the input that overlap, and face the same side. The result contains one copy of the overlap.
  /// One of both facets is its source; in the other one, the overlap counts as hidden.
  std::vector<std::pair<std::size_t, std::size_t> > coplanar_pairs;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_UNITED_MESH_H
