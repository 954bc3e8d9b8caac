// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_EXAMINED_FIELD_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_EXAMINED_FIELD_H

#include <CGAL/Bspline_shell_3/Construction/Fitted_field.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Narrowed_thresholds.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_budget.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include <CGAL/Bspline_shell_3/Construction/failing_facets.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief caches the results for the field of a round: its range on the mesh in each cell, the facets that are proved to
 * face along its gradient, and the cover of the shell between its thresholds.
 *
 * An entry remains valid for the next field if that field is the same in the cell (`is_same_in_cell()`).
 */
template <typename ConcurrencyTag>
class Examined_field
{
public:
  typedef Refinement_problem::Field Field;
  typedef Field::Cell_index Index;
  typedef Fitted_field<ConcurrencyTag> Fitted;
  typedef Narrowed_thresholds<Field> Thresholds;

  /// \pre `problem` and `fitted` outlive this object
  Examined_field(const Refinement_problem& problem, const Fitted& fitted)
    : m_problem(problem), m_fitted(fitted), m_unexamined(problem.target_slopes.size()),
      m_thresholds(seeds(*problem.input))
  {}

  /// \name Changes of the field
  /// @{

  /// clears the cache for a new field.
  /// \param before the previous field, or null
  /// \param keeps_caps whether thresholds remain as narrow as they had to be for the previous field
  void reset(const Field* before, bool keeps_caps)
  {
    m_ranges = Mesh_ranges(m_fitted.field()->number_of_cells());
    std::fill(m_unexamined.begin(), m_unexamined.end(), 1);
    m_thresholds.reset();
    if(keeps_caps && before) m_thresholds.forget_field(before->cells(), m_fitted.field()->cells());
    else m_thresholds.forget();
  }

  /// updates the cache after a partial fit on finer cells
  void update_after_refinement(const Field& before)
  {
    const Field& field = *m_fitted.field();
    std::vector<Index> now(before.number_of_cells());
    for_each_cell(now.size(), [&](Index c) {
      now[c] = field.cells().leaf(before.cells().level(c), before.cells().lattice_point(c));
      if(now[c] != Field::npos && !is_same_in_cell(before, c, field, now[c])) now[c] = Field::npos;
    });
    const Mesh_ranges ranges = std::exchange(m_ranges, Mesh_ranges(field.number_of_cells()));
    for(Index c = 0; c < now.size(); ++c)
      if(now[c] != Field::npos) m_ranges.keep(ranges, c, now[c]);
    m_thresholds.cells_were_refined(now);
    invalidate_facets(m_fitted.part()->cells);
  }

  /// updates the cache after a change of coefficients on the same cells
  void has_changed(const Field& before)
  {
    const Field& field = *m_fitted.field();
    std::vector<char> changed(field.number_of_cells());
    for_each_cell(changed.size(), [&](Index c) { changed[c] = !is_same_in_cell(before, c, field, c); });
    for(Index c = 0; c < changed.size(); ++c)
      if(changed[c]) m_ranges.forget(c);
    m_thresholds.field_has_changed(changed);
    invalidate_facets(changed);
  }
  /// @}

  /// \name Results
  /// Only invalid entries are computed.
  /// @{

  /// returns the range of the field on the mesh in each cell
  const std::vector<Level_range>& ranges(Mesh_ranges::Precision precision)
  {
    m_ranges.template update<ConcurrencyTag>(
      *m_fitted.field(), m_fitted.clipped(), [&](Index c) { return m_problem.half_thickness(*m_fitted.field(), c); },
      precision);
    return m_ranges.cells();
  }
  /// returns the thick cells of the last call of `ranges()`
  const std::vector<Thick_cell>& thick_cells() const { return m_ranges.thick_cells(); }
  /// computes ranges and thick cells, and reports them
  void find_thick_cells(Refinement_budget& budget)
  {
    ranges(Mesh_ranges::SUFFICIENT);
    const Level_range on_mesh = m_ranges.mesh();
    budget.round().thickness = on_mesh.max - on_mesh.min;
    budget.round().thick_cells = m_ranges.thick_cells().size();
    budget.end_step(Refinement_budget::BOUNDS);
  }
  /// returns an enclosure of the field on each facet
  /// \pre `ranges()` was called
  std::vector<Level_range> facet_ranges() const
  {
    return m_ranges.template facets<ConcurrencyTag>(*m_fitted.field(), m_fitted.clipped());
  }

  /// returns the facets that are not proved to face along the gradient
  std::vector<Facet_failure> failing_facets()
  {
    std::vector<Facet_failure> failures = Bspline_shells::failing_facets<ConcurrencyTag>(
      *m_fitted.field(), *m_problem.input, m_unexamined);
    std::fill(m_unexamined.begin(), m_unexamined.end(), 0);
    for(const Facet_failure& f : failures) m_unexamined[f.facet] = 1;
    return failures;
  }

  /// chooses thresholds, and returns the places where |f| on the mesh is too large for thresholds that exclude the
  /// obstacles
  /// \pre `thresholds().begin()` was called
  std::vector<Threshold_obstacle> choose_thresholds(const Narrowing_limits& limits)
  {
    if(m_problem.parameters.constant_thresholds) {
      const Level_range on_mesh = Bspline_shells::facet_ranges<ConcurrencyTag>(*m_fitted.field(), m_fitted.clipped())
                                    .mesh;
      m_thresholds.set_constant(round_outwards(on_mesh, m_problem.input->unit() / levels_per_box_size));
    }
    const auto ranges = [&](Mesh_ranges::Precision precision) -> const std::vector<Level_range>& {
      return this->ranges(precision);
    };
    return m_thresholds.template choose<ConcurrencyTag>(ranges, limits);
  }
  /// @}

  Thresholds& thresholds() { return m_thresholds; }
  const Thresholds& thresholds() const { return m_thresholds; }

private:
  // returns a point on each component of a mesh
  static std::vector<Field::Point_3> seeds(const Input_mesh_3& input)
  {
    std::vector<Field::Point_3> points(input.number_of_components());
    for(Input_mesh_3::Face_index f : input.mesh().faces()) {
      const auto& p = input.mesh().point(input.mesh().target(input.mesh().halfedge(f)));
      points[input.component(f)] = Field::Point_3(p.x(), p.y(), p.z());
    }
    return points;
  }

  template <typename Function>
  static void for_each_cell(std::size_t size, const Function& function)
  {
    constexpr std::size_t chunk = 256;
    internal::for_each_chunk<ConcurrencyTag>(size, chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c) function(Index(c));
    });
  }

  // invalidates the facets in some cells
  void invalidate_facets(const std::vector<char>& cells)
  {
    for(const Clipped_mesh_3::Piece& piece : m_fitted.clipped().pieces())
      if(cells[piece.cell]) m_unexamined[piece.facet] = 1;
  }

  const Refinement_problem& m_problem;
  const Fitted& m_fitted;
  std::vector<char> m_unexamined; // by facet: whether its result is invalid
  Mesh_ranges m_ranges;
  Thresholds m_thresholds;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_EXAMINED_FIELD_H
