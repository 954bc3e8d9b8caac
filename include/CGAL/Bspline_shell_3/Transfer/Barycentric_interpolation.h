// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_BARYCENTRIC_INTERPOLATION_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_BARYCENTRIC_INTERPOLATION_H

#include <CGAL/IO/Color.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Point_2.h>
#include <CGAL/Point_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief interpolates the values at the corners of a triangle linearly.
 *
 * Values may be numbers, `std::array`s of numbers, `CGAL::IO::Color`s, and points of a kernel. All types with `T + T`
 * and `double * T` are also permitted, such as vectors of a kernel or of Eigen. Integers and channels of colors are
 * rounded.
 *
 * \cgalModels `AttributeInterpolation`
 */
struct Barycentric_interpolation
{
  typedef std::array<double, 3> Weights; ///< barycentric coordinates; negative coordinates extrapolate

  template <typename T>
  T operator()(const std::array<T, 3>& v, const Weights& w) const
  {
    if constexpr(std::is_floating_point<T>::value) return T(w[0] * v[0] + w[1] * v[1] + w[2] * v[2]);
    else if constexpr(std::is_integral<T>::value) return T(std::lround(w[0] * v[0] + w[1] * v[1] + w[2] * v[2]));
    else return T(w[0] * v[0] + w[1] * v[1] + w[2] * v[2]);
  }

  template <typename T, std::size_t size>
  std::array<T, size> operator()(const std::array<std::array<T, size>, 3>& v, const Weights& w) const
  {
    std::array<T, size> r;
    for(std::size_t i = 0; i < size; ++i) r[i] = (*this)(std::array<T, 3>{ v[0][i], v[1][i], v[2][i] }, w);
    return r;
  }

  IO::Color operator()(const std::array<IO::Color, 3>& v, const Weights& w) const
  {
    const auto channel = [&](std::size_t i) {
      const double c = w[0] * v[0][i] + w[1] * v[1][i] + w[2] * v[2][i];
      return (unsigned char)(std::lround((std::min)((std::max)(c, 0.), 255.)));
    };
    return IO::Color(channel(0), channel(1), channel(2), channel(3));
  }

  template <typename K>
  Point_2<K> operator()(const std::array<Point_2<K>, 3>& v, const Weights& w) const
  {
    return v[0] + (w[1] * (v[1] - v[0]) + w[2] * (v[2] - v[0]));
  }
  template <typename K>
  Point_3<K> operator()(const std::array<Point_3<K>, 3>& v, const Weights& w) const
  {
    return v[0] + (w[1] * (v[1] - v[0]) + w[2] * (v[2] - v[0]));
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_BARYCENTRIC_INTERPOLATION_H
