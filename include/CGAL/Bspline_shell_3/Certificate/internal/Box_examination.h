// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOX_EXAMINATION_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOX_EXAMINATION_H

#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/critical_values.h>
#include <CGAL/Bspline_shell_3/Spline/monotone_direction.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Examines a box with only the field and the thresholds on it: whether the box is excluded from the shell, or has no
// critical point in the shell, and how steep the field is.
template <typename Threshold>
class Box_examination
{
public:
  // The field and, unless the thresholds are constant, its differences from the two thresholds.
  typedef std::array<Enclosed_tricubic, Threshold::is_constant ? 1 : 3> Functions;

  Box_examination(const Threshold& inner, const Threshold& outer) : m_inner(inner), m_outer(outer) {}

  // Returns the functions on a leaf cell.
  template <typename Cell>
  Functions functions(const Cell& cell, std::uint32_t c) const
  {
    Functions functions;
    functions[0] = enclosed_value(cell);
    if constexpr(!Threshold::is_constant) {
      functions[1] = m_inner.difference(functions[0], c);
      functions[2] = m_outer.difference(functions[0], c);
    }
    return functions;
  }

  // Returns whether all of a box is proved to lie between the thresholds.
  bool are_between_thresholds(const Functions& functions) const
  {
    if constexpr(Threshold::is_constant) {
      const Level_range r = functions[0].range();
      return r.min >= m_inner.level() && r.max <= m_outer.level();
    } else return functions[1].range().min >= 0 && functions[2].range().max <= 0;
  }

  // Returns whether all of a face, an edge, or a vertex of a box is proved to be outside the shell.
  bool is_excluded_towards(const std::array<int, 3>& direction, const Functions& functions) const
  {
    if constexpr(Threshold::is_constant) {
      const Level_range r = functions[0].range_towards(direction);
      return r.max < m_inner.level() || r.min > m_outer.level();
    } else return functions[1].range_towards(direction).max < 0 || functions[2].range_towards(direction).min > 0;
  }

  // Determines the kind of a box, and its proof.
  void examine(const Functions& functions, Cover_box& box) const
  {
    bool meets_inner = false, meets_outer = false;
    if constexpr(Threshold::is_constant) {
      const Level_range r = functions[0].range();
      box.kind = r.max < m_inner.level() || r.min > m_outer.level() ? Box_kind::EXCLUDED : Box_kind::UNDECIDED;
    } else {
      const Level_range inner = functions[1].range(), outer = functions[2].range();
      box.kind = inner.max < 0 || outer.min > 0 ? Box_kind::EXCLUDED : Box_kind::UNDECIDED;
      meets_inner = inner.min <= 0;
      meets_outer = outer.max >= 0;
    }
    if(box.kind == Box_kind::EXCLUDED) return;
    // At a threshold, the difference between field and threshold must increase along curves. It suffices that the
    // threshold is less steep than the field.
    double steepest = 0;
    if constexpr(!Threshold::is_constant)
      for(int side = 1; side < 3; ++side)
        if(side == 1 ? meets_inner : meets_outer)
          steepest = (std::max)(steepest, steepest_threshold(functions[0], functions[side]));
    if(is_monotone(functions[0], steepest, box.proof)) {
      box.kind = Box_kind::MONOTONE;
      return;
    }
    const Critical_center center = critical_center(functions[0]);
    const Level_range thresholds = mean_thresholds(functions);
    if(!(center.value < thresholds.min || center.value > thresholds.max)) return;
    const Box_kind kind = center.value < thresholds.min ? Box_kind::CRITICAL_BELOW : Box_kind::CRITICAL_ABOVE;
    const double beyond = beyond_threshold(functions, kind, center.point);
    if(beyond > 0 && beyond > steepest * reach(center.point)) {
      box.kind = kind;
      box.proof = center.point;
    }
  }

  // Returns whether critical points in a box seem to be in the shell, and parts of the box would not give much better
  // bounds on their values.
  bool seems_critical(const Functions& functions) const
  {
    constexpr double near = 0.1, close = 0.2, level = 1. / 32;
    const Critical_center center = critical_center(functions[0]);
    const Level_range thresholds = mean_thresholds(functions);
    if(!(center.value >= thresholds.min && center.value <= thresholds.max && center.slope < level)) return false;
    if(std::any_of(center.point.begin(), center.point.end(), [](double x) { return x < -near || x > 1 + near; }))
      return false;
    const Level_range values = values_at_critical_points(functions[0], functions[0], center.point).range();
    return values.max - values.min < close * (std::max)(values.min, -values.max);
  }

  // Returns a lower bound on the length of the gradient in the shell, per unit of the box, for a box that is not
  // undecided. It bounds the derivative along the direction of the box or a better one, or toward the center of the
  // box.
  double gradient_bound(const Functions& functions, const Cover_box& box) const
  {
    const Enclosed_tricubic& f = functions[0];
    double bound = 0;
    const auto include = [&](const std::array<double, 3>& direction) {
      const double size = length_bound(direction);
      if(size > 0 && std::isfinite(size))
        bound = (std::max)(bound, enclosed_derivative(f, direction).range().min / size);
    };
    include(nearest_of_hull(control_vectors_of_gradient(f)));
    if(box.kind == Box_kind::MONOTONE) include(box.proof);
    else bound = (std::max)(bound, beyond_threshold(functions, box.kind, box.proof) / reach(box.proof));
    return bound;
  }

  // Returns the length of the gradient in the middle of a box, per unit of the box, or infinity if the middle is not in
  // the shell. Not rigorous.
  double gradient_in_the_middle(const Functions& functions) const
  {
    const auto middle = [](const Enclosed_tricubic& f) {
      const Weights<double> half = { 0.125, 0.375, 0.375, 0.125 };
      return contract(f.coefficients.data(), half, half, half);
    };
    if constexpr(Threshold::is_constant) {
      const double f = middle(functions[0]);
      if(f < m_inner.level() || f > m_outer.level()) return std::numeric_limits<double>::infinity();
    } else if(middle(functions[1]) < 0 || middle(functions[2]) > 0) return std::numeric_limits<double>::infinity();
    std::array<double, 3> slope;
    for(int a = 0; a < 3; ++a) {
      std::array<double, 3> axis = {};
      axis[a] = 1;
      slope[a] = middle(enclosed_derivative(functions[0], axis));
    }
    return std::hypot(slope[0], slope[1], slope[2]);
  }

private:
  // Returns a lower bound on the difference by which the field is beyond a threshold at all critical points in a box.
  double beyond_threshold(const Functions& functions, Box_kind kind, const std::array<double, 3>& center) const
  {
    const bool below = kind == Box_kind::CRITICAL_BELOW;
    const Level_range above = [&] {
      if constexpr(Threshold::is_constant)
        return values_at_critical_points((below ? m_inner : m_outer).difference(functions[0], 0), functions[0], center)
          .range();
      else return values_at_critical_points(functions[below ? 1 : 2], functions[0], center).range();
    }();
    return below ? -above.max : above.min;
  }

  // Returns an upper bound on half the distance of points of a box from a center, in units of the box.
  static double reach(const std::array<double, 3>& center)
  {
    std::array<double, 3> farthest;
    for(int a = 0; a < 3; ++a) farthest[a] = (std::max)(std::abs(center[a]), std::abs(1 - center[a])) / 2;
    return (1 + 4 * rounding) * length_bound(farthest);
  }

  // Returns the means of the thresholds on a box. Not rigorous.
  Level_range mean_thresholds(const Functions& functions) const
  {
    if constexpr(Threshold::is_constant) return { m_inner.level(), m_outer.level() };
    else {
      const auto mean = [](const Enclosed_tricubic& f) {
        return std::accumulate(f.coefficients.begin(), f.coefficients.end(), 0.) / 64;
      };
      const double f = mean(functions[0]);
      return { f - mean(functions[1]), f - mean(functions[2]) };
    }
  }

  // Returns an upper bound on the length of the gradient of the threshold f - (f - threshold).
  static double steepest_threshold(const Enclosed_tricubic& f, const Enclosed_tricubic& above)
  {
    const Enclosed_tricubic threshold = difference(f, above);
    std::array<double, 3> steepest;
    for(int a = 0; a < 3; ++a) {
      std::array<double, 3> axis = {};
      axis[a] = 1;
      const Level_range r = enclosed_derivative(threshold, axis).range();
      steepest[a] = (std::max)(std::abs(r.min), std::abs(r.max));
    }
    return length_bound(steepest);
  }

  Threshold m_inner, m_outer;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_BOX_EXAMINATION_H
