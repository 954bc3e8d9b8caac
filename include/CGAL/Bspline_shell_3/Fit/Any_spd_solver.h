// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H
#define CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <functional>
#include <memory>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief a type-erased reference to a model of `SPDSolver`, so that fits are compiled only once.
 *
 * Solutions are checked. The status is `Solver_status::WRONG_SOLUTION` if a solver returns `SUCCESS`, but its solution
 * has a wrong size, or the relative residual \f$|b - Ax| / |b|\f$ exceeds 1/10. No useful tolerance is larger: with a
 * residual of 1/10, at most one digit of the right-hand side is reproduced. A check takes about as long as one
 * iteration of conjugate gradients.
 *
 * \cgalModels `SPDSolver`
 */
class Any_spd_solver
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  /// \tparam Solver a model of `SPDSolver`
  /// \param solver the solver
  /// \param is_checked whether solutions are checked; `false` for solvers of this package, which compute their
  ///   residuals
  /// \pre `solver` outlives this object
  template <typename Solver>
  Any_spd_solver(Solver& solver, bool is_checked = true)
    : Any_spd_solver(solver, is_checked, std::make_shared<const Matrix*>(nullptr))
  {}
  Any_spd_solver(Any_spd_solver&) = default; // preferred over the template
  Any_spd_solver(const Any_spd_solver&) = default;

  /// \name Operations
  /// See `SPDSolver`.
  /// @{
  std::function<Solver_status(const Matrix& lower, const Unknown_blocks& blocks)> compute;
  std::function<Solver_status(const Vector& b, Vector& x)> solve;
  std::function<std::size_t()> iterations;
  std::function<double()> residual;
  /// @}

private:
  // `matrix` points to the last matrix, because both operations need it.
  template <typename Solver>
  Any_spd_solver(Solver& solver, bool is_checked, const std::shared_ptr<const Matrix*>& matrix)
    : compute([&solver, matrix](const Matrix& lower, const Unknown_blocks& blocks) {
        *matrix = &lower;
        return solver.compute(lower, blocks);
      }),
      solve([&solver, is_checked, matrix](const Vector& b, Vector& x) {
        const Solver_status status = solver.solve(b, x);
        return status == Solver_status::SUCCESS && is_checked ? check(**matrix, b, x) : status;
      }),
      iterations([&solver] { return std::size_t(solver.iterations()); }),
      residual([&solver] { return double(solver.residual()); })
  {}

  static Solver_status check(const Matrix& lower, const Vector& b, const Vector& x);
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_FIT_ANY_SPD_SOLVER_H
