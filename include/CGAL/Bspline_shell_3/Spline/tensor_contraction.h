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

// A tricubic polynomial has 64 coefficients c[i + 4j + 16k], with i along x. In each basis (B-spline or Bernstein),
// values and derivatives are contractions with one array of four weights per axis.
template <typename NT>
using Weights = std::array<NT, 4>;

template <typename NT>
inline NT dot4(const NT* c, const Weights<NT>& w)
{
  return c[0] * w[0] + c[1] * w[1] + c[2] * w[2] + c[3] * w[3];
}

// Returns r[m] = sum_k c[size k + m] w[k]. The contraction is along the slowest axis, so that neighboring results are
// computed at once.
template <int size, typename NT, typename Coefficient>
inline std::array<NT, size> contract_slowest(const Coefficient* c, const Weights<NT>& w)
{
  std::array<NT, size> r;
  for(int m = 0; m < size; ++m)
    r[m] = w[0] * c[m] + w[1] * c[size + m] + w[2] * c[2 * size + m] + w[3] * c[3 * size + m];
  return r;
}

template <typename NT, typename Coefficient>
inline NT contract(const Coefficient* c, const Weights<NT>& x, const Weights<NT>& y, const Weights<NT>& z)
{
  const std::array<NT, 16> rz = contract_slowest<16>(c, z);
  const std::array<NT, 4> ry = contract_slowest<4>(rz.data(), y);
  return dot4(ry.data(), x);
}

// value and gradient (x, y, z) of a tricubic
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
  const std::array<NT, 16> z0 = contract_slowest<16>(c, b[0][2]);
  const std::array<NT, 16> z1 = contract_slowest<16>(c, b[1][2]);
  const std::array<NT, 4> y0z0 = contract_slowest<4>(z0.data(), b[0][1]);
  const std::array<NT, 4> y1z0 = contract_slowest<4>(z0.data(), b[1][1]);
  const std::array<NT, 4> y0z1 = contract_slowest<4>(z1.data(), b[0][1]);
  First_order_jet<NT> jet;
  jet.value = dot4(y0z0.data(), b[0][0]);
  jet.gradient[0] = dot4(y0z0.data(), b[1][0]);
  jet.gradient[1] = dot4(y1z0.data(), b[0][0]);
  jet.gradient[2] = dot4(y0z1.data(), b[0][0]);
  return jet;
}

template <typename NT, typename Coefficient>
inline Second_order_jet<NT> second_order_jet(const Coefficient* c, const Basis_jet<NT, 3>& b)
{
  const std::array<NT, 16> z0 = contract_slowest<16>(c, b[0][2]);
  const std::array<NT, 16> z1 = contract_slowest<16>(c, b[1][2]);
  const std::array<NT, 16> z2 = contract_slowest<16>(c, b[2][2]);
  const std::array<NT, 4> y0z0 = contract_slowest<4>(z0.data(), b[0][1]);
  const std::array<NT, 4> y1z0 = contract_slowest<4>(z0.data(), b[1][1]);
  const std::array<NT, 4> y2z0 = contract_slowest<4>(z0.data(), b[2][1]);
  const std::array<NT, 4> y0z1 = contract_slowest<4>(z1.data(), b[0][1]);
  const std::array<NT, 4> y1z1 = contract_slowest<4>(z1.data(), b[1][1]);
  const std::array<NT, 4> y0z2 = contract_slowest<4>(z2.data(), b[0][1]);
  Second_order_jet<NT> jet;
  jet.value = dot4(y0z0.data(), b[0][0]);
  jet.gradient[0] = dot4(y0z0.data(), b[1][0]);
  jet.gradient[1] = dot4(y1z0.data(), b[0][0]);
  jet.gradient[2] = dot4(y0z1.data(), b[0][0]);
  jet.hessian[0] = dot4(y0z0.data(), b[2][0]);
  jet.hessian[1] = dot4(y2z0.data(), b[0][0]);
  jet.hessian[2] = dot4(y0z2.data(), b[0][0]);
  jet.hessian[3] = dot4(y1z0.data(), b[1][0]);
  jet.hessian[4] = dot4(y0z1.data(), b[1][0]);
  jet.hessian[5] = dot4(y1z1.data(), b[0][0]);
  return jet;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_TENSOR_CONTRACTION_H
