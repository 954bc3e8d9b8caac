// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SLOPE_TUNING_H
#define CGAL_BSPLINE_SHELL_3_FIT_SLOPE_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Fit
/// \brief tuning parameters of `Slope_enforcement`. They affect time, and which conditions can be met; no proof
/// depends on them.
struct Slope_tuning
{
  /// Number of sweeps over all violated cells.
  int max_sweeps = 3;
  /// Largest fraction of the violated cells that a sweep may leave, unless it leaves at most `few_violated_cells`. If
  /// it leaves more, the problem is not local.
  double violated_cells_left = 0.7;
  std::size_t few_violated_cells = 64;
  /// Number of patches among which independent ones are searched for. It affects time only.
  std::size_t max_waiting_patches = 64;
  /// Largest number of unknowns in a patch: its dense matrix is factorized.
  std::size_t max_unknowns = 500;
  /// Number of times that violated conditions are added to those of a patch, its largest number of conditions, and the
  /// largest number of conditions that are added at once.
  int max_exchanges = 8;
  std::size_t max_rows = 160, max_new_rows = 32;
  /// If a patch leaves more than this fraction of its worst violation, it is not tried again.
  double violation_left = 0.5;
  /// Largest multiplier of a condition. With the weights of the energy, multipliers are typically about ten; if
  /// conditions contradict each other, they grow without bound.
  double largest_multiplier = 100;
  /// Fraction by which solutions aim beyond the required values, because they are not exact.
  double excess = 0.05;
  /// Number of sweeps over the multipliers, and the change of slopes at which they end.
  int max_dual_sweeps = 100;
  double dual_tolerance = 1e-4;
};

inline constexpr Slope_tuning slope_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SLOPE_TUNING_H
