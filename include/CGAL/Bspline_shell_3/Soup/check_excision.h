// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_H
#define CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// the outcome of `check_excision()` or `check_replacement()`: the first condition that is violated
enum class Excision_status
{
  VALID,
  EQUAL_POINTS,       ///< two vertices have the same coordinates
  REPEATED_CORNER,    ///< a triangle has a repeated corner
  REPEATED_TRIANGLE,  ///< two triangles have the same corners
  NOT_MANIFOLD,       ///< an edge of the mesh has more than two facets, or a vertex has several fans
  NOT_ORIENTED,       ///< two facets of the mesh traverse their common edge in the same direction
  DIFFERENT_MESH,     ///< the facets of the mesh are not the kept triangles
  UNLISTED_PIN,       ///< an inner vertex or edge of the mesh belongs to an excised triangle, but is not listed
  DIFFERENT_BORDER,   ///< the border edges of the replacement are not those of the mesh
  MISSING_PIN,        ///< a pinned vertex or edge is not in the replacement
  COMMON_FACET,       ///< a facet of the replacement has the corners of an excised triangle
  COMMON_EDGE,        ///< an edge of the replacement belongs to an excised triangle, but not to the contact
  COMMON_COORDINATES, ///< a vertex of the replacement has the coordinates of an excised point, but is not in contact
  MOVED_TIP           ///< a truncated vertex belongs to the contact
};

/// \ingroup PkgBsplineShell3Soup
/// returns a sentence that describes the outcome
const char* message(Excision_status status);

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the outcome of a check, and what violates its condition.
 */
struct Excision_verdict
{
  Excision_status status = Excision_status::VALID;
  std::vector<std::size_t> triangles; ///< offending triangles of the soup, ascending
  /// offending vertices of the mesh that was checked, ascending; for an edge, both of its vertices
  std::vector<Excised_soup_3::Mesh::Vertex_index> vertices;

  explicit operator bool() const { return status == Excision_status::VALID; }
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief checks, exactly, that the excised triangles and the mesh of a soup have the properties that
 * \ref BsplineShell3Excision requires: they are a simplicial complex by vertex numbers, the mesh is an oriented
 * manifold of the kept triangles, and all inner simplices of the contact are pinned.
 *
 * \param truncated vertices of the mesh whose tips are truncated; none of them may belong to the contact
 */
Excision_verdict check_excision(const Excised_soup_3& soup,
                                const std::vector<Excised_soup_3::Mesh::Vertex_index>& truncated = {});

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief checks, exactly, that a mesh can replace the mesh of an excised soup. It must be an oriented manifold with the
 * same directed border and the same pins, bit for bit. It must have no other vertex, edge, or facet in common with the
 * excised triangles. Vertices are equal if they have equal coordinates.
 *
 * \param soup a valid excised soup (`check_excision()`)
 * \param mesh a triangle mesh without garbage
 */
Excision_verdict check_replacement(const Excised_soup_3& soup, const Excised_soup_3::Mesh& mesh);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Soup/check_excision_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_SOUP_CHECK_EXCISION_H
