// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_POINT_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_POINT_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/morton_order.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Calls f(n, p) for all n < size, where p are the rounded coordinates of point(n). In between, the calling thread calls
// visitor.advance(done, size); if this returns false, the rest is skipped. Returns true if all points were processed.
// Points near each other are processed consecutively, because they use the same cached data: for a million random
// points on 52,000 facets, this makes the projection three times as fast. Each chunk has a copy of `f`, which may store
// its last point.
template <typename ConcurrencyTag, typename Visitor, typename PointOf, typename Function>
bool for_each_point(std::size_t size, const PointOf& point, Visitor& visitor, const Function& f)
{
  std::vector<std::array<double, 3> > points(size);
  for_each_chunk<ConcurrencyTag>(size, 1024, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const auto p = point(n);
      points[n] = rounded_coordinates(p);
    }
  });
  const Morton_order order = morton_order<ConcurrencyTag>(points);

  constexpr std::size_t block = 16384, chunk = 64;
  for(std::size_t first = 0; first < size; first += block) {
    const std::size_t last = (std::min)(size, first + block);
    for_each_chunk<ConcurrencyTag>(last - first, chunk, [&](std::size_t begin, std::size_t end) {
      Function of_chunk(f);
      for(std::size_t i = first + begin; i < first + end; ++i) of_chunk(order[i], points[order[i]]);
    });
    if(!visitor.advance(last, size) && last < size) return false;
  }
  return true;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_POINT_H
