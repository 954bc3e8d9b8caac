// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPES_AT_GAPS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPES_AT_GAPS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/gap_in_cell.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the slopes that can be required of a field on the mesh in cells with narrow walls or gaps.
 *
 * In cells of width \f$h\f$, the second derivatives of a field are at most about \f$1/h\f$. If the field is zero on
 * both sides of a wall of width \f$g < h\f$, it resembles \f$(x^2 - g^2/4) / h\f$ across the wall. On both sides,
 * its slope is \f$g/h\f$. A quarter of this slope leaves room for variation along the wall.
 *
 * \param requested cells for which slopes are returned
 * \return the slope for each of these cells; infinite if no gap is narrower than the cell
 */
template <typename ConcurrencyTag>
std::vector<double> slopes_at_gaps(const Cell_hierarchy_3& cells, const std::vector<Cell_hierarchy_3::Index>& requested,
                                   const Local_gap_3& gap, const Clipped_mesh_3& clipped)
{
  constexpr std::size_t chunk = 16;
  std::vector<double> slopes(requested.size(), std::numeric_limits<double>::infinity());
  internal::for_each_chunk<ConcurrencyTag>(requested.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const double width = cells.width(requested[n]), narrowest = gap_in_cell(gap, clipped, requested[n], width);
      if(narrowest < width) slopes[n] = condition_tuning.slope_at_gap * narrowest / width;
    }
  });
  return slopes;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPES_AT_GAPS_H
