// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H

#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/assertions.h>

#include <cmath>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef std::array<Exact_rational, 3> Exact_coordinates;

inline Exact_coordinates exact_difference(const std::array<double, 3>& p, const std::array<double, 3>& q)
{
  typedef Exact_rational ET;
  return { ET(p[0]) - ET(q[0]), ET(p[1]) - ET(q[1]), ET(p[2]) - ET(q[2]) };
}

} // namespace internal

class Projection_facets_3::Tree
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef internal::AABB_traits_3<Kernel, internal::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator> > Traits;

public:
  // with a margin around it
  class Segment
  {
  public:
    Segment(const Coordinates& p, const Coordinates& direction, double first, double last, double margin)
      : m_first(first), m_last(last), m_margin(margin), m_point(p)
    {
      for(int a = 0; a < 3; ++a) m_inverse[a] = 1 / direction[a];
    }

    // by the slabs of the box; where the direction has no component along an axis, by comparisons with infinities
    bool may_meet(const Bbox_3& box) const
    {
      double first = m_first, last = m_last;
      for(int a = 0; a < 3; ++a) {
        const double low = ((box.min)(a) - m_margin - m_point[a]) * m_inverse[a], high = ((box.max)(a) + m_margin - m_point[a]) * m_inverse[a];
        first = (std::max)(first, (std::min)(low, high));
        last = (std::min)(last, (std::max)(low, high));
      }
      return !(first > last);
    }

  private:
    double m_first, m_last, m_margin;
    Coordinates m_point, m_inverse;
  };

  explicit Tree(const std::vector<Facet>& facets)
  {
    const auto point = [](const Coordinates& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    for(const Facet& f : facets) m_triangles.emplace_back(point(f.vertex[0]), point(f.vertex[1]), point(f.vertex[2]));
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
  }

  template <typename Query, typename Visitor>
  void visit(const Query& query, const Visitor& visit) const
  {
    Visiting_traits<Visitor> traits{ visit, m_triangles.cbegin() };
    m_tree.traversal(query, traits);
  }

  Index closest(const Coordinates& p) const
  {
    return Index(m_tree.closest_point_and_primitive(Kernel::Point_3(p[0], p[1], p[2])).second - m_triangles.cbegin());
  }

private:
  template <typename Visitor>
  struct Visiting_traits
  {
    const Visitor& visit;
    Triangles::const_iterator first;

    bool go_further() const { return true; }
    template <typename Query>
    void intersection(const Query&, const typename Traits::Primitive& primitive) { visit(Index(primitive.id() - first)); }
    template <typename Node>
    bool do_intersect(const Bbox_3& box, const Node& node) const { return do_overlap(box, node.bbox()); }
    template <typename Node>
    bool do_intersect(const Segment& segment, const Node& node) const { return segment.may_meet(node.bbox()); }
  };

  Triangles m_triangles;
  AABB_tree<Traits> m_tree;
};

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Projection_facets_3(std::vector<Facet> facets)
  : m_facets(std::move(facets))
{
  for(Facet& f : m_facets) f.normal = normal(f.vertex[0], f.vertex[1], f.vertex[2]);
  if(!m_facets.empty()) m_tree = std::make_shared<const Tree>(m_facets);
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<Projection_facets_3::Index> Projection_facets_3::components(std::size_t& number) const
{
  number = 0;
  std::vector<Index> component(m_facets.size(), npos), stack;
  for(Index first = 0; first < m_facets.size(); ++first) {
    if(component[first] != npos) continue;
    component[first] = Index(number);
    stack.push_back(first);
    while(!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for(Index n : m_facets[f].neighbor)
        if(n != npos && component[n] == npos) {
          component[n] = Index(number);
          stack.push_back(n);
        }
    }
    ++number;
  }
  return component;
}

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Position Projection_facets_3::position(Index facet, const Coordinates& p) const
{
  using internal::cross;
  using internal::dot;
  const Facet& f = m_facets[facet];
  CGAL_precondition(has_area(facet));
  const double squared = dot(f.normal, f.normal);
  Position result{ {}, -std::numeric_limits<double>::infinity(), 0, {} };
  Coordinates e[3];
  double lengths[3], longest = 0;         // squared
  for(int i = 0; i < 3; ++i) {
    e[i] = difference(f.vertex[(i + 1) % 3], f.vertex[i]);
    lengths[i] = dot(e[i], e[i]);
    longest = (std::max)(longest, lengths[i]);
  }
  Coordinates& w = result.barycentric;
  // Rounding moves a point by eps / thinness of its distance from the facet's vertex, and after a second step by the square of that
  constexpr double thin = 1e-6;
  if(squared > thin * thin * longest * longest) {
    const Coordinates inwards[2] = { cross(f.normal, e[2]), cross(f.normal, e[0]) }, d = difference(p, f.vertex[0]);
    w[1] = dot(inwards[0], d) / squared;
    w[2] = dot(inwards[1], d) / squared;
    Coordinates rest;
    for(int a = 0; a < 3; ++a) rest[a] = d[a] - w[1] * e[0][a] + w[2] * e[2][a];
    w[1] += dot(inwards[0], rest) / squared;
    w[2] += dot(inwards[1], rest) / squared;
    w[0] = 1 - w[1] - w[2];
  }
  else w = exact_barycentric(f, p);
  // compared by their squares, with a sign
  for(int i = 0; i < 3; ++i) {
    const double weight = w[(i + 2) % 3], outside = -weight * std::abs(weight) / lengths[i];
    if(outside > result.outside) { result.outside = outside; result.edge = i; }
  }
  result.outside = std::copysign(std::sqrt(std::abs(result.outside) * squared), result.outside);
  result.nearest = result.barycentric;
  if(!(result.outside > 0)) return result;
  // where two edges meet at a small angle, a point far from both may be next to their lines
  result.outside = nearest_on_edges(f, p, result.nearest);
  return result;
}

// the distance from the edges, and the barycentric coordinates of where it is taken
CGAL_BSPLINE_SHELL_3_INLINE double Projection_facets_3::nearest_on_edges(const Facet& f, const Coordinates& p, Coordinates& barycentric)
{
  using internal::dot;
  double least = std::numeric_limits<double>::infinity();
  for(int i = 0; i < 3; ++i) {
    const Coordinates e = difference(f.vertex[(i + 1) % 3], f.vertex[i]), v = difference(p, f.vertex[i]);
    const double length = dot(e, e), t = length > 0 ? (std::min)((std::max)(dot(v, e) / length, 0.), 1.) : 0.;
    const Coordinates off = { v[0] - t*e[0], v[1] - t*e[1], v[2] - t*e[2] };
    if(!(dot(off, off) < least)) continue;
    least = dot(off, off);
    barycentric[i] = 1 - t;
    barycentric[(i + 1) % 3] = t;
    barycentric[(i + 2) % 3] = 0;
  }
  return std::sqrt(least);
}

CGAL_BSPLINE_SHELL_3_INLINE std::pair<Projection_facets_3::Index, Projection_facets_3::Coordinates>
Projection_facets_3::closest(const Coordinates& p) const
{
  CGAL_precondition(m_tree != nullptr);
  const Index facet = m_tree->closest(p);
  if(has_area(facet)) return { facet, position(facet, p).nearest };
  Coordinates barycentric;
  nearest_on_edges(m_facets[facet], p, barycentric);
  return { facet, barycentric };
}

CGAL_BSPLINE_SHELL_3_INLINE void
Projection_facets_3::visit_facets(const Bbox_3& box, void (*visit)(const void*, Index), const void* visitor) const
{
  if(m_tree) m_tree->visit(box, [&](Index facet) { visit(visitor, facet); });
}

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Index
Projection_facets_3::facet_on_line(const Coordinates& p, const Coordinates& direction, double first, double last, double margin) const
{
  using internal::cross;
  using internal::dot;
  Index best = npos;
  double largest_least = -std::numeric_limits<double>::infinity(), nearest = std::numeric_limits<double>::infinity();
  const auto visit = [&](Index n) {
    const Facet& f = m_facets[n];
    const double volume = dot(f.normal, direction);
    if(!(volume > 0)) return;
    const Coordinates v[3] = { difference(f.vertex[0], p), difference(f.vertex[1], p), difference(f.vertex[2], p) };
    double least = 0;
    for(int i = 0; i < 3; ++i) least = (std::min)(least, dot(direction, cross(v[i], v[(i + 1) % 3])) / volume);
    const double distance = std::abs(dot(f.normal, v[0]) / volume);
    if(least > largest_least || (least == largest_least && distance < nearest)) {
      best = n;
      largest_least = least;
      nearest = distance;
    }
  };
  if(m_tree) m_tree->visit(Tree::Segment(p, direction, first, last, margin), visit);
  return best;
}

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Index
Projection_facets_3::facet_on_line_near(Index facet, const Coordinates& p, const Coordinates& direction, double first, double last) const
{
  using internal::cross;
  using internal::dot;
  constexpr int most_moves = 16;        // more take longer than to look it up
  for(int moves = 0; moves < most_moves; ++moves) {
    const Facet& f = m_facets[facet];
    const double volume = dot(f.normal, direction);
    if(!(volume > 0)) return npos;
    const Coordinates v[3] = { difference(f.vertex[0], p), difference(f.vertex[1], p), difference(f.vertex[2], p) };
    double least = 0;
    int passed = -1;
    for(int i = 0; i < 3; ++i) {
      const double side = dot(direction, cross(v[i], v[(i + 1) % 3]));
      if(side < least) { least = side; passed = i; }
    }
    if(passed == -1) {
      const double s = dot(f.normal, v[0]) / volume;
      return s >= first && s <= last ? facet : npos;
    }
    facet = f.neighbor[passed];
    if(facet == npos) return npos;
  }
  return npos;
}

// The exact one, rounded, where cancellation would turn it so that points of the facet were far from its plane.
CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Coordinates
Projection_facets_3::normal(const Coordinates& p, const Coordinates& q, const Coordinates& r)
{
  using internal::cross;
  using internal::dot;
  const Coordinates u = difference(q, p), v = difference(r, p), n = cross(u, v);
  constexpr double thin = 1e-3;
  if(dot(n, n) > thin * thin * dot(u, u) * dot(v, v)) return n;
  const internal::Exact_coordinates exact_normal = cross(internal::exact_difference(q, p), internal::exact_difference(r, p));
  Coordinates result;
  for(int a = 0; a < 3; ++a) result[a] = CGAL::to_double(exact_normal[a]);
  return result;
}

// of the point of the plane that is nearest to `p`, rounded: a weight is the area of the triangle opposite its vertex, n . (e x (p - v)) / n^2
CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Coordinates
Projection_facets_3::exact_barycentric(const Facet& f, const Coordinates& p)
{
  using internal::cross;
  using internal::dot;
  using internal::exact_difference;
  typedef Exact_rational ET;
  const internal::Exact_coordinates n = cross(exact_difference(f.vertex[1], f.vertex[0]), exact_difference(f.vertex[2], f.vertex[0]));
  const ET squared = dot(n, n);
  Coordinates result;
  for(int i = 0; i < 3; ++i) {
    const Coordinates &v = f.vertex[(i + 1) % 3], &w = f.vertex[(i + 2) % 3];
    result[i] = CGAL::to_double(ET(dot(n, cross(exact_difference(w, v), exact_difference(p, v))) / squared));
  }
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H
