// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

class Local_gap_3::Facets
{
  typedef Simple_cartesian<double> Kernel;
  typedef std::vector<Kernel::Triangle_3> Triangles;
  typedef internal::AABB_traits_3<Kernel, internal::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator> >
    Traits;

public:
  explicit Facets(const Input_mesh_3& input)
  {
    const Input_mesh_3::Triangle_mesh& mesh = input.mesh();
    for(auto f : mesh.faces()) {
      const auto t = input.triangle(f);
      m_triangles.emplace_back(kernel_point(t[0]), kernel_point(t[1]), kernel_point(t[2]));
      Point n = facet_normal(t[0], t[1], t[2]).direction;
      const double length = internal::norm(n);
      for(double& x : n) x /= length;
      m_normals.push_back(n);
      const auto h = mesh.halfedge(f);
      m_vertices.push_back(
        { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) });
    }
    m_tree.insert(m_triangles.cbegin(), m_triangles.cend());
    m_tree.build();
  }

  double gap(std::size_t facet, const Point* corners, std::size_t size, Sign side, double most) const
  {
    Query query(*this, facet, corners, size, side, most);
    m_tree.traversal(query, query);
    return query.gap;
  }

  std::array<Point, 3> corners(std::size_t facet) const
  {
    const Kernel::Triangle_3& t = m_triangles[facet];
    return { coordinates(t[0]), coordinates(t[1]), coordinates(t[2]) };
  }

private:
  static constexpr double facing_away = -0.5; // cosine of the angle between normals

  template <typename P>
  static Kernel::Point_3 kernel_point(const P& p)
  {
    return Kernel::Point_3(p[0], p[1], p[2]);
  }
  static Point coordinates(const Kernel::Point_3& p) { return { p.x(), p.y(), p.z() }; }

  // A query of the tree, with its traversal traits and the smallest gap that was found.
  struct Query
  {
    const Facets& facets;
    std::size_t facet;
    const Point* corners;
    std::size_t size;
    Point direction; // unit vector to the side of the facet
    Bbox_3 box;      // bounding box of the corners
    double gap;

    Query(const Facets& facets, std::size_t facet, const Point* corners, std::size_t size, Sign side, double most)
      : facets(facets), facet(facet), corners(corners), size(size), direction(facets.m_normals[facet]), gap(most)
    {
      if(side == NEGATIVE)
        for(double& x : direction) x = -x;
      for(std::size_t n = 0; n < size; ++n) box += kernel_point(corners[n]).bbox();
    }

    bool go_further() const { return gap > 0; }

    // A ball that touches the polygon lies in the bounding box of the polygon, shifted by the radius along `direction`
    // and enlarged by the radius.
    template <typename Node>
    bool do_intersect(const Query&, const Node& node) const
    {
      const Bbox_3 b = node.bbox();
      const double radius = gap / 2;
      for(int a = 0; a < 3; ++a) {
        const double shift = radius * direction[a];
        if((b.min)(a) > (box.max)(a) + shift + radius || (b.max)(a) < (box.min)(a) + shift - radius) return false;
      }
      return true;
    }

    void intersection(const Query&, const Traits::Primitive& primitive)
    {
      const std::size_t other = std::size_t(primitive.id() - facets.m_triangles.cbegin());
      if(!(internal::dot(facets.m_normals[facet], facets.m_normals[other]) < facing_away)) return;
      for(std::size_t v : facets.m_vertices[facet])
        if(std::find(facets.m_vertices[other].begin(), facets.m_vertices[other].end(), v)
           != facets.m_vertices[other].end())
          return;
      narrow(facets.m_triangles[other]);
    }

    // Let h be the height of a point q above the polygon's plane. The ball that touches the polygon at p and has q on
    // its boundary has the diameter |q - p|^2 / h. Balls of diameter D that touch the polygon have their centers on the
    // polygon moved by D / 2. The interior of one of them meets the triangle if and only if the moved polygon is closer
    // than D / 2 to the triangle. The closest points of the two then give a smaller diameter (Dinkelbach's method for
    // fractional programs).
    void narrow(const Kernel::Triangle_3& triangle)
    {
      constexpr int max_steps = 64;
      constexpr double progress = 1e-9;
      if(!std::isfinite(gap)) {
        // Starts with a ball through a vertex of the triangle.
        for(int i = 0; i < 3; ++i) {
          const Kernel::Vector_3 d = triangle[i] - kernel_point(corners[0]);
          const double height = height_of(d);
          if(height > 0) gap = (std::min)(gap, d.squared_length() / height);
        }
        if(!std::isfinite(gap)) return;
      }
      for(int step = 0; step < max_steps; ++step) {
        const Kernel::Vector_3 d = from_next(triangle, gap / 2);
        const double height = height_of(d);
        if(!(height > 0 && d.squared_length() < (1 - progress) * gap * height)) return;
        gap = d.squared_length() / height;
      }
    }

    double height_of(const Kernel::Vector_3& d) const
    {
      return d.x() * direction[0] + d.y() * direction[1] + d.z() * direction[2];
    }

    // Returns the vector from the polygon to the triangle between their closest points, which are determined for the
    // polygon moved by `shift`.
    Kernel::Vector_3 from_next(const Kernel::Triangle_3& triangle, double shift) const
    {
      const Kernel::Vector_3 moved(shift * direction[0], shift * direction[1], shift * direction[2]);
      double least = std::numeric_limits<double>::infinity();
      Kernel::Vector_3 result = NULL_VECTOR;
      const auto consider = [&](const Kernel::Point_3& p, const Kernel::Point_3& q) {
        const double squared = (q - p).squared_length();
        if(!(squared < least)) return;
        least = squared;
        result = q - p + moved;
      };
      const auto corner = [&](std::size_t n) { return kernel_point(corners[n % size]) + moved; };
      const auto consider_on_polygon = [&](const Kernel::Point_3& q) {
        for(std::size_t n = 1; n + 1 < size; ++n) consider(closest({ corner(0), corner(n), corner(n + 1) }, q), q);
      };
      for(std::size_t n = 0; n < size; ++n) consider(corner(n), closest(triangle, corner(n)));
      for(int i = 0; i < 3; ++i) consider_on_polygon(triangle[i]);
      // If the polygon and the triangle intersect, an edge of one meets the plane of the other at a common point.
      for(int i = 0; i < 3; ++i) {
        const double h = height_of(triangle[i] - corner(0)), k = height_of(triangle[i + 1] - corner(0));
        if(h * k < 0) consider_on_polygon(triangle[i] + h / (h - k) * (triangle[i + 1] - triangle[i]));
      }
      const Kernel::Vector_3 normal = cross_product(triangle[1] - triangle[0], triangle[2] - triangle[0]);
      for(std::size_t n = 0; n < size; ++n) {
        const double h = (corner(n) - triangle[0]) * normal, k = (corner(n + 1) - triangle[0]) * normal;
        if(h * k >= 0) continue;
        const Kernel::Point_3 p = corner(n) + h / (h - k) * (corner(n + 1) - corner(n));
        consider(p, closest(triangle, p));
      }
      for(std::size_t n = 0; n < size; ++n)
        for(int i = 0; i < 3; ++i) {
          const auto [s, t] = closest_of_lines(corner(n), corner(n + 1), triangle[i], triangle[i + 1]);
          // Vertices were considered above.
          if(s > 0 && s < 1 && t > 0 && t < 1)
            consider(corner(n) + s * (corner(n + 1) - corner(n)), triangle[i] + t * (triangle[i + 1] - triangle[i]));
        }
      return result;
    }

    // Returns the parameters of the closest points, or values outside [0, 1] if the lines are parallel.
    static std::array<double, 2> closest_of_lines(const Kernel::Point_3& p, const Kernel::Point_3& q,
                                                  const Kernel::Point_3& r, const Kernel::Point_3& s)
    {
      const Kernel::Vector_3 u = q - p, v = s - r, w = p - r;
      const double a = u * u, b = u * v, c = v * v, d = u * w, e = v * w, determinant = a * c - b * b;
      if(!(determinant > 0)) return { -1, -1 };
      return { (b * e - c * d) / determinant, (a * e - b * d) / determinant };
    }

    static Kernel::Point_3 closest(const Kernel::Triangle_3& triangle, const Kernel::Point_3& p)
    {
      return Kernel().construct_projected_point_3_object()(triangle, p);
    }
  };

  Triangles m_triangles;
  std::vector<Point> m_normals;
  std::vector<std::array<std::size_t, 3> > m_vertices;
  AABB_tree<Traits> m_tree;
};

CGAL_BSPLINE_SHELL_3_INLINE Local_gap_3::Local_gap_3(const Input_mesh_3& input)
  : m_facets(std::make_shared<const Facets>(input))
{}

CGAL_BSPLINE_SHELL_3_INLINE double Local_gap_3::operator()(Face_index facet, const Point* corners, std::size_t size,
                                                           Sign side, double most) const
{
  return m_facets->gap(std::size_t(facet), corners, size, side, most);
}

CGAL_BSPLINE_SHELL_3_INLINE double Local_gap_3::operator()(Face_index facet, Sign side, double most) const
{
  const std::array<Point, 3> corners = m_facets->corners(std::size_t(facet));
  return m_facets->gap(std::size_t(facet), corners.data(), corners.size(), side, most);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_LOCAL_GAP_3_IMPL_H
