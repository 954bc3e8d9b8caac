// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_INTERNAL_FOR_EACH_WITH_PROGRESS_H
#define CGAL_BSPLINE_SHELL_3_INTERNAL_FOR_EACH_WITH_PROGRESS_H

#include <CGAL/Bspline_shell_3/internal/for_each_chunk.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Calls f(n) for all n < size, and in between, from the calling thread, visitor.advance(done, size). Stops if that is false: tells
// whether all was done.
template <typename ConcurrencyTag, typename Visitor, typename Function>
bool for_each_with_progress(std::size_t size, Visitor& visitor, const Function& f)
{
  constexpr std::size_t block = 16384, chunk = 64;
  for(std::size_t first = 0; first < size; first += block) {
    const std::size_t last = (std::min)(size, first + block);
    for_each_chunk<ConcurrencyTag>(last - first, chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = first + begin; n < first + end; ++n) f(n);
    });
    if(!visitor.advance(last, size) && last < size) return false;
  }
  return true;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_INTERNAL_FOR_EACH_WITH_PROGRESS_H
