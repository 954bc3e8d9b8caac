// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_VISIT_FACETS_PASSED_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_VISIT_FACETS_PASSED_H

#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_error.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Bbox_3.h>

#include <cmath>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A point where a curve meets a facet.
struct Curve_hit
{
  Projection_facets_3::Index facet = Projection_facets_3::npos;
  double value = 0; // value of the field
  Projection_facets_3::Coordinates barycentric = {};
  double outside = std::numeric_limits<double>::infinity(); // distance from the facet
  bool is_beyond_border = false;                            // by less than the tolerance
  Image_error error;
};

inline constexpr double search_tolerance = 100; // factor on the tolerance: points within steps are less accurate

// Calls `visit(hit)` for the facets that the curve passes through between the thresholds during its last step, whatever
// their orientation. At edges, `search_tolerance` applies. A facet whose plane the curve crosses twice in one step may
// be missed.
template <typename Curve, typename Visitor>
void visit_facets_passed(const Curve& curve, const Projection_facets_3& facets, double tolerance, const Visitor& visit)
{
  typedef Projection_facets_3::Coordinates Coordinates;
  const double first = curve.begin(), last = curve.value();
  const Coordinates x0 = curve.at(first), x1 = curve.at(last);
  Bbox_3 box(x0[0], x0[1], x0[2], x0[0], x0[1], x0[2]);
  constexpr int parts = 4;
  for(int i = 1; i <= parts; ++i) {
    const Coordinates x = curve.at(first + (last - first) * i / parts);
    box += Bbox_3(x[0], x[1], x[2], x[0], x[1], x[2]);
  }
  const double margin = tolerance + std::abs(last - first) * curve.speed() / 4;
  box = Bbox_3(box.xmin() - margin, box.ymin() - margin, box.zmin() - margin, box.xmax() + margin, box.ymax() + margin,
               box.zmax() + margin);
  facets.visit_facets(box, [&](Projection_facets_3::Index facet) {
    const double near = tolerance * norm(facets.normal(facet));
    if(!(near > 0)) return; // no area
    double s0 = first, s1 = last, h0 = facets.height(facet, x0), h1 = facets.height(facet, x1);
    if((h0 < 0) == (h1 < 0) && std::abs(h0) > near && std::abs(h1) > near) return;
    Curve_hit hit;
    hit.facet = facet;
    hit.value = std::abs(h0) <= std::abs(h1) ? s0 : s1;
    Coordinates x = std::abs(h0) <= std::abs(h1) ? x0 : x1;
    if((h0 < 0) != (h1 < 0))
      for(int i = 0; i < 100 && s1 != s0; ++i) { // regula falsi, Illinois variant
        hit.value = s1 - h1 * (s1 - s0) / (h1 - h0);
        x = curve.at(hit.value);
        const double h = facets.height(facet, x);
        if(std::abs(h) * tolerance <= curve.crossing_precision(1) * near) break;
        if((h < 0) == (h1 < 0)) h0 /= 2;
        else {
          s0 = s1;
          h0 = h1;
        }
        s1 = hit.value;
        h1 = h;
      }
    const auto position = facets.position(facet, x);
    hit.barycentric = position.nearest;
    hit.outside = position.outside;
    if(hit.outside <= search_tolerance * tolerance && curve.is_within_thresholds(x, hit.value)) visit(hit);
  });
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_VISIT_FACETS_PASSED_H
