// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_POINTS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_POINTS_H

#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

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
 * \brief calls `visit(piece, point)` for the points of a cell where a field should meet conditions: the centers of
 * pieces, and the corners of pieces that are not small relative to the cell. In cells with many pieces, only some
 * centers are visited.
 *
 * \param pieces all pieces in the cell
 * \param width width of the cell
 */
template <typename Visitor>
void visit_condition_points(const Clipped_mesh_3& clipped, const Clipped_mesh_3::Piece_range& pieces, double width,
                            const Visitor& visit)
{
  const std::size_t few = condition_tuning.few_pieces, most = condition_tuning.max_pieces;
  const auto is_small = [&](const Clipped_mesh_3::Piece& piece) {
    std::array<double, 3> low = clipped.point(piece.first), high = low;
    for(std::uint32_t v = 1; v < piece.size; ++v)
      for(int a = 0; a < 3; ++a) {
        low[a] = (std::min)(low[a], clipped.point(piece.first + v)[a]);
        high[a] = (std::max)(high[a], clipped.point(piece.first + v)[a]);
      }
    return !((std::max)({ high[0] - low[0], high[1] - low[1], high[2] - low[2] })
             > condition_tuning.small_piece * width);
  };
  const std::size_t size = pieces.size(), stride = (size + most - 1) / most;
  for(std::size_t n = 0; n < size; n += stride) {
    const Clipped_mesh_3::Piece& piece = pieces.begin()[std::ptrdiff_t(n)];
    std::array<double, 3> middle = {};
    for(std::uint32_t v = 0; v < piece.size; ++v)
      for(int a = 0; a < 3; ++a) middle[a] += clipped.point(piece.first + v)[a] / piece.size;
    visit(piece, middle);
    if(size > few || is_small(piece)) continue;
    for(std::uint32_t v = 0; v < piece.size; ++v) visit(piece, clipped.point(piece.first + v));
  }
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the conditions that `conditions_in(c, pieces, conditions)` appends for the cells `c` with pieces, in
 * the order of the cells.
 *
 * \tparam ConcurrencyTag unless it is `Sequential_tag`, the function is called concurrently
 */
template <typename ConcurrencyTag, typename Function>
std::vector<Slope_condition> conditions_by_cell(const Clipped_mesh_3& clipped, const Function& conditions_in)
{
  constexpr std::size_t chunk = 1024;
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  // A cell belongs to the chunk that contains its first piece.
  const auto first_of_cell = [&](std::size_t n) {
    while(0 < n && n < pieces.size() && pieces[n - 1].cell == pieces[n].cell) ++n;
    return n;
  };
  return internal::collect_from_chunks<ConcurrencyTag, Slope_condition>(
    pieces.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Slope_condition>& conditions) {
      for(std::size_t n = first_of_cell(begin), next; n < end; n = next) {
        for(next = n + 1; next < pieces.size() && pieces[next].cell == pieces[n].cell; ++next) {}
        conditions_in(
          pieces[n].cell,
          Clipped_mesh_3::Piece_range(pieces.begin() + std::ptrdiff_t(n), pieces.begin() + std::ptrdiff_t(next)),
          conditions);
      }
    });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CONDITION_POINTS_H
