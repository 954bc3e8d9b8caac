// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_CRITICAL_VALUES_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_CRITICAL_VALUES_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns \f$g - \frac{1}{2} (x - c) \cdot \nabla f\f$, which equals \f$g\f$ wherever the gradient of \f$f\f$
 * vanishes.
 *
 * Let \f$g = f\f$. If \f$f\f$ is quadratic with a critical point at \f$c\f$, the result is constant, by Euler's
 * identity. On a box that is small relative to the third derivatives of \f$f\f$, it is nearly constant. Its
 * coefficients therefore enclose the values of \f$g\f$ at critical points of \f$f\f$ much more closely than those of
 * \f$g\f$ do. This also holds in the middle of thin walls of any orientation, where the gradient is nearly zero. The
 * degree is three along each axis, like that of \f$f\f$.
 *
 * \param center any point \f$c\f$, in local coordinates; it may be rounded
 */
inline Enclosed_tricubic values_at_critical_points(const Enclosed_tricubic& g, const Enclosed_tricubic& f,
                                                   const std::array<double, 3>& center)
{
  Enclosed_tricubic r = g;
  std::array<double, 3> steepest = {};
  internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
    const double* b = &f.coefficients[std::size_t(n)];
    double* v = &r.coefficients[std::size_t(n)];
    const double c = center[std::size_t(axis)];
    const double s0 = b[stride] - b[0], s1 = b[2 * stride] - b[stride], s2 = b[3 * stride] - b[2 * stride];
    // Subtracts half of (t - c) times the derivative with the coefficients 3 s0, 3 s1, 3 s2.
    v[0] += 1.5 * c * s0;
    v[stride] += c * s1 - (0.5 - 0.5 * c) * s0;
    v[2 * stride] -= (1 - c) * s1 - 0.5 * c * s2;
    v[3 * stride] -= 1.5 * (1 - c) * s2;
    double& most = steepest[std::size_t(axis)];
    most = (std::max)(most, (std::max)((std::max)((std::max)(0., std::abs(s0)), std::abs(s1)), std::abs(s2)));
  });
  // The absolute weights of the differences along an axis sum to at most 1.5 (|c| + |1 - c|). Each term is rounded nine
  // times. If a value overflows, the radius is infinite.
  double error = g.radius
                 + 8 * internal::rounding
                     * (internal::largest_size(r.coefficients) + internal::largest_size(g.coefficients));
  for(std::size_t a = 0; a < 3; ++a) {
    const double weight = 1.5 * (std::abs(center[a]) + std::abs(1 - center[a]));
    error += 2 * weight * f.radius + 12 * internal::rounding * (weight * steepest[a]);
  }
  r.radius = (1 + 32 * internal::rounding) * (error + internal::underflow);
  return r;
}

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief an estimate of the point where the gradient of a function on a box vanishes.
 */
struct Critical_center
{
  std::array<double, 3> point; ///< local coordinates
  double value;                ///< mean of `values_at_critical_points()` on the box
  double slope;                ///< remaining slope divided by the curvature: a distance in units of the box
};

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns a center for which `values_at_critical_points()` of a function itself varies little; not rigorous.
 *
 * The mean slope of this function on the box vanishes, up to damping. If the given function were quadratic, its
 * gradient would vanish at the center. Along directions of small curvature, the center is near the middle of the box.
 */
inline Critical_center critical_center(const Enclosed_tricubic& f)
{
  constexpr double flat = 0.1; // damping, relative to the size of the second derivatives
  // means of the function, and of its partial derivatives, on the faces of the box
  double face[3][2] = {}, slope[3][3][2] = {}, mean = 0;
  std::array<double, 3> x = {};
  internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
    const double* b = &f.coefficients[std::size_t(n)];
    const std::array<int, 3> at = { n & 3, (n >> 2) & 3, n >> 4 };
    face[axis][0] += b[0] / 16;
    face[axis][1] += b[3 * stride] / 16;
    slope[axis][axis][0] += 3 * (b[stride] - b[0]) / 16;
    slope[axis][axis][1] += 3 * (b[3 * stride] - b[2 * stride]) / 16;
    const double difference = b[3 * stride] - b[0];
    for(int other : { (axis + 1) % 3, (axis + 2) % 3 })
      if(at[other] % 3 == 0) slope[axis][other][at[other] / 3] += difference / 4;
    if(axis == 0) mean += (b[0] + b[stride] + b[2 * stride] + b[3 * stride]) / 64;
  });
  // Integration by parts converts integrals of x_b times a derivative along b to integrals on faces. Let m be the
  // middle of the box. Then H (c - m) is the sum, over the axes, of the mean slope on the two faces across the axis,
  // minus 4 times the mean slope. Both sides are scaled, because squares of small or large numbers would underflow or
  // overflow.
  double H[3][3], M[3][3], largest = 0, squared = 0;
  for(int a = 0; a < 3; ++a)
    for(int b = 0; b < 3; ++b) {
      H[a][b] = slope[a][b][1] - slope[a][b][0];
      largest = (std::max)(largest, std::abs(H[a][b]));
    }
  const double unit = internal::reciprocal_power_of_two(largest);
  for(auto& row : H)
    for(double& h : row) {
      h *= unit;
      squared += h * h;
    }
  std::array<double, 3> right;
  for(int a = 0; a < 3; ++a) {
    right[a] = -4 * (face[a][1] - face[a][0]);
    for(int b = 0; b < 3; ++b) right[a] += (slope[a][b][0] + slope[a][b][1]) / 2;
    right[a] *= unit;
  }
  // Computes the damped least-squares solution.
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j) {
      M[i][j] = H[0][i] * H[0][j] + H[1][i] * H[1][j] + H[2][i] * H[2][j];
      x[i] += H[j][i] * right[j];
    }
  for(int i = 0; i < 3; ++i) M[i][i] += flat * flat * squared;
  for(int i = 0; i < 3; ++i)
    for(int j = i + 1; j < 3; ++j) {
      const double m = M[j][i] / M[i][i];
      for(int k = i; k < 3; ++k) M[j][k] -= m * M[i][k];
      x[j] -= m * x[i];
    }
  for(int i = 2; i >= 0; --i) {
    for(int k = i + 1; k < 3; ++k) x[i] -= M[i][k] * x[k];
    x[i] /= M[i][i];
  }
  Critical_center center = { {}, 2.5 * mean, 0 };
  for(int a = 0; a < 3; ++a) {
    const double c = 0.5 + x[a];
    center.point[a] = c;
    center.value -= ((1 - c) * face[a][1] + c * face[a][0]) / 2;
    double left = unit * (face[a][1] - face[a][0]);
    for(int b = 0; b < 3; ++b) left += H[a][b] * x[b];
    center.slope += left * left / squared;
  }
  center.slope = std::sqrt(center.slope);
  return center;
}

/// \ingroup PkgBsplineShell3Spline
/// encloses the values of a function at the points where its gradient vanishes. If the range is empty (`min > max`), it
/// is proved that there is no such point.
inline Level_range critical_values(const Enclosed_tricubic& f)
{
  const Level_range all = f.range(), close = values_at_critical_points(f, f, critical_center(f).point).range();
  return { (std::max)(close.min, all.min), (std::min)(close.max, all.max) };
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_CRITICAL_VALUES_H
