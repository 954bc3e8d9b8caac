// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_TRIANGLE_QUADRATURE_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_TRIANGLE_QUADRATURE_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Calls f(point, weight) for the points of a quadrature rule on a triangle in cell units; the weights sum to its area.
// The integrands vary on the scale of a cell: the three-point rule (exact to degree two) for triangles as large as
// that, the centroid (degree one) for smaller ones, of which a cell holds many.
template <typename Function>
inline void for_each_quadrature_point(const std::array<double, 3>& p, const std::array<double, 3>& q,
                                      const std::array<double, 3>& r, const Function& f)
{
  constexpr double small = 0.25;
  const double u[3] = { q[0] - p[0], q[1] - p[1], q[2] - p[2] }, v[3] = { r[0] - p[0], r[1] - p[1], r[2] - p[2] };
  const double area = norm(cross(u, v)) / 2;
  if(!(area > 0)) return;
  double extent = 0;
  for(int a = 0; a < 3; ++a)
    extent = (std::max)(extent, (std::max)({ p[a], q[a], r[a] }) - (std::min)({ p[a], q[a], r[a] }));
  if(extent < small) {
    f(std::array<double, 3>{ (p[0] + q[0] + r[0]) / 3, (p[1] + q[1] + r[1]) / 3, (p[2] + q[2] + r[2]) / 3 }, area);
    return;
  }
  const std::array<double, 3>* corner[3] = { &p, &q, &r };
  for(int m = 0; m < 3; ++m) {
    const std::array<double, 3>& far = *corner[m];
    std::array<double, 3> x;
    for(int a = 0; a < 3; ++a) x[a] = (p[a] + q[a] + r[a]) / 6 + far[a] / 2;
    f(x, area / 3);
  }
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_TRIANGLE_QUADRATURE_H
