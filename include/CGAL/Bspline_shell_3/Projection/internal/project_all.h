// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_PROJECT_ALL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_PROJECT_ALL_H

#include <CGAL/Bspline_shell_3/Support/for_each_point.h>

#include <cstddef>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the images of points under a projection, in the same order.
template <typename ConcurrencyTag, typename Projection, typename PointRange, typename Visitor>
std::vector<typename Projection::Image> project_all(const Projection& projection, const PointRange& points,
                                                    Visitor& visitor)
{
  std::vector<typename Projection::Image> images(std::size_t(std::end(points) - std::begin(points)));
  for_each_point<ConcurrencyTag>(
    images.size(), [&](std::size_t n) -> decltype(auto) { return *(std::begin(points) + std::ptrdiff_t(n)); }, visitor,
    [&, hint = typename Projection::Hint()](std::size_t n, const auto& p) mutable { images[n] = projection(p, hint); });
  return images;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_PROJECT_ALL_H
