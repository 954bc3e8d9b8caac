// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CORRECTED_FIELD_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CORRECTED_FIELD_H

#include <CGAL/Bspline_shell_3/Construction/Examined_field.h>
#include <CGAL/Bspline_shell_3/Construction/Fitted_field.h>
#include <CGAL/Bspline_shell_3/Construction/Marked_cells.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_history.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/failing_facets.h>
#include <CGAL/Bspline_shell_3/Construction/fold_conditions.h>
#include <CGAL/Bspline_shell_3/Construction/slope_conditions.h>
#include <CGAL/Bspline_shell_3/Construction/slopes_at_gaps.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_enforcement.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief corrects the field of a round locally where its slope across facets is too small, or where |f| is too large on
 * the mesh (`Slope_enforcement`).
 */
template <typename ConcurrencyTag>
class Corrected_field
{
public:
  typedef Refinement_problem::Field Field;
  typedef Field::Cell_index Index;

  /// \pre the arguments outlive this object
  Corrected_field(Refinement_problem& problem, Fitted_field<ConcurrencyTag>& fitted,
                  Examined_field<ConcurrencyTag>& examined, Refinement_budget& budget)
    : m_problem(problem), m_tuning(problem.parameters.tuning), m_fitted(fitted), m_examined(examined), m_budget(budget)
  {}

  /// corrects the field until all conditions are met or corrections no longer help.
  /// \return `false` if too many conditions fail, which `facets_with_small_slopes()` then returns
  bool correct()
  {
    if(!m_enforcement) begin();
    for(;;) {
      switch(exchange_conditions()) {
        case Outcome::MENDED: return true;
        case Outcome::TOO_MUCH: return false;
        case Outcome::LESS_REQUIRED: begin();
      }
    }
  }

  /// adds conditions, and corrects the field
  bool correct(const std::vector<Slope_condition>& conditions)
  {
    m_at_obstacles.insert(m_at_obstacles.end(), conditions.begin(), conditions.end());
    m_enforcement->insert(conditions);
    return correct();
  }

  /// returns the facets across which the slope is still too small
  const std::vector<Sloping_facet>& facets_with_small_slopes() const { return m_sloping; }

  /// returns whether more cells are thick than corrections can handle
  bool are_many_thick() const
  {
    return m_examined.thick_cells().size()
           > (std::min)(m_tuning.most_thick_cells, m_fitted.cells_at_mesh() / m_tuning.thick_cells);
  }

private:
  enum class Outcome
  {
    MENDED,
    TOO_MUCH,
    LESS_REQUIRED
  };

  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  // returns the slope that is required across a facet in a cell
  double target_slope(Index c, std::uint32_t facet) const
  {
    return m_slope_limits.empty() ? m_problem.target_slopes[facet]
                                  : (std::min)(m_problem.target_slopes[facet], m_slope_limits[c]);
  }

  // returns the bound on |f| on the mesh at which corrections aim, in units of the width of root cells
  double largest_on_mesh(Index c) const
  {
    return m_tuning.size_aimed_at * m_problem.half_thickness(*m_fitted.field(), c) / m_fitted.width();
  }

  void begin()
  {
    m_enforcement.emplace(*m_fitted.field(), m_fitted.A(), m_fitted.b());
    const auto needs_conditions = [&](Index c) { return !m_fitted.part() || m_fitted.part()->cells[c]; };
    m_enforcement->insert(slope_conditions<ConcurrencyTag>(
      *m_fitted.field(), m_fitted.clipped(), [&](Index c, std::uint32_t facet) { return target_slope(c, facet); },
      needs_conditions, [&](Index c) { return largest_on_mesh(c); }));
    if(m_has_folds) {
      const std::vector<Slope_condition> at_folds = fold_conditions<ConcurrencyTag>(
        *m_fitted.field(), m_fitted.clipped(), [&](std::uint32_t facet) { return m_problem.is_at_fold(facet); },
        needs_conditions, m_problem.parameters.slope_fraction);
      m_has_folds = !at_folds.empty();
      m_enforcement->insert(at_folds);
    }
    std::vector<Slope_condition> conditions = m_at_obstacles;
    add_conditions_of_thick_cells(conditions);
    m_enforcement->insert(conditions);
  }

  // Adds a condition at the point of each thick cell where |f| is largest.
  void add_conditions_of_thick_cells(std::vector<Slope_condition>& conditions) const
  {
    for(const Thick_cell& t : m_examined.thick_cells())
      if(m_problem.target_slopes[t.facet] > 0)
        conditions.push_back({ t.cell, t.facet, m_fitted.field()->cell(t.cell).local_coordinates(t.point),
                               m_fitted.clipped().normal(t.facet), target_slope(t.cell, t.facet),
                               largest_on_mesh(t.cell) });
  }

  void add_conditions_of_sloping_facets(const std::vector<Facet_failure>& failures,
                                        std::vector<Slope_condition>& conditions) const
  {
    for(const Facet_failure& f : failures)
      if(can_be_corrected(f))
        conditions.push_back({ f.cell, f.facet, m_fitted.field()->cell(f.cell).local_coordinates(f.point),
                               m_fitted.clipped().normal(f.facet), target_slope(f.cell, f.facet) });
  }

  bool can_be_corrected(const Facet_failure& f) const
  {
    return f.cell != Field::npos && m_problem.target_slopes[f.facet] > 0;
  }

  // Alternates between corrections and new conditions at the places that still fail.
  Outcome exchange_conditions()
  {
    const std::size_t most_violated = (std::max)(m_tuning.least_violated_cells,
                                                 m_fitted.cells_at_mesh() / m_tuning.violated_cells);
    std::vector<Facet_failure> failures;
    m_sloping.clear();
    for(int exchange = 0;; ++exchange) {
      const Slope_report slopes = m_enforcement->template operator()<ConcurrencyTag>(m_fitted.x(), most_violated);
      if(exchange == 0) m_budget.round().sloping_cells = slopes.violated_before;
      m_budget.round().sloping_cells_left = slopes.violated_cells.size();
      if(!slopes.enforced) {
        if(std::exchange(m_has_folds, false)) { // the proof needs no conditions there
          if(slopes.patches > 0) m_examined.has_changed(m_fitted.update());
          return Outcome::LESS_REQUIRED;
        }
        if(slopes.patches == 0 && limit_slopes(slopes.violated_cells)) return Outcome::LESS_REQUIRED;
        for(std::size_t n = 0; n < slopes.violated_cells.size(); ++n)
          m_sloping.push_back({ slopes.violated_cells[n], slopes.violated_facets[n] });
        return Outcome::TOO_MUCH;
      }
      if(slopes.patches > 0) m_examined.has_changed(m_fitted.update());
      else if(exchange > 0) break;
      const std::size_t thick_before = m_examined.thick_cells().size();
      failures = m_examined.failing_facets();
      m_budget.end_step(Refinement_budget::SLOPES);
      m_examined.find_thick_cells(m_budget);
      const std::size_t thick = m_examined.thick_cells().size();
      if((thick == 0 && failures.empty()) || are_many_thick()) break;
      if(exchange + 1 == m_tuning.max_slope_exchanges) {
        if(!failures.empty() && (std::exchange(m_has_folds, false) || relax_slopes(slopes.violated_cells)))
          return Outcome::LESS_REQUIRED;
        break;
      }
      if(exchange > 0 && thick > m_tuning.few_thick_cells
         && double(thick) > m_tuning.thick_cells_left * double(thick_before))
        break;
      std::vector<Slope_condition> conditions;
      add_conditions_of_sloping_facets(failures, conditions);
      add_conditions_of_thick_cells(conditions);
      if(conditions.empty()) break;
      m_enforcement->insert(conditions);
    }
    m_budget.round().failing_facets = failures.size();
    for(const Facet_failure& f : failures)
      if(can_be_corrected(f)) m_sloping.push_back({ f.cell, f.facet });
    return Outcome::MENDED;
  }

  // Limits the slopes required in cells that contain a wall or gap narrower than the cell (`slopes_at_gaps()`). Returns
  // whether any slope was reduced.
  bool limit_slopes(const std::vector<Index>& cells)
  {
    if(!m_slope_limits.empty()) return false;
    const std::vector<double> limits = slopes_at_gaps<ConcurrencyTag>(m_fitted.field()->cells(), cells, m_problem.gap(),
                                                                      m_fitted.clipped());
    if(std::none_of(limits.begin(), limits.end(),
                    [&](double limit) { return limit < m_problem.parameters.slope_fraction; }))
      return false;
    m_slope_limits.assign(m_fitted.field()->number_of_cells(), unlimited);
    for(std::size_t n = 0; n < cells.size(); ++n) m_slope_limits[cells[n]] = limits[n];
    return true;
  }

  // If conditions contradict each other, reduces the slope required across all facets around to a fraction of the
  // smallest one: along a sharp fin, a field that is steep across one facet may not increase through the next facet.
  // Returns `false` if slopes were already reduced in this round.
  bool relax_slopes(const std::vector<Index>& cells)
  {
    if(!m_slope_limits.empty() || cells.empty()) return false;
    const Cell_hierarchy_3& all = m_fitted.field()->cells();
    std::vector<double> least(all.number_of_cells(), unlimited);
    for(const Clipped_mesh_3::Piece& piece : m_fitted.clipped().pieces())
      if(m_problem.target_slopes[piece.facet] > 0)
        least[piece.cell] = (std::min)(least[piece.cell], m_problem.target_slopes[piece.facet]);
    m_slope_limits.assign(all.number_of_cells(), unlimited);
    for(Index c : cells)
      visit_around(
        all, c, [&](Index n) { m_slope_limits[n] = (std::min)(m_slope_limits[n], m_tuning.relaxed_slope * least[c]); });
    return true;
  }

  Refinement_problem& m_problem;
  const Refinement_tuning& m_tuning;
  Fitted_field<ConcurrencyTag>& m_fitted;
  Examined_field<ConcurrencyTag>& m_examined;
  Refinement_budget& m_budget;
  std::optional<Slope_enforcement<Field> > m_enforcement;
  std::vector<Slope_condition> m_at_obstacles; // the added conditions
  bool m_has_folds = true;                     // whether conditions at folds are required, if there are folds
  std::vector<double> m_slope_limits;          // by cell; empty if no slope is limited
  std::vector<Sloping_facet> m_sloping;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CORRECTED_FIELD_H
