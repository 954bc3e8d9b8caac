// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_RANGE_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_RANGE_H

#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns the smallest and the largest value of a univariate polynomial on \f$[0, 1]\f$, up to rounding.
 *
 * The interval is bisected where the Bernstein coefficients exceed the values found so far.
 *
 * \tparam N degree plus one
 * \param coefficients Bernstein coefficients
 * \cgalHeading{Cost} About 26 bisections for each extremum, because the coefficients converge quadratically.
 */
template <std::size_t N>
Level_range bernstein_range(const std::array<double, N>& coefficients)
{
  typedef std::array<double, N> Coefficients;
  constexpr std::size_t max_depth = 52;
  Level_range range;
  range.include(coefficients.front());
  range.include(coefficients.back());
  double largest = 0;
  for(double c : coefficients) largest = (std::max)(largest, std::abs(c));
  const double tolerance = 2 * std::numeric_limits<double>::epsilon() * largest;

  struct Interval
  {
    Coefficients coefficients;
    std::size_t depth;
  };
  std::array<Interval, max_depth + 1> stack; // one interval waits at each depth, and one more at the last depth
  std::size_t size = 0;
  stack[size++] = { coefficients, 0 };
  while(size > 0) {
    Interval& left = stack[size - 1];
    const auto hull = std::minmax_element(left.coefficients.begin(), left.coefficients.end());
    if(left.depth == max_depth || (*hull.first >= range.min - tolerance && *hull.second <= range.max + tolerance)) {
      --size;
      continue;
    }
    // de Casteljau: the left half replaces the interval, and the right half is pushed on top of it
    Interval right = left;
    for(std::size_t n = 1; n < N; ++n) {
      for(std::size_t i = 0; i + n < N; ++i)
        right.coefficients[i] = (right.coefficients[i] + right.coefficients[i + 1]) / 2;
      left.coefficients[n] = right.coefficients[0];
    }
    range.include(right.coefficients.front());
    right.depth = ++left.depth;
    stack[size++] = right;
  }
  return range;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_RANGE_H
