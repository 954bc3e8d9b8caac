// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_TENSOR_CONTRACTION_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_TENSOR_CONTRACTION_H

#include <array>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A tricubic polynomial has 64 coefficients c[i + 4j + 16k], i along x. Values and derivatives are contractions
// with one array of four weights per axis, whatever the basis (B-spline or Bernstein).
template <typename NT>
using Weights = std::array<NT, 4>;

template <typename NT>
inline NT dot4(const NT* c, const Weights<NT>& w)
{
  return c[0]*w[0] + c[1]*w[1] + c[2]*w[2] + c[3]*w[3];
}

// r[m] = sum_i c[4m + i] w[i]
template <int rows, typename NT, typename Coefficient>
inline std::array<NT, rows> contract_rows(const Coefficient* c, const Weights<NT>& w)
{
  std::array<NT, rows> r;
  for(int m = 0; m < rows; ++m)
    r[m] = w[0]*c[4*m] + w[1]*c[4*m+1] + w[2]*c[4*m+2] + w[3]*c[4*m+3];
  return r;
}

template <typename NT, typename Coefficient>
inline NT contract(const Coefficient* c, const Weights<NT>& x, const Weights<NT>& y, const Weights<NT>& z)
{
  const std::array<NT, 16> rx = contract_rows<16>(c, x);
  const std::array<NT, 4> ry = contract_rows<4>(rx.data(), y);
  return dot4(ry.data(), z);
}

// value, gradient (x, y, z) of a tricubic
template <typename NT>
struct First_order_jet
{
  NT value;
  std::array<NT, 3> gradient;
};

// value, gradient, second derivatives (xx, yy, zz, xy, xz, yz)
template <typename NT>
struct Second_order_jet
{
  NT value;
  std::array<NT, 3> gradient;
  std::array<NT, 6> hessian;
};

// weights of the basis functions and of their derivatives, [order][axis]
template <typename NT, int orders>
using Basis_jet = std::array<std::array<Weights<NT>, 3>, orders>;

template <typename NT, typename Coefficient>
inline First_order_jet<NT> first_order_jet(const Coefficient* c, const Basis_jet<NT, 2>& b)
{
  const std::array<NT, 16> x0 = contract_rows<16>(c, b[0][0]);
  const std::array<NT, 16> x1 = contract_rows<16>(c, b[1][0]);
  const std::array<NT, 4> x0y0 = contract_rows<4>(x0.data(), b[0][1]);
  const std::array<NT, 4> x0y1 = contract_rows<4>(x0.data(), b[1][1]);
  const std::array<NT, 4> x1y0 = contract_rows<4>(x1.data(), b[0][1]);
  First_order_jet<NT> jet;
  jet.value = dot4(x0y0.data(), b[0][2]);
  jet.gradient[0] = dot4(x1y0.data(), b[0][2]);
  jet.gradient[1] = dot4(x0y1.data(), b[0][2]);
  jet.gradient[2] = dot4(x0y0.data(), b[1][2]);
  return jet;
}

template <typename NT, typename Coefficient>
inline Second_order_jet<NT> second_order_jet(const Coefficient* c, const Basis_jet<NT, 3>& b)
{
  const std::array<NT, 16> x0 = contract_rows<16>(c, b[0][0]);
  const std::array<NT, 16> x1 = contract_rows<16>(c, b[1][0]);
  const std::array<NT, 16> x2 = contract_rows<16>(c, b[2][0]);
  const std::array<NT, 4> x0y0 = contract_rows<4>(x0.data(), b[0][1]);
  const std::array<NT, 4> x0y1 = contract_rows<4>(x0.data(), b[1][1]);
  const std::array<NT, 4> x0y2 = contract_rows<4>(x0.data(), b[2][1]);
  const std::array<NT, 4> x1y0 = contract_rows<4>(x1.data(), b[0][1]);
  const std::array<NT, 4> x1y1 = contract_rows<4>(x1.data(), b[1][1]);
  const std::array<NT, 4> x2y0 = contract_rows<4>(x2.data(), b[0][1]);
  Second_order_jet<NT> jet;
  jet.value = dot4(x0y0.data(), b[0][2]);
  jet.gradient[0] = dot4(x1y0.data(), b[0][2]);
  jet.gradient[1] = dot4(x0y1.data(), b[0][2]);
  jet.gradient[2] = dot4(x0y0.data(), b[1][2]);
  jet.hessian[0] = dot4(x2y0.data(), b[0][2]);
  jet.hessian[1] = dot4(x0y2.data(), b[0][2]);
  jet.hessian[2] = dot4(x0y0.data(), b[2][2]);
  jet.hessian[3] = dot4(x1y1.data(), b[0][2]);
  jet.hessian[4] = dot4(x1y0.data(), b[1][2]);
  jet.hessian[5] = dot4(x0y1.data(), b[1][2]);
  return jet;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_TENSOR_CONTRACTION_H
