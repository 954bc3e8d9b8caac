// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H

#include <CGAL/Bspline_shell_3/Construction/Threshold_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_forms.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <array>
#include <cmath>
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
 * \brief a cell where the size of a field may be too large on the mesh, and the examined point where it is largest.
 */
struct Thick_cell
{
  std::uint32_t cell;
  std::uint32_t facet;         ///< facet of the point
  std::array<double, 3> point; ///< user units
};

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

  /// returns the cells where |f| exceeds the bound of the last update, or is not proved not to exceed it; ascending
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
      Scratch scratch;
      for(std::size_t n = begin; n < end; ++n) {
        const Cell_index c = pieces[outdated[n].first].cell;
        const std::optional<Thick_cell> found = bound(field, clipped, outdated[n].first, outdated[n].second, largest(c),
                                                      precision, scratch);
        if(found) thick.push_back(*found);
        m_precision[c] = precision;
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
      Scratch scratch;
      std::optional<Bounds<Field> > bounds;
      for(std::size_t n = begin; n < end; ++n) {
        const Cell_index c = pieces[n].cell;
        if(n == begin || c != pieces[n - 1].cell) bounds.emplace(field, c);
        const Level_range range = bounds->by_corners(clipped, pieces[n], scratch.corners).range;
        of_piece[n] = { (std::max)(range.min, m_range[c].min), (std::min)(range.max, m_range[c].max) };
      }
    });
    std::vector<Level_range> ranges(clipped.number_of_facets());
    for(std::size_t n = 0; n < pieces.size(); ++n) ranges[pieces[n].facet].include(of_piece[n]);
    return ranges;
  }

private:
  struct Bounds_by_corners
  {
    Level_range at_corners, range;
    std::size_t corner; // corner where |f| is largest; `size` is |f| there
    double size;
  };

  struct Scratch
  {
    std::vector<internal::Subtriangle> stack;
    std::vector<std::array<double, 3> > corners, part;
    std::vector<Bounds_by_corners> by_corners;
  };

  // Bounds of the field in a cell.
  template <typename Field>
  struct Bounds
  {
    internal::Cell_with_pieces<Field> in;
    internal::Corner_bounds corner_bounds;

    Bounds(const Field& field, Cell_index c) : in(field, c), corner_bounds(enclosed_value(in.cell)) {}

    // Also returns the corners in local coordinates.
    Bounds_by_corners by_corners(const Clipped_mesh_3& clipped, const Clipped_mesh_3::Piece& piece,
                                 std::vector<std::array<double, 3> >& corners) const
    {
      in.get_corners(clipped, piece, corners);
      const std::pair<double, double> excess = corner_bounds.excess(corners, in.shift);
      Bounds_by_corners result = { {}, {}, piece.first, -1 };
      Level_range& range = result.at_corners;
      for(std::size_t v = piece.first; v < piece.first + piece.size; ++v) {
        const double value = in.cell.value(clipped.point(v));
        range.include(value);
        if(std::abs(value) > result.size) {
          result.size = std::abs(value);
          result.corner = v;
        }
      }
      result.range = widened(range, excess);
      return result;
    }

    Level_range widened(const Level_range& values, const std::pair<double, double>& excess) const
    {
      return { values.min - excess.first - in.error, values.max + excess.second + in.error };
    }

    // Bounds by how much the field may exceed its values on a `Grid_on_triangle`. All triangles of the grid are
    // congruent, so one of them suffices.
    std::pair<double, double> excess_on_grid(const std::vector<std::array<double, 3> >& corners, int halvings,
                                             std::vector<std::array<double, 3> >& part) const
    {
      std::pair<double, double> most(0, 0);
      for(std::size_t v = 1; v + 1 < corners.size(); ++v) {
        const Grid_on_triangle grid = { corners[0], corners[v], corners[v + 1], halvings };
        part = { grid(0, 0), grid(1, 0), grid(0, 1) };
        const std::pair<double, double> excess = corner_bounds.excess(part, in.shift);
        most = { (std::max)(most.first, excess.first), (std::max)(most.second, excess.second) };
      }
      return most;
    }

    // Calls `visit(point, value)` for the points of the grid that are not on the grid with one halving less.
    template <typename Visitor>
    void visit_grid(const std::vector<std::array<double, 3> >& corners, int halvings, const Visitor& visit) const
    {
      for(std::size_t v = 1; v + 1 < corners.size(); ++v) {
        const Grid_on_triangle grid = { corners[0], corners[v], corners[v + 1], halvings };
        const int first = v == 1 ? 0 : 1; // the common edge was visited with the previous triangle
        for(int j = first; j <= 1 << halvings; ++j)
          for(int i = 0; i + j <= 1 << halvings; ++i) {
            if(i % 2 == 0 && j % 2 == 0) continue;
            const std::array<double, 3> x = grid(i, j);
            visit(x, in.cell.local_value(x));
          }
      }
    }
  };

  // The grid of points that repeated halving of a triangle's edges yields, in local coordinates.
  struct Grid_on_triangle
  {
    std::array<double, 3> p, q, r;
    int halvings;

    std::array<double, 3> operator()(int i, int j) const
    {
      const double step = 1. / (1 << halvings);
      std::array<double, 3> x;
      for(int a = 0; a < 3; ++a) x[a] = p[a] + (i * step) * (q[a] - p[a]) + (j * step) * (r[a] - p[a]);
      return x;
    }
  };

  static bool is_within(const Level_range& range, double size) { return range.min >= -size && range.max <= size; }

  // Bounds the field on the pieces of a cell. Returns a point if the cell is thick.
  template <typename Field>
  std::optional<Thick_cell> bound(const Field& field, const Clipped_mesh_3& clipped, std::size_t first,
                                  std::size_t last, double size, Precision precision, Scratch& scratch)
  {
    const Cell_index c = clipped.pieces()[first].cell;
    const Bounds<Field> bounds(field, c);
    const auto& in = bounds.in;
    // First, bounds by the values at corners.
    auto& by_corners = scratch.by_corners;
    by_corners.clear();
    Level_range attained;
    Thick_cell place = { c, clipped.pieces()[first].facet, clipped.point(clipped.pieces()[first].first) };
    double most = -1;
    for(std::size_t n = first; n < last; ++n) {
      const Clipped_mesh_3::Piece& piece = clipped.pieces()[n];
      by_corners.push_back(bounds.by_corners(clipped, piece, scratch.corners));
      attained.include(by_corners.back().at_corners);
      if(by_corners.back().size > most) {
        most = by_corners.back().size;
        place.facet = piece.facet;
        place.point = clipped.point(by_corners.back().corner);
      }
    }
    const auto see = [&](double value, std::uint32_t facet, const std::array<double, 3>& x) {
      attained.include(value);
      if(!(std::abs(value) > most)) return;
      most = std::abs(value);
      place.facet = facet;
      for(int a = 0; a < 3; ++a) place.point[a] = in.cell.corner()[a] + in.cell.width() * x[a];
    };
    // Once |f| exceeds the bound at a point, the cell is thick. The search then only continues for a point where |f| is
    // nearly largest. Pieces whose ranges exceed the attained values by little need no better bounds.
    const auto open_from = [&] { return most > size ? most / threshold_tuning.nearly_largest : size; };
    const double excess = threshold_tuning.range_excess * size;
    const auto is_enough = [&](const Level_range& r) {
      return is_within(r, open_from())
             && (precision == SUFFICIENT || (r.min >= attained.min - excess && r.max <= attained.max + excess));
    };
    Level_range range;
    for(std::size_t n = first; n < last; ++n) {
      if(is_enough(by_corners[n - first].range)) {
        range.include(by_corners[n - first].range);
        continue;
      }
      const Clipped_mesh_3::Piece& piece = clipped.pieces()[n];
      in.get_corners(clipped, piece, scratch.corners);
      const auto& corners = scratch.corners;
      // Then, bounds by a grid, if it may be fine enough.
      Level_range values = by_corners[n - first].at_corners;
      bool is_known = false;
      for(int halvings = 1, seen = 0; halvings <= threshold_tuning.max_grid_halvings && !is_known; ++halvings) {
        const std::pair<double, double> beyond = bounds.excess_on_grid(corners, halvings, scratch.part);
        if(!is_enough(bounds.widened(values, beyond))) continue;
        while(seen < halvings)
          bounds.visit_grid(corners, ++seen, [&](const std::array<double, 3>& x, double value) {
            values.include(value);
            see(value, piece.facet, x);
          });
        const Level_range enclosure = bounds.widened(values, beyond);
        is_known = is_enough(enclosure);
        if(is_known) range.include(enclosure);
      }
      if(is_known) continue;
      auto& stack = scratch.stack;
      for(std::size_t v = 1; v + 1 < corners.size(); ++v)
        stack.push_back({ corners[0], corners[v], corners[v + 1], 0 });
      while(!stack.empty()) {
        const internal::Subtriangle t = stack.back();
        stack.pop_back();
        const std::array<double, 55> b = triangle_bernstein_form<double>(in.cell.coefficients(), t.p, t.q, t.r);
        see(b[0], piece.facet, t.p);
        see(b[45], piece.facet, t.q);
        see(b[54], piece.facet, t.r);
        const auto hull = std::minmax_element(b.begin(), b.end());
        const Level_range part = { *hull.first - in.error, *hull.second + in.error };
        // written such that the search ends if bounds are NaN
        const bool is_open = (std::max)(-part.min, part.max) > open_from();
        if(is_open && t.depth < threshold_tuning.max_range_depth) t.push_quarters(stack);
        else range.include(part);
      }
    }
    if(m_precision[c] != UNKNOWN)
      range = { (std::max)(range.min, m_range[c].min), (std::min)(range.max, m_range[c].max) };
    m_range[c] = range;
    if(is_within(range, size)) return std::nullopt;
    return place;
  }

  std::vector<Level_range> m_range;
  std::vector<Precision> m_precision;
  std::vector<Thick_cell> m_thick;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MESH_RANGES_H
