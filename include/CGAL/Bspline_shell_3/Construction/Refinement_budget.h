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
 * \brief records the rounds of a refinement with their times, and checks whether the limits allow another round.
 */
class Refinement_budget
{
public:
  /// steps of a round, in the order of `Refinement_round::seconds`
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
  Refinement_round& round() { return m_rounds.back(); } ///< the current round
  /// begins a round; the time since the end of the last step is not counted
  Refinement_round& begin_round()
  {
    m_step.reset();
    m_rounds.emplace_back();
    return m_rounds.back();
  }

  /// adds to the number of fitted cells, for the limit of effort
  void add_fitted_cells(std::size_t cells) { m_fitted_cells += cells; }

  /// starts the timer
  void start() { m_step.start(); }
  /// ends a step of the current round, and begins the next step
  void end_step(Step step)
  {
    m_rounds.back().seconds[step] += m_step.time();
    m_step.reset();
  }

  /// returns whether the last round was partial and made no progress
  bool was_partial_round_stalled() const
  {
    const std::size_t n = m_rounds.size();
    if(n < 2 || !m_rounds[n - 1].partial) return false;
    const Refinement_round& now = m_rounds[n - 1];
    const Refinement_round& before = m_rounds[n - 2];
    if(now.examined != before.examined) return !now.examined;
    return now.undecided_cells + now.thick_cells >= before.undecided_cells + before.thick_cells;
  }

  /// returns the limit that a round with this number of cells would exceed, if there is one.
  /// \param points number of points, on all levels, at which the field of that round would have coefficients
  /// \param most_points largest number of points for which the equations can be numbered
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
  std::size_t m_fitted_cells = 0; // total of all rounds
  Real_timer m_step;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_BUDGET_H
