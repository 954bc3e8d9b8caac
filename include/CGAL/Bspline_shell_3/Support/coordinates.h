// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_COORDINATES_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_COORDINATES_H

#include <CGAL/number_utils.h>

#include <boost/container_hash/hash.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace CGAL {

template <typename ET>
class Lazy_exact_nt;

namespace Bspline_shells {
namespace internal {

// Operations on vectors without a kernel: three coordinates u[0], u[1], u[2], which are doubles or exact numbers.

template <typename U, typename V>
auto dot(const U& u, const V& v)
{
  typedef std::decay_t<decltype(u[0])> FT;
  return FT(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
}

template <typename U, typename V>
auto cross(const U& u, const V& v)
{
  typedef std::decay_t<decltype(u[0])> FT;
  return std::array<FT, 3>{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

template <typename Vector>
double norm(const Vector& v)
{
  return std::sqrt(dot(v, v));
}

// Returns the double that represents a number of the user. Proofs hold for the rounded mesh, so all code must round in
// this way: to_double() of a lazy number depends on its history, and has a relative error of up to 1e-5.
template <typename NT>
double rounded(const NT& x)
{
  return CGAL::to_double(x);
}
template <typename ET>
double rounded(const Lazy_exact_nt<ET>& x)
{
  const auto known = x.approx();
  // A lazy number that is infinite or NaN has no exact value.
  return known.inf() < known.sup() ? CGAL::to_double(x.exact()) : known.inf();
}

// Returns the rounded coordinates of a point or vector.
template <typename Vector>
std::array<double, 3> rounded_coordinates(const Vector& v)
{
  return { rounded(v[0]), rounded(v[1]), rounded(v[2]) };
}

// Returns a point with coordinates of type double as a point of another kernel, or `p` itself if it has this type.
template <typename Point, typename Other>
decltype(auto) converted(Other&& p)
{
  static_assert(std::is_same<std::decay_t<decltype(p[0])>, double>::value,
                "The coordinates must be of type double: other types would be rounded.");
  if constexpr(!std::is_same<Point, std::decay_t<Other> >::value) return Point(p[0], p[1], p[2]);
  else return static_cast<std::conditional_t<std::is_lvalue_reference<Other>::value, const Point&, Point> >(p);
}

struct Hash_coordinates
{
  // Zeros of both signs have the same hash.
  std::size_t operator()(const std::array<double, 3>& p) const
  {
    std::size_t seed = 0;
    for(double x : p) boost::hash_combine(seed, x + 0.);
    return seed;
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_COORDINATES_H
