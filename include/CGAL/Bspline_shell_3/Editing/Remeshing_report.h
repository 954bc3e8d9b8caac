// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_REMESHING_REPORT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_REMESHING_REPORT_H

#include <CGAL/Bspline_shell_3/Editing/Edit_report.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the report of a remeshing.
 */
struct Remeshing_report : Edit_report
{
  std::size_t splits = 0, collapses = 0, flips = 0, moves = 0; ///< number of operations of each kind
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_REMESHING_REPORT_H
