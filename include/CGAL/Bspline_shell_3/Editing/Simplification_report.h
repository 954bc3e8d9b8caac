// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFICATION_REPORT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFICATION_REPORT_H

#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief how the simplification of a mesh went.
 */
struct Simplification_report : Edit_report
{
  std::size_t selected = 0;  ///< edges that were considered, with those considered again
  std::size_t collapsed = 0; ///< with those of length zero
  std::size_t retried = 0;   ///< edges for which another place was accepted than the first one
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFICATION_REPORT_H
