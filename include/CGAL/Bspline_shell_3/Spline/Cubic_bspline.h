// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_CUBIC_BSPLINE_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_CUBIC_BSPLINE_H

#include <array>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief the univariate uniform cubic B-spline \f$b\f$ on knots of spacing 1 (Eq. 3.1 of
 * \cgalCite{CubicBsplineShell2025}).
 *
 * A cell is the unit interval between two knots. The four functions that do not vanish on the cell \f$[i, i+1]\f$ are
 * centered at the knots \f$i-1, i, i+1, i+2\f$; all arrays of this class list them in this order. The position `t` in
 * the cell is between 0 and 1. Outside \f$[0,1]\f$, the polynomial pieces of the cell are continued.
 *
 * \tparam NT a field number type (`double`, `Interval_nt<false>`, a rational)
 */
template <typename NT = double>
class Cubic_bspline
{
public:
  /// number of functions on a cell, and of Bernstein coefficients of a cubic
  static constexpr int size = 4;
  typedef std::array<NT, 4> Weights;

  /// returns the values of the four functions; they sum to one
  static Weights values(const NT& t)
  {
    const NT s = NT(1) - t;
    return { s * s * s / NT(6), (NT(4) + NT(3) * t * (t * (t - NT(2)))) / NT(6),
             (NT(4) + NT(3) * s * (s * (s - NT(2)))) / NT(6), t * t * t / NT(6) };
  }

  /// returns the first derivatives, per cell unit
  static Weights first_derivatives(const NT& t)
  {
    const NT s = NT(1) - t;
    return { -s * s / NT(2), t * (NT(3) * t - NT(4)) / NT(2), s * (NT(4) - NT(3) * s) / NT(2), t * t / NT(2) };
  }

  /// returns the second derivatives, per cell unit squared
  static Weights second_derivatives(const NT& t)
  {
    const NT s = NT(1) - t;
    return { s, NT(3) * t - NT(2), NT(3) * s - NT(2), t };
  }

  /// returns the Bernstein coefficients over the cell of the cubic with the four B-spline coefficients `c`
  static Weights bernstein_coefficients(const Weights& c)
  {
    const NT left = (c[0] + NT(4) * c[1] + c[2]) / NT(6);
    const NT right = (c[1] + NT(4) * c[2] + c[3]) / NT(6);
    return { left, (NT(2) * c[1] + c[2]) / NT(3), (c[1] + NT(2) * c[2]) / NT(3), right };
  }

  /// returns the mask \f$m\f$ of the two-scale relation \f$b(t) = \sum_{j=-2}^{2} m_{j+2}\, b(2t - j)\f$
  static std::array<NT, 5> two_scale_mask()
  {
    return { NT(1) / NT(8), NT(4) / NT(8), NT(6) / NT(8), NT(4) / NT(8), NT(1) / NT(8) };
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_CUBIC_BSPLINE_H
