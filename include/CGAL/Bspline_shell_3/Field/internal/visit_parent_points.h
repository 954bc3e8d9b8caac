// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_VISIT_PARENT_POINTS_H
#define CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_VISIT_PARENT_POINTS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Calls visit(q, weight) for the points of the level above whose weighted coefficients sum to the coefficient at p.
template <typename Visitor>
void visit_parent_points(const Lattice_point& p, const Visitor& visit)
{
  // There are two parents along an axis for odd coordinates, and three for even coordinates.
  int first[3], size[3];
  for(int a = 0; a < 3; ++a) {
    const int odd = p[a] & 1;
    first[a] = odd ? (p[a] - 1) / 2 : p[a] / 2 - 1;
    size[a] = 3 - odd;
  }
  const auto mask = Cubic_bspline<>::two_scale_mask();
  const auto weight = [&](int a, int i) { return mask[std::size_t(p[a] - 2 * (first[a] + i) + 2)]; };
  for(int k = 0; k < size[2]; ++k)
    for(int j = 0; j < size[1]; ++j)
      for(int i = 0; i < size[0]; ++i)
        visit(Lattice_point{ first[0] + i, first[1] + j, first[2] + k }, weight(0, i) * weight(1, j) * weight(2, k));
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_VISIT_PARENT_POINTS_H
