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
/// a facet with too small a slope in a cell
struct Sloping_facet
{
  std::uint32_t cell, facet;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief what the obstacles to the thresholds of a round tell.
 */
enum class Obstacle_kind
{
  FEW, ///< they are local
  MANY,
  THICK_FIELD, ///< many are left of a field that was too large on the mesh in many cells
  NARROW_GAPS  ///< walls or gaps are too narrow for the shell asked for on much of the mesh
};

/// \ingroup PkgBsplineShell3Construction
/// with obstacles in more cells than that they are many
inline std::size_t many_obstacles(std::size_t cells_at_mesh, const Refinement_tuning& tuning)
{
  return (std::max)(tuning.least_many_obstacles, cells_at_mesh / tuning.many_obstacles);
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief what the rounds of a refinement have shown: whether they lead on, where refinement does not help, and whether
 * gaps are too narrow.
 */
class Refinement_history
{
public:
  /// \pre `tuning` outlives this object
  Refinement_history(std::size_t number_of_facets, const Refinement_tuning& tuning)
    : m_tuning(tuning), m_refinements(number_of_facets, 0)
  {}

  /// adds a round for which thresholds were chosen
  /// \param undecided_volume of the boxes that are in the way: boxes are larger where there are many, so that few of
  ///   them may have more volume than others before
  void add_round(const Refinement_round& round, double undecided_volume)
  {
    const bool leads_on = round.thick_cells > 0 || round.failing_facets < m_fewest_facets
                          || undecided_volume < m_tuning.progress * m_least_volume
                          || double(round.undecided_cells) < m_tuning.progress * m_fewest_obstacles;
    m_rounds_in_vain = leads_on ? 0 : m_rounds_in_vain + 1;
    m_least_volume = (std::min)(m_least_volume, undecided_volume);
    m_fewest_facets = (std::min)(m_fewest_facets, round.failing_facets);
    m_fewest_obstacles = (std::min)(m_fewest_obstacles, double(round.undecided_cells));
  }
  /// whether the last rounds have not led on
  bool is_in_vain() const { return m_rounds_in_vain >= m_tuning.max_rounds_in_vain; }

  /// the cells of facets that were not refined too often before
  std::vector<std::uint32_t> cells_worth_refining(const std::vector<Sloping_facet>& facets) const
  {
    std::vector<std::uint32_t> cells;
    for(const Sloping_facet& f : facets)
      if(is_worth_refining(f)) cells.push_back(f.cell);
    return cells;
  }
  /// counts one more refinement of these facets
  void add_refinements(const std::vector<Sloping_facet>& facets)
  {
    std::vector<std::uint32_t> refined;
    for(const Sloping_facet& f : facets)
      if(is_worth_refining(f)) refined.push_back(f.facet);
    sort_unique(refined);
    for(std::uint32_t f : refined) ++m_refinements[f];
  }

  /// tells the kind of the obstacles of a round. Gaps are narrow if there are very many, or many again after others
  /// were refined; once known, that stays so.
  /// \param cells with obstacles
  /// \param cells_at_mesh that the mesh passes through
  /// \param was_thick whether the field was too large on the mesh in many cells before small changes
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
  std::vector<int> m_refinements; // of each facet: how often it was a reason for them
  double m_least_volume = std::numeric_limits<double>::infinity(), m_fewest_obstacles = m_least_volume;
  std::size_t m_fewest_facets = std::numeric_limits<std::size_t>::max();
  int m_rounds_in_vain = 0;
  bool m_were_very_many = false, m_are_gaps_narrow = false;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_HISTORY_H
