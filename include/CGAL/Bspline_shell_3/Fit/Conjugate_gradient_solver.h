// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_CONJUGATE_GRADIENT_SOLVER_H
#define CGAL_BSPLINE_SHELL_3_FIT_CONJUGATE_GRADIENT_SOLVER_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Schwarz_preconditioner.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Symmetric_matrix.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <CGAL/tags.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <cstddef>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief conjugate gradients (of Eigen) with an additive Schwarz preconditioner; the default solver.
 *
 * The preconditioner solves on overlapping blocks of neighboring functions. Tens of iterations suffice, where a
 * diagonal preconditioner takes hundreds to thousands. With the default tolerance, the extrema of the field on the mesh
 * agree with those of a direct solve up to about 1 % of the shell's thickness. The result does not depend on the number
 * of threads.
 *
 * \cgalModels `SPDSolver`
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`
 * \cgalHeading{Memory} About as much as the matrix.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag>
class Conjugate_gradient_solver
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  /// \param tolerance relative residual \f$|b - Ax| / |b|\f$ at which the iteration stops
  /// \param max_iterations the largest number of iterations
  explicit Conjugate_gradient_solver(double tolerance = 1e-6, std::size_t max_iterations = 1000)
  {
    m_solver.setTolerance(tolerance);
    m_solver.setMaxIterations(Eigen::Index(max_iterations));
  }

  /// constructs a solver with the same limits, but without a matrix
  Conjugate_gradient_solver(const Conjugate_gradient_solver& other)
    : Conjugate_gradient_solver(other.m_solver.tolerance(), std::size_t(other.m_solver.maxIterations()))
  {}

  /// \param lower the lower triangle of the matrix, which must not change until the last `solve()`
  /// \param blocks blocks of the preconditioner; without blocks, it is the diagonal
  Solver_status compute(const Matrix& lower, const Unknown_blocks& blocks = Unknown_blocks())
  {
    m_matrix.emplace(lower);
    m_solver.preconditioner().set_blocks(&blocks);
    m_solver.compute(*m_matrix);
    m_solver.preconditioner().set_blocks(nullptr);
    return Solver_status::SUCCESS;
  }

  /// \param b the right-hand side
  /// \param[in,out] x the initial value of the iteration, then the solution
  Solver_status solve(const Vector& b, Vector& x)
  {
    x = m_solver.solveWithGuess(b, x).eval();
    m_iterations = std::size_t(m_solver.iterations());
    m_residual = m_solver.error();
    return m_solver.info() == Eigen::Success ? Solver_status::SUCCESS : Solver_status::NOT_CONVERGED;
  }

  std::size_t iterations() const { return m_iterations; } ///< iterations of the last `solve()`
  double residual() const { return m_residual; }          ///< relative residual of the last `solve()`

private:
  typedef internal::Symmetric_matrix<ConcurrencyTag> Symmetric_matrix;

  std::optional<Symmetric_matrix> m_matrix;
  Eigen::ConjugateGradient<Symmetric_matrix, Eigen::Lower | Eigen::Upper,
                           internal::Schwarz_preconditioner<ConcurrencyTag> >
    m_solver;
  std::size_t m_iterations = 0;
  double m_residual = 0;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_CONJUGATE_GRADIENT_SOLVER_H
