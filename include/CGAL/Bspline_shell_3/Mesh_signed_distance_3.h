// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SIGNED_DISTANCE_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_SIGNED_DISTANCE_3_H

#include <CGAL/Bspline_shell_3/Input_mesh_3.h>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Distance
 *
 * \brief the signed distance to a closed mesh: negative on the side that the facets turn their backs to.
 *
 * The distance is computed with an AABB tree in `double`s; the sign comes from `CGAL::Side_of_triangle_mesh`, whose
 * predicates are exact. Const member functions may be called from several threads at once.
 *
 * \cgalModels `SignedDistanceOracle_3`
 */
class Mesh_signed_distance_3
{
  typedef Exact_predicates_inexact_constructions_kernel Exact_side_kernel;
  typedef Simple_cartesian<double> Distance_kernel;
  typedef std::vector<Distance_kernel::Triangle_3> Triangles;
  typedef AABB_traits<Distance_kernel, AABB_triangle_primitive<Distance_kernel, Triangles::const_iterator> > Traits;
  typedef AABB_tree<Traits> Distance_tree;
  typedef Side_of_triangle_mesh<Input_mesh_3::Triangle_mesh, Exact_side_kernel> Side_of_mesh;
  typedef AABB_tree<AABB_traits<Exact_side_kernel, AABB_face_graph_triangle_primitive<Input_mesh_3::Triangle_mesh> > >
    Side_tree;

public:
  typedef Exact_side_kernel::Point_3 Point_3;
  typedef double FT;
  /// a closest point and its facet, to start the search for the next one from
  typedef Distance_tree::Point_and_primitive_id Hint;

  /// \pre `input` is built, and outlives the oracle
  explicit Mesh_signed_distance_3(const Input_mesh_3& input)
    : m_flip(!input.faces_outwards())
  {
    for(auto f : input.mesh().faces()) {
      const auto t = input.triangle(f);
      m_triangles.emplace_back(to_distance(t[0]), to_distance(t[1]), to_distance(t[2]));
    }
    m_distance_tree = std::make_unique<Distance_tree>(m_triangles.cbegin(), m_triangles.cend());
    m_distance_tree->build();
    m_side_tree = std::make_unique<Side_tree>(faces(input.mesh()).begin(), faces(input.mesh()).end(), input.mesh());
    m_side_tree->build();
    m_side = std::make_unique<Side_of_mesh>(*m_side_tree);
  }

  /// the signed distance
  FT operator()(const Point_3& p) const { return sign(p) * distance(p); }

  /// -1, 0 or 1: exact
  int sign(const Point_3& p) const
  {
    const Bounded_side side = (*m_side)(p);
    if(side == ON_BOUNDARY) return 0;
    return (side == ON_BOUNDED_SIDE) != m_flip ? -1 : 1;
  }

  /// the distance without its sign
  FT distance(const Point_3& p) const
  {
    return std::sqrt(m_distance_tree->squared_distance(to_distance(p)));
  }

  /// a hint to start with
  Hint any_hint() const { return m_distance_tree->any_reference_point_and_id(); }

  /// the distance; the search starts from `hint`, which is replaced. Fast if the last point was near.
  FT distance(const Point_3& p, Hint& hint) const
  {
    const Distance_kernel::Point_3 q = to_distance(p);
    hint = m_distance_tree->closest_point_and_primitive(q, hint);
    return std::sqrt(squared_distance(q, hint.first));
  }

private:
  static Distance_kernel::Point_3 to_distance(const Point_3& p) { return Distance_kernel::Point_3(p.x(), p.y(), p.z()); }

  Triangles m_triangles;
  std::unique_ptr<Distance_tree> m_distance_tree;
  std::unique_ptr<Side_tree> m_side_tree;
  std::unique_ptr<Side_of_mesh> m_side;
  bool m_flip;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_SIGNED_DISTANCE_3_H
