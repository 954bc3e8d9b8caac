// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_FACET_NORMAL_H
#define CGAL_BSPLINE_SHELL_3_MESH_FACET_NORMAL_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief an enclosure of a facet normal: for some positive factor, each component of the exact normal times the factor
 * differs from `direction` by at most `radius`. The largest component is close to one.
 */
struct Facet_normal
{
  std::array<double, 3> direction;
  double radius;
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns an enclosure of the normal of a triangle with `double` vertices. It is computed in `double`s, or from
 * the exact cross product if cancellation is too large (for needles, and for facets far from the origin).
 *
 * \pre the triangle is not degenerate; otherwise, the result has no meaning
 */
template <typename Point_3>
Facet_normal facet_normal(const Point_3& p, const Point_3& q, const Point_3& r)
{
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const auto normalized = [](std::array<double, 3> n, double radius) {
    const double largest = (std::max)({ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) });
    for(double& x : n) x /= largest;
    return Facet_normal{ n, (1 + 4 * eps) * (radius / largest) + eps };
  };

  std::array<double, 3> u, v, n;
  double size_u = 0, size_v = 0;
  for(int a = 0; a < 3; ++a) {
    u[a] = q[a] - p[a];
    v[a] = r[a] - p[a];
    size_u = (std::max)(size_u, std::abs(u[a]));
    size_v = (std::max)(size_v, std::abs(v[a]));
  }
  double largest = 0;
  for(int a = 0; a < 3; ++a) {
    n[a] = u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3];
    largest = (std::max)(largest, std::abs(n[a]));
  }
  // Two differences and a product make three roundings of each of two products; one more for the difference of
  // products.
  const double radius = 8 * eps * size_u * size_v;
  constexpr double far_from_underflow = 1e-280;
  if(radius < 1e-8 * largest && largest > far_from_underflow) return normalized(n, radius);

  typedef Exact_rational ET;
  ET eu[3], ev[3], en[3], scale = 0;
  for(int a = 0; a < 3; ++a) {
    eu[a] = ET(q[a]) - ET(p[a]);
    ev[a] = ET(r[a]) - ET(p[a]);
  }
  for(int a = 0; a < 3; ++a) {
    en[a] = eu[(a + 1) % 3] * ev[(a + 2) % 3] - eu[(a + 2) % 3] * ev[(a + 1) % 3];
    scale = (std::max)(scale, ET(CGAL::abs(en[a])));
  }
  if(scale == 0) return Facet_normal{ {}, 1 };
  for(int a = 0; a < 3; ++a) n[a] = internal::rounded(ET(en[a] / scale));
  return normalized(n, 2 * eps); // a number in [-1, 1] is rounded by at most one unit in the last place
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_FACET_NORMAL_H
