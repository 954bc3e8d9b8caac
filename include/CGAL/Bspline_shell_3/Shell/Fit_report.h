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
 * \brief statistics of a fit.
 */
struct Fit_report
{
  Solver_status status = Solver_status::SUCCESS;
  std::size_t linear_solves = 0; ///< 1 plus the number of Gauss-Newton steps
  std::size_t iterations = 0;    ///< iterations of the linear solver, summed over all solves
  double residual = 0;           ///< relative residual of the last solve
  /// weighted terms at the solution, in cell units and in the order of `Energy_term`
  std::array<double, 6> energy = {};
  double seconds_assembly = 0;
  double seconds_solver = 0; ///< including the assembly of Gauss-Newton steps
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_FIT_REPORT_H
