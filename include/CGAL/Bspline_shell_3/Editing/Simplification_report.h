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
 * \brief the report of a simplification.
 */
struct Simplification_report : Edit_report
{
  std::size_t selected = 0;  ///< edges that were considered; repetitions are counted
  std::size_t collapsed = 0; ///< including edges of length zero
  std::size_t retried = 0;   ///< edges for which the first placement was rejected and another one accepted
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFICATION_REPORT_H
