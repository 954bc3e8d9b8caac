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
 * \brief the rounds of a refinement with the time that they took, and what this says of the next one.
 */
class Refinement_budget
{
public:
  /// of a round, in the order of `Refinement_round::seconds`
  enum Step { CELLS, DISTANCE, ASSEMBLY, SOLVER, SLOPES, BOUNDS, CERTIFICATE };

  /// of a field
  struct Size
  {
    std::size_t cells;
    double points;      ///< at which there are coefficients, on all levels
  };

  explicit Refinement_budget(const Refinement_parameters& parameters) : m_parameters(parameters) {}

  const std::vector<Refinement_round>& rounds() const { return m_rounds; }
  Refinement_round& round() { return m_rounds.back(); }         ///< the present one
  Refinement_round& begin_round()
  {
    m_rounds.emplace_back();
    return m_rounds.back();
  }

  /// time runs from now on
  void start()
  {
    m_total.start();
    m_step.start();
  }
  /// what time has passed since the last step belongs to none
  void begin_step() { m_step.reset(); }
  /// a step of the present round has ended, and the next one begins
  void end_step(Step step)
  {
    m_rounds.back().seconds[step] += m_step.time();
    m_step.reset();
  }
  double seconds() const { return m_total.time(); }
  double seconds_left() const { return m_parameters.max_seconds - m_total.time(); }
  bool is_late() const { return m_total.time() > m_parameters.max_seconds; }

  /// whether the last round was partial in vain
  bool was_part_in_vain() const
  {
    const std::size_t n = m_rounds.size();
    if(n < 2 || !m_rounds[n-1].partial) return false;
    const Refinement_round& now = m_rounds[n-1];
    const Refinement_round& before = m_rounds[n-2];
    if(now.examined != before.examined) return !now.examined;
    return now.undecided_cells + now.thick_cells >= before.undecided_cells + before.thick_cells;
  }

  /// What a round with so many cells would have too little of: each cell takes as much memory and time as in the last round, and if thresholds were not
  /// chosen there, as much again for that as for the fit.
  /// \param now the last field
  /// \param may_be_partial whether the round may be, if it has few cells more
  /// \param most_points that the numbering of equations can take
  Refinement_limit limit_of_round(std::size_t cells, const Size& now, bool may_be_partial, double most_points) const
  {
    constexpr std::size_t many = 32;      // one more of so many
    const bool will_be_partial = may_be_partial && (cells - now.cells) * many < cells;
    auto round = m_rounds.rbegin();
    if(!will_be_partial)
      while(round->partial) ++round;
    const Refinement_round& last = *round;
    const double more = double(cells) / double(last.cells);
    double seconds = 0;
    for(double s : last.seconds) seconds += s;
    if(!last.examined) seconds += last.seconds[ASSEMBLY] + last.seconds[SOLVER];
    const double points = double(cells) / double(now.cells) * now.points;
    Refinement_limit limit = { Refinement_resource::NONE, cells, m_total.time() + more * seconds, 1600. * double(cells) + 4000. * points };
    if(!(limit.seconds <= m_parameters.max_seconds)) limit.resource = Refinement_resource::TIME;
    else if(!(limit.bytes <= m_parameters.max_bytes)) limit.resource = Refinement_resource::MEMORY;
    else if(points > most_points) limit.resource = Refinement_resource::NUMBERS;
    return limit;
  }

private:
  Refinement_parameters m_parameters;
  std::vector<Refinement_round> m_rounds;
  Real_timer m_total, m_step;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_BUDGET_H
