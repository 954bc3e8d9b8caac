// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_IMPL_H

#include <CGAL/Bspline_shell_3/Certificate/critical_point.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
std::optional<Critical_point> prove_critical_point(const Enclosed_tricubic& f)
{
  constexpr double largest_radius = 1. / 16;
  const std::array<std::array<double, 3>, 3> axes = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  std::array<Enclosed_tricubic, 3> slope;
  std::array<std::array<Level_range, 3>, 3> second; // on the whole box
  Eigen::Matrix3d middle;
  for(int a = 0; a < 3; ++a) slope[a] = enclosed_derivative(f, axes[a]);
  for(int a = 0; a < 3; ++a)
    for(int b = 0; b < 3; ++b) {
      second[a][b] = enclosed_derivative(slope[a], axes[b]).range();
      middle(a, b) = (second[a][b].min + second[a][b].max) / 2;
    }
  const auto gradient = [&](const Eigen::Vector3d& t) {
    Eigen::Vector3d g;
    for(int a = 0; a < 3; ++a) {
      const Level_range r = enclose_at_point(slope[a], { t[0], t[1], t[2] }, 0);
      g[a] = (r.min + r.max) / 2;
    }
    return g;
  };
  // An approximate inverse, without overflow for second derivatives of any size.
  const double largest = middle.cwiseAbs().maxCoeff();
  const Eigen::Matrix3d in_units = middle / largest;
  const Eigen::Matrix3d Y = in_units.inverse() / largest;
  if(!Y.allFinite()) return std::nullopt;
  Eigen::Vector3d x(0.5, 0.5, 0.5);
  for(int step = 0; step < 20; ++step) x -= Y * gradient(x);
  // The box of the test must lie in the box on which the second derivatives are enclosed.
  double radius = largest_radius;
  for(int a = 0; a < 3; ++a) radius = (std::min)({ radius, x[a], 1 - x[a] });
  if(!(radius > 0)) return std::nullopt;
  // K = x - Y g(x) + (I - Y H) [-radius, radius]^3 must lie in the interior of the box. Magnitudes are rounded up.
  constexpr double up = 1 + 64 * internal::rounding;
  for(int a = 0; a < 3; ++a) {
    double shift = 0, spread = 0;
    for(int b = 0; b < 3; ++b) {
      const Level_range g = enclose_at_point(slope[b], { x[0], x[1], x[2] }, 0);
      shift += std::abs(Y(a, b)) * (std::max)(std::abs(g.min), std::abs(g.max));
      // row a of I - Y H: its middle, and the deviation of H from the middle
      double center = a == b ? 1 : 0, size = std::abs(center);
      for(int c = 0; c < 3; ++c) {
        const double product = Y(a, c) * middle(c, b);
        center -= product;
        size += std::abs(product);
      }
      spread += std::abs(center) + 8 * internal::rounding * size;
      for(int c = 0; c < 3; ++c) {
        const double half = (std::max)(second[c][b].max - middle(c, b), middle(c, b) - second[c][b].min);
        spread += std::abs(Y(a, c)) * half * up;
      }
    }
    if(!((shift + spread * radius) * up < radius)) return std::nullopt;
  }
  return Critical_point{ { x[0], x[1], x[2] }, radius };
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_IMPL_H
