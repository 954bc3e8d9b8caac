// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_COUNT_REMOVED_BORDER_POINTS_H
#define CGAL_BSPLINE_SHELL_3_MESH_COUNT_REMOVED_BORDER_POINTS_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether points are within a distance of a segment; `true` is proved.
// pre: rounding is to nearest
inline bool are_near_segment(const std::vector<std::array<double, 3> >& points, const std::array<double, 3>& source,
                             const std::array<double, 3>& target, double distance)
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
  // The exact square is not smaller.
  const double squared = std::nextafter(distance * distance, 0.);
  const auto point = [](const std::array<double, 3>& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  const Kernel::Segment_3 segment(point(source), point(target));
  return std::all_of(points.begin(), points.end(), [&](const std::array<double, 3>& p) {
    return Kernel().compare_squared_distance_3_object()(point(p), segment, squared) != LARGER;
  });
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the number of border points that a simplified border lacks, if it is proved to be within a distance of
 * the original border.
 *
 * The points of the simplified border must be points of the original border, bit for bit, in the same order on the same
 * closed curves. Every point that is missing between two of them must be within the distance of the segment that
 * connects them. Then every point of each border is within the distance of the other border. The test is exact, except
 * that the square of the distance is rounded down.
 *
 * \param closing triangles with the original border
 * \param simplified triangles with the simplified border
 * \param distance a length in the units of the coordinates; at least 0
 * \return nothing if the borders differ in another way, or if one of the closings is not valid
 * \cgalHeading{Cost} Linear in the sizes of the closings.
 */
inline std::optional<std::size_t> count_removed_border_points(const Shell_closing_3& closing,
                                                              const Shell_closing_3& simplified, double distance)
{
  typedef Shell_closing_3::Index Index;
  if(!closing.is_valid() || !simplified.is_valid()) return std::nullopt;
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  const std::vector<Index> next = closing.next_border_points(), next_kept = simplified.next_border_points();
  std::vector<char> is_kept(next.size(), 0);
  const auto original = [&](Index kept) { return closing.border_point(simplified.points()[kept]); };
  for(Index kept = 0; kept < next_kept.size(); ++kept) {
    if(original(kept) == Shell_closing_3::npos) return std::nullopt;
    is_kept[original(kept)] = 1;
  }
  std::size_t removed = 0;
  for(Index kept = 0; kept < next_kept.size(); ++kept) {
    const Index first = original(kept);
    std::vector<Shell_closing_3::Point> between;
    Index last = next[first];
    for(; !is_kept[last]; last = next[last]) between.push_back(closing.points()[last]);
    if(last != original(next_kept[kept])) return std::nullopt;
    if(!internal::are_near_segment(between, closing.points()[first], closing.points()[last], distance))
      return std::nullopt;
    removed += between.size();
  }
  // The border may consist of several closed curves, none of which may be missing.
  if(next_kept.size() + removed != next.size()) return std::nullopt;
  return removed;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_COUNT_REMOVED_BORDER_POINTS_H
