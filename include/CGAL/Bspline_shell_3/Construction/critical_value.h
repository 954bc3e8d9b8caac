// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CRITICAL_VALUE_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CRITICAL_VALUE_H

#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>

#include <cmath>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief an estimate of the value that a function takes where its slope vanishes, next to a point: that of its Taylor polynomial of degree two along
 * the gradient, \f$f - |g|^2 / 2c\f$ with the curvature \f$c = g^T H g / |g|^2\f$.
 *
 * \param jet of the function at the point
 * \param reach how far the place may be from the point, user units
 * \return nothing if it is farther away
 */
inline std::optional<double> critical_value(const internal::Second_order_jet<double>& jet, double reach)
{
  const auto& g = jet.gradient;
  const auto& h = jet.hessian;
  const double squared = g[0]*g[0] + g[1]*g[1] + g[2]*g[2];
  if(squared == 0) return jet.value;
  const double curvature = (h[0]*g[0]*g[0] + h[1]*g[1]*g[1] + h[2]*g[2]*g[2]
                            + 2 * (h[3]*g[0]*g[1] + h[4]*g[0]*g[2] + h[5]*g[1]*g[2])) / squared;
  if(!(std::abs(curvature) * reach >= std::sqrt(squared))) return std::nullopt;
  return jet.value - squared / (2 * curvature);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_CRITICAL_VALUE_H
