// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_RECENT_SAMPLES_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_RECENT_SAMPLES_H

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A cache of the most recent samples of vertices. Consecutive facets of a mesh usually share vertices, and a look-up
// takes less time than a sample.
template <typename Bounds>
class Recent_samples
{
  typedef typename Bounds::Sample Sample;
public:
  explicit Recent_samples(const Bounds& bounds) : m_bounds(bounds) {}

  // \param p position of the vertex
  template <typename Point>
  Sample operator()(std::size_t vertex, const Point& p)
  {
    Slot& slot = m_slots[vertex % size];
    if(slot.vertex != vertex) {
      slot.sample = m_bounds.sample(p);
      slot.vertex = vertex;
    }
    return slot.sample;
  }

private:
  static constexpr std::size_t size = 128, none = std::size_t(-1);
  struct Slot
  {
    std::size_t vertex = none;
    Sample sample;
  };

  const Bounds& m_bounds;
  std::array<Slot, size> m_slots;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_RECENT_SAMPLES_H
