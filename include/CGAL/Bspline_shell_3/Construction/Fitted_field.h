// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Construction/Weights_at_gaps.h>
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
 * A fit computes all coefficients, or only the coefficients that act on cells with new samples or weights. Samples of
 * the signed distance are reused in cells that were not split.
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
  explicit Fitted_field(Refinement_problem& problem) : m_problem(problem) {}

  /// fits a field on new cells, or on the same cells with new weights.
  /// \param may_be_partial whether to fit only the coefficients that act on changed cells if there are few of them
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

    const std::shared_ptr<Field> before = std::exchange(m_field, std::make_shared<Field>(std::move(cells)));
    budget.round().cells = m_field->number_of_cells();
    budget.round().unknowns = m_field->number_of_coefficients();
    budget.round().levels = m_field->number_of_levels();
    m_clipped.reset(); // frees memory before the next clipped mesh is built
    m_clipped.emplace(clip_mesh_to_cells<ConcurrencyTag>(*m_problem.input, m_field->cells()));
    const double largest_part = m_problem.parameters.tuning.largest_part * double(m_field->number_of_cells());
    m_part.reset();
    if(!m_weights.factors().empty()) {
      if(before->number_of_cells() != m_field->number_of_cells())
        m_weights.refine(before->cells(), m_field->cells(), *m_clipped, m_problem.gap());
      for(Index c : std::exchange(m_reweighed, {})) {
        const Index now = m_field->cells().leaf(before->cells().level(c), before->cells().lattice_point(c));
        if(now != Field::npos) split.push_back(now);
      }
    }
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

  /// increases the weight of the surface term in later fits, in the gaps that contain given cells (`Weights_at_gaps`).
  /// \return whether the weight of a cell increases
  bool weigh_gaps(const std::vector<Index>& cells)
  {
    if(cells.empty()) return false;
    m_reweighed = m_weights.add(m_field->cells(), *m_clipped, m_problem.gap(), cells);
    return !m_reweighed.empty();
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
    energy.set_surface_factors(m_weights.factors());
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

  Refinement_problem& m_problem;
  std::shared_ptr<Field> m_field;
  std::vector<double> m_samples;
  std::optional<Clipped_mesh_3> m_clipped;
  std::optional<Fitted_part> m_part;
  Matrix m_A;
  Vector m_b, m_x;
  Solver_status m_solved = Solver_status::SUCCESS;
  Weights_at_gaps<ConcurrencyTag> m_weights;
  std::vector<Index> m_reweighed; // cells whose weight has changed since the last fit
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_FITTED_FIELD_H
