// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TIP_H
#define CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TIP_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef Mesh_with_origins::Triangle_mesh Truncation_mesh;
typedef Mesh_with_origins::Kernel Truncation_kernel;

// A vertex with its facets, which are cut within a ball around it.
struct Tip
{
  typedef Truncation_kernel::Point_3 Point_3;
  typedef Truncation_kernel::Vector_3 Vector_3;

  Truncation_mesh::Vertex_index vertex;
  Point_3 center;
  std::vector<Truncation_mesh::Vertex_index> link; // counterclockwise
  std::vector<Truncation_mesh::Face_index> facets; // between link[i] and the next vertex
  std::vector<Point_3> ends;                       // positions of the vertices of the link
  std::vector<Point_3> normals;                    // unit normals of the facets
  double margin = 0;                               // cone margin of the vertex
  double radius = 0;                               // radius of the ball

  Tip(const Truncation_mesh& mesh, Truncation_mesh::Vertex_index v)
    : vertex(v), center(mesh.point(v)), margin(vertex_cone_margin(mesh, v))
  {
    for(auto h : CGAL::halfedges_around_target(v, mesh)) link.push_back(mesh.source(h));
    std::reverse(link.begin(), link.end()); // halfedges_around_target() visits the facets in reverse order
    for(std::size_t i = 0; i < link.size(); ++i) {
      ends.push_back(mesh.point(link[i]));
      facets.push_back(mesh.face(mesh.halfedge(v, link[i])));
    }
    for(std::size_t i = 0; i < link.size(); ++i)
      normals.push_back(unit_normal(center, ends[i], ends[(i + 1) % link.size()]));
  }

  static Point_3 unit_normal(const Point_3& p, const Point_3& q, const Point_3& r)
  {
    const auto n = facet_normal(p, q, r).direction;
    const double length = norm(n);
    return length > 0 ? Point_3(n[0] / length, n[1] / length, n[2] / length) : Point_3(0, 0, 0);
  }

  std::size_t size() const { return ends.size(); }
  double edge_length(std::size_t i) const { return std::sqrt(CGAL::squared_distance(center, ends[i])); }
  double shortest_edge() const
  {
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t i = 0; i < size(); ++i) least = (std::min)(least, edge_length(i));
    return least;
  }
  // Returns an upper bound on the margin of any disc: at each cut of an edge, the two facets along the edge bound it.
  double largest_margin() const
  {
    double least = 1;
    for(std::size_t i = 0; i < size(); ++i) {
      const Vector_3 sum = (normals[i] - CGAL::ORIGIN) + (normals[(i + size() - 1) % size()] - CGAL::ORIGIN);
      least = (std::min)(least, std::sqrt(sum.squared_length()) / 2);
    }
    return least;
  }
};

// A disc that may replace a tip: triangles between the rim, along which facets are cut, and inner points.
struct Tip_disc
{
  typedef Tip::Point_3 Point_3;
  // The point center + s (ends[facet] - center) + t (ends[facet + 1] - center); on an edge, t is zero.
  struct Rim_point
  {
    std::size_t facet;
    double s, t;
    Point_3 point;
  };

  std::vector<Rim_point> rim; // counterclockwise; one on each edge
  std::vector<Point_3> inner;
  std::vector<std::array<std::size_t, 3> > triangles; // numbers of rim points, followed by inner points
  double margin = 0;                                  // least margin of all points

  const Point_3& point(std::size_t n) const { return n < rim.size() ? rim[n].point : inner[n - rim.size()]; }

  static Rim_point rim_point(const Tip& tip, std::size_t facet, double s, double t)
  {
    const Point_3 p = tip.center + s * (tip.ends[facet] - tip.center)
                      + t * (tip.ends[(facet + 1) % tip.size()] - tip.center);
    return { facet, s, t, p };
  }

  // Computes the margin. Stops early, with an upper bound, if the margin is at most `least`.
  void measure(const Tip& tip, double least)
  {
    std::vector<std::vector<Point_3> > normals(rim.size() + inner.size());
    for(std::size_t n = 0; n < rim.size(); ++n) {
      normals[n].push_back(tip.normals[rim[n].facet]);
      if(rim[n].t == 0) normals[n].push_back(tip.normals[(rim[n].facet + tip.size() - 1) % tip.size()]);
    }
    for(const auto& t : triangles) {
      const Point_3 normal = Tip::unit_normal(point(t[0]), point(t[1]), point(t[2]));
      for(std::size_t p : t) normals[p].push_back(normal);
    }
    margin = 1;
    for(const auto& at_point : normals) {
      margin = (std::min)(margin, norm(cone_axis(at_point)));
      if(margin <= least) return;
    }
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRUNCATION_INTERNAL_TIP_H
