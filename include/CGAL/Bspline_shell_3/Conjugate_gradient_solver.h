// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONJUGATE_GRADIENT_SOLVER_H
#define CGAL_BSPLINE_SHELL_3_CONJUGATE_GRADIENT_SOLVER_H

#include <CGAL/Bspline_shell_3/Solver_status.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief conjugate gradients with a diagonal preconditioner (Eigen); the default solver.
 *
 * A fit needs few digits: with the default tolerance the extrema of the field on the mesh agree with those of a direct
 * solve to about 1 % of the thickness on meshes with creases, to 10 % on smooth ones, whose shells are the thinnest.
 *
 * \cgalModels `SPDSolver`
 */
class Conjugate_gradient_solver
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  /// \param tolerance relative residual \f$|b - Ax| / |b|\f$ at which the iteration stops
  /// \param max_iterations gives up after so many
  explicit Conjugate_gradient_solver(double tolerance = 1e-5, std::size_t max_iterations = 5000)
  {
    m_solver.setTolerance(tolerance);
    m_solver.setMaxIterations(Eigen::Index(max_iterations));
  }

  /// a copy has the same limits, but no matrix
  Conjugate_gradient_solver(const Conjugate_gradient_solver& other)
    : Conjugate_gradient_solver(other.m_solver.tolerance(), std::size_t(other.m_solver.maxIterations()))
  {}

  /// \param lower the lower triangle of the matrix, which must stay as it is until the last `solve()`
  Solver_status compute(const Matrix& lower)
  {
    m_solver.compute(lower);
    return Solver_status::SUCCESS;
  }

  /// \param b the right-hand side
  /// \param[in,out] x where the iteration starts, and the solution
  Solver_status solve(const Vector& b, Vector& x)
  {
    x = m_solver.solveWithGuess(b, x).eval();
    return m_solver.info() == Eigen::Success ? Solver_status::SUCCESS : Solver_status::NOT_CONVERGED;
  }

  std::size_t iterations() const { return std::size_t(m_solver.iterations()); }   ///< of the last `solve()`
  double residual() const { return m_solver.error(); }                            ///< of the last `solve()`, relative

private:
  Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::DiagonalPreconditioner<double> > m_solver;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONJUGATE_GRADIENT_SOLVER_H
