// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_POWER_OF_TWO_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_POWER_OF_TWO_H

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns a power of two whose product with x has an absolute value in [1/2, 1), or less if x is subnormal. Returns one
// if x is zero or not finite. Scaling by powers of two does not round, and squares of scaled numbers neither overflow
// nor underflow.
inline double reciprocal_power_of_two(double x)
{
  if(!std::isfinite(x) || x == 0) return 1;
  int exponent;
  std::frexp(x, &exponent);
  constexpr int greatest_exponent = 1023;
  return std::ldexp(1., (std::min)(-exponent, greatest_exponent));
}

// Returns this power of two for the largest component of a vector.
inline double reciprocal_power_of_two(const std::array<double, 3>& v)
{
  return reciprocal_power_of_two((std::max)({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) }));
}

// Returns the vector, scaled by this power of two.
inline std::array<double, 3> scaled_to_unit(const std::array<double, 3>& v)
{
  const double unit = reciprocal_power_of_two(v);
  return { unit * v[0], unit * v[1], unit * v[2] };
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_POWER_OF_TWO_H
