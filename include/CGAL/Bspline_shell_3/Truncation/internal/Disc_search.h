// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_DISC_SEARCH_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_DISC_SEARCH_H

#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Tip.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Truncation_tuning.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/assemble_truncation.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Spherical_discs.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Finds the disc of largest margin for a tip. Candidates are triangulations of the polygon of cuts, fans around a
// point, and, if these have small margins, parts of a sphere. Discs that intersect themselves or the cut facets are
// rejected.
class Disc_search
{
  typedef Tip::Point_3 Point_3;
  typedef Tip::Vector_3 Vector_3;
  typedef std::array<std::size_t, 3> Triangle;
public:
  explicit Disc_search(const Tip& tip)
    : m_tip(tip), m_goal(truncation_tuning.good_share * (std::min)(tip.largest_margin(), truncation_tuning.good_margin))
  {}

  // Returns the best disc found, or nothing.
  std::optional<Tip_disc> operator()()
  {
    std::mt19937 random(1);
    std::vector<double> radii(m_tip.size(), m_tip.radius);
    const double least = truncation_tuning.least_distance;
    for(int n = 0; n < truncation_tuning.max_attempts && !is_good(); ++n) {
      if(n > 0)
        for(double& r : radii)
          r = m_tip.radius * (least + (1 - least) * double(random()) / double(std::mt19937::max()));
      search_triangulations(radii);
      if(!is_good()) search_apex(radii);
    }
    if(!m_best || m_best->margin < truncation_tuning.spherical_share * m_goal)
      for(const Tip_disc& disc : Spherical_discs(m_tip)()) offer(disc);
    return m_best;
  }

private:
  bool is_good() const { return m_best && m_best->margin >= m_goal; }
  double best_margin() const { return m_best ? m_best->margin : 0; }

  // Accepts a disc if it is better than the best one and embedded.
  void offer(Tip_disc disc)
  {
    disc.measure(m_tip, best_margin());
    if(disc.margin > best_margin() && is_embedded(disc)) m_best = std::move(disc);
  }

  Tip_disc empty_disc(const std::vector<double>& radii) const
  {
    Tip_disc disc;
    for(std::size_t i = 0; i < m_tip.size(); ++i)
      disc.rim.push_back(Tip_disc::rim_point(m_tip, i, radii[i] / m_tip.edge_length(i), 0));
    return disc;
  }

  // Tries triangulations without inner points: from several initial ones, flips diagonals while this increases the
  // margin.
  void search_triangulations(const std::vector<double>& radii)
  {
    Tip_disc disc = empty_disc(radii);
    const std::size_t k = disc.rim.size();
    const std::size_t most_fans = truncation_tuning.max_fans;
    std::vector<std::vector<Triangle> > begins;
    std::vector<Point_3> polygon;
    for(const auto& p : disc.rim) polygon.push_back(p.point);
    begins.push_back(triangulate_polygon(polygon));
    for(std::size_t first = 0; first < k; first += (k + most_fans - 1) / most_fans) {
      std::vector<Triangle> fan;
      for(std::size_t i = 1; i + 1 < k; ++i) fan.push_back({ first, (first + i) % k, (first + i + 1) % k });
      begins.push_back(std::move(fan));
    }
    for(const auto& triangles : begins) {
      disc.triangles = triangles;
      disc.measure(m_tip, -1);
      offer(disc);
      for(bool has_improved = true; has_improved;) {
        has_improved = false;
        Tip_disc best = disc;
        for(std::size_t a = 0; a < disc.triangles.size(); ++a)
          for(std::size_t b = a + 1; b < disc.triangles.size(); ++b) {
            Triangle s = disc.triangles[a], t = disc.triangles[b];
            if(!flip(s, t)) continue;
            Tip_disc flipped = disc;
            flipped.triangles[a] = s;
            flipped.triangles[b] = t;
            flipped.measure(m_tip, best.margin);
            if(!(flipped.margin > best.margin)) continue;
            offer(flipped);
            best = std::move(flipped);
            has_improved = true;
          }
        disc = std::move(best);
      }
    }
  }

  // If two triangles have a common edge, replaces it by the other diagonal and returns true.
  static bool flip(Triangle& s, Triangle& t)
  {
    for(int i = 0; i < 3; ++i)
      for(int j = 0; j < 3; ++j)
        if(s[i] == t[(j + 1) % 3] && s[(i + 1) % 3] == t[j]) {
          const std::size_t p = s[i], q = s[(i + 1) % 3], r = s[(i + 2) % 3], o = t[(j + 2) % 3];
          s = { p, o, r };
          t = { o, q, r };
          return true;
        }
    return false;
  }

  // Tries fans around a point in the ball, which is moved while this increases the margin.
  void search_apex(const std::vector<double>& radii)
  {
    Tip_disc disc = empty_disc(radii);
    const std::size_t k = disc.rim.size();
    for(std::size_t i = 0; i < k; ++i) disc.triangles.push_back({ i, (i + 1) % k, k });
    Vector_3 centroid = NULL_VECTOR, mean = NULL_VECTOR;
    for(const auto& p : disc.rim) centroid = centroid + (p.point - m_tip.center) / double(k);
    for(const Point_3& n : m_tip.normals) mean = mean + (n - CGAL::ORIGIN) / double(k);
    const double r = m_tip.radius, offset = truncation_tuning.apex_offset * r;
    for(const Vector_3& begin : { centroid, Vector_3(centroid + offset * mean), Vector_3(centroid - offset * mean) }) {
      Vector_3 at = begin;
      const auto measured = [&](const Vector_3& v) {
        disc.inner = { m_tip.center + v };
        disc.measure(m_tip, -1);
        return disc.margin;
      };
      double margin = measured(at);
      double step = truncation_tuning.first_apex_step * r;
      for(int n = 0; n < truncation_tuning.apex_steps; ++n, step /= 2)
        for(int a = 0; a < 3; ++a)
          for(double sign : { -1., 1. }) {
            const Vector_3 moved = at + sign * step * Vector_3(a == 0, a == 1, a == 2);
            if(!(moved.squared_length() < r * r)) continue;
            const double moved_margin = measured(moved);
            if(!(moved_margin > margin)) continue;
            margin = moved_margin;
            at = moved;
          }
      measured(at);
      offer(disc);
    }
  }

  // Tests the disc and the cut facets only, because all other facets are outside the ball.
  bool is_embedded(const Tip_disc& disc) const
  {
    Truncation_mesh star;
    Tip tip = m_tip;
    tip.vertex = star.add_vertex(m_tip.center);
    for(std::size_t i = 0; i < tip.size(); ++i) tip.link[i] = star.add_vertex(tip.ends[i]);
    for(std::size_t i = 0; i < tip.size(); ++i)
      tip.facets[i] = star.add_face(tip.vertex, tip.link[i], tip.link[(i + 1) % tip.size()]);
    const Shell_truncation_3 truncation = assemble_truncation(star, { tip }, { disc });
    if(!truncation.is_valid()) return false;
    const auto patches = find_patches(truncation, star, star.points());
    return !patches.empty() && replace_patches(truncation, patches, star, star.points())
           && !Polygon_mesh_processing::does_self_intersect<Sequential_tag>(star);
  }

  const Tip& m_tip;
  double m_goal;
  std::optional<Tip_disc> m_best;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_DISC_SEARCH_H
