// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Construction/Examined_field.h>
#include <CGAL/Bspline_shell_3/Construction/Fitted_field.h>
#include <CGAL/Bspline_shell_3/Construction/Corrected_field.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Narrowed_thresholds.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_history.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include <CGAL/Bspline_shell_3/Construction/Weights_at_gaps.h>
#include <CGAL/Bspline_shell_3/Construction/common_direction.h>
#include <CGAL/Bspline_shell_3/Construction/plan_refinement.h>
#include <CGAL/Bspline_shell_3/Construction/refine_at_gaps.h>
#include <CGAL/Bspline_shell_3/Construction/refinement_obstacles.h>
#include <CGAL/Bspline_shell_3/Construction/thickness_on_mesh.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_limit.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief splits cells and fits the field again, in rounds, until the shell is certified, no progress is made, or a
 * limit is reached.
 *
 * A round consists of these steps:
 * - `Fitted_field` fits the field on the current cells.
 * - `Corrected_field` corrects the field if few cells fail. A cell fails if the slope on a facet is too small, or if
 *   |f| on the mesh exceeds half the thickness there (a *thick* cell).
 * - `Narrowed_thresholds` chooses thresholds between the values of f on the mesh and the values at possible critical
 *   points. An *obstacle* is a place where there is no room between the two. If there are few obstacles, the field is
 *   corrected there again.
 * - If nothing fails, `Shell_certificate_3` examines the claims.
 * - Unless all claims are proved, `plan_refinement()` chooses the cells to split. At flat walls and gaps, the field is
 *   first fitted again with larger weights (`Weights_at_gaps`).
 *
 * When refinement ends without a proof, the certificate examines the last field as well, so that the report contains
 * verdicts and witnesses.
 *
 * A round is *partial* if few cells were split or have a new weight: it fits only the coefficients that act on them,
 * and examines only the cells where the field changes (`Examined_field`). After a partial round without progress, or a
 * correction that was not completed, the next round is full.
 */
template <typename ConcurrencyTag>
class Certified_refinement
{
public:
  typedef Refinement_problem::Field Field;
  typedef Spline_threshold<Field> Threshold;
  typedef Shell_certificate_3<Field, Threshold> Certificate;

  /// \pre `problem` outlives this object
  explicit Certified_refinement(Refinement_problem& problem)
    : m_problem(problem), m_tuning(problem.parameters.tuning), m_fitted(problem), m_examined(problem, m_fitted),
      m_history(problem.target_slopes.size(), problem.parameters.tuning), m_budget(problem.parameters)
  {}

  /// refines the cells until the shell is certified or refinement ends; returns the reason
  /// \param cells the initial cells; they contain the mesh
  Refinement_status operator()(Cell_hierarchy_3 cells)
  {
    m_budget.start();
    for(std::size_t round = 1;; ++round) {
      const std::optional<Refinement_status> failure = fit(std::move(cells));
      if(failure) return *failure;
      Round_findings found = correct_and_choose_thresholds();
      if(m_examined.thresholds().are_chosen() && plan(found).is_empty() && certify(found))
        return Refinement_status::CERTIFIED;

      const Refinement_plan next = plan(found); // again, because `certify()` may add cells to `found`
      m_budget.round().marked_cells = next.split.size();
      const bool is_stalled = next.is_empty() || m_history.is_stalled();
      if(!is_stalled) {
        cells = refined_cells(next);
        m_limit = limit_of_round(cells.number_of_cells()); // before equations are allocated
        if(round >= m_problem.parameters.max_rounds) m_limit.resource = Refinement_resource::ROUNDS;
      }
      if(is_stalled || m_limit.resource != Refinement_resource::NONE) {
        certify_last_field(found);
        return is_stalled ? Refinement_status::NO_PROGRESS : Refinement_status::LIMIT_REACHED;
      }
    }
  }

  const std::vector<Refinement_round>& rounds() const { return m_budget.rounds(); }
  /// returns the limit that ended the refinement, if there is one
  const Refinement_limit& limit() const { return m_limit; }
  Solver_status solver_status() const { return m_fitted.solver_status(); }
  std::shared_ptr<const Field> field() const { return m_fitted.field(); }
  /// returns the certificate of the last field, which refers to `field()`; none if the fit failed
  const std::optional<Certificate>& certificate() const { return m_certificate; }
  const Threshold& inner() const { return m_examined.thresholds().inner(); }
  const Threshold& outer() const { return m_examined.thresholds().outer(); }
  /// returns enclosures of the last field on each triangle
  std::vector<Level_range> facet_ranges() const { return m_examined.facet_ranges(); }

  /// returns the places where the proof failed in the last round, narrowest first: obstacles to thresholds, and
  /// witnesses of the certificate
  /// \pre the refinement ended with `CERTIFIED`, `NO_PROGRESS`, or `LIMIT_REACHED`
  std::vector<Refinement_obstacle> obstacles();

  /// returns the thickness of the shell of the last field
  Thickness_on_mesh thickness_on_mesh() const
  {
    return Bspline_shells::thickness_on_mesh(m_fitted.clipped(), inner(), outer(),
                                             [&](Index c) { return 2 * m_problem.half_thickness(*field(), c); });
  }

private:
  typedef Field::Cell_index Index;
  typedef Corrected_field<ConcurrencyTag> Corrected;

  std::optional<Refinement_status> fit(Cell_hierarchy_3 cells)
  {
    const bool may_be_partial = m_is_corrected && !m_budget.was_partial_round_stalled();
    const std::shared_ptr<const Field> before = field();
    m_budget.begin_round();
    m_certificate.reset();
    const std::optional<Refinement_status> failure = m_fitted.fit(std::move(cells), may_be_partial, m_budget);
    if(failure) return failure;
    if(m_fitted.part()) m_examined.update_after_refinement(*before);
    else m_examined.reset(before.get(), m_history.are_gaps_narrow());
    return std::nullopt;
  }

  // corrects the field, chooses thresholds, and returns the cells that still fail
  Round_findings correct_and_choose_thresholds()
  {
    Round_findings found;
    Corrected corrected(m_problem, m_fitted, m_examined, m_budget);
    m_problem.start(Shell_step::BOUNDS);
    m_examined.find_thick_cells(m_budget);
    if(m_examined.thick_cells().size() > m_fitted.cells_at_mesh() / m_tuning.many_thick_at_first)
      found.thick_at_first = nearly_thick_cells();
    m_is_corrected = !corrected.are_many_thick() && corrected.correct();
    m_budget.end_step(Refinement_budget::SLOPES);
    record_failures(corrected, found);
    if(m_is_corrected && !found.are_many_thick) {
      m_problem.start(Shell_step::CERTIFICATE);
      choose_thresholds(corrected, found);
      m_budget.end_step(Refinement_budget::CERTIFICATE);
      m_history.add_round(m_budget.round(), m_examined.thresholds().undecided_volume());
    }
    m_history.add_refinements(corrected.facets_with_small_slopes());
    // Along a fold, thick cells become more with each round until they are so small that none is thick.
    if(found.are_many_thick || !found.thick.empty()) m_history.add_failing_cells(0, 0);
    else record_failing_cells(corrected, found);
    return found;
  }

  // records the cells that fail after corrections
  void record_failures(const Corrected& corrected, Round_findings& found) const
  {
    found.cells_with_small_slopes = m_history.cells_worth_refining(corrected.facets_with_small_slopes());
    found.are_many_thick = corrected.are_many_thick();
    found.thick.clear();
    if(m_is_corrected || found.are_many_thick)
      for(const Thick_cell& t : m_examined.thick_cells()) found.thick.push_back(t.cell);
  }

  // records how many cells fail, and how many of them contain facets at folds
  void record_failing_cells(const Corrected& corrected, const Round_findings& found)
  {
    std::vector<Index> failing = cells_of(found.obstacles);
    for(const Sloping_facet& f : corrected.facets_with_small_slopes()) failing.push_back(f.cell);
    if(failing.empty()) return m_history.add_failing_cells(0, 0);
    sort_unique(failing);
    std::vector<char> is_at_fold(field()->number_of_cells(), 0);
    for(const Clipped_mesh_3::Piece& piece : m_fitted.clipped().pieces())
      if(m_problem.is_at_fold(piece.facet)) is_at_fold[piece.cell] = 1;
    const auto at_folds = std::count_if(failing.begin(), failing.end(), [&](Index c) { return is_at_fold[c]; });
    m_history.add_failing_cells(failing.size(), std::size_t(at_folds));
  }

  // Returns the cells that are thick or nearly thick; the latter are often thick in the next round.
  std::vector<Index> nearly_thick_cells()
  {
    const std::vector<Level_range>& ranges = m_examined.ranges(Mesh_ranges::SHARP);
    std::vector<Index> cells;
    for(Index c = 0; c < ranges.size(); ++c)
      if(ranges[c].largest_size() > m_tuning.nearly_thick * m_problem.half_thickness(*field(), c)) cells.push_back(c);
    return cells;
  }

  // Chooses thresholds. If few obstacles remain, the field is corrected. It then increases there along a direction at
  // less than 90 degrees to the normals of all facets nearby.
  void choose_thresholds(Corrected& corrected, Round_findings& found)
  {
    m_examined.thresholds().begin(*field(), m_problem.thickness);
    std::vector<Threshold_obstacle> obstacles = choose_thresholds(Narrowing_limits().max_passes);
    std::size_t cells = cells_of(obstacles).size();
    double most = double(many_obstacles(m_fitted.cells_at_mesh(), m_tuning));
    for(int exchange = 0; exchange < m_tuning.max_obstacle_exchanges && cells > 0 && double(cells) <= most;
        ++exchange) {
      if(!plan(found).split.empty()) break;
      const double few = double(m_tuning.few_obstacles_left);
      most = (std::min)({ most, double(cells), (std::max)(few, m_tuning.obstacles_left * double(cells)) });
      const std::vector<Slope_condition> conditions = conditions_at(obstacles);
      if(conditions.empty()) break;
      m_budget.end_step(Refinement_budget::CERTIFICATE);
      m_is_corrected = corrected.correct(conditions);
      m_budget.end_step(Refinement_budget::SLOPES);
      record_failures(corrected, found);
      if(!m_is_corrected || !plan(found).split.empty()) break;
      obstacles = choose_thresholds(Narrowing_limits().max_passes);
      cells = cells_of(obstacles).size();
    }
    m_budget.round().undecided_cells = obstacles.size();
    found.kind = m_history.kind_of_obstacles(cells, m_fitted.cells_at_mesh(), !found.thick_at_first.empty());
    if(cells > m_tuning.few_obstacles && weigh_gaps(obstacles)) found.kind = Obstacle_kind::WEIGHED_GAPS;
    if(found.kind == Obstacle_kind::NARROW_GAPS) find_causing_cells(obstacles, found);
    found.obstacles = std::move(obstacles);
  }

  // Chooses thresholds. Returns the obstacles that they cannot exclude, because |f| on the mesh is too large there.
  std::vector<Threshold_obstacle> choose_thresholds(int max_passes)
  {
    m_budget.round().examined = true;
    return m_examined.choose_thresholds({ max_passes, many_obstacles(m_fitted.cells_at_mesh(), m_tuning) });
  }

  std::vector<Slope_condition> conditions_at(const std::vector<Threshold_obstacle>& obstacles) const
  {
    std::vector<Any_signed_distance_3::Point_3> points;
    for(const Threshold_obstacle& o : obstacles) points.emplace_back(o.point[0], o.point[1], o.point[2]);
    std::vector<double> distances(points.size());
    m_problem.oracle(points, distances.data());
    std::vector<Slope_condition> conditions;
    for(std::size_t n = 0; n < obstacles.size(); ++n) {
      const auto condition = common_slope(*field(), m_fitted.clipped(), obstacles[n].cell, obstacles[n].point,
                                          std::abs(distances[n]), m_problem.parameters.slope_fraction);
      if(condition) conditions.push_back(*condition);
    }
    return conditions;
  }

  // Increases weights in the gaps where they are expected to remove the obstacles. Returns whether there are any.
  bool weigh_gaps(const std::vector<Threshold_obstacle>& obstacles)
  {
    return m_fitted.weigh_gaps(weighable_cells<ConcurrencyTag>(*field(), m_fitted.clipped(), m_problem.gap(),
                                                               m_examined.ranges(Mesh_ranges::SHARP), obstacles,
                                                               m_tuning.most_at_obstacles));
  }

  // Finds the cells where |f| on the mesh is so large that little or no room is left for a threshold between the mesh
  // and an obstacle.
  void find_causing_cells(const std::vector<Threshold_obstacle>& obstacles, Round_findings& found)
  {
    std::vector<Threshold_obstacle> places = m_examined.thresholds().narrow_places();
    places.insert(places.end(), obstacles.begin(), obstacles.end());
    const std::vector<Level_range>& ranges = m_examined.ranges(Mesh_ranges::SHARP);
    found.causing_cells = causing_cells_of<ConcurrencyTag>(*field(), ranges, places, m_tuning.most_at_obstacles);
  }

  Refinement_plan plan(const Round_findings& found) const
  {
    return plan_refinement(field()->cells(), found, m_fitted.cells_at_mesh(), m_tuning);
  }

  Cell_hierarchy_3 refined_cells(const Refinement_plan& plan)
  {
    if(plan.split.empty()) return field()->cells();
    if(plan.at_gaps.empty()) return field()->cells().refined(plan.split, m_tuning.rings);
    return refine_at_gaps<ConcurrencyTag>(field()->cells(), plan.split, m_tuning.rings, plan.at_gaps,
                                          m_tuning.max_halvings, m_problem.gap(), m_fitted.clipped(),
                                          [&](std::size_t size) { return is_beyond_limits(size); });
  }

  // Returns the first limit that a round with this number of cells would exceed, if the number of points per cell
  // remains the same.
  Refinement_limit limit_of_round(std::size_t cells) const
  {
    const double points = double(cells) / double(field()->number_of_cells()) * double(field()->number_of_points());
    return m_budget.limit_of_round(cells, points, double(Fit_energy<Field>::max_number_of_unknowns) / 2);
  }
  bool is_beyond_limits(std::size_t cells) const { return limit_of_round(cells).resource != Refinement_resource::NONE; }

  // examines the claims, and records the cells where two components of the mesh share a component of the shell
  bool certify(Round_findings& found)
  {
    m_examined.thresholds().forget_cover(); // the certificate computes its own
    m_fitted.release_equations();           // the field no longer changes
    m_certificate.emplace(*field(), inner(), outer());
    m_certificate->template verify<ConcurrencyTag>(m_problem.input);
    for(const Certificate_witness& w : m_certificate->witnesses())
      if(w.reason == Certificate_witness::TWO_SHEETS) {
        const Index c = field()->locate(Field::Point_3(w.point[0], w.point[1], w.point[2]));
        if(c != Field::npos) found.two_sheets.push_back(c);
      }
    m_budget.end_step(Refinement_budget::CERTIFICATE);
    return m_certificate->is_certified();
  }

  // examines the claims for the last field, although some will not be proved
  void certify_last_field(Round_findings& found)
  {
    if(!m_examined.thresholds().are_chosen()) {
      constexpr int once = 1;
      m_examined.find_thick_cells(m_budget); // the field may have changed
      m_examined.thresholds().begin(*field(), m_problem.thickness);
      found.obstacles = choose_thresholds(once);
    }
    if(!m_certificate) certify(found);
    m_obstacles = std::move(found.obstacles);
  }

  Refinement_problem& m_problem;
  const Refinement_tuning& m_tuning;
  Fitted_field<ConcurrencyTag> m_fitted;
  Examined_field<ConcurrencyTag> m_examined;
  Refinement_history m_history;
  Refinement_budget m_budget;
  Refinement_limit m_limit;
  bool m_is_corrected = false; // whether the last correction was completed
  std::optional<Certificate> m_certificate;
  std::vector<Threshold_obstacle> m_obstacles; // those of the last round
};

template <typename ConcurrencyTag>
std::vector<Refinement_obstacle> Certified_refinement<ConcurrencyTag>::obstacles()
{
  std::map<Index, std::array<double, 3> > places;
  for(const Threshold_obstacle& o : m_obstacles) places.insert({ o.cell, o.point });
  for(const Certificate_witness& w : m_certificate->witnesses()) {
    // TWO_SHEETS does not refer to a single place, and CONTAINMENT_NOT_PROVED has no point.
    if(w.reason == Certificate_witness::TWO_SHEETS || w.reason == Certificate_witness::CONTAINMENT_NOT_PROVED) continue;
    const Index c = field()->locate(Field::Point_3(w.point[0], w.point[1], w.point[2]));
    if(c != Field::npos) places.insert({ c, w.point });
  }
  if(places.empty()) return {};
  return refinement_obstacles<ConcurrencyTag>(field()->cells(), m_fitted.clipped(), m_problem.gap(), places);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H
