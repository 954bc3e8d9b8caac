// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRACE_TO_LEVEL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRACE_TO_LEVEL_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_error.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <cmath>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The end of a traced curve.
template <typename Velocity>
struct Traced
{
  typename Velocity::State state, derivative;
  Image_error error;
};

// Traces the integral curve from a point to the point where the field is `level`.
template <typename Shell, typename Velocity>
Flow_status trace_to_level(const Shell& shell, double tolerance, const typename Velocity::State& start, double level,
                           Traced<Velocity>& result)
{
  return keep_tolerance(tolerance, result, [&](double step_tolerance, Traced<Velocity>& end) {
    Integral_curve<Shell, Velocity> curve(shell, tolerance, step_tolerance);
    Flow_status status = curve.start(start);
    if(!std::isfinite(level)) return Flow_status::NOT_FINITE;
    while(status == Flow_status::SUCCESS && curve.value() != level) status = curve.step(level);
    if(status != Flow_status::SUCCESS) return status;
    // The value of the field at the end gives the error along the curve.
    const Curve_error error = curve.error();
    const double along = curve.drift(curve.state(), level) * curve.speed();
    end = { curve.state(), curve.derivative(), { error.at_end() + along, error.at_start() } };
    return status;
  });
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template Flow_status trace_to_level(const Bspline_shell_3<>&, double, const Flow_velocity::State&, double,
                                           Traced<Flow_velocity>&);
extern template Flow_status trace_to_level(const Certified_bspline_shell_3&, double, const Flow_velocity::State&,
                                           double, Traced<Flow_velocity>&);
extern template Flow_status trace_to_level(const Bspline_shell_3<>&, double,
                                           const Flow_velocity_with_differential::State&, double,
                                           Traced<Flow_velocity_with_differential>&);
extern template Flow_status trace_to_level(const Certified_bspline_shell_3&, double,
                                           const Flow_velocity_with_differential::State&, double,
                                           Traced<Flow_velocity_with_differential>&);
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRACE_TO_LEVEL_H
