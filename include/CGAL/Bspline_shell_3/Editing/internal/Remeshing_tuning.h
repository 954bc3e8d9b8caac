// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Tuned numbers of remeshing. The quality of a triangle is 1 if it is equilateral, and 0 without an area.
struct Remeshing_tuning
{
  // Lengths relative to the target above which edges are split, and below which they are collapsed: halves of the
  // former are not among the latter.
  double longest = 4. / 3, shortest = 4. / 5;
  // Largest ratio of new edges to the one that is split: without it, needles would be split for ever.
  double largest_new_edge = 0.9;
  // Quality that a flip towards regular valences, or a collapse, must leave, if it was better before.
  double regular_quality = 0.3;
  // Quality that a move must leave, if it was better before.
  double good_quality = 0.7;
  // Factor by which a flip must improve the quality, and the number of passes of such flips.
  double least_gain = 1.01;
  int max_flip_passes = 10;
  // Second eigenvalue of the tensor of normals from which a vertex is on a crease: 25 degrees between two equal facets.
  double crease = 0.05;
  // Least cosine between two facets whose edge may be flipped.
  double least_cosine = 0.9;
};

inline constexpr Remeshing_tuning remeshing_tuning = {};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_TUNING_H
