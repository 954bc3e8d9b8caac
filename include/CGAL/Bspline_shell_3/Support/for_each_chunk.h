// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_CHUNK_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_CHUNK_H

#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/FPU.h>
#include <CGAL/for_each.h>
#include <CGAL/tags.h>

#include <boost/range/irange.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the size of chunks, at most `most`. If there are few items, chunks are smaller, so that there are at least
// about 64 of them. This suits items that are cheap if there are many and may be expensive if there are few, such as
// facets of a mesh.
inline std::size_t chunk_size(std::size_t size, std::size_t most)
{
  constexpr std::size_t few = 64;
  return (std::max)(std::size_t(1), (std::min)(most, size / few));
}

// Calls f(begin, end) for consecutive chunks of [0, size). The chunks depend only on `size` and `chunk`, so results per
// chunk do not depend on the number of threads. Throws `Run::Ended` if the run of this thread ends first.
template <typename ConcurrencyTag, typename Function>
void for_each_chunk(std::size_t size, std::size_t chunk, const Function& f)
{
  const std::size_t chunks = (size + chunk - 1) / chunk;
  Run* const run = Run::current();
  CGAL::for_each<ConcurrencyTag>(boost::irange<std::size_t>(0, chunks), [&](const std::size_t& c) {
    const Run::Scope scope(run);
    Run::poll();
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // each thread has its own rounding mode
    f(c * chunk, (std::min)(size, (c + 1) * chunk));
    return true;
  });
}

// Calls f(begin, end, found) for each chunk; f appends any number of results to `found`. Returns all results in the
// order of the chunks.
template <typename ConcurrencyTag, typename T, typename Function>
std::vector<T> collect_from_chunks(std::size_t size, std::size_t chunk, const Function& f)
{
  std::vector<std::vector<T> > found((size + chunk - 1) / chunk);
  for_each_chunk<ConcurrencyTag>(size, chunk,
                                 [&](std::size_t begin, std::size_t end) { f(begin, end, found[begin / chunk]); });
  std::size_t total = 0;
  for(const std::vector<T>& part : found) total += part.size();
  std::vector<T> all;
  all.reserve(total);
  for(std::vector<T>& part : found) {
    all.insert(all.end(), part.begin(), part.end());
    std::vector<T>().swap(part);
  }
  return all;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_FOR_EACH_CHUNK_H
