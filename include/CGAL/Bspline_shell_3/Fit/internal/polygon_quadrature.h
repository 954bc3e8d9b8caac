// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_POLYGON_QUADRATURE_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_POLYGON_QUADRATURE_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Calls f(point, weight) for the points of a quadrature rule on a convex planar polygon in cell units. The weights sum
// to its area. The rule commutes with reflections and rotations, and does not depend on the first corner.
//
// The integrands vary on the scale of a cell. A small polygon, of which a cell has many, has one point, its centroid c
// (exact to degree one). A triangle as large as a cell has three points (exact to degree two). Other polygons have one
// point per side: the centroids of the triangles between c and the sides, moved away from c until the mean of |x - c|^2
// is exact. On a parallelogram, the rule is exact to degree two.
template <typename Function>
inline void for_each_quadrature_point(const std::vector<std::array<double, 3> >& polygon, const Function& f)
{
  typedef std::array<double, 3> Point;
  constexpr double small = 0.25;
  Point mean = {}, low = polygon.front(), high = low;
  for(const Point& p : polygon)
    for(int a = 0; a < 3; ++a) {
      mean[a] += p[a] / double(polygon.size());
      low[a] = (std::min)(low[a], p[a]);
      high[a] = (std::max)(high[a], p[a]);
    }
  const bool is_small = (std::max)({ high[0] - low[0], high[1] - low[1], high[2] - low[2] }) < small;

  // calls visit(u, v, area) for the triangles (o, o + u, o + v) between a point o and the sides
  const auto for_each_triangle = [&](const Point& o, const auto& visit) {
    const auto from_o = [&](const Point& p) { return Point{ p[0] - o[0], p[1] - o[1], p[2] - o[2] }; };
    Point u = from_o(polygon.back());
    for(const Point& p : polygon) {
      const Point v = from_o(p);
      visit(u, v, norm(cross(u, v)) / 2);
      u = v;
    }
  };
  double area = 0;
  Point moment = {};
  for_each_triangle(mean, [&](const Point& u, const Point& v, double part) {
    area += part;
    for(int a = 0; a < 3; ++a) moment[a] += part * (u[a] + v[a]) / 3;
  });
  if(!(area > 0)) return;
  const Point c = { mean[0] + moment[0] / area, mean[1] + moment[1] / area, mean[2] + moment[2] / area };
  if(is_small) {
    f(c, area);
    return;
  }
  if(polygon.size() == 3) {
    for(const Point& p : polygon) f(Point{ (c[0] + p[0]) / 2, (c[1] + p[1]) / 2, (c[2] + p[2]) / 2 }, area / 3);
    return;
  }
  double of_centroids = 0, of_triangles = 0; // integrals of |x - c|^2
  for_each_triangle(c, [&](const Point& u, const Point& v, double part) {
    const double squares = dot(u, u) + dot(v, v), product = dot(u, v);
    of_centroids += part * (squares + 2 * product) / 9;
    of_triangles += part * (squares + product) / 6;
  });
  // The largest factor, 1/2, gives the midpoint of the side.
  const double factor = of_centroids > 0 ? (std::min)(0.5, std::sqrt(of_triangles / of_centroids) / 3) : 1. / 3;
  for_each_triangle(c, [&](const Point& u, const Point& v, double part) {
    f(Point{ c[0] + factor * (u[0] + v[0]), c[1] + factor * (u[1] + v[1]), c[2] + factor * (u[2] + v[2]) }, part);
  });
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_POLYGON_QUADRATURE_H
