// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THICKNESS_ON_MESH_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THICKNESS_ON_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the thickness of a shell on a mesh.
 */
struct Thickness_on_mesh
{
  double largest = 0; ///< largest difference of the thresholds
  /// fraction of the mesh's area in cells where this difference is more than 1 % below the requested thickness
  double narrowed_area = 0;
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief compares thresholds with the requested thickness.
 *
 * \param clipped the mesh, clipped to the cells of the thresholds
 * \param requested the requested thickness in a cell, in the units of the coordinates
 */
template <typename Threshold, typename Thickness>
Thickness_on_mesh thickness_on_mesh(const Clipped_mesh_3& clipped, const Threshold& inner, const Threshold& outer,
                                    const Thickness& requested)
{
  constexpr double narrower = 0.99;
  Thickness_on_mesh result;
  double narrow_area = 0, area = 0;
  for(std::size_t n = 0, next; n < clipped.number_of_pieces(); n = next) {
    const std::uint32_t c = clipped.pieces()[n].cell;
    double in_cell = 0;
    for(next = n; next < clipped.number_of_pieces() && clipped.pieces()[next].cell == c; ++next)
      in_cell += clipped.area(clipped.pieces()[next]);
    const Level_range difference =
      Bspline_shells::difference(enclosed_value(outer.field().cell(c)), enclosed_value(inner.field().cell(c))).range();
    result.largest = (std::max)(result.largest, difference.max);
    area += in_cell;
    if(difference.min < narrower * requested(c)) narrow_area += in_cell;
  }
  result.narrowed_area = narrow_area / area;
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_THICKNESS_ON_MESH_H
