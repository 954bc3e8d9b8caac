// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CELLS_CELL_COMPLEX_3_H
#define CGAL_BSPLINE_SHELL_3_CELLS_CELL_COMPLEX_3_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief the lattice of cell corners: all points `origin + spacing * (i, j, k)` with integers `i`, `j`, and `k`.
 *
 * The spacing is rounded to at most 20 significant bits, and the origin to a multiple of half the spacing's last bit.
 * Hence the corners of all cells, and of cells split up to `finest_level` times, are `double`s, and a proof on a cell's
 * box holds for the cell. The lattice is symmetric about the box's center. If a mesh is reflected, rotated by a right
 * angle, or scaled by a power of two, so is its lattice.
 */
class Lattice_3
{
public:
  typedef Lattice_point Point;            ///< three `int`
  static constexpr int finest_level = 12; ///< number of times that cells can be split, at least

  Lattice_3() = default;

  /// constructs a lattice with a point near the center of `box` and a spacing near `spacing`, in the units of the
  /// coordinates
  /// \pre `box` is finite, `spacing > 0`
  Lattice_3(const Bbox_3& box, double spacing)
  {
    double largest = 0;
    for(int a = 0; a < 3; ++a) largest = (std::max)({ largest, std::abs((box.min)(a)), std::abs((box.max)(a)) });
    int exponent, magnitude;
    const double mantissa = std::frexp(spacing, &exponent); // lies in [1/2, 1)
    const double cells = (largest + 4 * spacing) / spacing;
    std::frexp(cells, &magnitude);
    const int bits = (std::min)(max_bits, 51 - finest_level - magnitude);
    m_exact = std::isfinite(cells) && bits >= 4 && std::ldexp(1., exponent - bits - finest_level) > 0;
    if(!m_exact) return;
    const double last_bit = std::ldexp(1., exponent - bits);
    m_spacing = std::nearbyint(std::ldexp(mantissa, bits)) * last_bit;
    for(int a = 0; a < 3; ++a) {
      const double center = (box.min)(a) / 2 + (box.max)(a) / 2; // symmetric rounding
      m_origin[a] = std::nearbyint(center / last_bit) * last_bit;
    }
  }

  /// returns the lattice of the constructor, shifted by half a spacing along each axis where a side of the box would
  /// lie in a lattice plane or near it. Otherwise, rounding would put a side of a mesh on either side of such a plane,
  /// and the cells of a scaled mesh would not be the scaled cells.
  static Lattice_3 off_the_ends(const Bbox_3& box, double spacing)
  {
    Lattice_3 lattice(box, spacing);
    if(!lattice.m_exact) return lattice;
    for(int a = 0; a < 3; ++a) {
      const double end = ((box.max)(a) / 2 - (box.min)(a) / 2) / lattice.m_spacing;
      // The bound is not 1/4, because boxes with simple ratios of sides have this fraction, so that rounding would
      // decide.
      if(std::abs(end - std::nearbyint(end)) < 0.2) lattice.m_origin[a] -= lattice.m_spacing / 2;
    }
    return lattice;
  }

  /// returns the lattice with exactly this origin and spacing, for example from a file. `is_exact()` refers to the
  /// corners of the cells with lattice points from `first` to `last`, and of these cells split up to `finest_level`
  /// times.
  /// \pre the absolute coordinates of `first` and `last` are at most `Lattice_key::max_coordinate`
  static Lattice_3 from_origin(const std::array<double, 3>& origin, double spacing, const Point& first,
                               const Point& last)
  {
    Lattice_3 lattice;
    lattice.m_origin = origin;
    lattice.m_spacing = spacing;
    if(!(std::isfinite(spacing) && spacing > 0)) return lattice;
    constexpr int digits = std::numeric_limits<double>::digits;
    // Corners are multiples of 2^unit, and doubles if they are less than 2^(unit + digits).
    int unit = last_bit(spacing) - finest_level;
    for(double x : origin) {
      if(!std::isfinite(x)) return lattice;
      if(x != 0) unit = (std::min)(unit, last_bit(x));
    }
    lattice.m_exact = std::ilogb(spacing) - last_bit(spacing) < max_bits
                      && unit >= std::numeric_limits<double>::min_exponent - digits;
    const double bound = std::ldexp(1., unit + digits);
    for(int a = 0; a < 3; ++a) {
      const double furthest = (std::max)(
        { std::abs(double(first[a])), std::abs(double(last[a])), std::abs(last[a] + 1.) });
      lattice.m_exact = lattice.m_exact && std::abs(origin[a]) + furthest * spacing < bound;
    }
    return lattice;
  }

  /// returns how often cells with lattice points from `first` to `last` can be split with exact corners. If coordinates
  /// are not large, this is more than `finest_level`.
  int number_of_halvings(const Point& first, const Point& last) const
  {
    if(!m_exact) return 0;
    double furthest = 0;
    int unit = last_bit(m_spacing);
    for(int a = 0; a < 3; ++a) {
      if(m_origin[a] != 0) unit = (std::min)(unit, last_bit(m_origin[a]));
      furthest = (std::max)({ furthest, std::abs(coordinate(a, first[a])), std::abs(coordinate(a, last[a] + 1)) });
    }
    constexpr int digits = std::numeric_limits<double>::digits;
    // Corners are multiples of 2^(unit - halvings), and doubles if they are less than 2^(unit - halvings + digits).
    return (std::min)(unit + digits - 1 - std::ilogb(furthest),
                      unit - std::numeric_limits<double>::min_exponent + digits);
  }

  /// returns whether the corners are exact; otherwise, the cells are too small for their coordinates
  bool is_exact() const { return m_exact; }
  double spacing() const { return m_spacing; } ///< edge length of a cell
  const std::array<double, 3>& origin() const { return m_origin; }

  /// returns the exact coordinate of lattice plane `i` across axis `a`
  double coordinate(int a, int i) const { return m_origin[a] + i * m_spacing; }

  std::array<double, 3> corner(const Point& p) const
  {
    return { coordinate(0, p[0]), coordinate(1, p[1]), coordinate(2, p[2]) };
  }

  /// returns the index `i` with `coordinate(a, i) <= x < coordinate(a, i+1)`, exactly.
  /// \pre `x` is at most `Lattice_key::max_coordinate` spacings from the origin
  int interval(int a, double x) const
  {
    int i = static_cast<int>(std::floor((x - m_origin[a]) / m_spacing));
    while(coordinate(a, i) > x) --i;
    while(coordinate(a, i + 1) <= x) ++i;
    return i;
  }

private:
  static constexpr int max_bits = 20; // significant bits of a spacing

  // Returns the exponent of the last bit that is set in `x`, which is neither zero nor infinite.
  static int last_bit(double x)
  {
    int exponent;
    double rest = std::frexp(x, &exponent);
    while(rest != std::trunc(rest)) {
      rest *= 2;
      --exponent;
    }
    return exponent;
  }

  std::array<double, 3> m_origin = {};
  double m_spacing = 0;
  bool m_exact = false;
};

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief a finite set of cells of a lattice, numbered from 0: the root cells of a `Cell_hierarchy_3`, and the domain
 * \f$D\f$ of a field.
 *
 * Cells are closed cubes; cell \f$(i,j,k)\f$ has the lattice point \f$(i,j,k)\f$ as its smallest corner. Neighboring
 * cells along x have consecutive indices. Memory is linear in the number of cells.
 */
class Cell_complex_3
{
  typedef Lattice_set_3 Lattice_set;
public:
  typedef Lattice_set::Index Index;                ///< index of a cell
  static constexpr Index npos = Lattice_set::npos; ///< no cell

  Cell_complex_3() = default;

  /// constructs the cells of `lattice` with the given lattice points; `keys` are sorted and unique
  Cell_complex_3(const Lattice_3& lattice, const std::vector<std::uint64_t>& keys) : m_lattice(lattice), m_cells(keys)
  {
    for(Index c = 0; c < m_cells.size(); ++c)
      for(int a = 0; a < 3; ++a) {
        const int i = m_cells.point(c)[a];
        m_first[a] = c == 0 ? i : (std::min)(m_first[a], i);
        m_last[a] = c == 0 ? i : (std::max)(m_last[a], i);
      }
  }

  const Lattice_3& lattice() const { return m_lattice; }
  /// returns whether the corners of all cells are exact
  bool is_exact() const
  {
    return number_of_cells() == 0
           || Lattice_3::from_origin(m_lattice.origin(), m_lattice.spacing(), m_first, m_last).is_exact();
  }
  /// returns how often the cells can be split with all corners exact
  int number_of_halvings() const { return number_of_cells() == 0 ? 0 : m_lattice.number_of_halvings(m_first, m_last); }
  std::size_t number_of_cells() const { return m_cells.size(); }
  double width() const { return m_lattice.spacing(); }
  const Lattice_3::Point& lattice_point(Index cell) const { return m_cells.point(cell); }
  std::array<double, 3> corner(Index cell) const { return m_lattice.corner(m_cells.point(cell)); }
  Index cell(const Lattice_3::Point& p) const { return m_cells.index(p); }

  /// returns a cell that contains the point, or `npos` if there is none. For a point on a common face, this is the cell
  /// of larger coordinates if it exists.
  template <typename Point>
  Index locate(const Point& p) const
  {
    Lattice_3::Point l;
    bool on_plane[3];
    for(int a = 0; a < 3; ++a) {
      if(!(std::abs(p[a] - m_lattice.origin()[a]) < m_lattice.spacing() * Lattice_key::max_coordinate))
        return npos; // also if a coordinate is NaN
      l[a] = m_lattice.interval(a, p[a]);
      on_plane[a] = m_lattice.coordinate(a, l[a]) == p[a];
    }
    return closed_cell(l, on_plane);
  }

  /// calls `visit(cell)` once for every cell that meets the closed box; returns whether the closed cells cover the box.
  /// Every box is allowed: an infinite box meets all cells, and a box that is empty or has a NaN coordinate meets none;
  /// such boxes are not covered.
  template <typename Visitor>
  bool visit_cells(const Bbox_3& box, const Visitor& visit) const
  {
    if(m_cells.size() == 0) return false;
    bool covered = true;
    double lower[3], upper[3]; // the box, clipped to the extent of the cells
    Lattice_3::Point first, last;
    bool flat_on_plane[3];
    for(int a = 0; a < 3; ++a) {
      lower[a] = (std::max)((box.min)(a), m_lattice.coordinate(a, m_first[a]));
      upper[a] = (std::min)((box.max)(a), m_lattice.coordinate(a, m_last[a] + 1));
      if(!(lower[a] <= upper[a])) return false;
      covered = covered && lower[a] == (box.min)(a) && upper[a] == (box.max)(a);
      first[a] = m_lattice.interval(a, lower[a]);
      last[a] = m_lattice.interval(a, upper[a]);
      const bool on_plane = m_lattice.coordinate(a, first[a]) == lower[a];
      flat_on_plane[a] = on_plane && lower[a] == upper[a];
      if(on_plane) --first[a];
    }
    // A missing cell leaves a gap only if the box reaches into it, not if the box touches its boundary.
    const auto reaches_into = [&](int a, int i) {
      if(flat_on_plane[a]) return i == last[a]; // the cell below suffices as well: see closed_cell()
      return lower[a] < m_lattice.coordinate(a, i + 1) && upper[a] > m_lattice.coordinate(a, i);
    };
    for(int k = first[2]; k <= last[2]; ++k)
      for(int j = first[1]; j <= last[1]; ++j) {
        const std::pair<Index, Index> range = m_cells.index_range(first[0], last[0] + 1, j, k);
        const bool complete = range.second - range.first == Index(last[0] + 1 - first[0]);
        if(covered && !complete && reaches_into(1, j) && reaches_into(2, k))
          for(int i = first[0]; i <= last[0]; ++i)
            if(reaches_into(0, i) && closed_cell({ i, j, k }, flat_on_plane) == npos) covered = false;
        for(Index c = range.first; c < range.second; ++c) visit(c);
      }
    return covered;
  }

private:
  // Returns the cell with the lattice point `l`. If it does not exist, returns a cell below it, across axes along which
  // the query lies on the plane between the two: cells are closed.
  Index closed_cell(const Lattice_3::Point& l, const bool (&on_plane)[3]) const
  {
    Index cell = m_cells.index(l);
    for(int m = 1; cell == npos && m < 8; ++m) {
      Lattice_3::Point below = l;
      bool possible = true;
      for(int a = 0; a < 3; ++a)
        if(m & (1 << a)) {
          possible = possible && on_plane[a];
          --below[a];
        }
      if(possible) cell = m_cells.index(below);
    }
    return cell;
  }

  Lattice_3 m_lattice;
  Lattice_set m_cells;
  Lattice_3::Point m_first = {}, m_last = {}; // smallest and largest coordinates of the cells
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CELLS_CELL_COMPLEX_3_H
