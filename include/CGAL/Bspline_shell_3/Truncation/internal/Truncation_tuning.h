// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TRUNCATION_TUNING_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TRUNCATION_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Tuning parameters of truncation. Margins are cone margins (`vertex_cone_margin()`), and radii are those of the balls
// within which facets are cut.
struct Truncation_tuning
{
  // Smallest factor by which a disc must increase the margin. A smaller increase is not worth the cost.
  double least_gain = 2;
  // Largest radius, relative to the shortest edge at the vertex, so that balls at the ends of an edge are apart.
  double radius_per_edge = 1. / 3;
  // Largest radius, relative to the distance from other facets.
  double radius_per_gap = 1. / 2;
  // Smallest radius, relative to the largest coordinate: the directions of the disc's edges then have about five
  // correct digits.
  double least_radius = 1e-11;
  // Number of times that the radius is halved if the disc intersects other facets.
  int max_halvings = 8;

  // A disc with this margin leaves enough room (the margin at a right angle is 0.7).
  double good_margin = 0.35;
  // The search ends with this fraction of a good margin, or of the largest possible margin if that is smaller.
  double good_share = 0.8;
  // Parts of a sphere are tried if the margin is below this fraction of the goal.
  double spherical_share = 0.5;
  // Number of attempts with different distances of the cuts from the vertex: the radius in the first attempt, and then
  // random fractions of it, at least `least_distance`.
  int max_attempts = 40;
  double least_distance = 0.25;
  // Number of fans from which searches for triangulations begin.
  std::size_t max_fans = 12;
  // Offset of the inner point of a fan from the centroid of the cuts, relative to the radius.
  double apex_offset = 0.3;
  // Length of the first step of the inner point, relative to the radius, and number of steps, each half as long as the
  // previous one.
  double first_apex_step = 1. / 4;
  int apex_steps = 5;

  // Angular width of triangles on a sphere, in radians, and smallest distance of inner points from the rim, relative to
  // this width.
  double spherical_width = 0.3, least_rim_distance = 0.7;
  // Number of points on the sphere, multiplied by the square of the width; equilateral triangles would have 14.5.
  double points_on_sphere = 16;
};

inline constexpr Truncation_tuning truncation_tuning = {};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TRUNCATION_TUNING_H
