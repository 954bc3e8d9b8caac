// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_BASIS_ROWS_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_BASIS_ROWS_H

#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>

#include <Eigen/Core>

#include <array>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The derivatives of a functional of a field with respect to the 64 coefficients that act on a cell, in cell units.
typedef Eigen::Matrix<double, 64, 1> Local_vector;
typedef Eigen::Matrix<double, 64, 64> Local_matrix;

// Returns the basis functions along each axis and their derivatives, at a point of a cell.
inline Basis_jet<double, 2> first_order_basis(const std::array<double, 3>& position)
{
  Basis_jet<double, 2> basis;
  for(int a = 0; a < 3; ++a) {
    basis[0][a] = Cubic_bspline<>::values(position[a]);
    basis[1][a] = Cubic_bspline<>::first_derivatives(position[a]);
  }
  return basis;
}

// Returns the values of all 64 functions, from those of the four functions along each axis.
inline Local_vector outer(const std::array<double, 4>& x, const std::array<double, 4>& y,
                          const std::array<double, 4>& z)
{
  Local_vector v;
  for(int k = 0; k < 4; ++k)
    for(int j = 0; j < 4; ++j) {
      const double yz = y[j] * z[k];
      for(int i = 0; i < 4; ++i) v[16 * k + 4 * j + i] = yz * x[i];
    }
  return v;
}

// Returns the derivatives of all 64 functions along a direction.
inline Local_vector directional_row(const Basis_jet<double, 2>& basis, const std::array<double, 3>& direction)
{
  const auto& b = basis[0];
  const auto& d = basis[1];
  Local_vector row;
  for(int k = 0; k < 4; ++k)
    for(int j = 0; j < 4; ++j) {
      const double with_dx = direction[0] * b[1][j] * b[2][k];
      const double with_b = direction[1] * d[1][j] * b[2][k] + direction[2] * b[1][j] * d[2][k];
      for(int i = 0; i < 4; ++i) row[16 * k + 4 * j + i] = with_dx * d[0][i] + with_b * b[0][i];
    }
  return row;
}

// Returns the determinant of the Hessian at a point with a given basis and, if `row` is not null, its derivatives with
// respect to the 64 coefficients.
inline double hessian_determinant(const std::array<double, 64>& local, const Basis_jet<double, 3>& basis,
                                  Local_vector* row)
{
  const std::array<double, 6> h = second_order_jet<double>(local.data(), basis).hessian;
  const double xx = h[0], yy = h[1], zz = h[2], xy = h[3], xz = h[4], yz = h[5];
  const double cxx = yy * zz - yz * yz, cyy = xx * zz - xz * xz, czz = xx * yy - xy * xy;
  const double cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy, cyz = xy * xz - xx * yz;
  if(row != nullptr)
    *row = cxx * outer(basis[2][0], basis[0][1], basis[0][2]) + cyy * outer(basis[0][0], basis[2][1], basis[0][2])
           + czz * outer(basis[0][0], basis[0][1], basis[2][2]) + 2 * cxy * outer(basis[1][0], basis[1][1], basis[0][2])
           + 2 * cxz * outer(basis[1][0], basis[0][1], basis[1][2])
           + 2 * cyz * outer(basis[0][0], basis[1][1], basis[1][2]);
  return xx * cxx + xy * cxy + xz * cxz;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_BASIS_ROWS_H
