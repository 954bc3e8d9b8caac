// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FIELD_QUESTIONS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FIELD_QUESTIONS_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A question provides the tricubic to bound on a cell, and the unit in which it is given. It also provides the ranges
// of the tricubic that prove or refute the claim.
struct Values_within
{
  Level_range levels;
  template <typename Cell>
  Enclosed_tricubic function(const Cell& cell, std::size_t) const
  {
    return enclosed_value(cell);
  }
  bool proves(const Level_range& r) const { return levels.min < r.min && r.max < levels.max; }
  bool refutes(const Level_range& r) const { return r.max < levels.min || r.min > levels.max; }
  template <typename Cell>
  double unit(const Cell&) const
  {
    return 1;
  }
};

template <typename Threshold>
struct Is_beyond
{
  const Threshold& threshold;
  int sign; // 1: above it, -1: below it
  template <typename Cell>
  Enclosed_tricubic function(const Cell& cell, std::size_t c) const
  {
    Enclosed_tricubic d = threshold.difference(enclosed_value(cell), c);
    for(double& x : d.coefficients) x *= sign;
    return d;
  }
  bool proves(const Level_range& r) const { return r.min > 0; }
  bool refutes(const Level_range& r) const { return r.max < 0; }
  template <typename Cell>
  double unit(const Cell&) const
  {
    return 1;
  }
};

struct Is_in_cells
{
  const std::vector<char>& flagged;
  // The constant is positive on flagged cells. On other cells it has an infinite radius, which proves and refutes
  // nothing, as the simplex may only touch them.
  template <typename Cell>
  Enclosed_tricubic function(const Cell&, std::size_t c) const
  {
    Enclosed_tricubic constant;
    constant.coefficients.fill(1);
    constant.radius = flagged[c] ? 0 : std::numeric_limits<double>::infinity();
    return constant;
  }
  bool proves(const Level_range& r) const { return r.min > 0; }
  bool refutes(const Level_range& r) const { return r.max < 0; }
  template <typename Cell>
  double unit(const Cell&) const
  {
    return 1;
  }
};

struct Increases
{
  std::array<double, 3> direction;
  double radius;
  template <typename Cell>
  Enclosed_tricubic function(const Cell& cell, std::size_t) const
  {
    return enclosed_derivative(enclosed_value(cell), direction, radius);
  }
  bool proves(const Level_range& r) const { return r.min > 0; }
  bool refutes(const Level_range& r) const { return r.max <= 0; }
  template <typename Cell>
  double unit(const Cell& cell) const
  {
    return cell.width();
  }
};

template <typename Threshold>
struct Increases_above
{
  Increases increases;
  const Threshold& threshold;
  template <typename Cell>
  Enclosed_tricubic function(const Cell& cell, std::size_t c) const
  {
    return enclosed_derivative(threshold.difference(enclosed_value(cell), c), increases.direction, increases.radius);
  }
  bool proves(const Level_range& r) const { return r.min > 0; }
  bool refutes(const Level_range& r) const { return r.max <= 0; }
  template <typename Cell>
  double unit(const Cell& cell) const
  {
    return cell.width();
  }
};

// Returns the direction of a segment, scaled by a power of two: components are at most one, and err by one rounding.
template <typename Point_3>
Increases along(const std::array<Point_3, 2>& segment)
{
  Increases question = { {}, rounding };
  for(int a = 0; a < 3; ++a) question.direction[a] = segment[1][a] - segment[0][a];
  const double unit = reciprocal_power_of_two(question.direction);
  for(double& d : question.direction) d *= unit;
  return question;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FIELD_QUESTIONS_H
