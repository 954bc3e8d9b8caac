// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_PROXY_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_PROXY_REPORT_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a report on the construction of a proxy for a polygon soup.
 */
struct Proxy_report
{
  double alpha = 0;        ///< alpha of the wrap, in the units of the coordinates
  double offset = 0;       ///< distance of its vertices from the soup, in the units of the coordinates
  std::size_t wraps = 0;   ///< number of wraps, each coarser than the last, until one had no singular vertex
  double wrap_seconds = 0; ///< time for all wraps, in seconds
  /// whether the shell exceeds the thickness parameter in order to reach the soup
  bool exceeds_requested_thickness = false;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_PROXY_REPORT_H
