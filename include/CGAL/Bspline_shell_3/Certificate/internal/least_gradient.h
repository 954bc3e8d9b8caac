// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_LEAST_GRADIENT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_LEAST_GRADIENT_H

#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns bound(part) for the boxes of a cover, and infinity for boxes that are not part of it.
template <typename ConcurrencyTag, typename Subdivision, typename Bound>
std::vector<double> bounds_on_boxes(const Subdivision& subdivision, const std::vector<Cover_box>& boxes,
                                    const Bound& bound)
{
  constexpr std::size_t chunk = 256;
  std::vector<double> bounds(boxes.size(), std::numeric_limits<double>::infinity());
  for_each_chunk<ConcurrencyTag>(boxes.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n)
      if(boxes[n].component != Cover_box::no_component) bounds[n] = bound(subdivision.part(boxes[n]));
  });
  return bounds;
}

constexpr bool can_be_halved(const Cover_box& box)
{
  return box.depth < std::numeric_limits<std::uint16_t>::digits;
}

// Returns a lower bound, per user unit, of the length of the gradient in the shell, on the boxes of a cover. Boxes with
// the least bounds are subdivided, until their bounds are near the gradient in the middles of boxes, or up to a limit.
// pre: no box is undecided
template <typename ConcurrencyTag, typename Subdivision>
double least_gradient(const Subdivision& subdivision, const std::vector<Cover_box>& boxes)
{
  constexpr std::size_t max_subdivisions = 2000, at_once = 16; // numbers of boxes
  constexpr double near = 0.7;                                 // ratio of the bound to the gradient
  struct Bounded_box
  {
    double bound, in_the_middle;
    Cover_box box;
    bool operator<(const Bounded_box& other) const { return bound > other.bound; } // the least bound first
  };
  const std::vector<double> bounds = bounds_on_boxes<ConcurrencyTag>(
    subdivision, boxes, [&](const auto& part) { return subdivision.gradient_bound(part); });
  std::vector<Bounded_box> bounded;
  for(std::size_t n = 0; n < boxes.size(); ++n)
    if(bounds[n] < std::numeric_limits<double>::infinity()) bounded.push_back({ bounds[n], 0, boxes[n] });
  if(bounded.empty()) return std::numeric_limits<double>::infinity();
  std::priority_queue<Bounded_box> least({}, std::move(bounded));
  double attained = subdivision.gradient_in_the_middle(subdivision.part(least.top().box));
  std::vector<Bounded_box> worst;
  for(std::size_t subdivisions = 0; subdivisions < max_subdivisions; subdivisions += worst.size()) {
    worst.clear();
    while(worst.size() < at_once && !least.empty() && least.top().bound < near * attained
          && can_be_halved(least.top().box)) {
      worst.push_back(least.top());
      least.pop();
    }
    if(worst.empty()) break;
    const std::vector<Bounded_box> parts = collect_from_chunks<ConcurrencyTag, Bounded_box>(
      worst.size(), 1, [&](std::size_t w, std::size_t, std::vector<Bounded_box>& found) {
        for(const auto& part : subdivision.octants(subdivision.part(worst[w].box)))
          if(part.box.kind != Box_kind::EXCLUDED)
            // The bound for a part may be weaker than the bound for its box.
            found.push_back({ (std::max)(worst[w].bound, subdivision.gradient_bound(part)),
                              subdivision.gradient_in_the_middle(part), part.box });
      });
    for(const Bounded_box& part : parts) {
      attained = (std::min)(attained, part.in_the_middle);
      least.push(part);
    }
  }
  return least.empty() ? std::numeric_limits<double>::infinity() : least.top().bound;
}

// Returns a closer lower bound on a part: if the bound is far from the gradient in the middle, the part is subdivided.
template <typename Subdivision>
double close_gradient_bound(const Subdivision& subdivision, const typename Subdivision::Part& part, int subdivisions)
{
  constexpr int max_subdivisions = 3;
  constexpr double near = 0.6; // ratio of the bound to the gradient
  const double bound = subdivision.gradient_bound(part);
  if(bound >= near * subdivision.gradient_in_the_middle(part) || subdivisions == max_subdivisions
     || !can_be_halved(part.box))
    return bound;
  double least = std::numeric_limits<double>::infinity();
  for(const auto& octant : subdivision.octants(part))
    if(octant.box.kind != Box_kind::EXCLUDED)
      least = (std::min)(least, close_gradient_bound(subdivision, octant, subdivisions + 1));
  return (std::max)(bound, least);
}

// Returns such bounds for each of a number of leaf cells, on the boxes of a cover in the cell; infinite if there are
// none. Bounds are coarser than `least_gradient()`.
// pre: no box is undecided
template <typename ConcurrencyTag, typename Subdivision>
std::vector<double> least_gradients(const Subdivision& subdivision, const std::vector<Cover_box>& boxes,
                                    std::size_t number_of_cells)
{
  const std::vector<double> on_boxes = bounds_on_boxes<ConcurrencyTag>(
    subdivision, boxes, [&](const auto& part) { return close_gradient_bound(subdivision, part, 0); });
  std::vector<double> bounds(number_of_cells, std::numeric_limits<double>::infinity());
  for(std::size_t n = 0; n < boxes.size(); ++n) bounds[boxes[n].cell] = (std::min)(bounds[boxes[n].cell], on_boxes[n]);
  return bounds;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_LEAST_GRADIENT_H
