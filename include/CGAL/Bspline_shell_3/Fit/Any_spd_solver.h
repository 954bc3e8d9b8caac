// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H
#define CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief a reference to any model of `SPDSolver`, so that fits are compiled once for all of them.
 *
 * \cgalModels `SPDSolver`
 */
class Any_spd_solver
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  /// \tparam Solver a model of `SPDSolver`
  /// \pre `solver` outlives this object
  template <typename Solver>
  Any_spd_solver(Solver& solver)
    : compute([&solver](const Matrix& lower, const Unknown_blocks& blocks) { return solver.compute(lower, blocks); }),
      solve([&solver](const Vector& b, Vector& x) { return solver.solve(b, x); }),
      iterations([&solver] { return std::size_t(solver.iterations()); }),
      residual([&solver] { return double(solver.residual()); })
  {}
  Any_spd_solver(Any_spd_solver&) = default;        // not the template
  Any_spd_solver(const Any_spd_solver&) = default;

  /// \name Operations
  /// as the concept has them
  /// @{
  std::function<Solver_status(const Matrix& lower, const Unknown_blocks& blocks)> compute;
  std::function<Solver_status(const Vector& b, Vector& x)> solve;
  std::function<std::size_t()> iterations;
  std::function<double()> residual;
  /// @}
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H
