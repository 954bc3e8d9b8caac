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
/// how the proxy of a polygon soup represents a point of the soup
enum class Soup_point
{
  CARRIED,   ///< the point is in the shell, and is the first point of the soup visible from its image on the proxy
  CONTINUED, ///< the point is not in the shell; its image is the nearest point of the proxy, and is visible from it
  HIDDEN     ///< other parts of the soup are between the point and its image
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the shares of a soup's area that its proxy represents, estimated from samples.
 */
struct Soup_shares
{
  double carried = 0, continued = 0, hidden = 0; ///< fractions of the total area, by `Soup_point`
  std::vector<Soup_point> facets;                ///< values of most samples on the facets of the soup's mesh

  /// returns the carried fraction of the visible area
  double carried_of_visible() const { return carried + continued > 0 ? carried / (carried + continued) : 0; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_SHARES_H
