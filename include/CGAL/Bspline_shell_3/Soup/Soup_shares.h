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
/// what becomes of a point of a polygon soup on its way to the proxy
enum class Soup_point
{
  CARRIED,   ///< it is in the shell, and the first point of the soup that its image on the proxy sees
  CONTINUED, ///< it is not in the shell; its image is the nearest point of the proxy, and sees it
  HIDDEN     ///< other parts of the soup are between it and its image
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief which shares of a soup's area its proxy carries: estimates from samples.
 */
struct Soup_shares
{
  double carried = 0, continued = 0, hidden = 0; ///< of the whole area, by `Soup_point`
  std::vector<Soup_point> facets;                ///< what most samples of each facet of the soup's mesh are

  /// the share of what is visible that is carried
  double carried_of_visible() const { return carried + continued > 0 ? carried / (carried + continued) : 0; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_SOUP_SHARES_H
