// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_LEAVES_BAND_H
#define CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_LEAVES_BAND_H

#include <CGAL/Bspline_shell_3/internal/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/level_bounds.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Whether the part of {levels.min <= f <= levels.max} that hangs together with the mesh may reach the boundary of the
// domain. Bernstein coefficients over-estimate: `false` is certain (but for rounding), `true` is a maybe.
template <typename Field>
bool shell_leaves_band(const Field& field, const std::vector<std::uint64_t>& surface_cells, const Level_range& levels)
{
  typedef typename Field::Cell_index Index;
  const auto meets = [&](double least, double largest, double error) {
    return least - error <= levels.max && largest + error >= levels.min;
  };
  // the range of the sixteen coefficients on a face
  const auto face_meets = [&](const typename Field::Cell& cell, int axis, bool positive) {
    Level_range range;
    const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
    for(int n = 0; n < 64; ++n)
      if((n / stride) % 4 == (positive ? 3 : 0)) range.include(cell.coefficients()[n]);
    return meets(range.min, range.max, cell.error_radius());
  };
  std::vector<char> seen(field.number_of_cells(), 0);
  std::vector<Index> stack;
  for(std::uint64_t key : surface_cells) {
    const Index c = field.cells().cell(Lattice_key::decode(key));
    seen[c] = 1;
    stack.push_back(c);
  }
  while(!stack.empty()) {
    const Index c = stack.back();
    stack.pop_back();
    const auto cell = field.cell(c);
    for(int axis = 0; axis < 3; ++axis)
      for(bool positive : { false, true }) {
        const Index n = field.neighbor(c, axis, positive);
        if(n != Field::npos && seen[n]) continue;
        if(!face_meets(cell, axis, positive)) continue;
        if(n == Field::npos) return true;
        seen[n] = 1;
        stack.push_back(n);
      }
  }
  return false;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_INTERNAL_SHELL_LEAVES_BAND_H
