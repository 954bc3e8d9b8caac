// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_MONOTONE_DIRECTION_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_MONOTONE_DIRECTION_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns an upper bound on the length of a vector. Components are scaled, because squares of small or large numbers
// would underflow or overflow. The bound is infinite if a component is infinite, and NaN if a component is NaN.
inline double length_bound(const std::array<double, 3>& v)
{
  const double largest = (std::max)({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) });
  if(largest == 0 || std::isinf(largest)) return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  double squared = 0;
  for(double x : v) squared += (x / largest) * (x / largest);
  return largest * (std::sqrt(squared) * (1 + 16 * rounding)) + std::numeric_limits<double>::denorm_min();
}

typedef std::array<std::array<double, 64>, 3> Gradient_vectors; // by axis

// Returns the coefficients of the partial derivatives, raised to degree three; not rigorous.
inline Gradient_vectors control_vectors_of_gradient(const Enclosed_tricubic& f)
{
  Gradient_vectors gradient;
  for_each_coefficient_line([&](int axis, int n, auto stride) {
    const double* b = &f.coefficients[std::size_t(n)];
    double* g = &gradient[std::size_t(axis)][std::size_t(n)];
    const double s0 = b[stride] - b[0], s1 = b[2 * stride] - b[stride], s2 = b[3 * stride] - b[2 * stride];
    g[0] = 3 * s0;
    g[stride] = s0 + 2 * s1;
    g[2 * stride] = 2 * s1 + s2;
    g[3 * stride] = 3 * s2;
  });
  return gradient;
}

inline std::array<double, 3> mean(const Gradient_vectors& vectors)
{
  std::array<double, 3> m;
  for(int a = 0; a < 3; ++a) m[a] = std::accumulate(vectors[a].begin(), vectors[a].end(), 0.) / 64;
  return m;
}

// Returns the smallest scalar product of v with a vector, and stores the index of this vector in `worst`.
inline double worst_along(const std::array<double, 3>& v, const Gradient_vectors& vectors, std::size_t& worst)
{
  std::array<double, 64> along;
  for(int n = 0; n < 64; ++n) along[n] = v[0] * vectors[0][n] + v[1] * vectors[1][n] + v[2] * vectors[2][n];
  // Four searches are interleaved, because a single search would wait for each of its comparisons.
  std::array<double, 4> least = { along[0], along[1], along[2], along[3] };
  for(std::size_t n = 4; n < 64; n += 4)
    for(std::size_t m = 0; m < 4; ++m) least[m] = (std::min)(least[m], along[n + m]);
  const double of_all = (std::min)((std::min)(least[0], least[1]), (std::min)(least[2], least[3]));
  worst = (std::min)(std::size_t(std::find(along.begin(), along.end(), of_all) - along.begin()), along.size() - 1);
  return along[worst];
}

// Moves a point along the segment to one of the vectors, as close to the origin as possible. Returns false if the point
// is there already.
inline bool approach(std::array<double, 3>& v, const Gradient_vectors& vectors, std::size_t worst)
{
  std::array<double, 3> step;
  for(int a = 0; a < 3; ++a) step[a] = vectors[a][worst] - v[a];
  const double unit = reciprocal_power_of_two(step);
  double down = 0, squared = 0;
  for(int a = 0; a < 3; ++a) {
    down -= (unit * v[a]) * (unit * step[a]);
    squared += (unit * step[a]) * (unit * step[a]);
  }
  const double part = down / squared;
  if(!(part > 0)) return false;
  for(int a = 0; a < 3; ++a) v[a] += (std::min)(part, 1.) * step[a];
  return true;
}

constexpr int max_steps_of_direction = 12;

// Returns the direction of a point near the point of the control vectors' convex hull that is nearest to the origin,
// scaled to unit size. The iteration starts at the mean of the vectors, and approaches the worst vector in each step.
inline std::array<double, 3> nearest_of_hull(const Gradient_vectors& gradient)
{
  std::array<double, 3> nearest = mean(gradient);
  for(int step = 0; step < max_steps_of_direction; ++step) {
    std::size_t worst;
    worst_along(scaled_to_unit(nearest), gradient, worst);
    if(!approach(nearest, gradient, worst)) break;
  }
  return scaled_to_unit(nearest);
}

// Returns whether f is proved to increase along a direction, by more than `steepest` per unit of length. A direction
// suffices if its scalar products with all control vectors of the gradient are positive. The best direction is that of
// the point of their convex hull that is nearest to the origin. It is approached from the mean of the vectors, in steps
// toward the worst vector.
inline bool is_monotone(const Enclosed_tricubic& f, double steepest, std::array<double, 3>& direction)
{
  const Gradient_vectors gradient = control_vectors_of_gradient(f);
  std::array<double, 3> nearest = mean(gradient);
  for(int step = 0; step < max_steps_of_direction; ++step) {
    std::size_t worst;
    const std::array<double, 3> unit = scaled_to_unit(nearest);
    const double along = worst_along(unit, gradient, worst);
    if(along > 0 && along > steepest * length_bound(unit)) {
      const double largest = (std::max)({ std::abs(unit[0]), std::abs(unit[1]), std::abs(unit[2]) });
      for(int a = 0; a < 3; ++a) direction[a] = unit[a] / largest;
      const double slope = enclosed_derivative(f, direction).range().min;
      return slope > 0 && slope > steepest * length_bound(direction); // may fail only because of rounding
    }
    if(!approach(nearest, gradient, worst)) return false;
  }
  return false;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_MONOTONE_DIRECTION_H
