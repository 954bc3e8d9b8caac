// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGLE_QUALITY_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGLE_QUALITY_H

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns twice the inradius divided by the circumradius: 1 for an equilateral triangle, 0 if there is no area.
template <typename Point>
double triangle_quality(const Point& p, const Point& q, const Point& r)
{
  const double a = std::sqrt(CGAL::squared_distance(q, r)), b = std::sqrt(CGAL::squared_distance(r, p)),
               c = std::sqrt(CGAL::squared_distance(p, q));
  const double denominator = (a + b + c) * a * b * c;
  return denominator > 0 ? 4 * CGAL::cross_product(q - p, r - p).squared_length() / denominator : 0;
}

// Returns the worst quality of the triangles (p, link[n], link[n+1]) around a point.
template <typename Point>
double star_quality(const Point& p, const std::vector<Point>& link)
{
  double least = 1;
  for(std::size_t n = 0; n < link.size(); ++n)
    least = (std::min)(least, triangle_quality(p, link[n], link[(n + 1) % link.size()]));
  return least;
}

// Returns the unit normal of a triangle, or zero if it has no area.
template <typename Point>
typename Kernel_traits<Point>::Kernel::Vector_3 unit_normal_or_zero(const Point& p, const Point& q, const Point& r)
{
  const auto n = CGAL::cross_product(q - p, r - p);
  const double length = std::sqrt(n.squared_length());
  return length > 0 ? n / length : n;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_TRIANGLE_QUALITY_H
