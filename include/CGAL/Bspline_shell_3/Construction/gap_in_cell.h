// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_GAP_IN_CELL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_GAP_IN_CELL_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>

#include <CGAL/enum.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the smallest gap (`Local_gap_3`) of the part of a mesh in a cell, in the units of the coordinates;
 * `most` if the gap is larger or the cell does not contain a part of the mesh.
 *
 * \param side of the mesh, as for `Local_gap_3`
 * \param most larger gaps are not searched
 */
inline double gap_in_cell(const Local_gap_3& gap, const Clipped_mesh_3& clipped, Cell_hierarchy_3::Index c, Sign side,
                          double most)
{
  double least = most;
  std::vector<std::array<double, 3> > corners;
  for(const Clipped_mesh_3::Piece& piece : clipped.pieces(c)) {
    corners.clear();
    for(std::uint32_t v = 0; v < piece.size; ++v) corners.push_back(clipped.point(piece.first + v));
    least = gap(Input_mesh_3::Face_index(piece.facet), corners.data(), corners.size(), side, least);
  }
  return least;
}

/// \ingroup PkgBsplineShell3Construction
/// returns the smaller of the gaps on the two sides: the narrowest wall or gap in a cell
inline double gap_in_cell(const Local_gap_3& gap, const Clipped_mesh_3& clipped, Cell_hierarchy_3::Index c, double most)
{
  return gap_in_cell(gap, clipped, c, POSITIVE, gap_in_cell(gap, clipped, c, NEGATIVE, most));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_GAP_IN_CELL_H
