// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_INTEGRAL_CURVE_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_INTEGRAL_CURVE_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_error.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_tuning.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The velocity dx/ds = grad f / |grad f|^2; s is the value of f.
struct Flow_velocity
{
  typedef std::array<double, 3> State;

  Tricubic_cell_3 cell;

  void operator()(const State& x, State& dx, double /* s */) const { evaluate(x, dx); }

  // Returns f.
  double evaluate(const State& x, State& dx) const
  {
    // Local coordinates avoid divisions: with h = width grad f, dx = width h / |h|^2.
    const auto jet = cell.local_first_order_jet(cell.local_coordinates(x));
    const auto& h = jet.gradient;
    const double scale = cell.width() / dot(h, h);
    for(int a = 0; a < 3; ++a) dx[a] = scale * h[a];
    return jet.value;
  }
};

// The velocity, and the derivatives of x with respect to the start: three columns, times `unit`, so that one tolerance
// suits the whole state. With g = grad f and H its Hessian, the velocity has the derivative (I - 2 g g^T / |g|^2) H /
// |g|^2.
struct Flow_velocity_with_differential
{
  typedef std::array<double, 12> State;

  Tricubic_cell_3 cell;

  void operator()(const State& x, State& dx, double /* s */) const { evaluate(x, dx); }

  double evaluate(const State& x, State& dx) const
  {
    const auto jet = cell.second_order_jet(x);
    const auto& g = jet.gradient;
    const auto& h = jet.hessian;
    const double scale = 1 / dot(g, g);
    for(int a = 0; a < 3; ++a) dx[a] = scale * g[a];
    for(int j = 3; j < 12; j += 3) {
      const double u[3] = { h[0] * x[j] + h[3] * x[j + 1] + h[4] * x[j + 2],
                            h[3] * x[j] + h[1] * x[j + 1] + h[5] * x[j + 2],
                            h[4] * x[j] + h[5] * x[j + 1] + h[2] * x[j + 2] };
      const double along = 2 * scale * dot(g, u);
      for(int a = 0; a < 3; ++a) dx[j + a] = scale * (u[a] - along * g[a]);
    }
    return jet.value;
  }
};

// Returns approximately one unit in the last place of the coordinates in a shell. The coordinates of all cells differ
// from those of the first cell by at most a few times the size of the bounding box.
template <typename Shell>
double coordinate_rounding(const Shell& shell)
{
  if(!shell) return 0;
  const std::array<double, 3> corner = shell.field().cell(0).corner();
  double largest = 0;
  for(double x : corner) largest = (std::max)(largest, std::abs(x));
  return std::numeric_limits<double>::epsilon() * (largest + shell.report().unit);
}

// Steps along an integral curve in a shell.
//
// A step is taken with the polynomial of one cell, even if its stages lie outside the cell, and ends where the curve
// leaves the cell. The integrand is thus analytic, and the order of the method is preserved, although the third
// derivatives of the field jump between cells. A curve moves on to a neighbor only when it is beyond the face by
// `slack` times the cell's width. A curve along a face thus does not alternate between cells. Near the face, the two
// polynomials agree up to second derivatives, and thus differ by about 1e-18 of the third derivatives.
template <typename Shell, typename Velocity>
class Integral_curve
{
  typedef typename Shell::Field Field;
  typedef typename Field::Cell_index Cell_index;
  typedef typename Shell::Point_3 Point_3;
public:
  typedef typename Velocity::State State;

  // The curve may leave the shell by the distance `tolerance`; `step_tolerance` is the tolerance for the sum of the
  // errors of all steps. Both are in the units of the coordinates.
  Integral_curve(const Shell& shell, double tolerance, double step_tolerance)
    : m_shell(&shell), m_tolerance(tolerance), m_step_tolerance(step_tolerance),
      m_rounding(coordinate_rounding(shell)), m_velocity{ shell.field().cell(0) }
  {}
  Integral_curve(const Shell& shell, double tolerance) : Integral_curve(shell, tolerance, tolerance) {}

  // Begins a curve. State and value are valid only after success.
  Flow_status start(const State& x)
  {
    for(int a = 0; a < 3; ++a)
      if(!std::isfinite(x[a])) return Flow_status::NOT_FINITE;
    m_next_cell = m_shell->field().locate(Point_3(x[0], x[1], x[2]));
    if(!is_shell_cell(m_next_cell)) return Flow_status::STARTS_OUTSIDE;
    enter_next_cell();
    m_end = x;
    m_end_s = m_velocity.evaluate(m_end, m_end_dx);
    if(!is_gradient_certain())
      return m_end_s >= threshold(false, x) && m_end_s <= threshold(true, x) ? Flow_status::GRADIENT_VANISHES
                                                                             : Flow_status::STARTS_OUTSIDE;
    m_begin_s = m_end_s;
    m_error = Curve_error(divergence(m_velocity.cell, m_end));
    begin_step();
    m_step_size = std::numeric_limits<double>::infinity();
    m_step_error = 1;
    m_steps = 0;
    m_has_left = false;
    return is_within_thresholds(m_end, m_end_s) ? Flow_status::SUCCESS : Flow_status::STARTS_OUTSIDE;
  }

  double tolerance() const { return m_tolerance; }
  // Returns the precision of intersections with planes that meet the curve at an angle with this sine: a thousandth of
  // the tolerance or the rounding of coordinates, whichever is larger.
  double crossing_precision(double sine) const { return (std::max)(1e-3 * m_tolerance, 4 * m_rounding / sine); }
  const State& state() const { return m_end; }
  const State& derivative() const { return m_end_dx; }
  double value() const { return m_end_s; } // value of f
  // Returns the length of the curve per unit of f.
  double speed() const
  {
    return std::sqrt(m_end_dx[0] * m_end_dx[0] + m_end_dx[1] * m_end_dx[1] + m_end_dx[2] * m_end_dx[2]);
  }
  // Returns the outer or the inner threshold minus the value.
  double room(bool outwards) const { return threshold(outwards, m_end) - m_end_s; }

  // Takes one step toward `goal`, a value of f. The step may end earlier, where the curve leaves the cell or the error
  // becomes too large. If the curve leaves the shell, the last step can still be examined.
  Flow_status step(double goal)
  {
    do {
      if(m_has_left) return Flow_status::LEAVES_SHELL;
      const Flow_status status = step_in_cell(goal);
      m_has_left = status == Flow_status::LEAVES_SHELL;
      if(status != Flow_status::SUCCESS) return status;
    } while(m_end_s == m_begin_s && m_end_s != goal); // repeated if only the cell changed
    return Flow_status::SUCCESS;
  }

  // The curve during the last step
  // @{
  double begin() const { return m_begin_s; }
  // Returns the point of the last step with the value `s`, between `begin()` and `value()`; it is less accurate than
  // the ends.
  State at(double s) const
  {
    if(m_stepped.s == m_begin_s) return m_begin;
    State x;
    m_stepper.calc_state(s, x, m_begin, m_begin_dx, m_begin_s, m_stepped.x, m_stepped.dx, m_stepped.s);
    return x;
  }
  // Ends the step at `s`, a value within it. The polynomial of the step matches positions and derivatives at both ends.
  // With t = (s - begin) / length, its error is (4 t (1 - t))^2 times the error in the middle, which is negligible near
  // the end.
  void cut(double s)
  {
    m_next_cell = Field::npos;
    m_has_left = false;
    m_end_s = s;
    if(s == m_begin_s) {
      m_end = m_begin;
      m_end_dx = m_begin_dx;
    } else if(std::abs(m_stepped.s - s) <= curve_tuning.near_end * std::abs(m_stepped.s - m_begin_s)) {
      m_end = at(s);
      m_velocity(m_end, m_end_dx, s);
    } else {
      m_stepper.do_step(m_velocity, m_begin, m_begin_dx, m_begin_s, m_end, m_end_dx, s - m_begin_s);
      m_stepped = { m_end, m_end_dx, m_end_s };
    }
  }
  // Returns whether a point of the step is between the thresholds, up to the tolerance.
  bool is_within_thresholds(const State& x, double s) const
  {
    const double tolerance = m_tolerance / speed();
    return s <= threshold(true, x) + tolerance && s >= threshold(false, x) - tolerance;
  }
  // Returns the accumulated error of all steps.
  Curve_error error() const
  {
    Curve_error error = m_error;
    if(m_end_s != m_begin_s) error.add_step(m_end_s - m_begin_s, error_of_step(), divergence(m_velocity.cell, m_end));
    return error;
  }
  // Returns the difference between f at a point of the step and `s`, which would be zero on the exact curve.
  double drift(const State& x, double s) const { return std::abs(m_velocity.cell.value(x) - s); }
  // @}

private:
  typedef boost::numeric::odeint::runge_kutta_dopri5<State> Stepper;
  typedef boost::numeric::odeint::default_step_adjuster<double, double> Step_adjuster;

  static bool is_finite(const State& x)
  {
    double sum = 0;
    for(double d : x) sum += d;
    return std::isfinite(sum);
  }

  // Returns whether the velocity is finite and the gradient is much larger than its rounding error.
  bool is_gradient_certain() const
  {
    constexpr double safety = 100;
    return is_finite(m_end_dx) && speed() * safety * m_velocity.cell.error_radius() < m_velocity.cell.width();
  }
  // Returns whether the curve turned by less than a right angle. Otherwise, it jumped over a critical point or was
  // poorly resolved.
  bool goes_on() const
  {
    return m_begin_dx[0] * m_end_dx[0] + m_begin_dx[1] * m_end_dx[1] + m_begin_dx[2] * m_end_dx[2] > 0;
  }

  bool is_shell_cell(Cell_index c) const { return c != Field::npos && m_shell->shell_cells()[c]; }

  double threshold(bool outer, const State& x) const
  {
    return outer ? m_shell->outer_threshold().value(x, m_cell) : m_shell->inner_threshold().value(x, m_cell);
  }

  void enter_next_cell()
  {
    m_cell = m_next_cell;
    m_velocity.cell = m_shell->field().cell(m_cell);
    m_next_cell = Field::npos;
  }

  // Returns the estimated error of the last step plus its rounding error, in the units of the coordinates.
  double error_of_step() const
  {
    const double largest = (std::max)({ std::abs(m_end[0]), std::abs(m_end[1]), std::abs(m_end[2]) });
    return m_step_error * m_step_tolerance / curve_tuning.steps_per_curve
           + std::numeric_limits<double>::epsilon() * largest;
  }

  void begin_step()
  {
    m_error = error();
    m_begin = m_end;
    m_begin_dx = m_end_dx;
    m_begin_s = m_end_s;
    m_stepped = { m_end, m_end_dx, m_end_s };
  }

  Flow_status step_in_cell(double goal)
  {
    if(++m_steps > curve_tuning.max_steps) return Flow_status::TOLERANCE_NOT_MET;
    if(m_next_cell != Field::npos) enter_next_cell();
    begin_step();
    const double longest = m_velocity.cell.width() / speed();
    double ds = goal - m_begin_s;
    // The step size is computed only now, because most curves end after one step.
    m_step_size = Step_adjuster().increase_step(m_step_size, m_step_error, Stepper::stepper_order_value);
    for(double limit : { m_step_size, longest })
      if(std::abs(ds) > limit) ds = std::copysign(limit, ds);
    for(;;) {
      // A step that rounding reduces to zero makes no progress.
      if(m_begin_s + ds == m_begin_s && goal != m_begin_s) {
        cut(m_begin_s);
        return Flow_status::GRADIENT_VANISHES;
      }
      State errors;
      m_stepper.do_step(m_velocity, m_begin, m_begin_dx, m_begin_s, m_end, m_end_dx, ds, errors);
      m_step_error = 0;
      for(double error : errors)
        m_step_error = (std::max)(m_step_error, std::abs(error) * (curve_tuning.steps_per_curve / m_step_tolerance));
      const bool accepted = !(m_step_error > 1);
      if(accepted && is_finite(m_end) && is_gradient_certain() && goes_on()) {
        m_step_size = std::abs(ds);
        break;
      }
      ds = accepted ? ds / 8 : Step_adjuster().decrease_step(ds, m_step_error, Stepper::error_order_value);
      if(!(std::abs(ds) > curve_tuning.shortest_step * longest)) {
        cut(m_begin_s);
        const auto range = m_velocity.cell.coefficient_range();
        return m_velocity.cell.width() < curve_tuning.small_gradient * (range.second - range.first) * speed()
                 ? Flow_status::GRADIENT_VANISHES
                 : Flow_status::TOLERANCE_NOT_MET;
      }
    }
    m_end_s = ds == goal - m_begin_s ? goal : m_begin_s + ds;
    m_stepped = { m_end, m_end_dx, m_end_s };
    return stop_at_end_of_cell();
  }

  Flow_status stop_at_end_of_cell()
  {
    const std::array<double, 3>& corner = m_velocity.cell.corner();
    const double width = m_velocity.cell.width();
    int axis = -1;
    bool upwards = false;
    double exit = m_end_s;
    for(int a = 0; a < 3; ++a) {
      const double t = (m_end[a] - corner[a]) / width;
      if(t >= -curve_tuning.slack && t <= 1 + curve_tuning.slack) continue;
      const double s = crossing(a, t < 0 ? corner[a] : corner[a] + width, curve_tuning.slack / 2 * width);
      if(axis == -1 || std::abs(s - m_begin_s) < std::abs(exit - m_begin_s)) {
        axis = a;
        upwards = t > 0;
        exit = s;
      }
    }
    if(axis != -1) {
      cut(exit);
      // Leaves the cell through the face, not through one of its edges. Points on edges may belong to cells that the
      // curve does not enter, or leaves immediately. If the cell beyond the face is not in the shell, tries the cell
      // that contains the point.
      const std::array<double, 3> x = { m_end[0], m_end[1], m_end[2] };
      std::array<double, 3> beyond;
      for(int a = 0; a < 3; ++a)
        beyond[a] = (std::min)((std::max)(x[a], corner[a] + curve_tuning.slack * width),
                               corner[a] + (1 - curve_tuning.slack) * width);
      for(const std::array<double, 3>& p : { beyond, x }) {
        beyond = p;
        beyond[axis] = upwards ? corner[axis] + (1 + curve_tuning.slack) * width
                               : corner[axis] - curve_tuning.slack * width;
        m_next_cell = m_shell->field().locate(Point_3(beyond[0], beyond[1], beyond[2]));
        if(is_shell_cell(m_next_cell)) break;
      }
      if(!is_shell_cell(m_next_cell)) return Flow_status::LEAVES_SHELL;
    }
    const bool outwards = m_end_s > m_begin_s;
    const double beyond = outwards ? -room(true) : room(false);
    return beyond * speed() <= m_tolerance ? Flow_status::SUCCESS : Flow_status::LEAVES_SHELL;
  }

  // Returns the value of f at which the curve crosses a plane during the step, up to `precision` (regula falsi,
  // Illinois variant).
  double crossing(int axis, double plane, double precision) const
  {
    double s0 = m_begin_s, s1 = m_end_s, d0 = m_begin[axis] - plane, d1 = m_end[axis] - plane;
    if((d0 < 0) == (d1 < 0)) return m_begin_s; // the step began beyond the plane, by at most the slack
    for(int i = 0; i < 60; ++i) {
      const double s = s1 - d1 * (s1 - s0) / (d1 - d0), d = at(s)[axis] - plane;
      if(std::abs(d) <= precision) return s;
      if((d < 0) == (d1 < 0)) {
        s1 = s;
        d1 = d;
        d0 /= 2;
      } else {
        s0 = s1;
        d0 = d1;
        s1 = s;
        d1 = d;
      }
    }
    return s1;
  }

  const Shell* m_shell;
  double m_tolerance, m_step_tolerance, m_rounding;
  Velocity m_velocity;
  Stepper m_stepper;
  Cell_index m_cell = Field::npos;      // cell of the last step
  Cell_index m_next_cell = Field::npos; // next cell, if the step left its cell
  State m_begin, m_begin_dx, m_end, m_end_dx;
  double m_begin_s = 0, m_end_s = 0;
  struct
  {
    State x, dx;
    double s;
  } m_stepped;             // end of the last step of the method, before it was cut
  double m_step_size = 0;  // size of the last step, as a difference in f
  double m_step_error = 0; // error of that step, as a fraction of the allowed error
  Curve_error m_error;     // error of the steps before the last one
  int m_steps = 0;
  bool m_has_left = false; // whether the curve has left the shell
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_INTEGRAL_CURVE_H
