// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H

#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the triangles of a mesh as curves look for them: with coordinates in `double`s, neighbours and a tree of boxes.
 *
 * Facets are numbered as `faces(mesh)`. Vertex `i` of a facet is, in this order, `source(h)`, `target(h)`, `target(next(h))`
 * of its halfedge `h`, as for `CGAL::Polygon_mesh_processing::Face_location`; edge `i` leads from vertex `i` to the next.
 * Copies are not possible; const member functions may be called from several threads at once.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename TriangleMesh>
class Projection_target_3
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef internal::AABB_traits_3<Kernel, internal::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator> > Traits;
  typedef AABB_tree<Traits> Tree;
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef Exact_rational ET;
  typedef std::array<ET, 3> Exact_coordinates;

public:
  typedef TriangleMesh Mesh;
  typedef typename Graph_traits::face_descriptor face_descriptor;
  typedef std::array<double, 3> Coordinates;
  typedef std::uint32_t Index;
  static constexpr Index npos = std::numeric_limits<Index>::max();

  /// copies coordinates and neighbours; `vpm` is a model of `ReadablePropertyMap` from the mesh's vertices to points of a
  /// kernel. If a facet is no triangle or a coordinate not finite, the target is not valid.
  /// \pre the mesh outlives this object, unchanged. A mesh that keeps dynamic properties in itself, as `Surface_mesh` does, must not be prepared by
  /// two threads at once.
  template <typename VertexPointMap>
  Projection_target_3(const TriangleMesh& mesh, VertexPointMap vpm)
    : m_mesh(&mesh), m_index(get(dynamic_face_property_t<Index>(), mesh))
  {
    for(face_descriptor f : faces(mesh)) {
      put(m_index, f, Index(m_faces.size()));
      m_faces.push_back(f);
    }
    for(auto v : vertices(mesh)) m_vertices.push_back(coordinates(get(vpm, v)));
    for(face_descriptor f : m_faces) {
      m_valid = m_valid && is_triangle(halfedge(f, mesh), mesh);
      if(!m_valid) return;
      Facet facet;
      auto h = halfedge(f, mesh);
      for(int i = 0; i < 3; ++i, h = next(h, mesh)) {
        facet.vertex[i] = coordinates(get(vpm, source(h, mesh)));
        for(double c : facet.vertex[i]) m_valid = m_valid && std::isfinite(c);
        const auto neighbor = face(opposite(h, mesh), mesh);
        facet.neighbor[i] = neighbor == Graph_traits::null_face() ? npos : facet_of(neighbor);
      }
      m_facets.push_back(facet);
    }
    if(!m_valid) return;
    for(Facet& f : m_facets) f.normal = normal(f.vertex[0], f.vertex[1], f.vertex[2]);
    for(const Facet& f : m_facets) m_triangles.emplace_back(point(f.vertex[0]), point(f.vertex[1]), point(f.vertex[2]));
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
  }

  Projection_target_3(const Projection_target_3&) = delete;
  Projection_target_3& operator=(const Projection_target_3&) = delete;

  bool is_valid() const { return m_valid; }
  const TriangleMesh& mesh() const { return *m_mesh; }
  /// of vertices, in the order of `vertices(mesh)`
  const std::vector<Coordinates>& vertices_of_mesh() const { return m_vertices; }
  std::size_t number_of_facets() const { return m_faces.size(); }
  face_descriptor face_of(Index facet) const { return m_faces[facet]; }
  Index facet_of(face_descriptor f) const { return get(m_index, f); }
  const Coordinates& vertex(Index facet, int i) const { return m_facets[facet].vertex[i]; }
  const Coordinates& normal(Index facet) const { return m_facets[facet].normal; }     ///< twice the area long
  bool has_area(Index facet) const { return normal(facet) != Coordinates{}; }
  Index neighbor(Index facet, int edge) const { return m_facets[facet].neighbor[edge]; }      ///< `npos` at a border

  /// whether no facet is at a border
  bool is_closed() const
  {
    return std::all_of(m_facets.begin(), m_facets.end(), [](const Facet& f) {
      return std::find(f.neighbor.begin(), f.neighbor.end(), npos) == f.neighbor.end();
    });
  }

  /// the connected component that has each facet, and their number
  std::vector<Index> components(std::size_t& number) const
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

  /// the point with these barycentric coordinates
  Coordinates point(Index facet, const Coordinates& barycentric) const
  {
    Coordinates p;
    for(int a = 0; a < 3; ++a)
      p[a] = barycentric[0] * vertex(facet, 0)[a] + barycentric[1] * vertex(facet, 1)[a] + barycentric[2] * vertex(facet, 2)[a];
    return p;
  }

  /// normal . (p - the plane of the facet)
  double height(Index facet, const Coordinates& p) const
  {
    const Facet& f = m_facets[facet];
    return dot(f.normal, difference(p, f.vertex[0]));
  }

  /// Where in its plane a point is: barycentric coordinates, which may be negative; the distance from the facet, if it is outside, or
  /// else from the nearest edge, negative; the edge whose line it is farthest outside of, or nearest to; and the barycentric
  /// coordinates of the point of the facet that is nearest.
  struct Position { Coordinates barycentric; double outside; int edge; Coordinates nearest; };
  /// \pre the facet has an area
  Position position(Index facet, const Coordinates& p) const
  {
    const Facet& f = m_facets[facet];
    CGAL_precondition(has_area(facet));
    const double squared = dot(f.normal, f.normal);
    Position result{ {}, -std::numeric_limits<double>::infinity(), 0, {} };
    Coordinates e[3];
    double longest = 0;         // squared
    for(int i = 0; i < 3; ++i) {
      e[i] = difference(f.vertex[(i + 1) % 3], f.vertex[i]);
      longest = (std::max)(longest, dot(e[i], e[i]));
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
    for(int i = 0; i < 3; ++i) {
      const double outside = -w[(i + 2) % 3] * std::sqrt(squared / dot(e[i], e[i]));
      if(outside > result.outside) { result.outside = outside; result.edge = i; }
    }
    result.nearest = result.barycentric;
    if(!(result.outside > 0)) return result;
    // where two edges meet at a small angle, a point far from both may be next to their lines
    double least = std::numeric_limits<double>::infinity();
    for(int i = 0; i < 3; ++i) {
      const Coordinates v = difference(p, f.vertex[i]);
      const double t = (std::min)((std::max)(dot(v, e[i]) / dot(e[i], e[i]), 0.), 1.);
      const Coordinates off = { v[0] - t*e[i][0], v[1] - t*e[i][1], v[2] - t*e[i][2] };
      if(!(dot(off, off) < least)) continue;
      least = dot(off, off);
      result.nearest[i] = 1 - t;
      result.nearest[(i + 1) % 3] = t;
      result.nearest[(i + 2) % 3] = 0;
    }
    result.outside = std::sqrt(least);
    return result;
  }

  /// calls `visit(facet)` for all facets whose boxes meet the box
  template <typename Visitor>
  void visit_facets(const Bbox_3& box, const Visitor& visit) const
  {
    Visiting_traits<Visitor> traits{ visit, m_triangles.cbegin() };
    if(!m_tree.empty()) m_tree.traversal(box, traits);
  }

  /// the facet that the straight segment from `p + first * direction` to `p + last * direction` meets from behind, nearest to `p`, or
  /// else, among those that come as near to the segment as `margin`, the one that its line misses least; `npos` if there is none
  Index facet_on_line(const Coordinates& p, const Coordinates& direction, double first, double last, double margin) const
  {
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
    Visiting_traits<decltype(visit)> traits{ visit, m_triangles.cbegin() };
    if(!m_tree.empty()) m_tree.traversal(Segment(p, direction, first, last, margin), traits);
    return best;
  }

private:
  struct Facet
  {
    std::array<Coordinates, 3> vertex;
    Coordinates normal;
    std::array<Index, 3> neighbor;
  };

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

  template <typename Point>
  static Coordinates coordinates(const Point& p) { return { CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]) }; }
  static Kernel::Point_3 point(const Coordinates& p) { return Kernel::Point_3(p[0], p[1], p[2]); }
  static Coordinates difference(const Coordinates& p, const Coordinates& q) { return { p[0] - q[0], p[1] - q[1], p[2] - q[2] }; }
  template <typename FT>
  static FT dot(const std::array<FT, 3>& u, const std::array<FT, 3>& v) { return u[0]*v[0] + u[1]*v[1] + u[2]*v[2]; }
  template <typename FT>
  static std::array<FT, 3> cross(const std::array<FT, 3>& u, const std::array<FT, 3>& v)
  {
    return { u[1]*v[2] - u[2]*v[1], u[2]*v[0] - u[0]*v[2], u[0]*v[1] - u[1]*v[0] };
  }
  // The exact one, rounded, where cancellation would turn it so that points of the facet were far from its plane.
  static Coordinates normal(const Coordinates& p, const Coordinates& q, const Coordinates& r)
  {
    const Coordinates u = difference(q, p), v = difference(r, p), n = cross(u, v);
    constexpr double thin = 1e-3;
    if(dot(n, n) > thin * thin * dot(u, u) * dot(v, v)) return n;
    const Exact_coordinates exact_normal = cross(exact_difference(q, p), exact_difference(r, p));
    Coordinates result;
    for(int a = 0; a < 3; ++a) result[a] = CGAL::to_double(exact_normal[a]);
    return result;
  }
  // of the point of the plane that is nearest to `p`, rounded: a weight is the area of the triangle opposite its vertex, n . (e x (p - v)) / n^2
  static Coordinates exact_barycentric(const Facet& f, const Coordinates& p)
  {
    const Exact_coordinates n = cross(exact_difference(f.vertex[1], f.vertex[0]), exact_difference(f.vertex[2], f.vertex[0]));
    const ET squared = dot(n, n);
    Coordinates result;
    for(int i = 0; i < 3; ++i) {
      const Coordinates &v = f.vertex[(i + 1) % 3], &w = f.vertex[(i + 2) % 3];
      result[i] = CGAL::to_double(ET(dot(n, cross(exact_difference(w, v), exact_difference(p, v))) / squared));
    }
    return result;
  }
  static Exact_coordinates exact_difference(const Coordinates& p, const Coordinates& q)
  {
    return { ET(p[0]) - ET(q[0]), ET(p[1]) - ET(q[1]), ET(p[2]) - ET(q[2]) };
  }

  const TriangleMesh* m_mesh;
  typename boost::property_map<TriangleMesh, dynamic_face_property_t<Index> >::const_type m_index;
  std::vector<face_descriptor> m_faces;
  std::vector<Coordinates> m_vertices;
  std::vector<Facet> m_facets;
  Triangles m_triangles;
  Tree m_tree;
  bool m_valid = true;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H
