// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_SPHERICAL_DISCS_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_SPHERICAL_DISCS_H

#include <CGAL/Bspline_shell_3/Truncation/internal/Tip.h>
#include <CGAL/Bspline_shell_3/Truncation/internal/Truncation_tuning.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The sphere around the vertex of a tip, divided into two parts by the facets. Each part may replace the tip, because
// the facets meet the sphere at a right angle.
class Spherical_discs
{
  typedef Tip::Point_3 Point_3;
  typedef Tip::Vector_3 Vector_3;
  typedef Truncation_kernel::Point_2 Point_2;
public:
  explicit Spherical_discs(const Tip& tip) : m_tip(tip)
  {
    const double width = truncation_tuning.spherical_width;
    const std::size_t k = tip.size();
    for(std::size_t i = 0; i < k; ++i) {
      const double a = tip.edge_length(i), b = tip.edge_length((i + 1) % k);
      const Vector_3 d = (tip.ends[i] - tip.center) / a, e = (tip.ends[(i + 1) % k] - tip.center) / b;
      const double sine = std::sqrt(CGAL::cross_product(d, e).squared_length()),
                   angle = std::atan2(sine, CGAL::scalar_product(d, e));
      const int parts = int(std::ceil(angle / width));
      for(int j = 0; j < parts; ++j) {
        const double at = angle * j / parts;
        m_rim.push_back(j == 0 ? Tip_disc::rim_point(tip, i, tip.radius / a, 0)
                               : Tip_disc::rim_point(tip, i, tip.radius * std::sin(angle - at) / sine / a,
                                                     tip.radius * std::sin(at) / sine / b));
        m_directions.push_back((m_rim.back().point - tip.center) / tip.radius);
      }
    }
    // Points on a spiral on the sphere, about as dense as the rim.
    const int number = int(truncation_tuning.points_on_sphere / (width * width));
    for(int n = 0; n < number; ++n) {
      const double z = 1 - (2 * n + 1) / double(number), angle = CGAL_PI * (3 - std::sqrt(5.)) * n,
                   rho = std::sqrt(1 - z * z);
      m_samples.emplace_back(rho * std::cos(angle), rho * std::sin(angle), z);
    }
  }

  // Returns discs for one part of the sphere, both, or none.
  std::vector<Tip_disc> operator()() const
  {
    // In the projection from the sample farthest from the rim, samples inside the rim are beyond it, and the others on
    // the side of the pole.
    const std::optional<Vector_3> pole = farthest(m_samples);
    std::vector<Tip_disc> discs;
    if(!pole) return discs;
    const Polygon rim = seen_from(*pole, m_directions);
    if(!rim.is_simple()) return discs;
    std::vector<Vector_3> beyond, before;
    for(const Vector_3& s : m_samples) {
      if(s == *pole) before.push_back(s);
      else (rim.has_on_bounded_side(seen_from(*pole, { s })[0]) ? beyond : before).push_back(s);
    }
    for(const auto& sides : { std::make_pair(&beyond, &before), std::make_pair(&before, &beyond) })
      if(const auto from = farthest(*sides.second))
        if(auto disc = triangulated(*sides.first, *from)) discs.push_back(std::move(*disc));
    return discs;
  }

private:
  typedef CGAL::Polygon_2<Truncation_kernel> Polygon;

  double distance_from_rim(const Vector_3& p) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(const Vector_3& d : m_directions) least = (std::min)(least, (p - d).squared_length());
    return std::sqrt(least);
  }

  std::optional<Vector_3> farthest(const std::vector<Vector_3>& samples) const
  {
    std::optional<Vector_3> result;
    double largest = 0;
    for(const Vector_3& s : samples) {
      const double distance = distance_from_rim(s);
      if(!(distance > largest)) continue;
      largest = distance;
      result = s;
    }
    return result;
  }

  // Returns the stereographic projection from a pole, which preserves Delaunay triangulations.
  static Polygon seen_from(const Vector_3& pole, const std::vector<Vector_3>& points)
  {
    const int least = std::abs(pole.x()) < std::abs(pole.y()) ? (std::abs(pole.x()) < std::abs(pole.z()) ? 0 : 2)
                                                              : (std::abs(pole.y()) < std::abs(pole.z()) ? 1 : 2);
    Vector_3 u = CGAL::cross_product(pole, Vector_3(least == 0, least == 1, least == 2));
    u = u / std::sqrt(u.squared_length());
    const Vector_3 v = CGAL::cross_product(pole, u);
    Polygon seen;
    for(const Vector_3& p : points) {
      const double depth = 1 - CGAL::scalar_product(p, pole);
      seen.push_back(Point_2(CGAL::scalar_product(p, u) / depth, CGAL::scalar_product(p, v) / depth));
    }
    return seen;
  }

  std::optional<Tip_disc> triangulated(const std::vector<Vector_3>& samples, const Vector_3& pole) const
  {
    typedef CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Truncation_kernel> Vertex;
    typedef CGAL::Triangulation_data_structure_2<Vertex,
                                                 CGAL::Constrained_triangulation_face_base_2<Truncation_kernel> >
      Structure;
    typedef CGAL::Constrained_Delaunay_triangulation_2<Truncation_kernel, Structure> Triangulation;
    const Polygon rim = seen_from(pole, m_directions);
    if(!rim.is_simple()) return std::nullopt;
    Tip_disc disc;
    disc.rim = m_rim;
    Triangulation triangulation;
    std::vector<typename Triangulation::Vertex_handle> corners;
    for(std::size_t n = 0; n < rim.size(); ++n) {
      corners.push_back(triangulation.insert(rim[n]));
      corners.back()->info() = n;
    }
    if(triangulation.number_of_vertices() != rim.size()) return std::nullopt;
    for(std::size_t n = 0; n < rim.size(); ++n)
      triangulation.insert_constraint(corners[n], corners[(n + 1) % rim.size()]);
    for(const Vector_3& s : samples) {
      if(distance_from_rim(s) < truncation_tuning.least_rim_distance * truncation_tuning.spherical_width) continue;
      const Point_2 p = seen_from(pole, { s })[0];
      if(!rim.has_on_bounded_side(p)) continue;
      triangulation.insert(p)->info() = m_rim.size() + disc.inner.size();
      disc.inner.push_back(m_tip.center + m_tip.radius * s);
    }
    const bool is_turned = rim.is_clockwise_oriented();
    for(auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
      // Some triangles between points of the rim are outside.
      if(!rim.has_on_bounded_side(CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point())))
        continue;
      std::array<std::size_t, 3> t = { f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() };
      if(is_turned) std::swap(t[1], t[2]);
      disc.triangles.push_back(t);
    }
    return disc;
  }

  const Tip& m_tip;
  std::vector<Tip_disc::Rim_point> m_rim;
  std::vector<Vector_3> m_directions, m_samples;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_SPHERICAL_DISCS_H
