// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_TUNING_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Tuning parameters of traced curves. They affect time, and which points have no image; each image meets its tolerance
// or has a status with the reason.
struct Curve_tuning
{
  // Distance beyond a face of its cell at which a curve moves on to the next cell, in widths of the cell.
  double slack = 1e-6;
  // If a step is cut within this fraction of its length from its end, the new end is interpolated.
  double near_end = 0.03;
  // Number of steps that share the tolerance, and largest number of steps.
  double steps_per_curve = 10;
  int max_steps = 2000;
  // Shortest step, in widths of the cell.
  double shortest_step = 1e-12;
  // Gradient below which it is considered the cause of short steps, in ranges of f per width of the cell.
  double small_gradient = 1e-4;
  // Number of times that a curve is traced again with shorter steps.
  int max_repetitions = 3;
  // Factor on estimated errors, and fraction of the tolerance to aim at.
  double safety = 2, aim = 0.25;
  // Smallest tolerance of steps, as a fraction of the tolerance. For the default tolerance, it corresponds to the
  // rounding of coordinates.
  double least_step_tolerance = 1e-5;
  // Largest number of facets on the walk along the mesh, and the factor on its steps. Facets are then near the ends of
  // steps, where cutting steps is cheap.
  int max_moves = 64;
  double overshoot = 1.015;
  // Deviation of a curve from its tangent that the search by the tree allows for, as a fraction of its length.
  double bend = 0.1;
};

inline constexpr Curve_tuning curve_tuning = {};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_CURVE_TUNING_H
