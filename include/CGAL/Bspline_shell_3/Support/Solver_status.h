// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_SOLVER_STATUS_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_SOLVER_STATUS_H

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Support
/// the outcome of solving a linear system
enum class Solver_status
{
  SUCCESS,
  NOT_POSITIVE_DEFINITE, ///< the factorization broke down
  NOT_CONVERGED,         ///< the iteration limit was reached before the tolerance
  OUT_OF_MEMORY,         ///< the factorization needs more memory, or larger integers, than available
  NOT_FINITE,            ///< the solution has infinite or NaN components
  WRONG_SOLUTION         ///< the solver returned `SUCCESS` and a wrong solution (`Any_spd_solver`)
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_SOLVER_STATUS_H
