// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/refined_coefficients.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Fit/Fitted_part.h>
#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Fit/solve_part.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the field of a round, the mesh clipped to its cells, and the linear system of the fit.
 *
 * A fit computes all coefficients, or only the coefficients that act on the cells split since the last round. Samples
 * of the signed distance are reused in cells that were not split.
 */
template <typename ConcurrencyTag>
class Fitted_field
{
public:
  typedef Refinement_problem::Field Field;
  typedef Field::Cell_index Index;
  typedef Fit_energy<Field>::Matrix Matrix;
  typedef Eigen::VectorXd Vector;

  /// \pre `problem` outlives this object
  explicit Fitted_field(const Refinement_problem& problem) : m_problem(problem) {}

  /// fits a field on new cells.
  /// \param may_be_partial whether to fit only the coefficients that act on split cells if there are few of them
  /// \param budget records sizes and times of the round
  /// \return the reason if the fit fails
  std::optional<Refinement_status> fit(Cell_hierarchy_3 cells, bool may_be_partial, Refinement_budget& budget)
  {
    release_equations();
    m_problem.start(Shell_step::DISTANCE);
    std::vector<Index> split;
    if(m_field) split = update_signed_distance<ConcurrencyTag>(m_problem.oracle, m_field->cells(), cells, m_samples);
    else m_samples = sample_signed_distance<ConcurrencyTag>(m_problem.oracle, cells);
    if(!std::all_of(m_samples.begin(), m_samples.end(), [](double d) { return std::isfinite(d); }))
      return Refinement_status::DISTANCE_NOT_FINITE;
    budget.end_step(Refinement_budget::DISTANCE);

    inherit_surface_factors(cells);
    const std::shared_ptr<Field> before = std::exchange(m_field, std::make_shared<Field>(std::move(cells)));
    budget.round().cells = m_field->number_of_cells();
    budget.round().unknowns = m_field->number_of_coefficients();
    budget.round().levels = m_field->number_of_levels();
    m_clipped.reset(); // frees memory before the next clipped mesh is built
    m_clipped.emplace(clip_mesh_to_cells<ConcurrencyTag>(*m_problem.input, m_field->cells()));
    const double largest_part = m_problem.parameters.tuning.largest_part * double(m_field->number_of_cells());
    m_part.reset();
    if(may_be_partial && double(split.size()) < largest_part) {
      m_part.emplace(*m_field, split);
      if(double(m_part->number_of_cells) > largest_part) m_part.reset();
    }
    budget.round().partial = bool(m_part);
    budget.add_fitted_cells(m_part ? m_part->number_of_cells : m_field->number_of_cells());
    budget.end_step(Refinement_budget::CELLS);

    m_problem.start(Shell_step::FIT);
    m_solved = m_part ? solve_near_split_cells(*before, budget) : solve_all(budget);
    budget.end_step(Refinement_budget::SOLVER);
    if(m_solved == Solver_status::SUCCESS && !m_x.allFinite()) m_solved = Solver_status::NOT_FINITE;
    if(m_solved != Solver_status::SUCCESS) return Refinement_status::SOLVER_FAILED;
    m_field->template set_coefficients<ConcurrencyTag>(m_x * width());
    return std::nullopt;
  }

  /// sets the field's coefficients to `x()`.
  /// \return the previous field
  Field update() { return std::exchange(*m_field, m_field->template with_coefficients<ConcurrencyTag>(m_x * width())); }

  /// increases the weight of the surface term in the given cells in later fits
  void increase_surface_weights(const std::vector<Index>& cells)
  {
    if(cells.empty()) return;
    m_surface_factors.resize(m_field->number_of_cells(), 1);
    for(Index c : cells) m_surface_factors[c] = float(m_problem.parameters.tuning.weight_near_obstacles);
  }

  /// frees the matrix
  void release_equations() { m_A = Matrix(); }

  const std::shared_ptr<Field>& field() const { return m_field; }
  const Clipped_mesh_3& clipped() const { return *m_clipped; } ///< the mesh, clipped to the cells
  std::size_t cells_at_mesh() const { return m_clipped->cells().size(); }
  const std::optional<Fitted_part>& part() const { return m_part; }     ///< the part that was fitted, in a partial fit
  Solver_status solver_status() const { return m_solved; }              ///< the outcome of the last fit
  double width() const { return m_field->cells().lattice().spacing(); } ///< width of root cells

  /// \name Linear system
  /// The fit minimizes \f$x^T A x - 2 b^T x\f$. Coefficients are in units of the width of root cells.
  /// @{
  const Matrix& A() const { return m_A; }
  const Vector& b() const { return m_b; }
  Vector& x() { return m_x; }
  /// @}

private:
  Fit_energy<Field> energy() const
  {
    Fit_energy<Field> energy(*m_field, m_samples, *m_clipped, m_problem.input->unit() / width(),
                             m_problem.parameters.weights);
    energy.set_surface_factors(m_surface_factors);
    return energy;
  }

  Solver_status solve_all(Refinement_budget& budget)
  {
    const Fit_energy<Field> energy = this->energy();
    energy.template assemble<ConcurrencyTag>(m_A, m_b);
    m_x = energy.template initial_guess<ConcurrencyTag>();
    budget.end_step(Refinement_budget::ASSEMBLY);
    const Solver_status solved = m_problem.solver.compute(m_A, overlapping_blocks(*m_field));
    return solved == Solver_status::SUCCESS ? m_problem.solver.solve(m_b, m_x) : solved;
  }

  Solver_status solve_near_split_cells(const Field& before, Refinement_budget& budget)
  {
    m_x = refined_coefficients(before, m_x, *m_field);
    energy().template assemble<ConcurrencyTag>(*m_part, m_x, m_A, m_b);
    budget.end_step(Refinement_budget::ASSEMBLY);
    return solve_part(m_problem.solver, m_A, m_b, m_part->coefficients, overlapping_blocks(*m_field), m_x);
  }

  void inherit_surface_factors(const Cell_hierarchy_3& cells)
  {
    if(m_surface_factors.empty()) return;
    std::vector<float> factors(cells.number_of_cells(), 1);
    for(Index c = 0; c < factors.size(); ++c) {
      const std::array<double, 3> corner = cells.corner(c);
      const double half = cells.width(c) / 2;
      const Index before = m_field->locate(Field::Point_3(corner[0] + half, corner[1] + half, corner[2] + half));
      if(before != Field::npos) factors[c] = m_surface_factors[before];
    }
    m_surface_factors.swap(factors);
  }

  const Refinement_problem& m_problem;
  std::shared_ptr<Field> m_field;
  std::vector<double> m_samples;
  std::optional<Clipped_mesh_3> m_clipped;
  std::optional<Fitted_part> m_part;
  Matrix m_A;
  Vector m_b, m_x;
  Solver_status m_solved = Solver_status::SUCCESS;
  std::vector<float> m_surface_factors; // by cell (`Fit_energy`); empty if all are 1
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H
