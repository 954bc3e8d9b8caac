// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MOVE_TO_LEVEL_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MOVE_TO_LEVEL_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <array>
#include <optional>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Moves a point along the gradient of a field to where its value is the mean of the values at two points, up to
// rounding. Returns nothing if any of the points is outside the domain, or leaves it.
template <typename Field>
std::optional<typename Field::Point_3> move_to_mean_level(const Field& field, const typename Field::Point_3& p,
                                                          const typename Field::Point_3& a,
                                                          const typename Field::Point_3& b)
{
  const auto fa = field.value(a), fb = field.value(b);
  if(!fa || !fb) return std::nullopt;
  const double level = (*fa + *fb) / 2;
  constexpr int steps = 3; // steps of Newton's method; the field is nearly linear across the shell
  typename Field::Point_3 x = p;
  for(int n = 0; n < steps; ++n) {
    const typename Field::Cell_index c = field.locate(x);
    if(c == Field::npos) return std::nullopt;
    const auto jet = field.cell(c).first_order_jet(x);
    const std::array<double, 3> gradient = scaled_to_unit(jet.gradient);
    const double unit = reciprocal_power_of_two(jet.gradient), squared = dot(gradient, gradient);
    if(!(squared > 0)) return std::nullopt;
    const double s = unit * (level - jet.value) / squared;
    x = { x[0] + s * gradient[0], x[1] + s * gradient[1], x[2] + s * gradient[2] };
  }
  return x;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MOVE_TO_LEVEL_H
