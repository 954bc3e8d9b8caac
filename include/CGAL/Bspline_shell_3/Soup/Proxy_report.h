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
 * \brief how the proxy of a polygon soup was made.
 */
struct Proxy_report
{
  double alpha = 0;        ///< of the wrap, user units
  double offset = 0;       ///< of its vertices from the soup, user units
  std::size_t wraps = 0;   ///< how many were made, each coarser than the one before, until one had no singular vertex
  double wrap_seconds = 0; ///< that they took
  bool is_thicker_than_asked = false; ///< whether the shell exceeds the thickness parameter, to reach the soup
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_PROXY_REPORT_H
