// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H

#include <array>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Tuning parameters of remeshing. The quality of a triangle is 1 if it is equilateral, and 0 if it has no area.
struct Remeshing_tuning
{
  // Lengths relative to the target above which edges are split, and below which they are collapsed.
  double longest = 4. / 3, shortest = 4. / 5;
  // Largest ratio of the length of new edges to that of the split edge: without it, needles would be split forever.
  double largest_new_edge = 0.9;
  // Quality that must remain after a flip toward regular valences, or after a collapse, unless it was lower before.
  double regular_quality = 0.3;
  // Quality that must remain after a move, unless it was lower before.
  double good_quality = 0.7;
  // Fractions of a move that are tried, in this order.
  std::array<double, 3> parts_of_moves = { { 1, 0.5, 0.25 } };
  // Factor by which a flip must improve the quality, and the number of passes of such flips.
  double least_gain = 1.01;
  int max_flip_passes = 10;
  // Second eigenvalue of the tensor of normals above which a vertex is on a crease: 25 degrees between two equal
  // facets.
  double crease = 0.05;
  // Smallest cosine of the angle between the normals of two facets whose common edge may be flipped.
  double least_cosine = 0.9;
};

inline constexpr Remeshing_tuning remeshing_tuning = {};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H
