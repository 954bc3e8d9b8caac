// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H

#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/morton_order.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

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

// A tree of the boxes of groups. A group consists of successive facets in Morton order. Sorting the facets takes less
// time than building a CGAL tree of all facets.
class Projection_facets_3::Tree
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Iso_cuboid_3> Boxes;

  // The box of a group.
  class Primitive
  {
  public:
    typedef Boxes::const_iterator Id;
    typedef Kernel::Point_3 Point;
    typedef Kernel::Iso_cuboid_3 Datum;
    typedef const Datum& Datum_reference;

    Primitive() = default;
    explicit Primitive(Id id) : m_id(id) {}
    Id id() const { return m_id; }
    Datum_reference datum() const { return *m_id; }
    Point reference_point() const { return (m_id->min)(); }

  private:
    Id m_id;
  };
  typedef internal::AABB_traits_3<Kernel, Primitive> Traits;

public:
  // A segment with a margin around it.
  class Segment
  {
  public:
    Segment(const Coordinates& p, const Coordinates& direction, double first, double last, double margin)
      : m_first(first), m_last(last), m_margin(margin), m_point(p)
    {
      for(int a = 0; a < 3; ++a) m_inverse[a] = 1 / direction[a];
    }

    // Slab test. If a component of the direction is zero, bounds are infinite.
    bool may_meet(const Bbox_3& box) const
    {
      double first = m_first, last = m_last;
      for(int a = 0; a < 3; ++a) {
        const double low = ((box.min)(a)-m_margin - m_point[a]) * m_inverse[a],
                     high = ((box.max)(a) + m_margin - m_point[a]) * m_inverse[a];
        first = (std::max)(first, (std::min)(low, high));
        last = (std::min)(last, (std::max)(low, high));
      }
      return !(first > last);
    }

  private:
    double m_first, m_last, m_margin;
    Coordinates m_point, m_inverse;
  };

  // An open ball, which shrinks during a query.
  struct Ball
  {
    Coordinates center;
    double squared_radius;

    bool may_meet(const Bbox_3& box) const
    {
      double squared = 0;
      for(int a = 0; a < 3; ++a) {
        const double off = (std::max)({ (box.min)(a)-center[a], center[a] - (box.max)(a), 0. });
        squared += off * off;
      }
      return squared < squared_radius;
    }
  };

  explicit Tree(const std::vector<Facet>& facets)
  {
    std::vector<Coordinates> middles;
    middles.reserve(facets.size());
    for(const Facet& f : facets) {
      const Bbox_3 box = bbox(f);
      Coordinates middle;
      for(int a = 0; a < 3; ++a) middle[a] = (box.min)(a) / 2 + (box.max)(a) / 2;
      middles.push_back(middle);
    }
    const internal::Morton_order order = internal::morton_order<Sequential_tag>(middles);
    m_facets.reserve(facets.size());
    for(std::size_t n = 0; n < facets.size(); ++n) m_facets.push_back(Index(order[n]));
    m_boxes.reserve(facets.size() / group_size + 1);
    m_boxes_of_facets.reserve(facets.size());
    for(std::size_t begin = 0; begin < facets.size(); begin += group_size) {
      Bbox_3 box;
      for(std::size_t n = begin; n < (std::min)(begin + group_size, facets.size()); ++n) {
        m_boxes_of_facets.push_back(bbox(facets[m_facets[n]]));
        box += m_boxes_of_facets.back();
      }
      m_boxes.emplace_back(box);
    }
    m_tree.insert(m_boxes.cbegin(), m_boxes.cend());
    m_tree.build();
  }

  // Calls visit(facet) for the facets whose boxes intersect the query.
  template <typename Query, typename Visitor>
  void visit(const Query& query, const Visitor& visit) const
  {
    Visiting_traits<Visitor> traits{ *this, visit };
    m_tree.traversal(query, traits);
  }

  // Returns a facet near a point, not necessarily the nearest facet. Takes the nearest of a sample of all facets, and
  // then repeatedly of a finer sample close to it in Morton order.
  Index facet_near(const std::vector<Facet>& facets, const Coordinates& p) const
  {
    constexpr std::size_t some = 64;
    std::size_t nearest = 0;
    for(std::size_t begin = 0, end = m_facets.size(), step = 0; step != 1;) {
      step = (end - begin + some - 1) / some;
      double least = std::numeric_limits<double>::infinity();
      for(std::size_t n = begin; n < end; n += step) {
        const Coordinates off = difference(facets[m_facets[n]].vertex[0], p);
        const double squared = internal::dot(off, off);
        if(squared < least) {
          least = squared;
          nearest = n;
        }
      }
      begin = nearest - (std::min)(nearest, step);
      end = (std::min)(nearest + step, m_facets.size());
    }
    return m_facets[nearest];
  }

private:
  static constexpr std::size_t group_size = 8;

  static Bbox_3 bbox(const Facet& f)
  {
    Bbox_3 box;
    for(const Coordinates& p : f.vertex) box += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
    return box;
  }
  static bool do_meet(const Bbox_3& query, const Bbox_3& box) { return do_overlap(query, box); }
  static bool do_meet(const Segment& query, const Bbox_3& box) { return query.may_meet(box); }
  static bool do_meet(const Ball& query, const Bbox_3& box) { return query.may_meet(box); }

  template <typename Visitor>
  struct Visiting_traits
  {
    const Tree& tree;
    const Visitor& visit;

    bool go_further() const { return true; }
    template <typename Query>
    void intersection(const Query& query, const Primitive& group)
    {
      const std::size_t begin = std::size_t(group.id() - tree.m_boxes.cbegin()) * group_size;
      for(std::size_t n = begin; n < (std::min)(begin + group_size, tree.m_facets.size()); ++n)
        if(do_meet(query, tree.m_boxes_of_facets[n])) visit(tree.m_facets[n]);
    }
    template <typename Query, typename Node>
    bool do_intersect(const Query& query, const Node& node) const
    {
      return do_meet(query, node.bbox());
    }
  };

  std::vector<Index> m_facets; // ordered by groups
  Boxes m_boxes;
  // ordered in the same way, because facets of a group may be far from each other in memory
  std::vector<Bbox_3> m_boxes_of_facets;
  AABB_tree<Traits> m_tree;
};

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Projection_facets_3(std::vector<Facet> facets)
  : m_facets(std::move(facets))
{
  for(Facet& f : m_facets) f.normal = normal(f.vertex[0], f.vertex[1], f.vertex[2]);
  if(!m_facets.empty()) m_tree = std::make_shared<const Tree>(m_facets);
}

CGAL_BSPLINE_SHELL_3_INLINE std::vector<Projection_facets_3::Index> Projection_facets_3::components(
  std::size_t& number) const
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

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Position Projection_facets_3::position(Index facet,
                                                                                        const Coordinates& p) const
{
  using internal::cross;
  using internal::dot;
  const Facet& f = m_facets[facet];
  CGAL_precondition(has_area(facet));
  const double squared = dot(f.normal, f.normal);
  Position result{ {}, -std::numeric_limits<double>::infinity(), 0, {} };
  Coordinates e[3];
  double lengths[3], longest = 0; // squared
  for(int i = 0; i < 3; ++i) {
    e[i] = difference(f.vertex[(i + 1) % 3], f.vertex[i]);
    lengths[i] = dot(e[i], e[i]);
    longest = (std::max)(longest, lengths[i]);
  }
  Coordinates& w = result.barycentric;
  // Rounding moves a point by eps / thinness, relative to its distance from the facet's vertex. A second step squares
  // this factor.
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
  } else w = exact_barycentric(f, p);
  // Signed squares are compared.
  for(int i = 0; i < 3; ++i) {
    const double weight = w[(i + 2) % 3], outside = -weight * std::abs(weight) / lengths[i];
    if(outside > result.outside) {
      result.outside = outside;
      result.edge = i;
    }
  }
  result.outside = std::copysign(std::sqrt(std::abs(result.outside) * squared), result.outside);
  result.nearest = result.barycentric;
  if(!(result.outside > 0)) return result;
  // If two edges meet at a small angle, a point far from the edges may be close to their lines.
  result.outside = nearest_on_edges(f, p, result.nearest);
  return result;
}

// Returns the distance from the edges, and the barycentric coordinates of the nearest point on them.
CGAL_BSPLINE_SHELL_3_INLINE double Projection_facets_3::nearest_on_edges(const Facet& f, const Coordinates& p,
                                                                         Coordinates& barycentric)
{
  using internal::dot;
  double least = std::numeric_limits<double>::infinity();
  for(int i = 0; i < 3; ++i) {
    const Coordinates e = difference(f.vertex[(i + 1) % 3], f.vertex[i]), v = difference(p, f.vertex[i]);
    const double length = dot(e, e), t = length > 0 ? (std::min)((std::max)(dot(v, e) / length, 0.), 1.) : 0.;
    const Coordinates off = { v[0] - t * e[0], v[1] - t * e[1], v[2] - t * e[2] };
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
  std::pair<Index, Coordinates> result(0, { 1, 0, 0 }); // used if `p` is NaN
  Tree::Ball ball = { p, std::numeric_limits<double>::infinity() };
  const auto compare = [&](Index facet) {
    Coordinates barycentric;
    if(has_area(facet)) barycentric = position(facet, p).nearest;
    else nearest_on_edges(m_facets[facet], p, barycentric);
    const Coordinates off = difference(point(facet, barycentric), p);
    const double squared = internal::dot(off, off);
    if(!(squared < ball.squared_radius || (squared == ball.squared_radius && facet < result.first))) return;
    ball.squared_radius = squared;
    result = { facet, barycentric };
  };
  compare(m_tree->facet_near(m_facets, p)); // shrinks the ball, so that few other facets are compared
  m_tree->visit(ball, compare);
  return result;
}

CGAL_BSPLINE_SHELL_3_INLINE void Projection_facets_3::visit_facets(const Bbox_3& box, void (*visit)(const void*, Index),
                                                                   const void* visitor) const
{
  if(m_tree) m_tree->visit(box, [&](Index facet) { visit(visitor, facet); });
}

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Index Projection_facets_3::facet_on_line(const Coordinates& p,
                                                                                          const Coordinates& direction,
                                                                                          double first, double last,
                                                                                          double margin) const
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
    if(least > largest_least || (least == largest_least && (distance < nearest || (distance == nearest && n < best)))) {
      best = n;
      largest_least = least;
      nearest = distance;
    }
  };
  if(m_tree) m_tree->visit(Tree::Segment(p, direction, first, last, margin), visit);
  return best;
}

CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Index Projection_facets_3::facet_on_line_near(
  Index facet, const Coordinates& p, const Coordinates& direction, double first, double last) const
{
  using internal::cross;
  using internal::dot;
  constexpr int most_moves = 16; // more moves would take longer than a query of the tree
  for(int moves = 0; moves < most_moves; ++moves) {
    const Facet& f = m_facets[facet];
    const double volume = dot(f.normal, direction);
    if(!(volume > 0)) return npos;
    const Coordinates v[3] = { difference(f.vertex[0], p), difference(f.vertex[1], p), difference(f.vertex[2], p) };
    double least = 0;
    int passed = -1;
    for(int i = 0; i < 3; ++i) {
      const double side = dot(direction, cross(v[i], v[(i + 1) % 3]));
      if(side < least) {
        least = side;
        passed = i;
      }
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

// If cancellation would turn the normal so far that points of the facet leave its plane, the exact normal is rounded.
CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Coordinates Projection_facets_3::normal(const Coordinates& p,
                                                                                         const Coordinates& q,
                                                                                         const Coordinates& r)
{
  using internal::cross;
  using internal::dot;
  const Coordinates u = difference(q, p), v = difference(r, p), n = cross(u, v);
  constexpr double thin = 1e-3;
  if(dot(n, n) > thin * thin * dot(u, u) * dot(v, v)) return n;
  const internal::Exact_coordinates exact_normal = cross(internal::exact_difference(q, p),
                                                         internal::exact_difference(r, p));
  Coordinates result;
  for(int a = 0; a < 3; ++a) result[a] = internal::rounded(exact_normal[a]);
  return result;
}

// Returns the rounded exact barycentric coordinates of the point of the plane that is nearest to `p`. A weight is the
// area of the triangle opposite its vertex, n . (e x (p - v)) / n^2.
CGAL_BSPLINE_SHELL_3_INLINE Projection_facets_3::Coordinates Projection_facets_3::exact_barycentric(
  const Facet& f, const Coordinates& p)
{
  using internal::cross;
  using internal::dot;
  using internal::exact_difference;
  typedef Exact_rational ET;
  const internal::Exact_coordinates n = cross(exact_difference(f.vertex[1], f.vertex[0]),
                                              exact_difference(f.vertex[2], f.vertex[0]));
  const ET squared = dot(n, n);
  Coordinates result;
  for(int i = 0; i < 3; ++i) {
    const Coordinates &v = f.vertex[(i + 1) % 3], &w = f.vertex[(i + 2) % 3];
    result[i] = internal::rounded(ET(dot(n, cross(exact_difference(w, v), exact_difference(p, v))) / squared));
  }
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_FACETS_3_IMPL_H
