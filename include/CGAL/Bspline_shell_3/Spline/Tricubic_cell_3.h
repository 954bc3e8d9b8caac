// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_TRICUBIC_CELL_3_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_TRICUBIC_CELL_3_H

#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <utility>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief a leaf cell of a field: a closed axis-parallel cube with the tricubic polynomial of the field on it.
 *
 * The polynomial has 64 Bernstein coefficients \f$c_{i+4j+16k}\f$ (index `i` along x). They are rounded from the
 * coefficients of the spline: each is within `error_radius()` of the exact coefficient. A bound on the spline must add
 * this radius.
 *
 * A cell is a view, which is valid as long as its field is neither changed nor destroyed. Bounds, certificates,
 * tracing, and level sets access a field only by its cells.
 */
class Tricubic_cell_3
{
  template <int orders>
  using Basis_jet = internal::Basis_jet<double, orders>;

public:
  typedef internal::First_order_jet<double> First_order_jet;   ///< `value`, `gradient` (x, y, z)
  typedef internal::Second_order_jet<double> Second_order_jet; ///< also `hessian` (xx, yy, zz, xy, xz, yz)

  Tricubic_cell_3(const std::array<double, 3>& corner, double width, const double* coefficients, double error_radius)
    : m_corner(corner), m_width(width), m_coefficients(coefficients), m_error_radius(error_radius)
  {}

  /// returns the corner with the smallest coordinates, exactly
  const std::array<double, 3>& corner() const { return m_corner; }
  /// returns the length of the cell's edges in the units of the coordinates, exactly
  double width() const { return m_width; }
  /// returns the closed cell; its corners are exact
  Bbox_3 bbox() const
  {
    return Bbox_3(m_corner[0], m_corner[1], m_corner[2], m_corner[0] + m_width, m_corner[1] + m_width,
                  m_corner[2] + m_width);
  }
  /// returns the 64 Bernstein coefficients
  const double* coefficients() const { return m_coefficients; }
  /// returns a bound on the error of each coefficient, and hence on the difference of the polynomial and the spline on
  /// the cell. The bound is infinite if the spline has coefficients that are not finite, or close to the largest
  /// `double`.
  double error_radius() const { return m_error_radius; }

  /// returns the range of the Bernstein coefficients, which encloses the polynomial on the cell
  std::pair<double, double> coefficient_range() const
  {
    const auto mm = std::minmax_element(m_coefficients, m_coefficients + 64);
    return { *mm.first, *mm.second };
  }

  /// returns the position of `p` in the cell; the cell itself is \f$[0,1]^3\f$
  template <typename Point>
  std::array<double, 3> local_coordinates(const Point& p) const
  {
    return { (p[0] - m_corner[0]) / m_width, (p[1] - m_corner[1]) / m_width, (p[2] - m_corner[2]) / m_width };
  }

  /// \name Evaluation
  /// `p` has three coordinates `p[0]`, `p[1]`, `p[2]`; derivatives are with respect to these coordinates.
  /// @{
  template <typename Point>
  double value(const Point& p) const
  {
    return local_value(local_coordinates(p));
  }
  /// returns the value at local coordinates
  double local_value(const std::array<double, 3>& t) const
  {
    return internal::contract(m_coefficients, bernstein(t[0]), bernstein(t[1]), bernstein(t[2]));
  }

  template <typename Point>
  First_order_jet first_order_jet(const Point& p) const
  {
    First_order_jet jet = local_first_order_jet(local_coordinates(p));
    for(double& d : jet.gradient) d /= m_width;
    return jet;
  }
  /// returns the jet at local coordinates, with derivatives with respect to local coordinates
  First_order_jet local_first_order_jet(const std::array<double, 3>& t) const
  {
    Basis_jet<2> b;
    for(int a = 0; a < 3; ++a) {
      b[0][a] = bernstein(t[a]);
      b[1][a] = bernstein_derivative(t[a]);
    }
    return internal::first_order_jet<double>(m_coefficients, b);
  }

  template <typename Point>
  Second_order_jet second_order_jet(const Point& p) const
  {
    const std::array<double, 3> t = local_coordinates(p);
    Basis_jet<3> b;
    for(int a = 0; a < 3; ++a) {
      b[0][a] = bernstein(t[a]);
      b[1][a] = bernstein_derivative(t[a]);
      b[2][a] = bernstein_second_derivative(t[a]);
    }
    Second_order_jet jet = internal::second_order_jet<double>(m_coefficients, b);
    for(double& d : jet.gradient) d /= m_width;
    for(double& d : jet.hessian) d /= m_width * m_width;
    return jet;
  }
  /// @}

private:
  typedef std::array<double, 4> Weights;

  static Weights bernstein(double t)
  {
    const double s = 1 - t;
    return { s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t };
  }
  static Weights bernstein_derivative(double t)
  {
    const double s = 1 - t;
    return { -3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t };
  }
  static Weights bernstein_second_derivative(double t)
  {
    const double s = 1 - t;
    return { 6 * s, 6 * (t - 2 * s), 6 * (s - 2 * t), 6 * t };
  }

  std::array<double, 3> m_corner;
  double m_width;
  const double* m_coefficients;
  double m_error_radius;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_TRICUBIC_CELL_3_H
