// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_ERROR_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_ERROR_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_tuning.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The largest and the smallest logarithmic rate, with respect to the value of f, at which integral curves move apart,
// over all directions across the curve. These are the eigenvalues of the Hessian, restricted to the tangent plane of
// the level set, divided by |grad f|^2.
struct Divergence
{
  double most, least;
};

template <typename Point>
Divergence divergence(const Tricubic_cell_3& cell, const Point& p)
{
  const auto jet = cell.second_order_jet(p);
  const auto& g = jet.gradient;
  const auto& h = jet.hessian; // xx, yy, zz, xy, xz, yz
  // trace and determinant of the restriction, from n^T H n and n^T adj(H) n
  const auto form = [&](double xx, double yy, double zz, double xy, double xz, double yz) {
    return xx * g[0] * g[0] + yy * g[1] * g[1] + zz * g[2] * g[2]
           + 2 * (xy * g[0] * g[1] + xz * g[0] * g[2] + yz * g[1] * g[2]);
  };
  const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  const double half_trace = (h[0] + h[1] + h[2] - form(h[0], h[1], h[2], h[3], h[4], h[5]) / square) / 2;
  const double determinant = form(h[1] * h[2] - h[5] * h[5], h[0] * h[2] - h[4] * h[4], h[0] * h[1] - h[3] * h[3],
                                  h[4] * h[5] - h[2] * h[3], h[3] * h[5] - h[1] * h[4], h[3] * h[4] - h[0] * h[5])
                             / square;
  const double root = std::sqrt((std::max)(half_trace * half_trace - determinant, 0.));
  return { (half_trace + root) / square, (half_trace - root) / square };
}

// Estimates, to first order, the accumulated error of the steps along an integral curve. An error along the curve
// shifts its parameter and does not count.
class Curve_error
{
public:
  explicit Curve_error(const Divergence& at_start = {}) : m_divergence(at_start) {}

  // Adds a step over which f changes by `ds`, with its error and the divergence of curves at its end.
  void add_step(double ds, double error, const Divergence& at_end)
  {
    // The divergence changes little during a step. If f decreases, curves that moved apart approach each other.
    const double a = ds * (m_divergence.most + at_end.most) / 2, b = ds * (m_divergence.least + at_end.least) / 2;
    m_at_end = m_at_end * std::exp((std::max)(a, b)) + error;
    m_approach -= (std::min)(a, b);
    m_at_start += error * std::exp(m_approach);
    m_divergence = at_end;
  }

  // Returns the distance of the end from the exact curve through the start.
  double at_end() const { return m_at_end; }
  // Returns the distance of the start from the exact curve through the end.
  double at_start() const { return m_at_start; }

private:
  Divergence m_divergence;
  double m_at_end = 0, m_at_start = 0;
  double m_approach = 0; // logarithm of the largest factor by which distances at the end grow back to the start
};

// Estimated distances of an image from the exact one, and of the start from the exact curve through the image.
struct Image_error
{
  double at_image = 0, at_start = 0;
};

// Traces a curve, and traces it again in shorter steps while an estimated error exceeds the tolerance. If the error at
// the image still exceeds it at the end, the status is `TOLERANCE_NOT_MET`. The error at the start may exceed it where
// curves approach each other so closely that `double`s do not distinguish them at the image. `trace(step_tolerance,
// result)` returns a status; the result has a member `error`.
template <typename Result, typename Trace>
Flow_status keep_tolerance(double tolerance, Result& result, const Trace& trace)
{
  const Curve_tuning& t = curve_tuning;
  double step_tolerance = tolerance;
  const Flow_status status = trace(step_tolerance, result);
  if(status != Flow_status::SUCCESS) return status;
  for(int repetition = 0; repetition < t.max_repetitions; ++repetition) {
    const double error = (std::max)(result.error.at_image, result.error.at_start);
    if(t.safety * error <= tolerance || !(step_tolerance > t.least_step_tolerance * tolerance)) break;
    step_tolerance = (std::max)(step_tolerance * t.aim * tolerance / error, t.least_step_tolerance * tolerance);
    Result closer;
    if(trace(step_tolerance, closer) != Flow_status::SUCCESS) break;
    result = closer;
  }
  return result.error.at_image <= tolerance ? Flow_status::SUCCESS : Flow_status::TOLERANCE_NOT_MET;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_ERROR_H
