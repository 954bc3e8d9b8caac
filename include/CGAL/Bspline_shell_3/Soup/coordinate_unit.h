// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_COORDINATE_UNIT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_COORDINATE_UNIT_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns whether a decimal number with at most `digits` significant digits is read as `x`.
inline bool has_significant_digits(double x, int digits)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, x);
  return std::strtod(text.data(), nullptr) == x;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief returns the distance between neighboring values at the largest coordinate, in the format in which the
 * coordinates were stored.
 *
 * If all coordinates are values of `float`, this is the distance between two such values. Otherwise, it is the last
 * place of decimal numbers with the fewest significant digits that reproduce all coordinates. If they need all digits
 * of a `double`, it is the distance between two values of `double`.
 *
 * \pre coordinates are finite
 * \return the distance; 0 if all coordinates are zero
 */
inline double coordinate_unit(const Polygon_soup::Points& points)
{
  constexpr int most_digits = std::numeric_limits<double>::digits10; // each such number is reproduced by a `double`
  double largest = 0;
  bool are_floats = true;
  for(const auto& p : points)
    for(int a = 0; a < 3; ++a) {
      largest = (std::max)(largest, std::abs(p[a]));
      are_floats = are_floats && static_cast<double>(static_cast<float>(p[a])) == p[a];
    }
  if(largest == 0) return 0;
  if(are_floats) {
    const float x = static_cast<float>(largest);
    return static_cast<double>(std::nextafter(x, std::numeric_limits<float>::infinity())) - largest;
  }
  int digits = 1;
  for(std::size_t v = 0; v < points.size(); ++v) {
    if(v % 1024 == 0) internal::Run::poll();
    for(int a = 0; a < 3; ++a)
      while(!internal::has_significant_digits(points[v][a], digits))
        if(++digits > most_digits) return std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  }
  return std::pow(10., std::floor(std::log10(largest)) + 1 - digits);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_COORDINATE_UNIT_H
