// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_differential.h>
#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/trace_to_level.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <algorithm>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell along the integral curves of its field to a given value of the field.
 *
 * An embedded Runge-Kutta method of order five (Boost.Odeint) traces the curves. It solves \f$dc/ds = \nabla f /
 * |\nabla f|^2\f$, so that \f$s\f$ is the value of the field. Const member functions may be called concurrently.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 */
template <typename Shell>
class Gradient_flow_3
{
public:
  typedef typename Shell::Point_3 Point_3;

  /// returns 1e-9 of the box size of the mesh for which the shell was built, or 256 units in the last place of the
  /// coordinates if this is more.
  ///
  /// A smaller tolerance cannot be met: a curve takes about ten steps, and each step adds up seven stages and rounds
  /// each coordinate by some units in the last place. The sum over steps and coordinates is about a hundred units, and
  /// more where a curve meets a facet at an oblique angle.
  static double default_tolerance(const Shell& shell)
  {
    return (std::max)(1e-9 * shell.report().unit, 256 * internal::coordinate_rounding(shell));
  }

  /// the end of a traced curve
  struct Arrival
  {
    Flow_status status = Flow_status::CANCELED;
    Point_3 point;
    explicit operator bool() const { return status == Flow_status::SUCCESS; }
  };

  /// \pre `shell` outlives this object
  /// \param shell a shell; if it is not valid (`!shell`), all points have the status `NO_SHELL`
  /// \param tolerance largest distance of the end from the exact end, in the units of the coordinates; 0 stands for the
  ///   default. The distance is estimated: the errors of the steps are propagated along the curve to first order.
  ///   Curves that diverge are traced in shorter steps. If the accuracy of `double`s does not suffice, the status is
  ///   `TOLERANCE_NOT_MET`.
  explicit Gradient_flow_3(const Shell& shell, double tolerance = 0)
    : m_shell(&shell), m_tolerance(tolerance > 0 ? tolerance : default_tolerance(shell))
  {}
  explicit Gradient_flow_3(const Shell&&, double = 0) = delete; // would dangle

  const Shell& shell() const { return *m_shell; }
  double tolerance() const { return m_tolerance; }

  /// traces the curve from a point to the point where the field is `level`.
  /// \tparam Point a type with the coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Arrival trace(const Point& p, double level) const
  {
    Arrival arrival;
    arrival.status = Flow_status::NO_SHELL;
    if(!*m_shell) return arrival;
    internal::Traced<internal::Flow_velocity> end;
    arrival.status = internal::trace_to_level(*m_shell, m_tolerance, internal::rounded_coordinates(p), level, end);
    if(arrival) arrival.point = Point_3(end.state[0], end.state[1], end.state[2]);
    return arrival;
  }

  /// returns the differential of `trace()`, from the variational equation with the Hessian of the field. Its relative
  /// error is about the tolerance divided by the box size.
  template <typename Point>
  Flow_differential differential(const Point& p, double level) const
  {
    if(!*m_shell) return internal::no_differential(Flow_status::NO_SHELL);
    internal::Traced<internal::Flow_velocity_with_differential> end;
    const double unit = m_shell->report().unit;
    Flow_differential result;
    result.status = internal::trace_to_level(
      *m_shell, m_tolerance,
      { internal::rounded(p[0]), internal::rounded(p[1]), internal::rounded(p[2]), unit, 0, 0, 0, unit, 0, 0, 0, unit },
      level, end);
    if(result)
      for(int i = 0; i < 3; ++i) {
        result.velocity[i] = end.derivative[i];
        for(int j = 0; j < 3; ++j) result.matrix(i, j) = end.state[3 + 3 * j + i] / unit;
      }
    return result;
  }

private:
  const Shell* m_shell;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H
