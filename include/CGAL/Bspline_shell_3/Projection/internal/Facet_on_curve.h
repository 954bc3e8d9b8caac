// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_FACET_ON_CURVE_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_FACET_ON_CURVE_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Curve_tuning.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Integral_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/visit_facets_passed.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Finds the facet that the integral curve through a point meets.
template <typename Shell>
class Facet_on_curve
{
public:
  typedef Projection_facets_3::Coordinates Coordinates;
  typedef Projection_facets_3::Index Index;

  typedef Curve_hit Hit;

  // pre: `shell` and `facets` outlive this object
  Facet_on_curve(const Shell& shell, const Projection_facets_3& facets, double tolerance)
    : m_shell(&shell), m_facets(&facets), m_tolerance(tolerance)
  {}

  // `near` is a facet where the search begins, or `npos`.
  Flow_status operator()(const Coordinates& start, Index near, Hit& hit) const;

private:
  typedef Integral_curve<Shell, Flow_velocity> Curve;

  Flow_status trace(const Coordinates& start, Index near, double step_tolerance, Hit& hit) const;

  // Returns the sine of the angle between the curve and the plane of a facet.
  double sine(const Curve& curve, Index facet) const
  {
    const Coordinates& normal = m_facets->normal(facet);
    return dot(normal, curve.derivative()) / (norm(normal) * curve.speed());
  }

  // Finds where the curve passes through the plane of the facet, by Newton's method on the last step. For a straight
  // curve, one iteration suffices. Returns false if this is not during the step; `s` is then an estimate.
  bool pass_plane(const Curve& curve, Index facet, double& s, Coordinates& x) const
  {
    const double speed = curve.speed(), rate = dot(m_facets->normal(facet), curve.derivative());
    const double precision = curve.crossing_precision(sine(curve, facet)) / speed;
    double first = curve.begin(), last = curve.value();
    if(first > last) std::swap(first, last);
    s = curve.value();
    x = curve.state();
    double ds = -m_facets->height(facet, x) / rate;
    for(int i = 0; i < 20; ++i) {
      s += ds;
      if(!(s >= first - precision && s <= last + precision)) return false;
      if(std::abs(ds) <= precision) {
        for(int a = 0; a < 3; ++a) x[a] += ds * curve.derivative()[a];
        return true;
      }
      x = curve.at((std::min)((std::max)(s, first), last));
      ds = -m_facets->height(facet, x) / rate;
    }
    return false;
  }

  // Walks over edges from a facet that the tangent meets to the facet that the curve meets. Fails if the walk is not
  // conclusive.
  bool walk(Curve& curve, Index facet, Hit& best) const
  {
    Index previous = Projection_facets_3::npos;
    for(int moves = 0; moves < curve_tuning.max_moves; ++moves) {
      Hit hit;
      hit.facet = facet;
      Coordinates x;
      while(true) {
        if(!(dot(m_facets->normal(facet), curve.derivative()) > 0)) return false;
        if(pass_plane(curve, facet, hit.value, x)) break;
        const double goal = curve.value() + curve_tuning.overshoot * (hit.value - curve.value());
        if(curve.step(goal) != Flow_status::SUCCESS && !pass_plane(curve, facet, hit.value, x)) return false;
      }
      const auto position = m_facets->position(facet, x);
      hit.outside = position.outside;
      if(hit.outside < best.outside) best = hit;
      if(hit.outside <= 0) return true;
      const Index next = m_facets->neighbor(facet, position.edge);
      if(next == Projection_facets_3::npos || next == previous) break;
      previous = facet;
      facet = next;
    }
    return best.facet != Projection_facets_3::npos;
  }

  // Ends the curve where it passes through the plane of the facet that was found. Returns whether this point is on the
  // facet and in the shell, up to the tolerance.
  bool settle(Curve& curve, Hit& hit) const
  {
    double goal = hit.value;
    constexpr int most_corrections = 50; // Newton's method takes fewer
    for(int corrections = 0; corrections < most_corrections;) {
      const double low = (std::min)(curve.begin(), curve.value()), high = (std::max)(curve.begin(), curve.value());
      if(goal >= low && goal <= high) curve.cut(goal);
      else if(curve.step(goal) != Flow_status::SUCCESS) return false;
      if(curve.value() != goal) continue;
      ++corrections;
      Coordinates x = curve.state();
      const double ds = -m_facets->height(hit.facet, x) / dot(m_facets->normal(hit.facet), curve.derivative());
      goal += ds;
      const double sine = this->sine(curve, hit.facet);
      if(!(sine > 0)) return false;
      if(!(std::abs(ds) * curve.speed() <= curve.crossing_precision(sine))) continue;
      for(int a = 0; a < 3; ++a) x[a] += ds * curve.derivative()[a];
      const auto position = m_facets->position(hit.facet, x);
      hit.value = goal;
      hit.barycentric = position.nearest;
      const Curve_error error = curve.error();
      hit.error = { error.at_end() / sine, error.at_start() };
      hit.is_beyond_border = position.outside > 0
                             && m_facets->neighbor(hit.facet, position.edge) == Projection_facets_3::npos;
      const Coordinates image = m_facets->point(hit.facet, position.nearest);
      const Coordinates off = { image[0] - x[0], image[1] - x[1], image[2] - x[2] };
      return dot(off, off) <= m_tolerance * m_tolerance && curve.is_within_thresholds(x, goal)
             && curve.drift(x, goal) * curve.speed() <= m_tolerance;
    }
    return false;
  }

  // Returns whether the start lies on a facet, and is thus its own image. On steep facets, rounding may move the
  // intersection of the curve and the plane out of the facet.
  bool find_facet_at(const Coordinates& start, Hit& best) const
  {
    Curve curve(*m_shell, m_tolerance);
    curve.start(start);
    const double margin = curve.crossing_precision(1); // the precision with which curves end at facets
    double least = margin;
    best = Hit();
    const Bbox_3 box(start[0] - margin, start[1] - margin, start[2] - margin, start[0] + margin, start[1] + margin,
                     start[2] + margin);
    m_facets->visit_facets(box, [&](Index facet) {
      if(!(dot(m_facets->normal(facet), curve.derivative()) > 0)) return;
      Hit hit;
      hit.facet = facet;
      hit.value = curve.value();
      hit.barycentric = m_facets->position(facet, start).nearest;
      const Coordinates image = m_facets->point(facet, hit.barycentric);
      hit.outside = std::hypot(image[0] - start[0], image[1] - start[1], image[2] - start[2]);
      if(!(hit.outside <= least)) return;
      least = hit.outside;
      best = hit;
    });
    return best.facet != Projection_facets_3::npos;
  }

  // Searches all facets near the whole curve through a point.
  Flow_status search(const Coordinates& start, double step_tolerance, Hit& best) const
  {
    if(find_facet_at(start, best)) return Flow_status::SUCCESS;
    best = Hit();
    bool wrong_way = false;
    Flow_status failure = Flow_status::LEAVES_SHELL;
    for(const double direction : { 1., -1. }) {
      Curve curve(*m_shell, m_tolerance, step_tolerance);
      curve.start(start);
      Flow_status status = Flow_status::SUCCESS;
      while(status == Flow_status::SUCCESS && best.outside > 0) {
        status = curve.step(direction * std::numeric_limits<double>::infinity());
        look_at_step(curve, best, wrong_way);
      }
      if(best.outside <= 0) break;
      if(status != Flow_status::LEAVES_SHELL) failure = status;
    }
    if(best.facet != Projection_facets_3::npos) {
      Curve curve(*m_shell, m_tolerance, step_tolerance);
      curve.start(start);
      const bool is_inside = best.outside <= 0;
      if(settle(curve, best)) return Flow_status::SUCCESS;
      // The image exists, but is not found with the required accuracy.
      if(is_inside) return Flow_status::TOLERANCE_NOT_MET;
    }
    return wrong_way ? Flow_status::WRONG_ORIENTATION : failure;
  }

  void look_at_step(const Curve& curve, Hit& best, bool& wrong_way) const
  {
    visit_facets_passed(curve, *m_facets, m_tolerance, [&](const Hit& hit) {
      if(!(hit.outside < best.outside)) return;
      if(dot(m_facets->normal(hit.facet), curve.derivative()) > 0) best = hit;
      else if(hit.outside <= m_tolerance) wrong_way = true;
    });
  }

  const Shell* m_shell;
  const Projection_facets_3* m_facets;
  double m_tolerance;
};

template <typename Shell>
Flow_status Facet_on_curve<Shell>::trace(const Coordinates& start, Index near, double step_tolerance, Hit& hit) const
{
  Curve curve(*m_shell, m_tolerance, step_tolerance);
  const Flow_status status = curve.start(start);
  if(status != Flow_status::SUCCESS) return status;
  // Finds the facet that the tangent meets by a walk over edges, or in the tree.
  const Coordinates x = curve.state(), tangent = curve.derivative();
  const double above = curve.room(true), below = curve.room(false),
               margin = curve_tuning.bend * (above - below) * curve.speed();
  if(near != Projection_facets_3::npos) {
    const Index facet = m_facets->facet_on_line_near(near, x, tangent, below, above);
    if(facet != Projection_facets_3::npos) {
      if(walk(curve, facet, hit) && settle(curve, hit)) return Flow_status::SUCCESS;
      hit = Hit();
      curve.start(start);
    }
  }
  const Index facet = m_facets->facet_on_line(x, tangent, below, above, margin);
  if(facet != Projection_facets_3::npos && walk(curve, facet, hit) && settle(curve, hit)) return Flow_status::SUCCESS;
  return search(start, step_tolerance, hit);
}

template <typename Shell>
Flow_status Facet_on_curve<Shell>::operator()(const Coordinates& start, Index near, Hit& hit) const
{
  return keep_tolerance(m_tolerance, hit,
                        [&](double step_tolerance, Hit& result) { return trace(start, near, step_tolerance, result); });
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template class Facet_on_curve<Bspline_shell_3<> >;
extern template class Facet_on_curve<Certified_bspline_shell_3>;
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_FACET_ON_CURVE_H
