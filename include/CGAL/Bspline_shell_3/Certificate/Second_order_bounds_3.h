// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Bounded_cells.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Second_order_examination.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief Proves that triangles are in a shell and face along the gradient.
 *
 * Proofs use samples at the corners, and bounds on the second derivatives on the cells that a triangle meets. They are
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
  typedef internal::Bounded_cells<Field, Threshold> Cells;

public:
  typedef typename Field::Point_3 Point_3;
  typedef typename Field::Cell_index Cell_index;

  static constexpr Cell_index no_cell = Cells::no_cell;

  /// the field and the margins at a point: `point`; `cell`, which contains it, `no_cell` outside the domain; `above`
  /// and `below`, lower bounds on the field minus the inner threshold, and on the outer one minus the field;
  /// `gradient`, per user unit, rounded
  typedef typename Cells::Sample Sample;

  /// the result for a triangle: `is_contained` and `is_transversal` are proved. `leaves_shell` and `faces_away` prove
  /// nothing: a claim fails at a point that may be off the triangle by rounding errors. `slope` is a lower bound on the
  /// field's derivative along the unit normal, per user unit; it is 0 if the triangle is not proved transversal
  typedef internal::Facet_bounds Facet_bounds;

  /// Constructs the bounds without computing any: a cell is bounded when a point or a triangle first meets it.
  /// \pre `field` outlives this object, and does not change
  Second_order_bounds_3(const Field& field, const Threshold& inner, const Threshold& outer)
    : m_cells(field, inner, outer)
  {}
  Second_order_bounds_3(const Field&&, const Threshold&, const Threshold&) = delete; // it would dangle

  /// Returns the width of a cell, in user units.
  double width(Cell_index c) const { return m_cells.place(c).width; }

  Sample sample(const Point_3& p) const
  {
    return m_cells.sample({ p[0], p[1], p[2] }, m_cells.field().locate(p), true, true);
  }

  /// Returns the sample halfway between two points, rounded.
  Sample sample_middle(const Sample& p, const Sample& q) const
  {
    const std::array<double, 3> x = Cells::middle(p, q);
    for(Cell_index c : { p.cell, q.cell })
      if(c != no_cell && Cells::contains(m_cells.place(c), x)) return m_cells.sample(x, c, true, true);
    return m_cells.sample(x, m_cells.locate(x), true, true);
  }

  /// Returns the derivative of the field along a direction, rounded.
  static double slope(const Sample& s, const std::array<double, 3>& direction) { return Cells::slope(s, direction); }

  /// Examines a triangle.
  /// \param corners samples of the triangle's corners
  /// \param normal an enclosure of its normal
  /// \param most_bisections number of bisections after which nothing more is proved
  /// \param target_slope per user unit; a proved bound on the slope is at least this, or at least 9/10 of the slope at
  ///   some point
  Facet_bounds examine(const std::array<Sample, 3>& corners, const Facet_normal& normal, std::size_t most_bisections,
                       double target_slope = 0) const
  {
    return internal::Second_order_examination<Cells>(m_cells, corners, normal, most_bisections, target_slope).result();
  }

private:
  Cells m_cells;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SECOND_ORDER_BOUNDS_3_H
