// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_FILE_H
#define CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_FILE_H

#include <CGAL/Bspline_shell_3/Bspline_shell_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

constexpr std::string_view binary_shell_magic = "BSHELL", binary_shell_version = "01",
                           ASCII_shell_magic = "cubic_bspline_shell";
constexpr int ASCII_shell_version = 1;
constexpr std::uint64_t binary_uniform_field = 0;       // the only kind of field so far

// The lattice points of cells, from least to largest coordinates.
struct Lattice_extent
{
  Lattice_point first, last;

  void include(const Lattice_point& p)
  {
    for(int a = 0; a < 3; ++a) {
      first[a] = (std::min)(first[a], p[a]);
      last[a] = (std::max)(last[a], p[a]);
    }
  }

  // Sets of lattice points have a table with an entry for each row along x, also for those without cells. Whether it is
  // reasonable for so many cells: a file of two cells, far from each other, must not take all memory.
  bool has_reasonable_size(std::size_t cells) const
  {
    for(int a = 0; a < 3; ++a)
      if(first[a] < -Lattice_key::max_coordinate || last[a] > Lattice_key::max_coordinate) return false;
    const double rows = (last[1] - first[1] + 1.) * (last[2] - first[2] + 1.);
    return rows <= 67108864. + 1024. * double(cells);
  }
};

// averages of such numbers do not overflow on the way
inline bool is_coefficient(double x) { return std::abs(x) <= (std::numeric_limits<double>::max)() / 64; }

inline bool is_range(const Level_range& r) { return std::isfinite(r.min) && std::isfinite(r.max) && r.min <= r.max; }

// Whether there is a shell, and one that a file can hold.
template <typename Shell>
bool is_shell(const Shell& shell)
{
  if(!shell) return false;
  const auto& field = shell.field();
  const auto& cells = field.cells();
  if(field.number_of_cells() == 0 || shell.shell_cells().size() != field.number_of_cells()) return false;
  Lattice_extent extent = { cells.lattice_point(0), cells.lattice_point(0) };
  for(Cell_complex_3::Index c = 1; c < field.number_of_cells(); ++c) extent.include(cells.lattice_point(c));
  if(!extent.has_reasonable_size(field.number_of_cells())) return false;
  const Lattice_3& lattice = cells.lattice();
  Level_range levels;
  levels.min = shell.inner_level();
  levels.max = shell.outer_level();
  const double unit = shell.report().unit;
  return Lattice_3::from_origin(lattice.origin(), lattice.spacing(), extent.first, extent.last).is_exact()
      && is_range(levels) && std::isfinite(unit) && unit >= 0
      && std::all_of(shell.facet_ranges().begin(), shell.facet_ranges().end(), is_range)
      && std::all_of(field.coefficients().data(), field.coefficients().data() + field.coefficients().size(), is_coefficient);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_FILE_H
