// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CELL_COMPLEX_3_H
#define CGAL_BSPLINE_SHELL_3_CELL_COMPLEX_3_H

#include <CGAL/Bspline_shell_3/internal/Lattice_set_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief the lattice of cell corners: all points `origin + spacing * (i, j, k)` with integers `i`, `j`, `k`.
 *
 * The spacing is rounded to at most 20 significant bits and the origin, near the centre of the box, to a multiple of
 * the spacing's last bit, so that every corner of a cell, also of a cell halved up to twelve times, is a `double`:
 * what is proved on a cell's box is proved for the cell. The lattice is symmetric about its origin: a mesh that is
 * mirrored, turned by a right angle or scaled by a power of two gets the mirrored, turned or scaled lattice.
 */
class Lattice_3
{
public:
  typedef internal::Lattice_point Point;   ///< three `int`

  Lattice_3() = default;

  /// a lattice for meshes in `box`, of a spacing near `spacing` (user units).
  /// \pre `box` is finite, `spacing > 0`
  Lattice_3(const Bbox_3& box, double spacing)
  {
    double largest = 0;
    for(int a = 0; a < 3; ++a)
      largest = (std::max)({ largest, std::abs((box.min)(a)), std::abs((box.max)(a)) });
    int exponent, magnitude;
    const double mantissa = std::frexp(spacing, &exponent);            // in [1/2, 1)
    std::frexp((largest + 4 * spacing) / spacing, &magnitude);
    const int bits = (std::min)(20, 52 - finest_level - magnitude);
    m_exact = bits >= 4 && std::isfinite(largest);
    if(!m_exact) return;
    const double last_bit = std::ldexp(1., exponent - bits);
    m_spacing = std::nearbyint(std::ldexp(mantissa, bits)) * last_bit;
    for(int a = 0; a < 3; ++a) {
      const double center = (box.min)(a) + ((box.max)(a) - (box.min)(a)) / 2;
      m_origin[a] = std::nearbyint(center / last_bit) * last_bit;
    }
  }

  /// whether the corners are exact; if not, the cells are too small for coordinates of that size
  bool is_exact() const { return m_exact; }
  double spacing() const { return m_spacing; }                     ///< edge length of a cell, user units
  const std::array<double, 3>& origin() const { return m_origin; }

  /// a coordinate of the lattice plane number `i` across axis `a`, exact
  double coordinate(int a, int i) const { return m_origin[a] + i * m_spacing; }

  std::array<double, 3> corner(const Point& p) const
  {
    return { coordinate(0, p[0]), coordinate(1, p[1]), coordinate(2, p[2]) };
  }

  /// the number `i` with `coordinate(a, i) <= x < coordinate(a, i+1)`, exact
  int interval(int a, double x) const
  {
    int i = static_cast<int>(std::floor((x - m_origin[a]) / m_spacing));
    while(coordinate(a, i) > x) --i;
    while(coordinate(a, i + 1) <= x) ++i;
    return i;
  }

private:
  static constexpr int finest_level = 12;

  std::array<double, 3> m_origin = {};
  double m_spacing = 0;
  bool m_exact = false;
};

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief a finite set of cells of a lattice, numbered from 0: the domain \f$D\f$ of a field.
 *
 * Cells are closed cubes; cell \f$(i,j,k)\f$ has the lattice point \f$(i,j,k)\f$ as its least corner. Neighbouring
 * cells along x have consecutive numbers. Memory is linear in the number of cells.
 */
class Cell_complex_3
{
  typedef internal::Lattice_set_3 Lattice_set;
public:
  typedef Lattice_set::Index Index;                        ///< number of a cell
  static constexpr Index npos = Lattice_set::npos;         ///< no cell

  Cell_complex_3() = default;

  /// the cells of `lattice` with the given lattice points; `keys` are sorted and unique
  Cell_complex_3(const Lattice_3& lattice, const std::vector<std::uint64_t>& keys)
    : m_lattice(lattice), m_cells(keys)
  {}

  const Lattice_3& lattice() const { return m_lattice; }
  std::size_t number_of_cells() const { return m_cells.size(); }
  double width() const { return m_lattice.spacing(); }
  const Lattice_3::Point& lattice_point(Index cell) const { return m_cells.point(cell); }
  std::array<double, 3> corner(Index cell) const { return m_lattice.corner(m_cells.point(cell)); }
  Index cell(const Lattice_3::Point& p) const { return m_cells.index(p); }

  /// the cell across the face of `cell` with normal along `axis`, on the side of larger (`positive`) or smaller
  /// coordinates; `npos` where the domain ends
  Index neighbor(Index cell, int axis, bool positive) const
  {
    Lattice_3::Point p = m_cells.point(cell);
    p[axis] += positive ? 1 : -1;
    return m_cells.index(p);
  }

  /// a cell that contains the point, `npos` if there is none. Points on a common face get the cell of larger
  /// coordinates, if it exists.
  template <typename Point>
  Index locate(const Point& p) const
  {
    Lattice_3::Point l;
    bool on_plane[3];
    for(int a = 0; a < 3; ++a) {
      if(!(std::abs(p[a] - m_lattice.origin()[a]) < m_lattice.spacing() * internal::Lattice_key::max_coordinate))
        return npos;    // also for a coordinate that is not a number
      l[a] = m_lattice.interval(a, p[a]);
      on_plane[a] = m_lattice.coordinate(a, l[a]) == p[a];
    }
    Index cell = m_cells.index(l);
    // the domain is closed: on its upper faces the cell is the one below
    for(int m = 1; cell == npos && m < 8; ++m) {
      Lattice_3::Point below = l;
      bool possible = true;
      for(int a = 0; a < 3; ++a)
        if(m & (1 << a)) { possible = possible && on_plane[a]; --below[a]; }
      if(possible) cell = m_cells.index(below);
    }
    return cell;
  }

  /// calls `visit(cell)` for every cell that meets the closed box; returns whether the cells cover the box
  template <typename Visitor>
  bool visit_cells(const Bbox_3& box, const Visitor& visit) const
  {
    Lattice_3::Point first, last;
    for(int a = 0; a < 3; ++a) {
      first[a] = m_lattice.interval(a, (box.min)(a));
      last[a] = m_lattice.interval(a, (box.max)(a));
      if(m_lattice.coordinate(a, first[a]) == (box.min)(a)) --first[a];
    }
    bool covered = true;
    for(int k = first[2]; k <= last[2]; ++k)
      for(int j = first[1]; j <= last[1]; ++j) {
        const std::pair<Index, Index> range = m_cells.index_range(first[0], last[0] + 1, j, k);
        // a missing cell leaves a gap only if the box reaches into it, not if it touches its boundary
        const bool inside = reaches_into(box, 1, j) && reaches_into(box, 2, k);
        if(range.first == npos) { covered = covered && !inside; continue; }
        if(inside && range.second - range.first != Index(last[0] + 1 - first[0]))
          for(int i = first[0]; i <= last[0]; ++i)
            if(reaches_into(box, 0, i) && m_cells.index(i, j, k) == npos) covered = false;
        for(Index c = range.first; c < range.second; ++c) visit(c);
      }
    return covered;
  }

  const internal::Lattice_set_3& cells() const { return m_cells; }

private:
  bool reaches_into(const Bbox_3& box, int a, int i) const
  {
    const double lower = m_lattice.coordinate(a, i), upper = m_lattice.coordinate(a, i + 1);
    if((box.min)(a) == (box.max)(a)) return lower <= (box.min)(a) && (box.min)(a) < upper;
    return (box.min)(a) < upper && (box.max)(a) > lower;
  }

  Lattice_3 m_lattice;
  Lattice_set m_cells;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CELL_COMPLEX_3_H
