// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_OBSTACLE_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_OBSTACLE_H

#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief a place that thresholds must exclude from the shell, but cannot, because |f| on the mesh nearby is too large.
 */
struct Threshold_obstacle
{
  std::uint32_t cell;
  std::array<double, 3> point; ///< place in the units of the coordinates
  Sign side = ZERO;            ///< side of the threshold; `ZERO` if the field may be zero at the place
  double size = 0;             ///< upper bound on the threshold's magnitude
};

/// \ingroup PkgBsplineShell3Construction
/// returns the cells of obstacles, ascending
inline std::vector<std::uint32_t> cells_of(const std::vector<Threshold_obstacle>& obstacles)
{
  std::vector<std::uint32_t> cells;
  for(const Threshold_obstacle& o : obstacles) cells.push_back(o.cell);
  sort_unique(cells);
  return cells;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the cells where |f| on the mesh is so large that thresholds cannot exclude an obstacle.
 *
 * Thresholds are splines on the same cells, so all cells in the supports of the functions that act on an obstacle's
 * cell are examined. In the middle of a thin wall, for example, the field is near zero, and the cells with large values
 * are at its rim, some cells away. An obstacle whose side is `ZERO` has no causing cells.
 *
 * \param ranges enclosures of the field on the part of the mesh in each cell
 * \param part largest allowed |f| on the mesh, as a fraction of the obstacle's size
 */
template <typename Field>
std::vector<std::uint32_t> causing_cells_of(const Field& field, const std::vector<Level_range>& ranges,
                                            const Threshold_obstacle& o, double part)
{
  std::vector<std::uint32_t> cells;
  if(o.side == ZERO) return cells;
  // The box of all supports is shrunk to skip cells that only touch it.
  Bbox_3 b = field.cell(o.cell).bbox();
  field.visit_coefficients(o.cell, [&](int, std::uint32_t u, double) { b += field.support(u); });
  const double inside = field.cells().width(o.cell) / 64;
  const Bbox_3 box(b.xmin() + inside, b.ymin() + inside, b.zmin() + inside, b.xmax() - inside, b.ymax() - inside,
                   b.zmax() - inside);
  field.visit_cells(box, [&](std::uint32_t c) {
    if((o.side == POSITIVE ? ranges[c].max : -ranges[c].min) > part * o.size) cells.push_back(c);
  });
  return cells;
}

/// \ingroup PkgBsplineShell3Construction
/// returns the causing cells of all obstacles, ascending; the cell of an obstacle without causing cells is included
template <typename ConcurrencyTag, typename Field>
std::vector<std::uint32_t> causing_cells_of(const Field& field, const std::vector<Level_range>& ranges,
                                            const std::vector<Threshold_obstacle>& obstacles, double part)
{
  typedef typename Field::Cell_index Index;
  constexpr std::size_t chunk = 16;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Index>& found) {
    for(std::size_t n = begin; n < end; ++n) {
      const std::vector<Index> causing = causing_cells_of(field, ranges, obstacles[n], part);
      if(causing.empty()) found.push_back(obstacles[n].cell);
      found.insert(found.end(), causing.begin(), causing.end());
    }
    sort_unique(found);
  };
  std::vector<Index> cells = internal::collect_from_chunks<ConcurrencyTag, Index>(obstacles.size(), chunk, find);
  sort_unique(cells);
  return cells;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THRESHOLD_OBSTACLE_H
