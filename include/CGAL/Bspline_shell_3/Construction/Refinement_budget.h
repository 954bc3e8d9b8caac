// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_BUDGET_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_BUDGET_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_limit.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>

#include <CGAL/Real_timer.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the rounds of a refinement with the time that they took, for reports; and whether the limits allow another
 * round.
 */
class Refinement_budget
{
public:
  /// of a round, in the order of `Refinement_round::seconds`
  enum Step
  {
    CELLS,
    DISTANCE,
    ASSEMBLY,
    SOLVER,
    SLOPES,
    BOUNDS,
    CERTIFICATE
  };

  explicit Refinement_budget(const Refinement_parameters& parameters) : m_parameters(parameters) {}

  const std::vector<Refinement_round>& rounds() const { return m_rounds; }
  Refinement_round& round() { return m_rounds.back(); } ///< the present one
  /// what time has passed since the last step belongs to none
  Refinement_round& begin_round()
  {
    m_step.reset();
    m_rounds.emplace_back();
    return m_rounds.back();
  }

  /// adds to the number of fitted cells, for the limit of effort
  void add_fitted_cells(std::size_t cells) { m_fitted_cells += cells; }

  /// time runs from now on
  void start() { m_step.start(); }
  /// a step of the present round has ended, and the next one begins
  void end_step(Step step)
  {
    m_rounds.back().seconds[step] += m_step.time();
    m_step.reset();
  }

  /// whether the last round was partial in vain
  bool was_part_in_vain() const
  {
    const std::size_t n = m_rounds.size();
    if(n < 2 || !m_rounds[n - 1].partial) return false;
    const Refinement_round& now = m_rounds[n - 1];
    const Refinement_round& before = m_rounds[n - 2];
    if(now.examined != before.examined) return !now.examined;
    return now.undecided_cells + now.thick_cells >= before.undecided_cells + before.thick_cells;
  }

  /// Returns the limit that a round with so many cells would exceed, if there is one.
  /// \param points at which the field of that round has coefficients, on all levels
  /// \param most_points that the numbering of equations can take
  Refinement_limit limit_of_round(std::size_t cells, double points, double most_points) const
  {
    Refinement_limit limit = { Refinement_resource::NONE, cells, 1600. * double(cells) + 4000. * points };
    if(!(limit.bytes <= m_parameters.max_bytes)) limit.resource = Refinement_resource::MEMORY;
    else if(points > most_points) limit.resource = Refinement_resource::NUMBERS;
    else if(!(double(m_fitted_cells) + double(cells) <= m_parameters.max_cells))
      limit.resource = Refinement_resource::EFFORT;
    return limit;
  }

private:
  Refinement_parameters m_parameters;
  std::vector<Refinement_round> m_rounds;
  std::size_t m_fitted_cells = 0; // in all rounds together
  Real_timer m_step;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_BUDGET_H
