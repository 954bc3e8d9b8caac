// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_OUTERMOST_FACET_ON_CURVE_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_OUTERMOST_FACET_ON_CURVE_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/visit_facets_passed.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Finds the facet that the integral curve through a point meets first, from the outer surface of the shell inward,
// whatever its orientation.
template <typename Shell>
class Outermost_facet_on_curve
{
public:
  typedef Projection_facets_3::Coordinates Coordinates;

  // pre: `shell` and `facets` outlive this object
  Outermost_facet_on_curve(const Shell& shell, const Projection_facets_3& facets, double tolerance)
    : m_shell(&shell), m_facets(&facets), m_tolerance(tolerance)
  {}

  // Returns `LEAVES_SHELL` if there is no such facet; `innermost` is then the point where the curve leaves the shell
  // through the inner surface.
  Flow_status operator()(const Coordinates& start, Curve_hit& hit, Coordinates& innermost) const
  {
    const bool inwards[2] = { false, true };
    for(const bool is_inwards : inwards) {
      Integral_curve<Shell, Flow_velocity> curve(*m_shell, m_tolerance);
      Flow_status status = curve.start(start);
      if(status != Flow_status::SUCCESS) return status;
      const double infinity = std::numeric_limits<double>::infinity();
      while(status == Flow_status::SUCCESS && (!is_inwards || hit.facet == Projection_facets_3::npos)) {
        status = curve.step(is_inwards ? -infinity : infinity);
        visit_facets_passed(curve, *m_facets, m_tolerance, [&](const Curve_hit& other) {
          if(is_before(other, hit)) hit = other;
        });
      }
      if(status != Flow_status::SUCCESS && status != Flow_status::LEAVES_SHELL) return status;
      if(hit.facet != Projection_facets_3::npos) return Flow_status::SUCCESS;
      if(is_inwards) innermost = end_in_shell(curve);
    }
    return Flow_status::LEAVES_SHELL;
  }

private:
  // Returns the last point of the last step that is between the thresholds.
  template <typename Curve>
  static Coordinates end_in_shell(const Curve& curve)
  {
    double inside = curve.begin(), outside = curve.value();
    constexpr int bisections = 30;
    for(int i = 0; i < bisections; ++i) {
      const double middle = (inside + outside) / 2;
      (curve.is_within_thresholds(curve.at(middle), middle) ? inside : outside) = middle;
    }
    return curve.at(inside);
  }

  // Of two facets that are met at the same value, the one with the smaller index comes first.
  bool is_before(const Curve_hit& hit, const Curve_hit& best) const
  {
    if(best.facet == Projection_facets_3::npos) return true;
    return hit.value > best.value || (hit.value == best.value && hit.facet < best.facet);
  }

  const Shell* m_shell;
  const Projection_facets_3* m_facets;
  double m_tolerance;
};

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template class Outermost_facet_on_curve<Certified_bspline_shell_3>;
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_OUTERMOST_FACET_ON_CURVE_H
