// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_FIT_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_FIT_REPORT_H

#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief how a fit went.
 */
struct Fit_report
{
  Solver_status status = Solver_status::SUCCESS;
  std::size_t linear_solves = 0; ///< one, and one for each Gauss-Newton step
  std::size_t iterations = 0;    ///< of the linear solver, all solves together
  double residual = 0;           ///< relative, of the last solve
  /// weighted terms at the solution, in cell units, in the order of `Energy_term`
  std::array<double, 6> energy = {};
  double seconds_assembly = 0;
  double seconds_solver = 0; ///< with the assembly of Gauss-Newton steps
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_FIT_REPORT_H
