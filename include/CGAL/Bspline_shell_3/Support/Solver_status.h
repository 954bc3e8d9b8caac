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

/// \ingroup PkgBsplineShell3Support
/// returns a sentence that describes the problem and a remedy
inline const char* message(Solver_status status)
{
  switch(status) {
    case Solver_status::SUCCESS: return "The linear system was solved.";
    case Solver_status::NOT_POSITIVE_DEFINITE:
      return "The matrix is not positive definite up to rounding: use an iterative solver (spd_solver), or other "
             "weights (energy_weights).";
    case Solver_status::NOT_CONVERGED:
      return "The linear solver did not reach its tolerance: loosen the tolerance, allow more iterations, or use a "
             "direct solver (spd_solver).";
    case Solver_status::OUT_OF_MEMORY:
      return "The factorization needs more memory, or larger integers, than available: lower the resolution, or use an "
             "iterative solver (spd_solver).";
    case Solver_status::NOT_FINITE:
      return "The solution of the linear system has infinite or NaN components: use another solver (spd_solver).";
    case Solver_status::WRONG_SOLUTION:
      return "The linear solver reported success, but its solution is wrong: repair it, or use another solver "
             "(spd_solver).";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_SOLVER_STATUS_H
