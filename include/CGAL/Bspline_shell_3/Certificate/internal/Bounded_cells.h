// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOUNDED_CELLS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOUNDED_CELLS_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/second_derivatives.h>

#include <CGAL/FPU.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <thread>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The cells of a field with bounds on each of them. A cell is bounded when a point or a triangle first meets it, as
// many cells of a field are never met. Const member functions may be called from several threads at once.
template <typename Field, typename Threshold>
class Bounded_cells
{
public:
  typedef std::array<double, 3> Coordinates;
  typedef typename Field::Cell_index Cell_index;

  static constexpr Cell_index no_cell = Field::npos;

  // the field and the margins at a point
  struct Sample
  {
    std::array<double, 3> point;
    Cell_index cell; // a cell that contains the point; `no_cell` outside the domain
    // lower bounds on the field minus the inner threshold, and on the outer one minus the field
    double above, below;
    std::array<double, 3> gradient; // per user unit, rounded
  };

  // The data of a cell that samples use, in one cache line. The margins are the field minus the inner threshold, and
  // the outer threshold minus the field.
  struct alignas(64) Place
  {
    Coordinates corner;
    double width;
    const double* coefficients; // owned by the field
    double value_error;         // bounds the roundings of a margin at a point
    // Thresholds vary little on most cells, and need not be evaluated there. These constants bound them towards the
    // inside of the shell, and are as good. On other cells, they are NaN.
    double inner, outer;
  };

  // Bounds on all of a cell, per user unit.
  struct Bounds
  {
    Symmetric_matrix_range_3 above, below, field; // second derivatives, of the margins and the field
    Coordinates least_gradient, largest_gradient; // field's gradient, by component
    double steepness, curvature; // sums of absolute first and second derivatives, of the margins and the field
    double gradient_error;       // bounds the roundings of the gradient's components at a point
  };

  Bounded_cells(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_field(&field), m_inner(inner), m_outer(outer), m_states(new std::atomic<State>[field.number_of_cells()]()),
      m_places(new Place[field.number_of_cells()]), m_cells(new Bounds[field.number_of_cells()])
  {}

  const Field& field() const { return *m_field; }

  const Place& place(Cell_index c) const
  {
    ensure(c);
    return m_places[c];
  }
  const Bounds& bounds(Cell_index c) const
  {
    ensure(c);
    return m_cells[c];
  }

  Cell_index locate(const Coordinates& x) const { return m_field->locate(typename Field::Point_3(x[0], x[1], x[2])); }

  // Returns the middle of two points, rounded.
  static Coordinates middle(const Sample& p, const Sample& q)
  {
    return { (p.point[0] + q.point[0]) / 2, (p.point[1] + q.point[1]) / 2, (p.point[2] + q.point[2]) / 2 };
  }

  // Returns the derivative of the field along a direction, rounded.
  static double slope(const Sample& s, const Coordinates& direction)
  {
    return s.gradient[0] * direction[0] + s.gradient[1] * direction[1] + s.gradient[2] * direction[2];
  }

  static bool contains(const Place& cell, const Coordinates& x)
  {
    for(int a = 0; a < 3; ++a)
      if(x[a] < cell.corner[a] || x[a] > cell.corner[a] + cell.width) return false;
    return true;
  }

  // Returns the sample at a point, in a cell that contains the point.
  Sample sample(const Coordinates& x, Cell_index c, bool wants_margins, bool wants_gradient) const
  {
    Sample s = { x, c, -1, -1, {} };
    if(c == Field::npos) return s;
    const Place& place = this->place(c);
    constexpr double no_radius = 0; // not needed for values
    const typename Field::Cell cell(place.corner, place.width, place.coefficients, no_radius);
    double value = 0;
    if(wants_gradient) {
      const auto jet = cell.first_order_jet(x);
      s.gradient = jet.gradient;
      value = jet.value;
    } else if(wants_margins) {
      value = cell.value(x);
    }
    s.above = s.below = 0;
    if(wants_margins) {
      const bool are_flat = !std::isnan(place.inner);
      s.above = value - (are_flat ? place.inner : m_inner.value(x, c)) - place.value_error;
      s.below = (are_flat ? place.outer : m_outer.value(x, c)) - value - place.value_error;
    }
    return s;
  }

private:
  struct Slopes
  {
    Coordinates least, most;
  };

  // Encloses the components of the gradient on a cell.
  static Slopes slopes(const Enclosed_tricubic& f, double width)
  {
    Slopes slopes;
    const std::array<Level_range, 3> differences = difference_ranges(f.coefficients.data());
    for(std::size_t axis = 0; axis < 3; ++axis) {
      const double least = differences[axis].min, most = differences[axis].max;
      const double error = (1 + 16 * rounding)
                           * (8 * rounding * (std::max)(std::abs(least), std::abs(most)) + 2 * f.radius + underflow);
      slopes.least[axis] = 3 * (least - error) / width - underflow;
      slopes.most[axis] = 3 * (most + error) / width + underflow;
    }
    return slopes;
  }

  static double size(const Slopes& s)
  {
    double sum = 0;
    for(int a = 0; a < 3; ++a) sum += (std::max)(-s.least[a], s.most[a]);
    return sum;
  }

  enum class State : char
  {
    UNKNOWN,
    BUSY,
    KNOWN
  };
  void ensure(Cell_index c) const
  {
    if(m_states[c].load(std::memory_order_acquire) != State::KNOWN) bound_once(c);
  }
  // Bounds a cell once. If another thread is bounding the cell, this thread waits. If the field throws an exception
  // there, this thread takes over.
  void bound_once(Cell_index c) const
  {
    std::atomic<State>& state = m_states[c];
    for(;;) {
      State found = State::UNKNOWN;
      if(state.compare_exchange_strong(found, State::BUSY)) break;
      if(found == State::KNOWN) return;
      std::this_thread::yield();
    }
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // bounds must not depend on the thread that computes them
    try {
      bound(c);
    } catch(...) {
      state.store(State::UNKNOWN);
      throw;
    }
    state.store(State::KNOWN, std::memory_order_release);
  }

  void bound(Cell_index c) const
  {
    const typename Field::Cell cell = m_field->cell(c);
    const double width = cell.width();
    const Enclosed_tricubic f = enclosed_value(cell), above = m_inner.difference(f, c);
    Enclosed_tricubic below = m_outer.difference(f, c);
    for(double& x : below.coefficients) x = -x;
    Place& place = m_places[c];
    place.corner = cell.corner();
    place.width = width;
    place.coefficients = cell.coefficients();
    Bounds& bounds = m_cells[c];
    bounds.field = second_derivatives(f, width);
    bounds.above = second_derivatives(above, width);
    bounds.below = second_derivatives(below, width);
    const Slopes gradient = slopes(f, width);
    bounds.least_gradient = gradient.least;
    bounds.largest_gradient = gradient.most;
    bounds.curvature = (std::max)({ bounds.field.size(), bounds.above.size(), bounds.below.size() });
    bounds.steepness = (std::max)({ size(gradient), size(slopes(above, width)), size(slopes(below, width)) });
    // This bounds errors of values at points in the cell, as Form_error covers more roundings than there are. A
    // threshold is the difference of the field and a margin.
    const Form_error error(8 * rounding);
    place.value_error = 2 * error(f) + error(above) + error(below);
    const Level_range inner = m_inner.range(c), outer = m_outer.range(c);
    const double variation = (std::max)(inner.max - inner.min, outer.max - outer.min);
    place.inner = place.outer = std::numeric_limits<double>::quiet_NaN();
    if(variation < flat * (outer.min - inner.max)) {
      place.inner = inner.max;
      place.outer = outer.min;
      place.value_error += variation;
    }
    // The absolute weights of a derivative sum to at most six; local coordinates err by four roundings.
    bounds.gradient_error = 6 * error(f) / width + 8 * rounding * bounds.curvature * width + underflow;
    // Comparisons skip NaN, but keep infinity.
    if(!(bounds.steepness + bounds.curvature + place.value_error + bounds.gradient_error
         < std::numeric_limits<double>::infinity()))
      bounds.steepness = bounds.curvature = std::numeric_limits<double>::infinity();
  }

  static constexpr double flat = 1e-3; // variation of thresholds, relative to the thickness

  const Field* m_field;
  Threshold m_inner, m_outer;
  // Places and bounds of cells that are not known yet are uninitialized, and usually occupy no physical memory.
  std::unique_ptr<std::atomic<State>[]> m_states;
  std::unique_ptr<Place[]> m_places;
  std::unique_ptr<Bounds[]> m_cells;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOUNDED_CELLS_H
