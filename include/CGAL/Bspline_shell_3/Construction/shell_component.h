// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_COMPONENT_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_COMPONENT_H

#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the cells that the shell may intersect: a cover of the connected components of \f$\{\epsilon_1 \le f \le
 * \epsilon_2\}\f$ that intersect the mesh.
 *
 * Other components are not part of the shell: the field may have these values far from the mesh.
 */
struct Shell_component
{
  std::vector<char> cells; ///< whether each cell of the field is in the cover
  /// cells of the cover where the shell may reach the boundary of the domain
  std::vector<std::uint32_t> border_cells;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief computes the shell's cells by a flood fill.
 *
 * The flood fill starts at the cells that the mesh intersects. It passes all faces on which the range of the Bernstein
 * coefficients meets the interval between the thresholds. Because these ranges contain those of the field, cells
 * outside the cover are outside the shell, up to the rounding of thresholds.
 *
 * \param levels \f$\epsilon_1\f$ and \f$\epsilon_2\f$
 */
template <typename Field>
Shell_component shell_component(const Field& field, const std::vector<typename Field::Cell_index>& surface_cells,
                                const Level_range& levels)
{
  typedef typename Field::Cell_index Index;
  // Whether the range of the sixteen coefficients on a face meets the interval.
  const auto face_meets = [&](const typename Field::Cell& cell, int axis, bool positive) {
    Level_range range;
    const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
    for(int n = 0; n < 64; ++n)
      if((n / stride) % 4 == (positive ? 3 : 0)) range.include(cell.coefficients()[n]);
    return range.min - cell.error_radius() <= levels.max && range.max + cell.error_radius() >= levels.min;
  };
  Shell_component component;
  component.cells.assign(field.number_of_cells(), 0);
  std::vector<Index> stack;
  for(Index c : surface_cells) {
    component.cells[c] = 1;
    stack.push_back(c);
  }
  while(!stack.empty()) {
    const Index c = stack.back();
    stack.pop_back();
    const auto cell = field.cell(c);
    bool at_border = false;
    for(int axis = 0; axis < 3; ++axis)
      for(bool positive : { false, true }) {
        if(!face_meets(cell, axis, positive)) continue;
        const bool inside = field.visit_neighbors(c, axis, positive, [&](Index n) {
          if(component.cells[n]) return;
          component.cells[n] = 1;
          stack.push_back(n);
        });
        at_border = at_border || !inside;
      }
    if(at_border) component.border_cells.push_back(c);
  }
  return component;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_COMPONENT_H
