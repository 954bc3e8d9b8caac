// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RANGE_ON_PIECES_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RANGE_ON_PIECES_H

#include <CGAL/Bspline_shell_3/Construction/Threshold_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_forms.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

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
 * \brief a cell where the size of a field may be too large on the mesh, and the examined point where it is largest.
 */
struct Thick_cell
{
  std::uint32_t cell;
  std::uint32_t facet;         ///< facet of the point
  std::array<double, 3> point; ///< user units
};

namespace internal {

struct Bounds_by_corners
{
  Level_range at_corners, range;
  std::size_t corner; // corner where |f| is largest; `size` is |f| there
  double size;
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

// Bounds of the field in a cell.
template <typename Field>
struct Bounds_in_cell
{
  Cell_with_pieces<Field> in;
  Corner_bounds corner_bounds;

  Bounds_in_cell(const Field& field, typename Field::Cell_index c)
    : in(field, c), corner_bounds(enclosed_value(in.cell))
  {}

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

// Returns whether no absolute value in a range exceeds `size`.
inline bool is_within(const Level_range& range, double size)
{
  return range.min >= -size && range.max <= size;
}

// Encloses a field on the pieces of the mesh in one cell. For each piece, the cheapest of three bounds that is good
// enough is used: by values at its corners, by values on a grid, and by Bernstein coefficients on parts of triangles.
template <typename Field>
class Range_on_pieces
{
public:
  // Memory that is used again for the next cell.
  struct Scratch
  {
    std::vector<Subtriangle> stack;
    std::vector<std::array<double, 3> > corners, part;
    std::vector<Bounds_by_corners> by_corners;
  };

  // The pieces are `begin`, ..., `end` - 1. `largest` is the size that |f| should not exceed. A sharp range exceeds
  // attained values by little; others suffice to compare |f| with `largest`.
  Range_on_pieces(const Field& field, const Clipped_mesh_3& clipped, std::size_t begin, std::size_t end, double largest,
                  bool is_sharp, Scratch& scratch)
    : m_bounds(field, clipped.pieces()[begin].cell), m_clipped(clipped), m_largest(largest), m_is_sharp(is_sharp),
      m_scratch(scratch), m_place{ clipped.pieces()[begin].cell, clipped.pieces()[begin].facet,
                                   clipped.point(clipped.pieces()[begin].first) }
  {
    add_corners(begin, end);
    for(std::size_t n = begin; n < end; ++n) {
      const Bounds_by_corners& by_corners = m_scratch.by_corners[n - begin];
      if(is_enough(by_corners.range)) {
        m_range.include(by_corners.range);
        continue;
      }
      const Clipped_mesh_3::Piece& piece = clipped.pieces()[n];
      m_bounds.in.get_corners(clipped, piece, m_scratch.corners);
      if(!bound_by_grid(piece, by_corners.at_corners)) bound_by_parts(piece);
    }
  }

  const Level_range& range() const { return m_range; }

  // Returns the examined point where |f| is largest.
  const Thick_cell& place() const { return m_place; }

private:
  void add_corners(std::size_t begin, std::size_t end)
  {
    m_scratch.by_corners.clear();
    for(std::size_t n = begin; n < end; ++n) {
      const Clipped_mesh_3::Piece& piece = m_clipped.pieces()[n];
      m_scratch.by_corners.push_back(m_bounds.by_corners(m_clipped, piece, m_scratch.corners));
      const Bounds_by_corners& found = m_scratch.by_corners.back();
      m_attained.include(found.at_corners);
      if(found.size > m_most) {
        m_most = found.size;
        m_place.facet = piece.facet;
        m_place.point = m_clipped.point(found.corner);
      }
    }
  }

  // Records a value at a point, in local coordinates.
  void add_value(double value, std::uint32_t facet, const std::array<double, 3>& x)
  {
    m_attained.include(value);
    if(!(std::abs(value) > m_most)) return;
    m_most = std::abs(value);
    m_place.facet = facet;
    const auto& cell = m_bounds.in.cell;
    for(int a = 0; a < 3; ++a) m_place.point[a] = cell.corner()[a] + cell.width() * x[a];
  }

  // Once |f| exceeds the bound at a point, the cell is thick. The search then only continues for a point where |f| is
  // nearly largest.
  double open_from() const { return m_most > m_largest ? m_most / threshold_tuning.nearly_largest : m_largest; }

  // Pieces whose ranges exceed the attained values by little need no better bounds.
  bool is_enough(const Level_range& r) const
  {
    const double excess = threshold_tuning.range_excess * m_largest;
    return is_within(r, open_from())
           && (!m_is_sharp || (r.min >= m_attained.min - excess && r.max <= m_attained.max + excess));
  }

  // Bounds the field by values on a grid, if one is fine enough.
  bool bound_by_grid(const Clipped_mesh_3::Piece& piece, Level_range values)
  {
    const auto& corners = m_scratch.corners;
    for(int halvings = 1, seen = 0; halvings <= threshold_tuning.max_grid_halvings; ++halvings) {
      const std::pair<double, double> beyond = m_bounds.excess_on_grid(corners, halvings, m_scratch.part);
      if(!is_enough(m_bounds.widened(values, beyond))) continue;
      while(seen < halvings)
        m_bounds.visit_grid(corners, ++seen, [&](const std::array<double, 3>& x, double value) {
          values.include(value);
          add_value(value, piece.facet, x);
        });
      const Level_range enclosure = m_bounds.widened(values, beyond);
      if(!is_enough(enclosure)) continue;
      m_range.include(enclosure);
      return true;
    }
    return false;
  }

  void bound_by_parts(const Clipped_mesh_3::Piece& piece)
  {
    const auto& corners = m_scratch.corners;
    const Cell_with_pieces<Field>& in = m_bounds.in;
    auto& stack = m_scratch.stack;
    for(std::size_t v = 1; v + 1 < corners.size(); ++v) stack.push_back({ corners[0], corners[v], corners[v + 1], 0 });
    while(!stack.empty()) {
      const Subtriangle t = stack.back();
      stack.pop_back();
      const std::array<double, 55> b = triangle_bernstein_form<double>(in.cell.coefficients(), t.p, t.q, t.r);
      add_value(b[0], piece.facet, t.p);
      add_value(b[45], piece.facet, t.q);
      add_value(b[54], piece.facet, t.r);
      const auto hull = std::minmax_element(b.begin(), b.end());
      const Level_range part = { *hull.first - in.error, *hull.second + in.error };
      // written such that the search ends if bounds are NaN
      const bool is_open = (std::max)(-part.min, part.max) > open_from();
      if(is_open && t.depth < threshold_tuning.max_range_depth) t.push_quarters(stack);
      else m_range.include(part);
    }
  }

  Bounds_in_cell<Field> m_bounds;
  const Clipped_mesh_3& m_clipped;
  double m_largest;
  bool m_is_sharp;
  Scratch& m_scratch;
  Level_range m_attained, m_range;
  double m_most = -1; // |f| at `m_place`
  Thick_cell m_place;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RANGE_ON_PIECES_H
