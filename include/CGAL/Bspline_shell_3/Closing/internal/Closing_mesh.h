// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_CLOSING_MESH_H
#define CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_CLOSING_MESH_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_with_origins.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Queries on triangle meshes that are to be closed.

typedef Mesh_with_origins::Triangle_mesh Closing_mesh;
typedef Mesh_with_origins::Kernel Closing_kernel;

inline double length(const Closing_kernel::Vector_3& v)
{
  return std::sqrt(v.squared_length());
}

inline Closing_kernel::Vector_3 unit_normal(const Closing_mesh& mesh, Closing_mesh::Face_index f)
{
  const auto h = mesh.halfedge(f);
  const auto n = facet_normal(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                              mesh.point(mesh.target(mesh.next(h))))
                   .direction;
  const Closing_kernel::Vector_3 v(n[0], n[1], n[2]);
  return v / length(v);
}

// Returns the axis of the cone of facets at a vertex, which may be on a border; its length is the cone margin.
inline Closing_kernel::Vector_3 cone_axis_at(const Closing_mesh& mesh, Closing_mesh::Vertex_index v)
{
  std::vector<Closing_kernel::Point_3> normals;
  for(auto f : mesh.faces_around_target(mesh.halfedge(v)))
    if(f != Closing_mesh::null_face()) normals.push_back(CGAL::ORIGIN + unit_normal(mesh, f));
  const std::array<double, 3> axis = cone_axis(normals);
  return Closing_kernel::Vector_3(axis[0], axis[1], axis[2]);
}

// Returns the unit vector in the plane of a border edge's facet that is orthogonal to the edge and points away from the
// facet.
inline Closing_kernel::Vector_3 outward_conormal(const Closing_mesh& mesh, Closing_mesh::Halfedge_index border)
{
  const auto h = mesh.opposite(border);
  const Closing_kernel::Vector_3 along = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
  const Closing_kernel::Vector_3 c = CGAL::cross_product(along, unit_normal(mesh, mesh.face(h)));
  return c / length(c);
}

// AABB tree for ray queries.
class Ray_tree : public AABB_tree<AABB_traits_3<Closing_kernel, AABB_face_graph_triangle_primitive<Closing_mesh> > >
{
public:
  explicit Ray_tree(const Closing_mesh& mesh)
    : AABB_tree(mesh.faces().begin(), mesh.faces().end(), mesh),
      m_reach(1 / reciprocal_power_of_two(largest_coordinate(mesh)))
  {}

  // Returns the distance to the first facet in a direction, except for facets that `skip` selects, or infinity if there
  // is none. The direction is a unit vector.
  template <typename Skip>
  double distance(const Closing_kernel::Point_3& p, const Closing_kernel::Vector_3& direction, const Skip& skip) const
  {
    if(size() < 2) return std::numeric_limits<double>::infinity(); // with one facet, the tree would ignore `skip`
    const auto hit = first_intersection(Closing_kernel::Ray_3(p, m_reach * direction), skip);
    if(!hit) return std::numeric_limits<double>::infinity();
    const auto* point = internal::get_if<Closing_kernel::Point_3>(hit->first);
    return point ? std::sqrt(CGAL::squared_distance(p, *point)) : 0.; // the ray lies in a facet's plane
  }

private:
  static double largest_coordinate(const Closing_mesh& mesh)
  {
    double largest = 0;
    for(const Closing_kernel::Point_3& p : mesh.points())
      largest = (std::max)({ largest, std::abs(p.x()), std::abs(p.y()), std::abs(p.z()) });
    return largest;
  }

  // distance of the second point that defines a ray; at smaller distances, the sum with large coordinates would round
  // away the direction
  double m_reach;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLOSING_INTERNAL_CLOSING_MESH_H
