// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Support/CGAL_compatibility.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// `Simple_cartesian<double>` with a faster projection onto triangles: the signs of barycentric coordinates select the
// edges to consider.
struct Distance_kernel : Simple_cartesian<double>
{
  struct Construct_projected_point_3
  {
    Point_3 operator()(const Triangle_3& t, const Point_3& p) const
    {
      const Vector_3 edge[3] = { t[1] - t[0], t[2] - t[1], t[0] - t[2] };
      const Vector_3 normal = cross_product(edge[0], edge[1]);
      bool is_outside = false;
      Point_3 closest = t[0];
      double least = std::numeric_limits<double>::infinity();
      for(int i = 0; i < 3; ++i) {
        const Vector_3 away = p - t[i];
        if(cross_product(edge[i], away) * normal > 0) continue;
        is_outside = true; // or on the edge; or the triangle has no area
        const double length = edge[i].squared_length();
        const double along = length > 0 ? (std::min)((std::max)(edge[i] * away / length, 0.), 1.) : 0.;
        const Point_3 q = along == 1 ? t[(i + 1) % 3] : t[i] + along * edge[i];
        const double squared = (p - q).squared_length();
        if(squared < least) {
          least = squared;
          closest = q;
        }
      }
      return is_outside ? closest : p - ((p - t[0]) * normal / normal.squared_length()) * normal;
    }
  };

  Construct_projected_point_3 construct_projected_point_3_object() const { return Construct_projected_point_3(); }
};

} // namespace internal

class Mesh_signed_distance_3::Trees
{
  typedef Exact_predicates_inexact_constructions_kernel Exact_side_kernel;
  typedef internal::Distance_kernel Distance_kernel;
  typedef std::vector<Distance_kernel::Triangle_3> Triangles;
  typedef internal::AABB_traits_3<Distance_kernel,
                                  internal::AABB_triangle_primitive_3<Distance_kernel, Triangles::const_iterator> >
    Traits;
  typedef AABB_tree<Traits> Distance_tree;
  typedef Side_of_triangle_mesh<Input_mesh_3::Triangle_mesh, Exact_side_kernel> Side_of_mesh;
  typedef AABB_tree<
    internal::AABB_traits_3<Exact_side_kernel, AABB_face_graph_triangle_primitive<Input_mesh_3::Triangle_mesh> > >
    Side_tree;

public:
  explicit Trees(const Input_mesh_3& input) : m_mesh(input.mesh()), m_flip(!input.faces_outwards())
  {
    for(int a = 0; a < 3; ++a)
      m_largest_coordinate = (std::max)(
        { m_largest_coordinate, std::abs((input.bbox().min)(a)), std::abs((input.bbox().max)(a)) });
    m_triangles.reserve(m_mesh.number_of_faces());
    for(auto f : m_mesh.faces()) {
      const auto t = input.triangle(f);
      m_triangles.emplace_back(to_distance(t[0]), to_distance(t[1]), to_distance(t[2]));
    }
    compute_normals(m_mesh);
    m_distance_tree = std::make_unique<Distance_tree>(m_triangles.cbegin(), m_triangles.cend());
    m_distance_tree->build();
  }

  int sign(const Point_3& p) const
  {
    std::call_once(m_side_is_built, [&] { // built on demand, because few signs need it
      m_side_tree = std::make_unique<Side_tree>(faces(m_mesh).begin(), faces(m_mesh).end(), m_mesh);
      m_side_tree->build();
      m_side = std::make_unique<Side_of_mesh>(*m_side_tree);
    });
    const Bounded_side side = (*m_side)(p);
    if(side == ON_BOUNDARY) return 0;
    return (side == ON_BOUNDED_SIDE) != m_flip ? -1 : 1;
  }

  FT distance(const Point_3& p) const { return std::sqrt(m_distance_tree->squared_distance(to_distance(p))); }

  FT signed_distance(const Point_3& p, Hint& hint) const
  {
    const Distance_kernel::Point_3 q = to_distance(p);
    const Distance_tree::Point_and_primitive_id closest = m_distance_tree->closest_point_and_primitive(
      q, descend(q, hint.triangle));
    hint.triangle = std::size_t(closest.second - m_triangles.cbegin());
    const Vector away = q - closest.first;
    const FT length = std::sqrt(away.squared_length());
    if(!(length > 0)) return 0;
    // The normal is unreliable close to the mesh, and where the facets at the closest point are thin or seen edge-on;
    // there, the exact sign is used. Closest points are assigned to edges up to `rounding()`, which is less than 1/10
    // of `doubtful * nearest * m_largest_coordinate`. Such an error turns `away` by less than `doubtful`.
    constexpr FT doubtful = 1e-5, nearest = 1e-8;
    if(length < nearest * m_largest_coordinate) return sign(p) * length;
    const FT side = away * normal_at(hint.triangle, closest.first) / length;
    if(std::abs(side) < doubtful) return sign(p) * length;
    return side > 0 ? length : -length;
  }

private:
  typedef Distance_kernel::Vector_3 Vector;
  static constexpr std::size_t none = std::size_t(-1);

  struct Facet
  {
    Vector normal;
    std::array<std::uint32_t, 3> neighbor, vertex; // across edge `i`; source of edge `i`
    bool is_thin;
  };

  // Walks from facet to facet while the next facet is closer, so that the tree visits few unnecessary boxes.
  Distance_tree::Point_and_primitive_id descend(const Distance_kernel::Point_3& q, std::size_t facet) const
  {
    const auto closest_point = Distance_kernel().construct_projected_point_3_object();
    Distance_kernel::Point_3 closest = closest_point(m_triangles[facet], q);
    FT least = squared_distance(closest, q);
    for(std::size_t from = none, next = facet; next != none;) {
      next = none;
      for(std::size_t neighbor : m_facets[facet].neighbor) {
        if(neighbor == from) continue;
        const Distance_kernel::Point_3 there = closest_point(m_triangles[neighbor], q);
        const FT squared = squared_distance(there, q);
        if(squared < least) {
          least = squared;
          closest = there;
          next = neighbor;
        }
      }
      if(next != none) {
        from = facet;
        facet = next;
      }
    }
    return { closest, m_triangles.cbegin() + std::ptrdiff_t(facet) };
  }

  // Returns a bound on the rounding error of a closest point.
  FT rounding() const { return 32 * std::numeric_limits<FT>::epsilon() * m_largest_coordinate; }

  // Returns a unit vector, or zero for a facet too flat for `double`s.
  static Vector unit(Vector v)
  {
    const FT largest = (std::max)({ std::abs(v.x()), std::abs(v.y()), std::abs(v.z()) });
    if(!(largest > 0)) return v;
    v = v / largest;
    return v / std::sqrt(v.squared_length());
  }

  // The mesh has no removed facets, so the indices of facets are consecutive.
  void compute_normals(const Input_mesh_3::Triangle_mesh& mesh)
  {
    m_facets.reserve(m_triangles.size());
    m_vertex_normals.assign(mesh.num_vertices(), Vector(NULL_VECTOR));
    constexpr FT thinnest = 1e-6; // relative to coordinates, as is rounding
    for(auto f : mesh.faces()) {
      const Distance_kernel::Triangle_3& t = m_triangles[std::size_t(f)];
      const FT scale = std::sqrt((std::max)((t[1] - t[0]).squared_length(), (t[2] - t[0]).squared_length()));
      const Vector normal = cross_product((t[1] - t[0]) / scale, (t[2] - t[0]) / scale);
      FT largest = 0;
      for(int i = 0; i < 3; ++i)
        for(int a = 0; a < 3; ++a) largest = (std::max)(largest, std::abs(t[i][a]));
      Facet facet = { unit(normal), {}, {}, !(std::sqrt(normal.squared_length()) * scale > thinnest * largest) };
      auto h = mesh.halfedge(f);
      for(std::size_t i = 0; i < 3; ++i, h = mesh.next(h)) {
        facet.neighbor[i] = std::uint32_t(mesh.face(mesh.opposite(h)));
        facet.vertex[i] = std::uint32_t(mesh.source(h));
        const Vector u = unit(t[int(i + 1) % 3] - t[int(i)]), v = unit(t[int(i + 2) % 3] - t[int(i)]);
        const FT angle = std::atan2(std::sqrt(cross_product(u, v).squared_length()), u * v);
        Vector& sum = m_vertex_normals[facet.vertex[i]];
        sum = sum + angle * facet.normal;
      }
      m_facets.push_back(facet);
    }
    for(Vector& n : m_vertex_normals) n = unit(n);
  }

  // Returns the normal at a point of a facet. Returns zero on a facet, and on its edges, if the facet is so thin that
  // positions in it are within rounding errors.
  Vector normal_at(std::size_t n, const Distance_kernel::Point_3& p) const
  {
    const Distance_kernel::Triangle_3& t = m_triangles[n];
    const Facet& facet = m_facets[n];
    if(facet.is_thin) return NULL_VECTOR;
    bool on_edge[3];
    for(int i = 0; i < 3; ++i) {
      const Vector e = t[(i + 1) % 3] - t[i], across = cross_product(facet.normal, e);
      on_edge[i] = !(across * (p - t[i]) > rounding() * std::sqrt(across.squared_length()));
    }
    for(std::size_t i = 0; i < 3; ++i)
      if(on_edge[i] && on_edge[(i + 2) % 3]) return m_vertex_normals[facet.vertex[i]];
    for(std::size_t i = 0; i < 3; ++i)
      if(on_edge[i]) {
        const Facet& other = m_facets[facet.neighbor[i]];
        return other.is_thin ? Vector(NULL_VECTOR) : unit(facet.normal + other.normal);
      }
    return facet.normal;
  }

  static Distance_kernel::Point_3 to_distance(const Point_3& p)
  {
    return Distance_kernel::Point_3(p.x(), p.y(), p.z());
  }

  Triangles m_triangles;
  std::vector<Facet> m_facets;
  std::vector<Vector> m_vertex_normals;
  std::unique_ptr<Distance_tree> m_distance_tree;
  const Input_mesh_3::Triangle_mesh& m_mesh;
  mutable std::once_flag m_side_is_built;
  mutable std::unique_ptr<Side_tree> m_side_tree;
  mutable std::unique_ptr<Side_of_mesh> m_side;
  FT m_largest_coordinate = 0;
  bool m_flip;
};

CGAL_BSPLINE_SHELL_3_INLINE Mesh_signed_distance_3::Mesh_signed_distance_3(const Input_mesh_3& input)
  : m_trees(std::make_shared<const Trees>(input))
{}

CGAL_BSPLINE_SHELL_3_INLINE int Mesh_signed_distance_3::sign(const Point_3& p) const
{
  return m_trees->sign(p);
}

CGAL_BSPLINE_SHELL_3_INLINE double Mesh_signed_distance_3::distance(const Point_3& p) const
{
  return m_trees->distance(p);
}

CGAL_BSPLINE_SHELL_3_INLINE double Mesh_signed_distance_3::signed_distance(const Point_3& p, Hint& hint) const
{
  return m_trees->signed_distance(p, hint);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_IMPL_H
