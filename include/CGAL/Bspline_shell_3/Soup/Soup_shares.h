// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_SOUP_SHARES_H
#define CGAL_BSPLINE_SHELL_3_SOUP_SOUP_SHARES_H

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// Relation of a point of a polygon soup to the proxy.
enum class Soup_point
{
  CARRIED,   ///< It is in the shell, and is the first point of the soup visible from its image on the proxy.
  CONTINUED, ///< It is not in the shell; its image is the nearest proxy point, and is visible from it.
  HIDDEN     ///< Other parts of the soup are between it and its image.
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief Shares of a soup's area that its proxy carries, estimated from samples.
 */
struct Soup_shares
{
  double carried = 0, continued = 0, hidden = 0; ///< Fractions of the total area, by `Soup_point`.
  std::vector<Soup_point> facets;                ///< By facet of the soup's mesh: the value of most samples.

  /// Returns the carried fraction of the visible area.
  double carried_of_visible() const { return carried + continued > 0 ? carried / (carried + continued) : 0; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_SHARES_H
