// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_WEIGHTS_AT_GAPS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_WEIGHTS_AT_GAPS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/Marked_cells.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include <CGAL/Bspline_shell_3/Construction/gap_in_cell.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the factor on the weight of the surface term of the energy (`Fit_energy::set_surface_factors()`) in a
 * cell; zero if no wall or gap in it is narrower than the cell.
 *
 * In a cell of width \f$h\f$, a field that is zero on both sides of a gap of width \f$g < h\f$ has the value
 * \f$g^2 / (4h)\f$ in its middle (`slopes_at_gaps()`). Thresholds must lie between this value and \f$|f|\f$ on the
 * mesh, which the terms of the energy for slopes make as large as a fixed fraction of \f$h\f$. The factor \f$w\,
 * (h/g)^2\f$ reduces it to a fixed fraction of the value in the middle (\f$w\f$ is `Condition_tuning::weight_at_gap`).
 *
 * The factor is one if facets in the cell are not all parallel: a field that is zero on both facets of an edge has no
 * slope there. It is also one in cells wider than `Condition_tuning::widest_cell_at_gap` times the gap, where a cover
 * would need too many boxes.
 */
inline double surface_factor_at_gap(const Cell_hierarchy_3& cells, const Clipped_mesh_3& clipped,
                                    const Local_gap_3& gap, Cell_hierarchy_3::Index c)
{
  const double width = cells.width(c), narrowest = gap_in_cell(gap, clipped, c, width);
  if(!(narrowest < width)) return 0;
  if(width > condition_tuning.widest_cell_at_gap * narrowest) return 1;
  const Clipped_mesh_3::Piece_range pieces = clipped.pieces(c);
  const Clipped_mesh_3::Point& normal = clipped.normal(pieces.begin()->facet);
  for(const Clipped_mesh_3::Piece& piece : pieces)
    if(!(std::abs(internal::dot(normal, clipped.normal(piece.facet))) >= condition_tuning.least_parallel_cosine))
      return 1;
  const double ratio = width / narrowest;
  return condition_tuning.weight_at_gap * ratio * ratio;
}

/// \ingroup PkgBsplineShell3Construction
/// returns the factors of several cells
template <typename ConcurrencyTag>
std::vector<double> surface_factors_at_gaps(const Cell_hierarchy_3& cells, const Clipped_mesh_3& clipped,
                                            const Local_gap_3& gap,
                                            const std::vector<Cell_hierarchy_3::Index>& requested)
{
  constexpr std::size_t chunk = 16;
  std::vector<double> factors(requested.size());
  internal::for_each_chunk<ConcurrencyTag>(requested.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) factors[n] = surface_factor_at_gap(cells, clipped, gap, requested[n]);
  });
  return factors;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns causing cells of obstacles (`causing_cells_of()`) if larger weights in their gaps are likely to remove
 * most of the obstacles.
 *
 * An obstacle counts if the factor exceeds one in at least the fraction `Condition_tuning::weighable` of its causing
 * cells. At other obstacles, |f| is also large on parts of the mesh where larger weights do not help.
 *
 * \param ranges,part as for `causing_cells_of()`
 * \return the causing cells of the obstacles that count; empty if less than the same fraction of the obstacles counts
 */
template <typename ConcurrencyTag, typename Field>
std::vector<std::uint32_t> weighable_cells(const Field& field, const Clipped_mesh_3& clipped, const Local_gap_3& gap,
                                           const std::vector<Level_range>& ranges,
                                           const std::vector<Threshold_obstacle>& obstacles, double part)
{
  typedef std::vector<std::uint32_t> Cells;
  const Cells causing = causing_cells_of<ConcurrencyTag>(field, ranges, obstacles, part);
  const std::vector<double> factors = surface_factors_at_gaps<ConcurrencyTag>(field.cells(), clipped, gap, causing);
  std::vector<char> is_weighable(field.number_of_cells(), 0);
  for(std::size_t n = 0; n < causing.size(); ++n) is_weighable[causing[n]] = factors[n] > 1;
  const auto is_most = [](std::size_t some, std::size_t all) {
    return double(some) >= condition_tuning.weighable * double(all);
  };
  Cells result;
  std::size_t counted = 0;
  for(const Threshold_obstacle& o : obstacles) {
    const Cells of_obstacle = causing_cells_of(field, ranges, o, part);
    const auto some = std::count_if(of_obstacle.begin(), of_obstacle.end(), [&](auto c) { return is_weighable[c]; });
    if(some == 0 || !is_most(std::size_t(some), of_obstacle.size())) continue;
    ++counted;
    result.insert(result.end(), of_obstacle.begin(), of_obstacle.end());
  }
  if(!is_most(counted, obstacles.size())) return Cells();
  sort_unique(result);
  return result;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the factors on the weight of the surface term in the cells of a refinement.
 *
 * Only gaps with obstacles to thresholds have factors. A gap is a connected set of surface cells that are wider than a
 * wall or gap in them.
 */
template <typename ConcurrencyTag>
class Weights_at_gaps
{
public:
  typedef Cell_hierarchy_3::Index Index;

  /// the factor of each cell; empty if all are one
  const std::vector<float>& factors() const { return m_factors; }

  /// adds the gaps that contain given cells.
  /// \return the cells whose factor has increased
  std::vector<Index> add(const Cell_hierarchy_3& cells, const Clipped_mesh_3& clipped, const Local_gap_3& gap,
                         std::vector<Index> front)
  {
    m_factors.resize(cells.number_of_cells(), 1);
    m_is_at_gap.resize(cells.number_of_cells(), 0);
    std::vector<Index> increased;
    std::vector<char> is_seen = m_is_at_gap;
    const auto see = [&](std::vector<Index>& seen) {
      sort_unique(seen);
      seen.erase(std::remove_if(seen.begin(), seen.end(), [&](Index c) { return is_seen[c]; }), seen.end());
      for(Index c : seen) is_seen[c] = 1;
    };
    for(see(front); !front.empty(); see(front)) {
      const std::vector<double> factors = surface_factors_at_gaps<ConcurrencyTag>(cells, clipped, gap, front);
      std::vector<Index> next;
      for(std::size_t n = 0; n < front.size(); ++n) {
        if(factors[n] == 0) continue;
        m_is_at_gap[front[n]] = 1;
        m_factors[front[n]] = float(factors[n]);
        if(factors[n] > 1) increased.push_back(front[n]);
        visit_around(cells, front[n], [&](Index c) { next.push_back(c); });
      }
      front.swap(next);
    }
    sort_unique(increased);
    return increased;
  }

  /// keeps the gaps for finer cells, in which some factors are different
  void refine(const Cell_hierarchy_3& before, const Cell_hierarchy_3& cells, const Clipped_mesh_3& clipped,
              const Local_gap_3& gap)
  {
    const std::vector<float> old_factors = std::exchange(m_factors, std::vector<float>(cells.number_of_cells(), 1));
    const std::vector<char> was_at_gap = std::exchange(m_is_at_gap, std::vector<char>(cells.number_of_cells(), 0));
    std::vector<Index> fresh;
    for(Index c = 0; c < m_factors.size(); ++c) {
      const std::array<double, 3> corner = cells.corner(c);
      const double half = cells.width(c) / 2;
      const Index old = before.locate(Point(corner[0] + half, corner[1] + half, corner[2] + half));
      if(old == Cell_hierarchy_3::npos || !was_at_gap[old]) continue;
      m_is_at_gap[c] = 1;
      if(before.level(old) == cells.level(c)) m_factors[c] = old_factors[old];
      else fresh.push_back(c);
    }
    const std::vector<double> factors = surface_factors_at_gaps<ConcurrencyTag>(cells, clipped, gap, fresh);
    for(std::size_t n = 0; n < fresh.size(); ++n) m_factors[fresh[n]] = float((std::max)(factors[n], 1.));
  }

private:
  typedef Simple_cartesian<double>::Point_3 Point;

  std::vector<float> m_factors;
  std::vector<char> m_is_at_gap; // also set in cells whose factor is one
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_WEIGHTS_AT_GAPS_H
