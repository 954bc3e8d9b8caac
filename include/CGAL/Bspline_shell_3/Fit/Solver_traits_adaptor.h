// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SOLVER_TRAITS_ADAPTOR_H
#define CGAL_BSPLINE_SHELL_3_FIT_SOLVER_TRAITS_ADAPTOR_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <optional>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief adapts the solver traits of \cgal, such as `Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix> >`.
 *
 * The traits receive a copy of the whole matrix, and for each right-hand side a new vector, for which they factorize
 * the matrix again. Every failure has the status `NOT_CONVERGED`, because traits give no reason. Copies may share the
 * solver of the traits, and must therefore be used by one thread at a time.
 *
 * \cgalModels `SPDSolver`
 *
 * \tparam SolverTraits a model of `SparseLinearAlgebraTraits_d` with `NT` = `double`
 */
template <typename SolverTraits>
class Solver_traits_adaptor
{
public:
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;

  static_assert(std::is_same<typename SolverTraits::NT, double>::value,
                "SolverTraits must have the number type double.");

  explicit Solver_traits_adaptor(const SolverTraits& traits = SolverTraits()) : m_traits(traits) {}

  /// constructs a solver without a matrix. It may share the solver of the traits, to which `Eigen_solver_traits` has a
  /// pointer.
  Solver_traits_adaptor(const Solver_traits_adaptor& other) : m_traits(other.m_traits) {}

  /// \param lower the lower triangle of the matrix, which must not change until the last `solve()`
  Solver_status compute(const Matrix& lower, const Unknown_blocks& = Unknown_blocks())
  {
    m_lower = &lower;
    m_matrix.emplace(int(lower.rows()));
    constexpr bool is_new = true;
    for(int column = 0; column < lower.outerSize(); ++column)
      for(Matrix::InnerIterator entry(lower, column); entry; ++entry) {
        const int row = int(entry.row());
        m_matrix->set_coef(row, column, entry.value(), is_new);
        if(row != column) m_matrix->set_coef(column, row, entry.value(), is_new);
      }
    return Solver_status::SUCCESS;
  }

  /// \param b the right-hand side
  /// \param[out] x the solution
  Solver_status solve(const Vector& b, Vector& x)
  {
    const int size = int(b.size());
    typename SolverTraits::Vector right(size), solution(size);
    for(int n = 0; n < size; ++n) right[n] = b[n];
    double denominator = 1; // used by homogeneous solutions
    if(!m_traits.linear_solver(*m_matrix, right, solution, denominator)) return Solver_status::NOT_CONVERGED;
    x.resize(size);
    for(int n = 0; n < size; ++n) x[n] = solution[n] / denominator;
    const double norm = b.norm();
    const Vector r = b - m_lower->selfadjointView<Eigen::Lower>() * x;
    m_residual = norm > 0 ? r.norm() / norm : 0;
    return Solver_status::SUCCESS;
  }

  std::size_t iterations() const { return 1; }   ///< one solve
  double residual() const { return m_residual; } ///< relative residual of the last `solve()`

private:
  SolverTraits m_traits;
  std::optional<typename SolverTraits::Matrix> m_matrix;
  const Matrix* m_lower = nullptr;
  double m_residual = 0;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SOLVER_TRAITS_ADAPTOR_H
