// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Construction/Marked_cells.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Narrowed_thresholds.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include <CGAL/Bspline_shell_3/Construction/failing_facets.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Construction/refine_at_gaps.h>
#include <CGAL/Bspline_shell_3/Construction/refinement_obstacles.h>
#include <CGAL/Bspline_shell_3/Construction/similar_cells.h>
#include <CGAL/Bspline_shell_3/Construction/slope_conditions.h>
#include <CGAL/Bspline_shell_3/Construction/slopes_at_gaps.h>
#include <CGAL/Bspline_shell_3/Construction/thickness_on_mesh.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include <CGAL/Bspline_shell_3/Field/refined_coefficients.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Fit/Fitted_part.h>
#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Fit/enforce_slopes.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Fit/solve_part.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_limit.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
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
 * \brief fits a field on a hierarchy of cells, certifies it, refines cells where that fails, and begins again.
 *
 * A round fits the energy on the present cells. Where the field is too large on the mesh for the thickness asked for (`Mesh_ranges`), or facets have
 * too small a slope (`slope_conditions()`), small changes mend both (`Slope_enforcement`), unless that is in too many cells. Then thresholds are chosen
 * (`Narrowed_thresholds`); where the mesh needs them wider than they should be, the field is asked to increase. Cells where none of this helps are
 * refined, few of them with their neighbors; if they are many, at gaps of the mesh more than once (`refine_at_gaps()`), or, where the field was too
 * large in many cells before small changes, these are instead. When nothing is found wanting, the certificate is asked.
 *
 * In cells that are wider than a wall or a gap, no more slope is wanted than a field can have there (`slopes_at_gaps()`). Where walls or gaps turn out to be
 * too narrow on much of the mesh, cells are refined from then on where the field is so large on the mesh that there is no room for thresholds
 * (`culprits_of()`), with others that are like them (`similar_cells()`) if places without are few; and fields are asked to be nearer to zero there.
 *
 * Where not nearly all of the field is concerned, the next round is *partial*: only the coefficients that act on refined cells are fitted again
 * (`Fitted_part`), and only what these change is examined again. If that does not help, all are fitted in the round after it.
 *
 * \tparam ConcurrencyTag as for `bspline_shell_3()`; the result is the same
 */
template <typename ConcurrencyTag>
class Certified_refinement
{
public:
  typedef Hierarchical_bspline_field_3<> Field;
  typedef Spline_threshold<Field> Threshold;
  typedef Shell_certificate_3<Field, Threshold> Certificate;

  /// the thickness asked for near a point, user units
  typedef std::function<double(const Field::Point_3&)> Thickness;
  /// is called with each step that begins; `false` stops
  typedef std::function<bool(Shell_step)> Start;

  /// \param input the mesh; not null
  /// \param oracle the signed distance that the field is fitted to
  /// \param thickness outlives this object, as does what `oracle` refers to
  /// \param parameters what to aim at, and how far to go
  Certified_refinement(std::shared_ptr<const Input_mesh_3> input, const Any_signed_distance_3& oracle, const Thickness& thickness,
                       const Refinement_parameters& parameters);

  /// \param cells to begin with; they contain the mesh
  /// \param solver any model of `SPDSolver`
  /// \param start is called with each step that begins; `false` stops
  Refinement_status operator()(Cell_hierarchy_3 cells, const Any_spd_solver& solver, const Start& start);

  const std::vector<Refinement_round>& rounds() const { return m_budget.rounds(); }
  /// which limit ended it, if one did
  const Refinement_limit& limit() const { return m_limit; }
  std::shared_ptr<const Field> field() const { return m_field; }
  /// the certificate of the last field, to which it refers
  const std::optional<Certificate>& certificate() const { return m_certificate; }
  const Threshold& inner() const { return m_thresholds.inner(); }
  const Threshold& outer() const { return m_thresholds.outer(); }
  /// encloses the last field on each triangle, coarsely
  std::vector<Level_range> facet_ranges() const { return m_ranges.facets<ConcurrencyTag>(*m_field, *m_clipped); }

  /// what stands in the way of the proof in the last round, narrowest first: obstacles to the thresholds, and witnesses of the certificate
  std::vector<Refinement_obstacle> obstacles();

  /// how thick the shell of the last field is
  Thickness_on_mesh thickness_on_mesh() const
  {
    return Bspline_shells::thickness_on_mesh(*m_clipped, inner(), outer(), [&](Index c) { return 2 * half_thickness(c); });
  }

private:
  typedef Field::Cell_index Index;
  static constexpr double largest_part = 0.75;                  // of the cells, that is fitted apart from the others
  static constexpr int max_refinements_of_a_facet = 5;          // what they do not mend, more of them will not
  static constexpr std::size_t least_violated_cells = 64;
  static constexpr std::size_t many_thick_at_first = 24;        // one of so many, before small changes
  static constexpr std::size_t thick_cells_to_refine = 8;       // one of so many; fewer may be mended by small changes,
  static constexpr std::size_t most_thick_cells = 1000;         // which take milliseconds each
  static constexpr std::size_t least_many_obstacles = 100, obstacles_to_refine = 128;       // cells; one of so many
  static constexpr std::size_t cells_of_thin = 5, cells_of_nearly_thin = 12;      // one of so many at the mesh has an obstacle
  static constexpr double most_at_obstacles = 0.7;              // of the room for thresholds, that the field may take on the mesh
  static constexpr double considerable = 1e-3;                  // part of half the thickness: in the middle of walls, the field is smaller on the mesh
  static constexpr float near_obstacles = 20;                   // how much more a field counts there that is not zero on the mesh
  static constexpr std::size_t cells_to_split_alone = 38;       // if one of so many at the mesh has obstacles; fewer are split with their neighbors,
  static constexpr std::size_t few_obstacles = 8;               // so few cells with those across faces only
  typedef Refinement_budget Budget;

  // cells with obstacles: more than that are not a local affair
  std::size_t many_obstacles() const { return (std::max)(least_many_obstacles, m_clipped->cells().size() / obstacles_to_refine); }
  bool are_many(const std::vector<Index>& obstacles) const { return obstacles.size() > many_obstacles(); }

  // whether many obstacles are what is left of a field that was too large on the mesh in many cells
  bool are_due_to_thickness(const std::vector<Index>& obstacles) const { return are_many(obstacles) && !m_thick_at_first.empty(); }

  // Returns the limit that the next round would exceed with so many cells, if there is one. The number of points per
  // cell is assumed to stay as it is.
  Refinement_limit limit_of_round(std::size_t cells) const
  {
    const double points = double(cells) / double(m_field->number_of_cells()) * double(m_field->number_of_points());
    return m_budget.limit_of_round(cells, points, double(Fit_energy<Field>::max_number_of_unknowns) / 2);
  }

  // whether the last field has the slopes asked for, and if it was fitted in part, that helped
  bool can_be_partial() const { return !rounds().empty() && m_is_enforced && !m_budget.was_part_in_vain(); }

  // a point on each component of a mesh
  static std::vector<Field::Point_3> seeds(const Input_mesh_3& input)
  {
    std::vector<Field::Point_3> points(input.number_of_components());
    for(Input_mesh_3::Face_index f : input.mesh().faces()) {
      const auto& p = input.mesh().point(input.mesh().target(input.mesh().halfedge(f)));
      points[input.component(f)] = Field::Point_3(p.x(), p.y(), p.z());
    }
    return points;
  }

  // Begins a round: fits a field on the cells, and marks cells where it is too thick or not steep enough. Returns why that failed, if it did.
  std::optional<Refinement_status> fit(Cell_hierarchy_3 cells, const Any_spd_solver& solver, const Start& start)
  {
    const bool can_be_partial = this->can_be_partial();
    Refinement_round& log = m_budget.begin_round();
    m_enforcement.reset();
    m_certificate.reset();
    m_thresholds.reset();
    m_obstacles.clear();
    m_is_enforced = false;
    if(!start(Shell_step::DISTANCE)) return Refinement_status::CANCELED;
    std::vector<Index> split;
    if(m_field) split = update_signed_distance<ConcurrencyTag>(m_oracle, m_field->cells(), cells, m_samples);
    else m_samples = sample_signed_distance<ConcurrencyTag>(m_oracle, cells);
    if(!std::all_of(m_samples.begin(), m_samples.end(), [](double d) { return std::isfinite(d); }))
      return Refinement_status::DISTANCE_NOT_FINITE;
    m_budget.end_step(Budget::DISTANCE);
    inherit_surface_factors(cells);
    const std::shared_ptr<Field> before = std::exchange(m_field, std::make_shared<Field>(std::move(cells)));
    Field& field = *m_field;
    m_marked.begin(field.cells());
    log.cells = field.number_of_cells();
    log.unknowns = field.number_of_coefficients();
    log.levels = field.number_of_levels();
    m_cells_at_gaps.clear();
    m_similar_cells.clear();
    m_clipped.reset();        // before there is another one
    m_clipped.emplace(clip_mesh_to_cells<ConcurrencyTag>(*m_input, field.cells()));
    m_part.reset();
    if(can_be_partial && double(split.size()) < largest_part * double(log.cells)) {
      m_part.emplace(field, split);
      if(double(m_part->number_of_cells) > largest_part * double(log.cells)) m_part.reset();
    }
    log.partial = bool(m_part);
    m_budget.add_fitted_cells(m_part ? m_part->number_of_cells : log.cells);
    m_budget.end_step(Budget::CELLS);

    if(!start(Shell_step::FIT)) return Refinement_status::CANCELED;
    const double width = field.cells().lattice().spacing();
    Fit_energy<Field> energy(field, m_samples, *m_clipped, m_input->unit() / width, m_parameters.weights);
    energy.set_surface_factors(m_surface_factors);
    const Unknown_blocks blocks = overlapping_blocks(field);
    Solver_status solved;
    if(m_part) {
      m_x = refined_coefficients(*before, m_x, field);
      energy.template assemble<ConcurrencyTag>(*m_part, m_x, m_A, m_b);
      m_budget.end_step(Budget::ASSEMBLY);
      solved = solve_part(solver, m_A, m_b, m_part->coefficients, blocks, m_x);
    } else {
      energy.template assemble<ConcurrencyTag>(m_A, m_b);
      m_budget.end_step(Budget::ASSEMBLY);
      m_x = energy.template initial_guess<ConcurrencyTag>();
      solved = solver.compute(m_A, blocks);
      if(solved == Solver_status::SUCCESS) solved = solver.solve(m_b, m_x);
    }
    m_budget.end_step(Budget::SOLVER);
    if(solved != Solver_status::SUCCESS || !m_x.allFinite()) return Refinement_status::SOLVER_FAILED;
    field.template set_coefficients<ConcurrencyTag>(m_x * width);
    const Mesh_ranges ranges = std::exchange(m_ranges, Mesh_ranges(log.cells));
    if(m_part) {
      keep_what_was_examined(*before, ranges);
    } else {
      // at walls too thin for the thickness asked for, the cover of a shell that wide takes long, and says nothing
      if(!is_thin()) m_thresholds.forget();
      else m_thresholds.forget_field(before->cells(), field.cells());
      m_unexamined.assign(m_wanted.size(), 1);
    }
    if(!start(Shell_step::BOUNDS)) return Refinement_status::CANCELED;
    find_thick_cells();
    m_thick_at_first.clear();
    if(m_ranges.thick_cells().size() > m_clipped->cells().size() / many_thick_at_first) m_thick_at_first = nearly_thick_cells();
    if(are_many_thick()) {
      mark_thick_cells();
      return std::nullopt;
    }

    m_slope_limits.clear();
    begin_enforcement();
    m_is_enforced = enforce_conditions();
    m_budget.end_step(Budget::SLOPES);
    return std::nullopt;
  }

  // the slope wanted of a facet in a cell
  double wanted_slope(Index c, std::uint32_t facet) const
  {
    return m_slope_limits.empty() ? m_wanted[facet] : (std::min)(m_wanted[facet], m_slope_limits[c]);
  }

  void begin_enforcement()
  {
    m_enforcement.emplace(*m_field, m_A, m_b);
    m_enforcement->insert(slope_conditions<ConcurrencyTag>(
      *m_field, *m_clipped, [&](Index c, std::uint32_t facet) { return wanted_slope(c, facet); },
      [&](Index c) { return !m_part || m_part->cells[c]; }, [&](Index c) { return largest_on_mesh(c); }));
    std::vector<Slope_condition> conditions;
    add_conditions_of_thick_cells(conditions);
    m_enforcement->insert(std::move(conditions));
  }

  // where the field is largest in them
  void add_conditions_of_thick_cells(std::vector<Slope_condition>& conditions) const
  {
    for(const Thick_cell& t : m_ranges.thick_cells())
      if(m_wanted[t.facet] > 0)
        conditions.push_back({ t.cell, t.facet, m_field->cell(t.cell).local_coordinates(t.point), m_clipped->normal(t.facet),
                               wanted_slope(t.cell, t.facet), largest_on_mesh(t.cell) });
  }

  // In cells wider than a wall or a gap in them, no more is wanted than what such cells allow. Returns whether that is less than before anywhere.
  bool limit_slopes(const std::vector<Index>& cells)
  {
    if(!m_slope_limits.empty()) return false;
    if(!m_gap) m_gap.emplace(*m_input);
    const std::vector<double> limits = slopes_at_gaps<ConcurrencyTag>(m_field->cells(), cells, *m_gap, *m_clipped);
    if(std::none_of(limits.begin(), limits.end(), [&](double limit) { return limit < m_parameters.slope_fraction; })) return false;
    m_slope_limits.assign(m_field->number_of_cells(), std::numeric_limits<double>::infinity());
    for(std::size_t n = 0; n < cells.size(); ++n) m_slope_limits[cells[n]] = limits[n];
    return true;
  }

  // Where small changes meet some conditions only at the cost of others, asks all facets for half of the least slope that one of them was asked for:
  // along a sharp fin, a field that is steep on one facet may not increase through the next one. Returns false if that was done in this round.
  bool relax_slopes(const std::vector<Index>& cells)
  {
    if(!m_slope_limits.empty() || cells.empty()) return false;
    constexpr double part = 0.5;
    const double none = std::numeric_limits<double>::infinity();
    std::vector<double> least(m_field->number_of_cells(), none);
    for(const Clipped_mesh_3::Piece& piece : m_clipped->pieces())
      if(m_wanted[piece.facet] > 0) least[piece.cell] = (std::min)(least[piece.cell], m_wanted[piece.facet]);
    m_slope_limits.assign(m_field->number_of_cells(), none);
    for(Index c : cells)
      visit_around(m_field->cells(), c, [&](Index n) { m_slope_limits[n] = (std::min)(m_slope_limits[n], part * least[c]); });
    return true;
  }

  // Changes the field where facets have too small a slope, or where it is too large on the mesh, until neither is left, or nothing helps; marks cells where
  // it does not. Returns false, and only marks cells, if there is too much to change.
  bool enforce_conditions()
  {
    constexpr int max_exchanges = 6;
    constexpr double progress = 0.5;              // largest share of thick cells that an exchange may leave, after the first,
    constexpr std::size_t cheap = 2;              // unless it leaves no more than that: a round would take longer
    constexpr std::size_t cells_to_change = 6;    // at most one of so many at the mesh
    Refinement_round& log = m_budget.round();
    const std::size_t most_violated = (std::max)(least_violated_cells, m_clipped->cells().size() / cells_to_change);
    const std::vector<Thick_cell>& thick = m_ranges.thick_cells();
    std::vector<Facet_failure> failures;
    for(int exchange = 0; ; ++exchange) {
      const Slope_report slopes = m_enforcement->template operator()<ConcurrencyTag>(m_x, most_violated);
      if(exchange == 0) log.sloping_cells = slopes.violated_before;
      log.sloping_cells_left = slopes.violated_cells.size();
      if(!slopes.enforced && slopes.patches == 0 && limit_slopes(slopes.violated_cells)) {
        begin_enforcement();
        return enforce_conditions();
      }
      if(!slopes.enforced) {
        std::vector<std::uint32_t> facets;
        for(std::size_t n = 0; n < slopes.violated_cells.size(); ++n)
          if(m_refinements[slopes.violated_facets[n]] < max_refinements_of_a_facet) {
            m_marked.mark_widely(slopes.violated_cells[n]);
            facets.push_back(slopes.violated_facets[n]);
          }
        std::sort(facets.begin(), facets.end());
        facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
        for(std::uint32_t f : facets) ++m_refinements[f];
        return false;
      }
      if(slopes.patches > 0) change_field();
      else if(exchange > 0) break;
      for(const Clipped_mesh_3::Piece& piece : m_clipped->pieces())
        if(std::binary_search(slopes.changed_cells.begin(), slopes.changed_cells.end(), piece.cell)) m_unexamined[piece.facet] = 1;
      const std::size_t thick_before = thick.size();
      failures = failing_facets();
      m_budget.end_step(Budget::SLOPES);
      find_thick_cells();
      if((thick.empty() && failures.empty()) || are_many_thick()) break;
      if(exchange + 1 == max_exchanges) {
        if(failures.empty() || !relax_slopes(slopes.violated_cells)) break;
        begin_enforcement();
        return enforce_conditions();
      }
      if(exchange > 0 && thick.size() > cheap && double(thick.size()) > progress * double(thick_before)) break;
      std::vector<Slope_condition> conditions;
      for(const Facet_failure& f : failures) {
        if(f.cell != Field::npos && m_wanted[f.facet] > 0)
          conditions.push_back({ f.cell, f.facet, m_field->cell(f.cell).local_coordinates(f.point), m_clipped->normal(f.facet),
                                 wanted_slope(f.cell, f.facet) });
      }
      add_conditions_of_thick_cells(conditions);
      if(conditions.empty()) break;
      m_enforcement->insert(std::move(conditions));
    }
    log.failing_facets = failures.size();
    for(const Facet_failure& f : failures)
      if(f.cell != Field::npos && m_wanted[f.facet] > 0 && m_refinements[f.facet] < max_refinements_of_a_facet) {
        ++m_refinements[f.facet];
        m_marked.mark_widely(f.cell);
      }
    mark_thick_cells();
    return true;
  }

  // sets it to the present solution, and notes the cells where it is another one than what was examined
  void change_field()
  {
    constexpr std::size_t chunk = 1024;
    const Field before = std::exchange(*m_field, m_field->template with_coefficients<ConcurrencyTag>(m_x * m_field->cells().lattice().spacing()));
    std::vector<char> changed(m_field->number_of_cells());
    internal::for_each_chunk<ConcurrencyTag>(changed.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c) changed[c] = !is_same_in_cell(before, Index(c), *m_field, Index(c));
    });
    for(Index c = 0; c < changed.size(); ++c)
      if(changed[c]) m_ranges.forget(c);
    m_thresholds.field_has_changed(changed);
  }

  // keeps what is known of a field where it is the same on finer cells, and notes which facets are where it is not
  void keep_what_was_examined(const Field& before, const Mesh_ranges& ranges)
  {
    constexpr std::size_t chunk = 256;
    std::vector<Index> now(before.number_of_cells());
    internal::for_each_chunk<ConcurrencyTag>(now.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        const Index c = Index(n);
        now[c] = m_field->cells().leaf(before.cells().level(c), before.cells().lattice_point(c));
        if(now[c] != Field::npos && !is_same_in_cell(before, c, *m_field, now[c])) now[c] = Field::npos;
      }
    });
    for(Index c = 0; c < now.size(); ++c)
      if(now[c] != Field::npos) m_ranges.keep(ranges, c, now[c]);
    m_thresholds.cells_were_refined(now);
    for(const Clipped_mesh_3::Piece& piece : m_clipped->pieces())
      if(m_part->cells[piece.cell]) m_unexamined[piece.facet] = 1;
  }

  // among those that were not examined since the field changed there
  std::vector<Facet_failure> failing_facets()
  {
    std::vector<Facet_failure> failures = Bspline_shells::failing_facets<ConcurrencyTag>(*m_field, *m_input, m_unexamined);
    std::fill(m_unexamined.begin(), m_unexamined.end(), 0);
    for(const Facet_failure& f : failures) m_unexamined[f.facet] = 1;
    return failures;
  }

  void inherit_surface_factors(const Cell_hierarchy_3& cells)
  {
    if(!is_thin()) return;
    std::vector<float> factors(cells.number_of_cells(), 1);
    for(Index c = 0; c < factors.size(); ++c) {
      const std::array<double, 3> corner = cells.corner(c);
      const double half = cells.width(c) / 2;
      const Index before = m_field->locate(Field::Point_3(corner[0] + half, corner[1] + half, corner[2] + half));
      if(before != Field::npos) factors[c] = m_surface_factors[before];
    }
    m_surface_factors.swap(factors);
  }

  double half_thickness(Index c) const
  {
    const Bbox_3 b = m_field->cell(c).bbox();
    return m_thickness(Field::Point_3((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2)) / 2;
  }

  // bounds the field on the mesh, where it has changed
  void update_ranges(Mesh_ranges::Precision precision)
  {
    m_ranges.template update<ConcurrencyTag>(*m_field, *m_clipped, [&](Index c) { return half_thickness(c); }, precision);
  }

  void find_thick_cells()
  {
    update_ranges(Mesh_ranges::SUFFICIENT);
    Refinement_round& log = m_budget.round();
    const Level_range on_mesh = m_ranges.mesh();
    log.thickness = on_mesh.max - on_mesh.min;
    log.thick_cells = m_ranges.thick_cells().size();
    m_budget.end_step(Budget::BOUNDS);
  }

  bool are_many_thick() const
  {
    return m_ranges.thick_cells().size() > (std::min)(most_thick_cells, m_clipped->cells().size() / thick_cells_to_refine);
  }

  // what is nearly too thick would be in the next round, after small changes
  std::vector<Index> nearly_thick_cells()
  {
    constexpr double nearly = 0.8;
    update_ranges(Mesh_ranges::SHARP);
    std::vector<Index> cells;
    for(Index c = 0; c < m_field->number_of_cells(); ++c) {
      const Level_range& r = m_ranges.cells()[c];
      if(r.min <= r.max && (std::max)(-r.min, r.max) > nearly * half_thickness(c)) cells.push_back(c);
    }
    return cells;
  }

  void mark_thick_cells()
  {
    const bool are_many = are_many_thick();
    for(const Thick_cell& t : m_ranges.thick_cells())
      if(are_many) m_marked.mark(t.cell);
      else m_marked.mark_widely(t.cell);
    if(are_many)
      for(Index c : m_thick_at_first) m_marked.mark(c);
  }

  // what the field may be at points on the mesh, in units of the width of root cells: a little less than half of the thickness
  double largest_on_mesh(Index c) const
  {
    constexpr double nearly = 0.95;
    return nearly * half_thickness(c) / m_field->cells().lattice().spacing();
  }

  // Chooses thresholds. Where that is not enough, and if these places are few, the field is asked to increase along the direction that the
  // facets nearby have in common; if it still is not, cells are marked.
  void choose_field_and_thresholds()
  {
    constexpr int max_exchanges = 3;
    constexpr double progress = 0.75;
    m_thresholds.begin(*m_field, m_thickness);
    m_obstacles = choose_thresholds();
    double before = std::numeric_limits<double>::infinity();
    for(int exchange = 0; exchange < max_exchanges && !m_obstacles.empty() && m_marked.empty(); ++exchange) {
      const std::vector<Index> cells = cells_of(m_obstacles);
      if(are_many(cells) || double(cells.size()) > progress * before) break;
      before = double(cells.size());
      std::vector<Any_signed_distance_3::Point_3> points;
      for(const Threshold_obstacle& o : m_obstacles) points.emplace_back(o.point[0], o.point[1], o.point[2]);
      std::vector<double> distances(points.size());
      m_oracle(points, distances.data());
      std::vector<Slope_condition> conditions;
      for(std::size_t n = 0; n < m_obstacles.size(); ++n) {
        const Threshold_obstacle& o = m_obstacles[n];
        const auto condition = common_slope(*m_field, *m_clipped, o.cell, o.point, std::abs(distances[n]), m_parameters.slope_fraction);
        if(condition) conditions.push_back(*condition);
      }
      if(conditions.empty()) break;
      m_enforcement->insert(conditions);
      m_budget.end_step(Budget::CERTIFICATE);
      m_is_enforced = enforce_conditions();
      if(!m_is_enforced) break;
      m_budget.end_step(Budget::SLOPES);
      if(!m_marked.empty()) break;
      m_obstacles = choose_thresholds();
    }
    m_budget.round().undecided_cells = m_obstacles.size();
    const std::vector<Index> cells = cells_of(m_obstacles);
    if(are_due_to_thickness(cells)) {
      for(Index c : m_thick_at_first) m_marked.mark(c);
    } else if((is_thin() && !cells.empty()) || (are_many(cells) && becomes_thin(cells))) {
      make_room(cells);
    } else {
      if(are_many(cells)) m_cells_at_gaps = cells;
      const bool alone = cells.size() > m_clipped->cells().size() / cells_to_split_alone;
      const int axes = alone ? 0 : cells.size() <= few_obstacles ? 1 : 3;
      for(Index c : cells) m_marked.mark_widely(c, axes);
    }
    m_budget.end_step(Budget::CERTIFICATE);
  }

  // whether walls or gaps are too narrow for the shell asked for on much of the mesh: once known, it stays so
  bool is_thin() const { return !m_surface_factors.empty(); }

  // finds out, by the cells with obstacles: there are very many, or many again after others were refined
  bool becomes_thin(const std::vector<Index>& cells)
  {
    const std::size_t all = m_clipped->cells().size();
    const bool are_again = m_was_nearly_thin && cells.size() > all / cells_of_nearly_thin;
    m_was_nearly_thin = cells.size() > all / cells_of_nearly_thin;
    return are_again || cells.size() > all / cells_of_thin;
  }

  // Marks cells where the field is so large on the mesh that thresholds have no room at obstacles, or little: these would be the next ones. There and
  // at obstacles, the next field is asked to be nearer to zero on the mesh.
  void make_room(const std::vector<Index>& cells)
  {
    std::vector<Threshold_obstacle> places = m_thresholds.tight_places();
    places.insert(places.end(), m_obstacles.begin(), m_obstacles.end());
    update_ranges(Mesh_ranges::SHARP);
    const std::vector<Level_range>& ranges = m_ranges.cells();
    m_cells_at_gaps = culprits_of<ConcurrencyTag>(*m_field, ranges, places, most_at_obstacles);
    if(!are_many(cells)) {
      const Cell_hierarchy_3& all = m_field->cells();
      std::vector<Index> culprits;
      for(Index c : m_cells_at_gaps)
        if(all.level(c) < all.max_level() && (std::max)(-ranges[c].min, ranges[c].max) > considerable * half_thickness(c)) culprits.push_back(c);
      m_similar_cells = similar_cells(all, ranges, culprits);
    }
    if(!is_thin()) m_surface_factors.assign(m_field->number_of_cells(), 1);
    for(Index c : cells) m_surface_factors[c] = near_obstacles;
    for(Index c : m_cells_at_gaps) {
      m_surface_factors[c] = near_obstacles;
      m_marked.mark(c);
    }
    if(m_marked.empty())      // culprits are as small as they may be
      for(Index c : cells) m_marked.mark_widely(c);
  }

  // returns where the mesh needs thresholds wider than they should be
  std::vector<Threshold_obstacle> choose_thresholds(int max_passes = Narrowing_limits().max_passes)
  {
    m_budget.round().examined = true;
    if(m_parameters.constant_thresholds)
      m_thresholds.set_constant(Bspline_shells::facet_ranges<ConcurrencyTag>(*m_field, *m_clipped).mesh);
    const auto ranges = [&](Mesh_ranges::Precision precision) -> const std::vector<Level_range>& {
      update_ranges(precision);
      return m_ranges.cells();
    };
    return m_thresholds.template choose<ConcurrencyTag>(ranges, { max_passes, many_obstacles() });
  }

  // Marked cells are split once, and those next to many obstacles twice, if the gap is that narrow. So are similar ones, if that is within the limits.
  Cell_hierarchy_3 refined_cells()
  {
    if(m_similar_cells.empty()) return refined_cells(m_marked.sorted(), m_cells_at_gaps);
    std::vector<Index> marked = m_marked.sorted(), at_gaps = m_cells_at_gaps;
    marked.insert(marked.end(), m_similar_cells.begin(), m_similar_cells.end());
    at_gaps.insert(at_gaps.end(), m_similar_cells.begin(), m_similar_cells.end());
    Cell_hierarchy_3 cells = refined_cells(marked, at_gaps);
    if(is_beyond_limits(cells.number_of_cells())) return refined_cells(m_marked.sorted(), m_cells_at_gaps);
    for(Index c : m_similar_cells) m_surface_factors[c] = near_obstacles;
    return cells;
  }
  Cell_hierarchy_3 refined_cells(const std::vector<Index>& marked, const std::vector<Index>& at_gaps)
  {
    constexpr int max_halvings = 2, rings = 1;
    if(at_gaps.empty()) return m_field->cells().refined(marked, rings);
    if(!m_gap) m_gap.emplace(*m_input);
    return refine_at_gaps<ConcurrencyTag>(m_field->cells(), marked, rings, at_gaps, max_halvings, *m_gap, *m_clipped,
                                          [&](std::size_t size) { return is_beyond_limits(size); });
  }
  bool is_beyond_limits(std::size_t cells) const { return limit_of_round(cells).resource != Refinement_resource::NONE; }

  // Asks the certificate, and marks cells that keep the claims from being proved.
  bool certify()
  {
    m_thresholds.forget_cover();    // the certificate finds out for itself
    m_enforcement.reset();    // with what it refers to: the field stays as it is now
    m_A = Fit_energy<Field>::Matrix();
    m_certificate.emplace(*m_field, inner(), outer());
    m_certificate->template verify<ConcurrencyTag>(m_input);
    for(const Certificate_witness& w : m_certificate->witnesses())
      if(w.reason == Certificate_witness::TWO_SHEETS) {
        const Index c = m_field->locate(Field::Point_3(w.point[0], w.point[1], w.point[2]));
        if(c != Field::npos) m_marked.mark(c);
      }
    m_budget.end_step(Budget::CERTIFICATE);
    return m_certificate->is_certified();
  }

  std::shared_ptr<const Input_mesh_3> m_input;
  Any_signed_distance_3 m_oracle;
  const Thickness& m_thickness;
  Refinement_parameters m_parameters;
  std::vector<double> m_wanted;                       // the slope wanted for each triangle, per user unit
  std::vector<double> m_slope_limits;                 // of cells; empty if slopes are limited nowhere
  std::vector<int> m_refinements;                     // of each triangle: how often it was a reason for them
  std::shared_ptr<Field> m_field;
  std::vector<double> m_samples;
  std::optional<Clipped_mesh_3> m_clipped;
  Fit_energy<Field>::Matrix m_A;                      // x^T A x - 2 b^T x
  Eigen::VectorXd m_b, m_x;                           // in units of the width of root cells
  std::optional<Fitted_part> m_part;                  // of a partial round
  std::optional<Slope_enforcement<Field> > m_enforcement;
  std::vector<char> m_unexamined;                     // of each triangle: whether its slope is to be examined (again)
  Mesh_ranges m_ranges;                               // of the last field
  Narrowed_thresholds<Field> m_thresholds;
  std::optional<Certificate> m_certificate;
  Marked_cells m_marked;
  std::vector<Index> m_thick_at_first;                // before small changes, nearly
  std::vector<Threshold_obstacle> m_obstacles;                  // of the last thresholds
  std::vector<Index> m_cells_at_gaps;                 // to refine as the gap asks for
  std::vector<Index> m_similar_cells;                 // to refine with these, if limits allow it
  std::vector<float> m_surface_factors;               // of cells (`Fit_energy`)
  std::optional<Local_gap_3> m_gap;                   // made when it is needed
  bool m_was_nearly_thin = false;
  bool m_is_enforced = false;                         // slopes of the last field
  Refinement_budget m_budget;
  Refinement_limit m_limit;
};

template <typename ConcurrencyTag>
Certified_refinement<ConcurrencyTag>::Certified_refinement(std::shared_ptr<const Input_mesh_3> input, const Any_signed_distance_3& oracle,
                                                           const Thickness& thickness, const Refinement_parameters& parameters)
  : m_input(std::move(input)), m_oracle(oracle), m_thickness(thickness), m_parameters(parameters),
    m_wanted(wanted_slopes<ConcurrencyTag>(*m_input, parameters.slope_fraction)), m_refinements(m_wanted.size()), m_thresholds(seeds(*m_input)),
    m_budget(parameters)
{}

template <typename ConcurrencyTag>
Refinement_status Certified_refinement<ConcurrencyTag>::operator()(Cell_hierarchy_3 cells, const Any_spd_solver& solver, const Start& start)
{
  constexpr int max_rounds_in_vain = 4;
  constexpr double progress = 0.9;
  double least_volume = std::numeric_limits<double>::infinity();      // of undecided boxes
  std::size_t fewest_facets = std::numeric_limits<std::size_t>::max(), fewest_obstacles = fewest_facets;
  int rounds_in_vain = 0;
  m_budget.start();
  for(std::size_t round = 0; ; ++round) {
    m_budget.begin_step();
    const std::optional<Refinement_status> failure = fit(std::move(cells), solver, start);
    if(failure) return *failure;
    Refinement_round& log = m_budget.round();
    if(m_is_enforced && !are_many_thick()) {
      if(!start(Shell_step::CERTIFICATE)) return Refinement_status::CANCELED;
      choose_field_and_thresholds();
      if(m_marked.empty() && m_thresholds.are_chosen() && certify()) return Refinement_status::CERTIFIED;
      // boxes are larger where there are many: few obstacles may have more volume than others before them
      const bool better = log.thick_cells > 0 || log.failing_facets < fewest_facets || m_thresholds.undecided_volume() < progress * least_volume
                       || double(log.undecided_cells) < progress * double(fewest_obstacles);
      rounds_in_vain = better ? 0 : rounds_in_vain + 1;
      least_volume = (std::min)(least_volume, m_thresholds.undecided_volume());
      fewest_facets = (std::min)(fewest_facets, log.failing_facets);
      fewest_obstacles = (std::min)(fewest_obstacles, log.undecided_cells);
    }
    log.marked_cells = m_marked.sorted().size();
    const bool in_vain = rounds_in_vain == max_rounds_in_vain || m_marked.empty();
    if(!in_vain) {
      cells = refined_cells();
      // before the memory is taken
      m_limit = limit_of_round(cells.number_of_cells());
      if(round + 1 >= m_parameters.max_rounds) m_limit.resource = Refinement_resource::ROUNDS;
    }
    if(in_vain || m_limit.resource != Refinement_resource::NONE) {
      if(!m_thresholds.are_chosen()) {
        constexpr int once = 1;
        find_thick_cells();       // the field may have changed
        m_thresholds.begin(*m_field, m_thickness);
        m_obstacles = choose_thresholds(once);
      }
      if(!m_certificate) certify();
      return in_vain ? Refinement_status::NOTHING_TO_REFINE : Refinement_status::LIMIT_REACHED;
    }
  }
}

template <typename ConcurrencyTag>
std::vector<Refinement_obstacle> Certified_refinement<ConcurrencyTag>::obstacles()
{
  std::map<Index, std::array<double, 3> > places;
  for(const Threshold_obstacle& o : m_obstacles) places.insert({ o.cell, o.point });
  for(const Certificate_witness& w : m_certificate->witnesses()) {
    // of no place
    if(w.reason == Certificate_witness::TWO_SHEETS || w.reason == Certificate_witness::CONTAINMENT_NEEDED) continue;
    const Index c = m_field->locate(Field::Point_3(w.point[0], w.point[1], w.point[2]));
    if(c != Field::npos) places.insert({ c, w.point });
  }
  if(places.empty()) return {};
  if(!m_gap) m_gap.emplace(*m_input);
  return refinement_obstacles<ConcurrencyTag>(m_field->cells(), *m_clipped, *m_gap, places);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINE_UNTIL_CERTIFIED_H
