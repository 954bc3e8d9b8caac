// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H

#include <CGAL/Bspline_shell_3/Construction/Range_on_pieces.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief encloses a field on the part of the mesh in each cell, and updates these ranges where the field changes.
 *
 * For most cells, a proof that |f| is small enough suffices. It is based on the field's values at corners and on its
 * second derivatives. Otherwise, the field is also evaluated on grids of points. If this does not suffice either, the
 * field is bounded by Bernstein coefficients of degree nine, on parts of triangles where necessary.
 */
class Mesh_ranges
{
public:
  typedef std::uint32_t Cell_index;

  /// precision of a range
  enum Precision : char
  {
    UNKNOWN,
    SUFFICIENT,
    SHARP
  };

  explicit Mesh_ranges(std::size_t number_of_cells = 0)
    : m_range(number_of_cells), m_precision(number_of_cells, UNKNOWN)
  {}

  /// returns the range of each cell; empty if the cell does not contain a part of the mesh
  const std::vector<Level_range>& cells() const { return m_range; }

  /// returns the cells where |f| exceeds the bound, or is not proved not to exceed it; ascending
  const std::vector<Thick_cell>& thick_cells() const { return m_thick; }

  /// returns an enclosure of the field on the mesh
  Level_range mesh() const
  {
    Level_range range;
    for(const Level_range& r : m_range) range.include(r);
    return range;
  }

  /// invalidates the range of a cell; must be called where the field has changed
  void forget(Cell_index c) { m_precision[c] = UNKNOWN; }

  /// copies the results of cell `c` of `before` to cell `now`
  /// \pre both are the same cell, with the same field and the same part of the mesh
  void keep(const Mesh_ranges& before, Cell_index c, Cell_index now)
  {
    m_range[now] = before.m_range[c];
    m_precision[now] = before.m_precision[c];
    const auto thick = std::lower_bound(before.m_thick.begin(), before.m_thick.end(), c,
                                        [](const Thick_cell& t, Cell_index cell) { return t.cell < cell; });
    if(thick == before.m_thick.end() || thick->cell != c) return;
    m_thick.push_back(*thick);
    m_thick.back().cell = now;
  }

  /// bounds the field in all cells whose ranges are less precise than `precision`.
  /// \tparam ConcurrencyTag as for `bspline_shell_3()`; the result is the same
  /// \param field the field
  /// \param clipped the mesh, clipped to the field's cells
  /// \param largest the value that \f$|f|\f$ should not exceed, a function of cells
  /// \param precision `SUFFICIENT` if only a comparison with `largest` is needed, `SHARP` otherwise
  template <typename ConcurrencyTag, typename Field, typename Size>
  void update(const Field& field, const Clipped_mesh_3& clipped, const Size& largest, Precision precision)
  {
    constexpr std::size_t chunk = 16;
    std::vector<std::pair<std::size_t, std::size_t> > outdated; // ranges of pieces, by cell
    const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
    for(std::size_t n = 0, next; n < pieces.size(); n = next) {
      for(next = n + 1; next < pieces.size() && pieces[next].cell == pieces[n].cell; ++next) {}
      if(m_precision[pieces[n].cell] < precision) outdated.emplace_back(n, next);
    }
    m_thick.erase(std::remove_if(m_thick.begin(), m_thick.end(),
                                 [&](const Thick_cell& t) { return m_precision[t.cell] < precision; }),
                  m_thick.end());
    const auto examine = [&](std::size_t begin, std::size_t end, std::vector<Thick_cell>& thick) {
      typename internal::Range_on_pieces<Field>::Scratch scratch;
      for(std::size_t n = begin; n < end; ++n) {
        const Cell_index c = pieces[outdated[n].first].cell;
        const double size = largest(c);
        const internal::Range_on_pieces<Field> found(field, clipped, outdated[n].first, outdated[n].second, size,
                                                     precision == SHARP, scratch);
        Level_range range = found.range();
        if(m_precision[c] != UNKNOWN)
          range = { (std::max)(range.min, m_range[c].min), (std::min)(range.max, m_range[c].max) };
        m_range[c] = range;
        m_precision[c] = precision;
        if(!internal::is_within(range, size)) thick.push_back(found.place());
      }
    };
    const std::vector<Thick_cell> more = internal::collect_from_chunks<ConcurrencyTag, Thick_cell>(outdated.size(),
                                                                                                   chunk, examine);
    m_thick.insert(m_thick.end(), more.begin(), more.end());
    std::sort(m_thick.begin(), m_thick.end(), [](const Thick_cell& a, const Thick_cell& b) { return a.cell < b.cell; });
  }

  /// returns a coarse enclosure of the field on each facet
  /// \pre the ranges of all cells are known
  template <typename ConcurrencyTag, typename Field>
  std::vector<Level_range> facets(const Field& field, const Clipped_mesh_3& clipped) const
  {
    constexpr std::size_t chunk = 1024;
    const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
    std::vector<Level_range> of_piece(pieces.size());
    internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
      std::vector<std::array<double, 3> > corners;
      std::optional<internal::Bounds_in_cell<Field> > bounds;
      for(std::size_t n = begin; n < end; ++n) {
        const Cell_index c = pieces[n].cell;
        if(n == begin || c != pieces[n - 1].cell) bounds.emplace(field, c);
        const Level_range range = bounds->by_corners(clipped, pieces[n], corners).range;
        of_piece[n] = { (std::max)(range.min, m_range[c].min), (std::min)(range.max, m_range[c].max) };
      }
    });
    std::vector<Level_range> ranges(clipped.number_of_facets());
    for(std::size_t n = 0; n < pieces.size(); ++n) ranges[pieces[n].facet].include(of_piece[n]);
    return ranges;
  }

private:
  std::vector<Level_range> m_range;
  std::vector<Precision> m_precision;
  std::vector<Thick_cell> m_thick;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H
