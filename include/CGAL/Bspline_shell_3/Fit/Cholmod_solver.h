// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_CHOLMOD_SOLVER_H
#define CGAL_BSPLINE_SHELL_3_FIT_CHOLMOD_SOLVER_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief supernodal Cholesky factorization with CHOLMOD, through Eigen.
 *
 * Solutions are exact up to rounding. For more than about ten thousand unknowns, it is much slower than the default
 * solver. A program that includes this header must be linked with CHOLMOD (SuiteSparse).
 *
 * \cgalModels `SPDSolver`
 */
class Cholmod_solver
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  Cholmod_solver()
  {
    m_solver.cholmod().print = 0; // otherwise, messages go to the standard output
  }

  /// constructs a solver without a matrix
  Cholmod_solver(const Cholmod_solver&) : Cholmod_solver() {}

  /// \param lower the lower triangle of the matrix, which must not change until the last `solve()`
  Solver_status compute(const Matrix& lower, const Unknown_blocks& = Unknown_blocks())
  {
    m_matrix = &lower;
    m_solver.analyzePattern(lower);
    // Without a symbolic factor, which Eigen does not check, factorize() would crash.
    if(m_solver.cholmod().status < CHOLMOD_OK) return Solver_status::OUT_OF_MEMORY;
    m_solver.factorize(lower);
    if(m_solver.cholmod().status < CHOLMOD_OK) return Solver_status::OUT_OF_MEMORY;
    return m_solver.info() == Eigen::Success ? Solver_status::SUCCESS : Solver_status::NOT_POSITIVE_DEFINITE;
  }

  /// \param b the right-hand side
  /// \param[out] x the solution
  Solver_status solve(const Vector& b, Vector& x)
  {
    x = m_solver.solve(b);
    if(m_solver.info() != Eigen::Success) return Solver_status::NOT_POSITIVE_DEFINITE;
    const double norm = b.norm();
    const Vector r = b - m_matrix->selfadjointView<Eigen::Lower>() * x;
    m_residual = norm > 0 ? r.norm() / norm : 0;
    return Solver_status::SUCCESS;
  }

  std::size_t iterations() const { return 1; }   ///< one solve
  double residual() const { return m_residual; } ///< relative residual of the last `solve()`

private:
  Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> m_solver;
  const Matrix* m_matrix = nullptr;
  double m_residual = 0;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_CHOLMOD_SOLVER_H
