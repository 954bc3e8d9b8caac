// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FACET_ESTIMATOR_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FACET_ESTIMATOR_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

enum class Facet_estimate
{
  CLEAR,        // in the shell and facing along the gradient, as estimated from samples
  LEAVES_SHELL, // leaves the shell at a sample
  FACES_AWAY,   // does not face along the gradient at a sample
  DOUBTFUL
};

// Estimates the result of Second_order_bounds_3 on a triangle, in a few tenths of its time. Values and gradients at the
// corners of a part define a cubic triangle, whose Bernstein coefficients bound the margins; slopes at corners and
// middles of edges define a quadratic triangle. The errors of these bounds are estimated from the deviation of the
// cubics at the middles, and from the bend of the slopes. If a part is larger than a few cells, the estimated errors
// are multiplied by its area. Parts are bisected until the bounds suffice.
template <typename Bounds>
class Facet_estimator
{
  typedef typename Bounds::Sample Sample;
  typedef std::array<double, 3> Coordinates;
public:
  // \param normal a normal of any length
  Facet_estimator(const Bounds& bounds, const Coordinates& normal) : m_bounds(bounds), m_normal(normal) {}

  typedef std::array<const Sample*, 3> Samples;

  // \param corners samples of the corners
  // \param middles samples of the middles of edges, by the index of the opposite corner; null where they are unknown
  Facet_estimate operator()(const Samples& corners, const Samples& middles = {})
  {
    for(const Sample* s : corners) {
      const Facet_estimate there = at(*s);
      if(there != Facet_estimate::CLEAR) return there;
    }
    m_bisections_left = most_bisections;
    return estimate(corners, middles);
  }

private:
  static constexpr int most_bisections = 512;
  // Extents in cells: few points suffice for a part up to the first extent, and are useless for a part beyond the
  // second.
  static constexpr double small_extent = 8, large_extent = 24;
  static constexpr double safety = 2;         // margins of small parts, relative to the error of the cubics
  static constexpr double slope_safety = 0.5; // slopes, relative to their bend

  struct Edge
  {
    const Sample &p, &q;
  };
  static Edge edge(const Samples& corners, std::size_t v) { return { *corners[(v + 1) % 3], *corners[(v + 2) % 3] }; }

  // Returns the estimate from one sample.
  Facet_estimate at(const Sample& s) const
  {
    if(s.cell == Bounds::no_cell || !(s.above > 0 && s.below > 0)) return Facet_estimate::LEAVES_SHELL;
    return Bounds::slope(s, m_normal) > 0 ? Facet_estimate::CLEAR : Facet_estimate::FACES_AWAY;
  }

  Facet_estimate estimate(const Samples& corners, const Samples& known)
  {
    double width = 0, longest = -1;
    std::size_t top = 0;
    std::array<Coordinates, 3> along;
    for(std::size_t v = 0; v < 3; ++v) {
      width = (std::max)(width, m_bounds.width(corners[v]->cell));
      const Edge e = edge(corners, v);
      double squared = 0;
      for(std::size_t a = 0; a < 3; ++a) {
        along[v][a] = e.q.point[a] - e.p.point[a];
        squared += along[v][a] * along[v][a];
      }
      if(squared > longest) {
        longest = squared;
        top = v;
      }
    }
    const double extent = longest / (width * width); // squared, in cells
    if(extent > large_extent * large_extent) {
      const Edge e = edge(corners, top);
      const Sample middle = known[top] ? *known[top] : m_bounds.sample_middle(e.p, e.q);
      const Facet_estimate there = at(middle);
      return there == Facet_estimate::CLEAR ? bisect(corners, top, middle, known) : there;
    }

    Samples middles = known;
    std::array<Sample, 3> sampled; // samples that were not known
    Coordinates slopes;
    for(std::size_t v = 0; v < 3; ++v) slopes[v] = Bounds::slope(*corners[v], m_normal);
    double least = std::numeric_limits<double>::infinity(), off = 0;
    double least_slope = least, bend = 0;
    // sums of the coefficients at corners, and of the coefficients on edges
    double above_at_corners = 0, below_at_corners = 0, above_on_edges = 0, below_on_edges = 0;
    for(std::size_t v = 0; v < 3; ++v) {
      const Edge e = edge(corners, v);
      if(!known[v]) {
        sampled[v] = m_bounds.sample_middle(e.p, e.q);
        middles[v] = &sampled[v];
      }
      const Sample& middle = *middles[v];
      const Facet_estimate there = at(middle);
      if(there != Facet_estimate::CLEAR) return there;
      // Thresholds vary little, so the margins increase and decrease with the field.
      const double rise_p = Bounds::slope(e.p, along[v]), rise_q = Bounds::slope(e.q, along[v]);
      const double above_p = e.p.above + rise_p / 3, above_q = e.q.above - rise_q / 3;
      const double below_p = e.p.below - rise_p / 3, below_q = e.q.below + rise_q / 3;
      least = (std::min)({ least, corners[v]->above, corners[v]->below, above_p, above_q, below_p, below_q });
      above_at_corners += corners[v]->above;
      below_at_corners += corners[v]->below;
      above_on_edges += above_p + above_q;
      below_on_edges += below_p + below_q;
      const double bulge = (rise_p - rise_q) / 8;
      off = (std::max)({ off, std::abs((e.p.above + e.q.above) / 2 + bulge - middle.above),
                         std::abs((e.p.below + e.q.below) / 2 - bulge - middle.below) });
      const double mean = (slopes[(v + 1) % 3] + slopes[(v + 2) % 3]) / 2, slope = Bounds::slope(middle, m_normal);
      least_slope = (std::min)({ least_slope, slopes[v], 2 * slope - mean });
      bend = (std::max)(bend, std::abs(slope - mean));
    }
    // The coefficient in the middle is chosen so that quadratic functions are reproduced.
    least = (std::min)({ least, above_on_edges / 4 - above_at_corners / 6, below_on_edges / 4 - below_at_corners / 6 });
    // The fewer samples per cell, the better they must agree.
    const double sparsity = (std::max)(1., extent / (small_extent * small_extent));
    if(least > sparsity * safety * off && least_slope > sparsity * slope_safety * bend) return Facet_estimate::CLEAR;
    return bisect(corners, top, *middles[top], middles);
  }

  // Bisects a part at the middle of the edge opposite to a corner.
  Facet_estimate bisect(const Samples& corners, std::size_t top, const Sample& middle, const Samples& known)
  {
    if(m_bisections_left == 0) return Facet_estimate::DOUBTFUL;
    --m_bisections_left;
    const Sample between = m_bounds.sample_middle(*corners[top], middle); // middle of the common edge of the two halves
    for(std::size_t end : { 1, 2 }) {
      const std::size_t replaced = (top + end) % 3, kept = (top + 3 - end) % 3;
      Samples half = corners, known_of_half = {};
      half[replaced] = &middle;
      known_of_half[replaced] = known[replaced];
      known_of_half[kept] = &between;
      const Facet_estimate found = estimate(half, known_of_half);
      if(found != Facet_estimate::CLEAR) return found;
    }
    return Facet_estimate::CLEAR;
  }

  const Bounds& m_bounds;
  Coordinates m_normal;
  int m_bisections_left = 0;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_FACET_ESTIMATOR_H
