// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_HISTORY_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_HISTORY_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/Shell/Refinement_round.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// a facet across which the slope is too small in a cell
struct Sloping_facet
{
  std::uint32_t cell, facet;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the likely cause of the obstacles to thresholds in a round.
 */
enum class Obstacle_kind
{
  FEW,         ///< a few places
  MANY,        ///< many places, without a common cause
  THICK_FIELD, ///< many places, after |f| was too large on the mesh in many cells
  NARROW_GAPS, ///< walls or gaps are too narrow for the thickness on much of the mesh
  WEIGHED_GAPS ///< flat walls or gaps in which the field is fitted again with larger weights
};

/// \ingroup PkgBsplineShell3Construction
/// returns the number of cells with obstacles above which these are many
inline std::size_t many_obstacles(std::size_t cells_at_mesh, const Refinement_tuning& tuning)
{
  return (std::max)(tuning.least_many_obstacles, cells_at_mesh / tuning.many_obstacles);
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief records the rounds of a refinement: their progress, the facets at which refinement does not help, and whether
 * gaps are too narrow.
 */
class Refinement_history
{
public:
  /// \pre `tuning` outlives this object
  Refinement_history(std::size_t number_of_facets, const Refinement_tuning& tuning)
    : m_tuning(tuning), m_refinements(number_of_facets, 0)
  {}

  /// records a round in which thresholds were chosen.
  /// \param round the number of thick cells, failing facets, and obstacles
  /// \param undecided_volume total volume of the obstacles' boxes, whose sizes differ
  void add_round(const Refinement_round& round, double undecided_volume)
  {
    const bool makes_progress = round.thick_cells > 0 || round.failing_facets < m_fewest_facets
                                || undecided_volume < m_tuning.progress * m_least_volume
                                || double(round.undecided_cells) < m_tuning.progress * m_fewest_obstacles;
    m_stalled_rounds = makes_progress ? 0 : m_stalled_rounds + 1;
    m_least_volume = (std::min)(m_least_volume, undecided_volume);
    m_fewest_facets = (std::min)(m_fewest_facets, round.failing_facets);
    m_fewest_obstacles = (std::min)(m_fewest_obstacles, double(round.undecided_cells));
  }
  /// records the number of failing cells of a round, and how many of them are at folds. Zero means that the round
  /// cannot be compared with others.
  void add_failing_cells(std::size_t number, std::size_t at_folds)
  {
    const bool is_stalled = number >= m_failing_before && double(at_folds) >= m_tuning.share_at_folds * double(number);
    m_rounds_at_folds = is_stalled ? m_rounds_at_folds + 1 : 0;
    m_failing_before = number > 0 ? number : std::numeric_limits<std::size_t>::max();
  }
  /// returns whether the last rounds made no progress
  bool is_stalled() const
  {
    return m_stalled_rounds >= m_tuning.max_stalled_rounds || m_rounds_at_folds >= m_tuning.max_rounds_at_folds;
  }

  /// returns the cells of the facets that may still cause refinement
  std::vector<std::uint32_t> cells_worth_refining(const std::vector<Sloping_facet>& facets) const
  {
    std::vector<std::uint32_t> cells;
    for(const Sloping_facet& f : facets)
      if(is_worth_refining(f)) cells.push_back(f.cell);
    return cells;
  }
  /// counts one refinement of each facet
  void add_refinements(const std::vector<Sloping_facet>& facets)
  {
    std::vector<std::uint32_t> refined;
    for(const Sloping_facet& f : facets)
      if(is_worth_refining(f)) refined.push_back(f.facet);
    sort_unique(refined);
    for(std::uint32_t f : refined) ++m_refinements[f];
  }

  /// classifies and records the obstacles of a round. Once gaps are considered too narrow, they remain so.
  /// \param cells number of cells with obstacles
  /// \param cells_at_mesh number of surface cells
  /// \param was_thick whether many cells were thick before corrections
  Obstacle_kind kind_of_obstacles(std::size_t cells, std::size_t cells_at_mesh, bool was_thick)
  {
    const bool are_many = cells > many_obstacles(cells_at_mesh, m_tuning);
    if(are_many && was_thick) return Obstacle_kind::THICK_FIELD;
    if(are_many && !m_are_gaps_narrow) {
      const bool are_very_many = cells > cells_at_mesh / m_tuning.cells_of_nearly_thin;
      m_are_gaps_narrow = (m_were_very_many && are_very_many) || cells > cells_at_mesh / m_tuning.cells_of_thin;
      m_were_very_many = are_very_many;
    }
    if(m_are_gaps_narrow && cells > 0) return Obstacle_kind::NARROW_GAPS;
    return are_many ? Obstacle_kind::MANY : Obstacle_kind::FEW;
  }
  bool are_gaps_narrow() const { return m_are_gaps_narrow; }

private:
  bool is_worth_refining(const Sloping_facet& f) const
  {
    return m_refinements[f.facet] < m_tuning.max_refinements_of_a_facet;
  }

  const Refinement_tuning& m_tuning;
  std::vector<int> m_refinements; // by facet: how often it caused refinement
  double m_least_volume = std::numeric_limits<double>::infinity(), m_fewest_obstacles = m_least_volume;
  std::size_t m_fewest_facets = std::numeric_limits<std::size_t>::max(), m_failing_before = m_fewest_facets;
  int m_stalled_rounds = 0, m_rounds_at_folds = 0;
  bool m_were_very_many = false, m_are_gaps_narrow = false;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_HISTORY_H
