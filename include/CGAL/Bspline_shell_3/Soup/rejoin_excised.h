// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the triangles of a mesh and the excised triangles of a soup, which the mesh completes.
 *
 * The vertices and facets of the mesh come first, in their order. The other points of excised triangles and the excised
 * triangles follow, in the order and orientation of `Excised_soup_3::soup()`.
 */
struct Rejoined_soup_3
{
  static constexpr std::size_t none = Excised_soup_3::none;

  /// the reason why the mesh does not complete the excised triangles, if any; everything else is then empty
  Excision_verdict verdict;
  Polygon_soup soup;                    ///< triangles
  std::size_t vertices = 0, facets = 0; ///< numbers of points and triangles that belong to the mesh
  /// by point: its position in `Excised_soup_3::soup()` if an excised triangle has it, bit for bit; otherwise `none`
  std::vector<std::size_t> excised_point;

  explicit operator bool() const { return bool(verdict); }
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief joins a mesh that replaces the mesh of an excised soup, such as the simplified mesh, with the excised
 * triangles.
 *
 * Let this mesh and the mesh of the soup be certified in the same shell. The map along integral curves, together with
 * the identity on excised triangles, is then one-to-one between the two soups: see \ref BsplineShell3Excision.
 *
 * \param soup a valid excised soup (`check_excision()`)
 * \param mesh a mesh without garbage, which is checked (`check_replacement()`)
 */
Rejoined_soup_3 rejoin_excised(const Excised_soup_3& soup, const Excised_soup_3::Mesh& mesh);

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns, exactly, the number of pairs of a facet of the mesh and an excised triangle that meet outside of
 * common vertices and edges. Excised triangles without area are not counted.
 *
 * \cgalHeading{Cost} As for self-intersections of a mesh.
 */
std::size_t number_of_contacts(const Rejoined_soup_3& rejoined);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_H
