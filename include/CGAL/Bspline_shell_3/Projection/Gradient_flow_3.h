// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>

#include <CGAL/assertions.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief how a point that is moved along its integral curve, by a fixed difference of the field's value, moves when it starts
 * elsewhere: a linear map between vectors.
 *
 * Along the curves themselves it does what they do; the maps between surfaces are composed of it and of the move along the
 * curve to the surface.
 */
struct Flow_differential
{
  Flow_status status = Flow_status::CANCELED;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();       ///< derivatives of the end by the start
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();         ///< at the end: of the curve, where the field's value is the time

  explicit operator bool() const { return status == Flow_status::SUCCESS; }

  /// The differential of the map along the curves to a plane, or to a surface with that tangent plane: its image is in the plane,
  /// and what points along the curve is mapped to zero. \pre the normal is not orthogonal to the velocity
  Eigen::Matrix3d onto_plane(const Eigen::Vector3d& normal) const
  {
    CGAL_precondition(normal.dot(velocity) != 0);
    return matrix - velocity * (normal.transpose() * matrix) / normal.dot(velocity);
  }
  /// the differential of the map along the curves to the level set through the end
  Eigen::Matrix3d onto_level_set() const { return onto_plane(velocity); }

  /// The same for a map that ends before a linear one, of which it is the inverse, or begins after one: planes that the linear map takes to each
  /// other stand for each other.
  /// \pre `linear` is invertible
  void prepend_to_end(const Eigen::Matrix3d& linear)
  {
    const Eigen::Matrix3d inverse = linear.inverse();
    matrix = inverse * matrix;
    velocity = inverse * velocity;
  }
  void append_to_start(const Eigen::Matrix3d& linear) { matrix *= linear; }
};

namespace internal {

// The result for a point without an image.
inline Flow_differential no_differential(Flow_status status)
{
  Flow_differential result;
  result.status = status;
  return result;
}

// that of the projection along a normal
inline Flow_differential orthogonal_differential(const std::array<double, 3>& normal)
{
  Flow_differential result;
  result.status = Flow_status::SUCCESS;
  result.velocity = Eigen::Vector3d(normal[0], normal[1], normal[2]);
  return result;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell along the integral curves of its field to where the field has a given value.
 *
 * Curves are traced by an embedded Runge-Kutta method of order five (Boost.Odeint) for \f$dc/ds = \nabla f / |\nabla f|^2\f$, so
 * that \f$s\f$ is the value of the field. Const member functions may be called from several threads at once.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 */
template <typename Shell>
class Gradient_flow_3
{
public:
  typedef typename Shell::Point_3 Point_3;
  static constexpr double default_tolerance = 1e-9;      ///< of the longest side of the box of the mesh that the shell was built for

  /// where a curve arrived
  struct Arrival
  {
    Flow_status status = Flow_status::CANCELED;
    Point_3 point;
    explicit operator bool() const { return status == Flow_status::SUCCESS; }
  };

  /// \pre `shell` outlives this object
  /// \param shell a shell; if it has none, all points have the status `NO_SHELL`
  /// \param tolerance of the tracing, user units; 0 stands for the default. The error of each step is estimated to be a tenth of it at most; what
  ///        many steps add up to, and what curves make of it that diverge, is not bounded.
  explicit Gradient_flow_3(const Shell& shell, double tolerance = 0)
    : m_shell(&shell), m_tolerance(tolerance > 0 ? tolerance : default_tolerance * shell.report().unit)
  {}
  explicit Gradient_flow_3(const Shell&&, double = 0) = delete;       // it would dangle

  const Shell& shell() const { return *m_shell; }
  double tolerance() const { return m_tolerance; }

  /// from a point to where the field is `level`.
  /// \tparam Point has three coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Arrival trace(const Point& p, double level) const
  {
    Arrival arrival;
    arrival.status = Flow_status::NO_SHELL;
    if(!*m_shell) return arrival;
    internal::Integral_curve<Shell, internal::Flow_velocity> curve(*m_shell, m_tolerance);
    arrival.status = run(curve, { CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]) }, level);
    if(arrival) arrival.point = Point_3(curve.state()[0], curve.state()[1], curve.state()[2]);
    return arrival;
  }

  /// the differential of `trace()`, from the variational equation with the Hessian of the field; its relative error is about the
  /// tolerance divided by the side of the box.
  template <typename Point>
  Flow_differential differential(const Point& p, double level) const
  {
    if(!*m_shell) return internal::no_differential(Flow_status::NO_SHELL);
    internal::Integral_curve<Shell, internal::Flow_velocity_with_differential> curve(*m_shell, m_tolerance);
    const double unit = m_shell->report().unit;
    Flow_differential result;
    result.status = run(curve, { CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]),
                                 unit, 0, 0,  0, unit, 0,  0, 0, unit }, level);
    if(result)
      for(int i = 0; i < 3; ++i) {
        result.velocity[i] = curve.derivative()[i];
        for(int j = 0; j < 3; ++j) result.matrix(i, j) = curve.state()[3 + 3*j + i] / unit;
      }
    return result;
  }

private:
  template <typename Curve>
  static Flow_status run(Curve& curve, const typename Curve::State& start, double level)
  {
    Flow_status status = curve.start(start);
    if(!std::isfinite(level)) return Flow_status::NOT_FINITE;
    while(status == Flow_status::SUCCESS && curve.value() != level) status = curve.step(level);
    // what errors of steps may add up to, and not more, as beside a critical point
    constexpr double most = 10;
    if(status == Flow_status::SUCCESS && curve.drift(curve.state(), level) * curve.speed() > most * curve.tolerance())
      return Flow_status::TOO_MANY_STEPS;
    return status;
  }

  const Shell* m_shell;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_GRADIENT_FLOW_3_H
