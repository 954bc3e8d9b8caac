// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H

#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/is_positive_on_triangle.h>
#include <CGAL/Bspline_shell_3/Spline/second_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/FPU.h>

#include <boost/container/small_vector.hpp>

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

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief Proves that triangles are in a shell and face along the gradient.
 *
 * Proofs use samples at the corners, and bounds of the second derivatives on the cells that a triangle meets. They are
 * rigorous, and fast for most triangles. `Field_predicates_3` decides the triangles that are left open.
 *
 * Let \f$x = \sum_i \lambda_i v_i\f$ be a point of a triangle. On the cells that the triangle meets, let the second
 * derivatives of a function \f$g\f$ differ from a symmetric matrix \f$C\f$ by at most \f$R\f$, entry by entry. Taylor's
 * formula at \f$x\f$ for each corner, weighted by \f$\lambda_i\f$, has no terms of first order. With \f$2 |d_a d_b| \le
 * d_a^2 + d_b^2\f$ it gives
 * \f[ g(x) \ge \sum_i \lambda_i g(v_i) - \frac{1}{2} \sum_{i<j} \lambda_i \lambda_j q(v_i - v_j). \f]
 * Here \f$q\f$ is the quadratic form of \f$C\f$ with the row sums of \f$R\f$ added to the diagonal. Only upward
 * curvature in the triangle's plane weakens the bound noticeably. `is_positive_on_triangle()` decides whether the bound
 * is positive.
 *
 * For the slope along the normal \f$n\f$, \f$C\f$ drops out in the same way:
 * \f[ n \cdot \nabla g(x) \ge \min_i n \cdot \nabla g(v_i) - \frac{1}{2} \sum_{a, b} |n_a| R_{ab} w_b \f]
 * with the widths \f$w\f$ of the triangle's box. Here, the mean distance of numbers from their mean is at most half the
 * length of the interval that contains them. The field has two continuous derivatives, so both bounds hold across
 * cells. Triangles are bisected until the bounds suffice.
 *
 * Const member functions may be called from several threads at once.
 *
 * \tparam Field a model of `BsplineField_3`
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field, typename Threshold = Constant_threshold>
class Second_order_bounds_3
{
public:
  typedef typename Field::Point_3 Point_3;
  typedef typename Field::Cell_index Cell_index;

  static constexpr Cell_index no_cell = Field::npos;

  /// the field and the margins at a point
  struct Sample
  {
    std::array<double, 3> point;
    Cell_index cell; ///< a cell that contains the point; `no_cell` outside the domain
    /// lower bounds of the field minus the inner threshold, and of the outer one minus the field
    double above, below;
    std::array<double, 3> gradient; ///< per user unit, rounded
  };

  /// the result for a triangle
  struct Facet_bounds
  {
    bool is_contained = false, is_transversal = false; ///< proved
    /// whether a claim fails at a point that is off the triangle by rounding at most: not a proof. The search stops
    /// there.
    bool leaves_shell = false, faces_away = false;
    /// lower bound of the field's derivative along the unit normal, per user unit, if the triangle is transversal;
    /// otherwise 0
    double slope = 0;
  };

  /// Constructs the bounds without computing any: a cell is bounded when a point or a triangle first meets it.
  /// \pre `field` outlives this object, and does not change
  Second_order_bounds_3(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_field(&field), m_inner(inner), m_outer(outer), m_states(new std::atomic<State>[field.number_of_cells()]()),
      m_places(new Cell_place[field.number_of_cells()]), m_cells(new Cell_bounds[field.number_of_cells()])
  {}
  Second_order_bounds_3(const Field&&, const Threshold&, const Threshold&) = delete; // it would dangle

  /// Returns the width of a cell, in user units.
  double width(Cell_index c) const { return place(c).width; }

  Sample sample(const Point_3& p) const { return sample({ p[0], p[1], p[2] }, m_field->locate(p), true, true); }

  /// Returns the sample halfway between two points, rounded.
  Sample sample_middle(const Sample& p, const Sample& q) const
  {
    const Coordinates x = middle(p, q);
    for(Cell_index c : { p.cell, q.cell })
      if(c != no_cell && contains(place(c), x)) return sample(x, c, true, true);
    return sample(x, locate(x), true, true);
  }

  /// Returns the derivative of the field along a direction, rounded.
  static double slope(const Sample& s, const std::array<double, 3>& direction)
  {
    return s.gradient[0] * direction[0] + s.gradient[1] * direction[1] + s.gradient[2] * direction[2];
  }

  /// Examines a triangle.
  /// \param corners samples of the triangle's corners
  /// \param normal an enclosure of its normal
  /// \param most_bisections number of bisections after which nothing more is proved
  /// \param wanted_slope per user unit; a proved bound of the slope is at least this, or at least 9/10 of the slope at
  ///   some point
  Facet_bounds examine(const std::array<Sample, 3>& corners, const Facet_normal& normal, std::size_t most_bisections,
                       double wanted_slope = 0) const
  {
    return Examination(*this, corners, normal, most_bisections, wanted_slope).result();
  }

private:
  typedef std::array<double, 3> Coordinates;
  typedef Symmetric_matrix_3 Symmetric_matrix;
  typedef Symmetric_matrix_range_3 Matrix_range;

  // The data of a cell that samples use, in one cache line. The margins are the field minus the inner threshold, and
  // the outer threshold minus the field.
  struct alignas(64) Cell_place
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
  struct Cell_bounds
  {
    Matrix_range above, below, field;              // second derivatives, of the margins and the field
    Coordinates least_gradient, largest_gradient; // field's gradient, by component
    double steepness, curvature; // sums of absolute first and second derivatives, of the margins and the field
    double gradient_error;       // bounds the roundings of the gradient's components at a point
  };

  static Coordinates middle(const Sample& p, const Sample& q)
  {
    return { (p.point[0] + q.point[0]) / 2, (p.point[1] + q.point[1]) / 2, (p.point[2] + q.point[2]) / 2 };
  }

  Cell_index locate(const Coordinates& x) const { return m_field->locate(Point_3(x[0], x[1], x[2])); }

  static bool contains(const Cell_place& cell, const Coordinates& x)
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
    const Cell_place& place = this->place(c);
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

  struct Slopes
  {
    Coordinates least, most;
  };

  // Encloses the components of the gradient on a cell.
  static Slopes slopes(const Enclosed_tricubic& f, double width)
  {
    Slopes slopes;
    const std::array<Level_range, 3> differences = internal::difference_ranges(f.coefficients.data());
    for(std::size_t axis = 0; axis < 3; ++axis) {
      const double least = differences[axis].min, most = differences[axis].max;
      const double error = (1 + 16 * internal::rounding)
                           * (8 * internal::rounding * (std::max)(std::abs(least), std::abs(most)) + 2 * f.radius
                              + internal::underflow);
      slopes.least[axis] = 3 * (least - error) / width - internal::underflow;
      slopes.most[axis] = 3 * (most + error) / width + internal::underflow;
    }
    return slopes;
  }

  static double size(const Slopes& s)
  {
    double sum = 0;
    for(int a = 0; a < 3; ++a) sum += (std::max)(-s.least[a], s.most[a]);
    return sum;
  }

  // Cells are bounded on demand, as many cells of a field are never met.
  enum class State : char
  {
    UNKNOWN,
    BUSY,
    KNOWN
  };
  const Cell_place& place(Cell_index c) const
  {
    ensure(c);
    return m_places[c];
  }
  const Cell_bounds& bounds(Cell_index c) const
  {
    ensure(c);
    return m_cells[c];
  }
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
    Cell_place& place = m_places[c];
    place.corner = cell.corner();
    place.width = width;
    place.coefficients = cell.coefficients();
    Cell_bounds& bounds = m_cells[c];
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
    const internal::Form_error error(8 * internal::rounding);
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
    bounds.gradient_error = 6 * error(f) / width + 8 * internal::rounding * bounds.curvature * width
                            + internal::underflow;
    // Comparisons skip NaN, but keep infinity.
    if(!(bounds.steepness + bounds.curvature + place.value_error + bounds.gradient_error
         < std::numeric_limits<double>::infinity()))
      bounds.steepness = bounds.curvature = std::numeric_limits<double>::infinity();
  }

  // The state of the examination of one triangle.
  class Examination
  {
  public:
    Examination(const Second_order_bounds_3& all, const std::array<Sample, 3>& corners, const Facet_normal& normal,
                std::size_t most_bisections, double wanted_slope)
      : m_all(all), m_normal(normal), m_bisections_left(most_bisections)
    {
      double reach = 0;
      for(const Sample& s : corners)
        for(double x : s.point) reach = (std::max)(reach, std::abs(x));
      // Each bisection rounds a coordinate once.
      m_shift = 4 * (max_depth + 1) * internal::rounding * reach;
      for(int a = 0; a < 3; ++a) m_absolute_normal[a] = std::abs(normal.direction[a]) + normal.radius;
      m_result.slope = std::numeric_limits<double>::infinity();
      const Part part = { { &corners[0], &corners[1], &corners[2] }, 0, 0, false, false };
      const double length = std::sqrt(square(m_absolute_normal[0]) + square(m_absolute_normal[1])
                                      + square(m_absolute_normal[2]));
      m_enough = wanted_slope * length * (1 + 32 * internal::rounding);
      m_result.is_contained = m_result.is_transversal = true;
      bool is_hopeless = false;
      for(const Sample& s : corners) is_hopeless = is_hopeless || fails(s, part);
      if(!is_hopeless) find_cells(part);
      m_result.slope = m_result.is_transversal ? m_result.slope / length * (1 - 16 * internal::rounding) : 0;
    }

    const Facet_bounds& result() const { return m_result; }

  private:
    struct Part
    {
      std::array<const Sample*, 3> corner; // owned by the caller, and by the bisections that led here
      int depth, refinements;              // number of bisections; number of them below the size of a cell
      bool is_contained, is_transversal;   // proved on all of the part, or no longer needed
    };
    struct Cell_met
    {
      Cell_index cell;
      bool is_transversal; // by the gradients on the cell
    };
    // A range of the cells met, by number, and bounds on all of them.
    struct Region
    {
      std::size_t begin, end;
      Symmetric_matrix above, below;      // q of the margins
      Symmetric_matrix radius;            // R of the field
      double width, steepness, curvature; // least width; largest steepness and curvature
      bool is_transversal;
    };
    struct Edges
    {
      std::array<Symmetric_matrix, 3> products; // products of components; doubled off the diagonal
      double longest;                           // length of the longest edge
      int top;                                  // corner opposite to the longest edge
    };

    static double square(double x) { return x * x; }

    // Returns true if a claim cannot be proved because of a point. Then the examination ends.
    bool fails(const Sample& s, const Part& part)
    {
      bool fails = s.cell == Field::npos;
      if(!fails && !part.is_contained) {
        const double margin = (std::min)(s.above, s.below);
        fails = margin < 0;
        m_result.leaves_shell = margin < -2 * m_all.place(s.cell).value_error;
      }
      if(!fails && !part.is_transversal) {
        const double at_point = slope(s, m_normal.direction);
        fails = !(at_point > 0);
        m_result.faces_away = at_point < -slope_error(s);
        m_enough = (std::min)(m_enough, 0.9 * at_point);
      }
      if(fails) m_result.is_contained = m_result.is_transversal = false;
      return fails;
    }

    // Bounds the roundings of the slope at a point.
    double slope_error(const Sample& s) const
    {
      const double size = std::abs(s.gradient[0]) + std::abs(s.gradient[1]) + std::abs(s.gradient[2]);
      return 4 * m_all.bounds(s.cell).gradient_error + (2 * m_normal.radius + 8 * internal::rounding) * size;
    }

    static Edges edges(const Part& part)
    {
      Edges edges;
      double longest = -1;
      for(int v = 0; v < 3; ++v) {
        const Coordinates &p = part.corner[(v + 1) % 3]->point, &q = part.corner[(v + 2) % 3]->point;
        const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2], squared = x * x + y * y + z * z;
        edges.products[v] = { x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y };
        if(squared > longest) {
          longest = squared;
          edges.top = v;
        }
      }
      edges.longest = std::sqrt(longest) * (1 + 8 * internal::rounding);
      return edges;
    }

    // Returns a box that contains the exact part, too.
    Bbox_3 bbox(const Part& part) const
    {
      Coordinates least, most;
      for(int a = 0; a < 3; ++a) {
        const double x = part.corner[0]->point[a], y = part.corner[1]->point[a], z = part.corner[2]->point[a];
        least[a] = (std::min)((std::min)(x, y), z) - m_shift;
        most[a] = (std::max)((std::max)(x, y), z) + m_shift;
      }
      return Bbox_3(least[0], least[1], least[2], most[0], most[1], most[2]);
    }

    static bool is_in(const Bbox_3& box, const Cell_place& cell)
    {
      for(int a = 0; a < 3; ++a)
        if((box.min)(a) < cell.corner[a] || (box.max)(a) > cell.corner[a] + cell.width) return false;
      return true;
    }
    static bool do_meet(const Bbox_3& box, const Cell_place& cell)
    {
      for(int a = 0; a < 3; ++a)
        if((box.max)(a) < cell.corner[a] || (box.min)(a) > cell.corner[a] + cell.width) return false;
      return true;
    }

    // Returns false if the facet's plane misses the cell.
    bool plane_meets(const Cell_place& cell, const Part& part) const
    {
      double distance = 0, extent = 0, reach = 0;
      for(int a = 0; a < 3; ++a) {
        const double d = cell.corner[a] + cell.width / 2 - part.corner[0]->point[a];
        distance += m_normal.direction[a] * d;
        extent += m_absolute_normal[a] * (cell.width / 2 + m_shift);
        reach = (std::max)(reach, std::abs(d));
      }
      return std::abs(distance)
             <= extent * (1 + 16 * internal::rounding) + (3 * m_normal.radius + 16 * internal::rounding) * reach;
    }

    void meet(Cell_index c)
    {
      const Cell_bounds& cell = m_all.bounds(c);
      double sum = 0, size = 0;
      for(int a = 0; a < 3; ++a) {
        sum += (std::min)(m_normal.direction[a] * cell.least_gradient[a],
                          m_normal.direction[a] * cell.largest_gradient[a]);
        size += (std::max)(std::abs(cell.least_gradient[a]), std::abs(cell.largest_gradient[a]));
      }
      const double least = sum - (2 * m_normal.radius + 8 * internal::rounding) * size;
      const bool is_transversal = least > 0 && least >= m_enough;
      m_cells.push_back({ c, is_transversal });
      if(is_transversal) m_result.slope = (std::min)(m_result.slope, least);
    }

    // Finds the cells that a part meets, and examines the part. Parts larger than a few cells are bisected first.
    void find_cells(const Part& part)
    {
      double width = 0;
      for(const Sample* s : part.corner) width = (std::max)(width, m_all.width(s->cell));
      const Edges e = edges(part);
      if(e.longest < large_extent * width) {
        const Bbox_3 box = bbox(part);
        const Cell_index first = part.corner[0]->cell;
        bool is_covered = part.corner[1]->cell == first && part.corner[2]->cell == first
                          && is_in(box, m_all.place(first));
        if(is_covered) meet(first);
        else
          is_covered = m_all.m_field->visit_cells(box, [&](Cell_index c) {
            if(plane_meets(m_all.place(c), part)) meet(c);
          });
        is_covered = is_covered && !m_cells.empty();
        if(is_covered) examine(part, e, region_from(0));
        m_cells.clear();
        if(is_covered) return;
      }
      bisect(part, e, [&](const Part& half) { find_cells(half); });
    }

    // Bisects a part, unless a limit is reached. Calls next() for each half, as long as something can still be proved.
    template <typename Next>
    void bisect(const Part& part, const Edges& e, const Next& next)
    {
      if(part.depth == max_depth || part.refinements == max_refinements || m_bisections_left == 0) {
        m_result.is_contained = m_result.is_contained && part.is_contained;
        m_result.is_transversal = m_result.is_transversal && part.is_transversal;
        return;
      }
      --m_bisections_left;
      const Coordinates x = middle(*part.corner[(e.top + 1) % 3], *part.corner[(e.top + 2) % 3]);
      const Sample between = m_all.sample(x, locate(x), !part.is_contained, !part.is_transversal);
      if(fails(between, part)) return;
      Part half = part;
      ++half.depth;
      for(int end : { 1, 2 }) {
        half.corner = part.corner;
        half.corner[(e.top + end) % 3] = &between;
        half.is_contained = part.is_contained || !m_result.is_contained; // a failed claim need not be proved
        half.is_transversal = part.is_transversal || !m_result.is_transversal;
        if(!(half.is_contained && half.is_transversal)) next(half);
      }
    }

    // Returns one of the cells met, if it contains the point, or else a cell of the field.
    Cell_index locate(const Coordinates& x) const
    {
      for(std::size_t n = m_cells.size(); n-- > 0;)
        if(contains(m_all.place(m_cells[n].cell), x)) return m_cells[n].cell;
      return m_all.locate(x);
    }

    // Returns the region of the cells met from a number on.
    Region region_from(std::size_t begin) const
    {
      const Cell_bounds& first = m_all.bounds(m_cells[begin].cell);
      Region region = { begin,
                        m_cells.size(),
                        {},
                        {},
                        {},
                        m_all.width(m_cells[begin].cell),
                        first.steepness,
                        first.curvature,
                        m_cells[begin].is_transversal };
      Matrix_range above = first.above, below = first.below, field = first.field;
      for(std::size_t n = begin + 1; n < m_cells.size(); ++n) {
        const Cell_bounds& cell = m_all.bounds(m_cells[n].cell);
        region.width = (std::min)(region.width, m_all.width(m_cells[n].cell));
        region.steepness = (std::max)(region.steepness, cell.steepness);
        region.curvature = (std::max)(region.curvature, cell.curvature);
        region.is_transversal = region.is_transversal && m_cells[n].is_transversal;
        above.include(cell.above);
        below.include(cell.below);
        field.include(cell.field);
      }
      region.above = above.largest_form();
      region.below = below.largest_form();
      for(int m = 0; m < 6; ++m) region.radius[m] = (field.most[m] - field.least[m]) / 2;
      return region;
    }

    // Examines a part that meets only cells of a region.
    void examine(Part part, const Edges& e, const Region& around)
    {
      const Bbox_3 box = bbox(part);
      const std::size_t size = m_cells.size();
      for(std::size_t n = around.begin; n < around.end; ++n)
        if(around.end - around.begin == 1 || do_meet(box, m_all.place(m_cells[n].cell)))
          m_cells.push_back(Cell_met(m_cells[n]));
      const bool is_smaller = m_cells.size() - size < around.end - around.begin;
      if(!is_smaller) m_cells.resize(size);
      if(is_smaller && m_cells.size() > size) examine(part, e, box, region_from(size));
      else examine(part, e, box, around);
      m_cells.resize(size);
    }

    void examine(Part& part, const Edges& e, const Bbox_3& box, const Region& region)
    {
      if(!part.is_contained) part.is_contained = is_contained(part, e, region);
      if(!part.is_transversal) part.is_transversal = is_transversal(part, box, region);
      if(part.is_contained && part.is_transversal) return;
      part.refinements += e.longest < region.width;
      bisect(part, e, [&](const Part& half) { examine(half, edges(half), region); });
    }

    static constexpr double up = 1 + 32 * internal::rounding;

    bool is_contained(const Part& part, const Edges& e, const Region& region) const
    {
      // Corners are off by the shift, and edges by twice the shift. This also exceeds the roundings of products, unless
      // these underflow.
      const double error = (region.steepness + 2 * region.curvature * (e.longest + m_shift)) * m_shift
                           + region.curvature * internal::underflow;
      std::array<double, 3> above, below;
      for(std::size_t v = 0; v < 3; ++v) {
        above[v] = part.corner[v]->above - error * up;
        below[v] = part.corner[v]->below - error * up;
      }
      return is_positive_on_triangle(above, on_edges(region.above, e))
             && is_positive_on_triangle(below, on_edges(region.below, e));
    }

    static std::array<double, 3> on_edges(const Symmetric_matrix& q, const Edges& e)
    {
      std::array<double, 3> on_edges;
      for(std::size_t v = 0; v < 3; ++v) {
        const Symmetric_matrix& p = e.products[v];
        on_edges[v] = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3] + q[4] * p[4] + q[5] * p[5];
      }
      return on_edges;
    }

    bool is_transversal(const Part& part, const Bbox_3& box, const Region& region)
    {
      if(region.is_transversal) return true;
      const Symmetric_matrix& r = region.radius;
      const Coordinates& n = m_absolute_normal;
      const double deviation = (box.xmax() - box.xmin()) * (r[0] * n[0] + r[5] * n[1] + r[4] * n[2])
                               + (box.ymax() - box.ymin()) * (r[5] * n[0] + r[1] * n[1] + r[3] * n[2])
                               + (box.zmax() - box.zmin()) * (r[4] * n[0] + r[3] * n[1] + r[2] * n[2]);
      double least = std::numeric_limits<double>::infinity();
      for(const Sample* s : part.corner) least = (std::min)(least, slope(*s, m_normal.direction) - slope_error(*s));
      least -= (deviation / 2 + 4 * region.curvature * m_shift) * up;
      if(!(least > 0 && least >= m_enough)) return false;
      m_result.slope = (std::min)(m_result.slope, least);
      return true;
    }

    const Second_order_bounds_3& m_all;
    const Facet_normal& m_normal;
    Coordinates m_absolute_normal;
    double m_shift;  // by which rounding may displace corners of parts
    double m_enough; // bound of the slope on a part that suffices
    std::size_t m_bisections_left;
    Facet_bounds m_result;
    // The cells of the current region, after the cells of the regions that contain it.
    boost::container::small_vector<Cell_met, 256> m_cells;
  };

  static constexpr double large_extent = 3; // cells
  static constexpr double flat = 1e-3;      // variation of thresholds, relative to the thickness
  static constexpr int max_depth = 40, max_refinements = 14;

  const Field* m_field;
  Threshold m_inner, m_outer;
  // Places and bounds of cells that are not known yet are uninitialized, and usually occupy no physical memory.
  std::unique_ptr<std::atomic<State>[]> m_states;
  std::unique_ptr<Cell_place[]> m_places;
  std::unique_ptr<Cell_bounds[]> m_cells;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H
