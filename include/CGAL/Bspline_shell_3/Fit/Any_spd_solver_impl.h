// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_IMPL_H
#define CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_IMPL_H

#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/SparseCore>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
Solver_status Any_spd_solver::check(const Matrix& lower, const Vector& b, const Vector& x)
{
  constexpr double largest_residual = 0.1;
  if(x.size() != b.size()) return Solver_status::WRONG_SOLUTION;
  if(!x.allFinite()) return Solver_status::NOT_FINITE;
  const Vector residual = b - lower.selfadjointView<Eigen::Lower>() * x;
  return residual.norm() <= largest_residual * b.norm() ? Solver_status::SUCCESS : Solver_status::WRONG_SOLUTION;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_IMPL_H
