// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_FIT_FIELD_H
#define CGAL_BSPLINE_SHELL_3_FIT_FIT_FIELD_H

#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Shell/Fit_report.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <CGAL/Real_timer.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief minimizes the energy over the coefficients of a field.
 *
 * One linear system gives the minimum of the quadratic terms. If \f$E_{singularH}\f$ has a weight, damped Gauss-Newton
 * steps on \f$\int (\det H)^2 / \max(|\det H|, \eta)\f$ follow, over the shell of the first solution. Each step solves
 * one system, starting at the last solution, and does a line search on the energy itself. The steps end when the energy
 * decreases by less than 1 %, or after ten steps.
 *
 * \tparam Field a model of `FittableBsplineField_3`
 * \param energy the energy of `field`
 * \param solver any model of `SPDSolver`; it solves one linear system for each step
 * \param x initial value for iterative solvers, divided by the width of root cells (`Fit_energy::initial_guess()`)
 * \param[out] field receives the coefficients of the solution, unless the solver fails
 * \cgalHeading{Cost} Assembly takes time linear in the number of cells and of quadrature points, and an iteration of
 *   conjugate gradients in the number of unknowns.
 */
template <typename ConcurrencyTag, typename Field>
Fit_report fit_field(Field& field, Fit_energy<Field>& energy, const Any_spd_solver& solver, Eigen::VectorXd x)
{
  typedef typename Fit_energy<Field>::Vector Vector;
  typedef typename Fit_energy<Field>::Matrix Matrix;
  constexpr std::size_t max_steps = 10;
  constexpr double least_decrease = 1e-2;
  constexpr double eta = 1e-3; // smaller determinants are treated as zero: curvatures of 1/10 per cell

  Fit_report report;
  Real_timer timer;
  timer.start();
  Matrix A;
  Vector b;
  energy.template assemble<ConcurrencyTag>(A, b);
  report.seconds_assembly = timer.time();
  timer.reset();

  const Unknown_blocks blocks = overlapping_blocks(field);
  const auto solve = [&](const Matrix& matrix, const Vector& rhs, Vector& solution) {
    ++report.linear_solves;
    report.status = solver.compute(matrix, blocks);
    if(report.status == Solver_status::SUCCESS) report.status = solver.solve(rhs, solution);
    if(report.status == Solver_status::SUCCESS && !solution.allFinite()) report.status = Solver_status::NOT_FINITE;
    report.iterations += solver.iterations();
    report.residual = solver.residual();
    return report.status == Solver_status::SUCCESS;
  };
  const bool solved = solve(A, b, x);
  report.seconds_solver = timer.time();
  if(!solved) return report;

  if(energy.weight(Energy_term::SINGULAR_HESSIAN) > 0) {
    // The term is an integral over the shell, which moves with the field. If the domain moved in every step, the steps
    // would oscillate, so it remains the shell of the first solution.
    const std::pair<double, double> range = energy.range_on_mesh(x);
    energy.set_singular_hessian_domain(x, range.first, range.second);
    for(std::size_t step = 0; step < max_steps; ++step) {
      const double before = energy.template value<ConcurrencyTag>(x);
      Matrix step_matrix = A;
      Vector step_rhs = b;
      energy.template add_singular_hessian<ConcurrencyTag>(x, eta, step_matrix, step_rhs);
      Vector target = x;
      const bool step_solved = solve(step_matrix, step_rhs, target);
      report.seconds_solver = timer.time();
      if(!step_solved) return report;
      // The full step minimizes the model; the energy itself may require a shorter step.
      double length = 1, after = energy.template value<ConcurrencyTag>(target);
      while(after > before && length > 1e-3) {
        length /= 2;
        after = energy.template value<ConcurrencyTag>(Vector(x + length * (target - x)));
      }
      if(after < before) x += length * (target - x);
      if(!(before - after > least_decrease * before)) break;
    }
  }
  for(Energy_term term : { Energy_term::DISTANCE, Energy_term::SURFACE, Energy_term::ANGLE,
                           Energy_term::SINGULAR_HESSIAN, Energy_term::NORMAL, Energy_term::COEFFICIENTS })
    report.energy[std::size_t(term)] = energy.template value<ConcurrencyTag>(term, x);
  field.template set_coefficients<ConcurrencyTag>(x * field.cells().lattice().spacing());
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_FIT_FIELD_H
