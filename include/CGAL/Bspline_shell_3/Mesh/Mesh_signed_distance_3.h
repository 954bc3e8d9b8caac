// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <memory>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the signed distance to a closed mesh, negative behind the facets.
 *
 * The distance is computed in `double`s with an AABB tree. The sign at a single point comes from
 * `CGAL::Side_of_triangle_mesh`, whose predicates are exact. For sequences of nearby points, `signed_distance()` is
 * faster. It determines the side by the normal of the facet, edge, or vertex on which the closest point lies. Normals
 * are weighted by angles (*Signed distance computation using the angle weighted pseudonormal*, J. A. Baerentzen and H.
 * Aanaes, 2005). Const member functions may be called concurrently.
 *
 * \cgalModels `SignedDistanceOracle_3`
 */
class Mesh_signed_distance_3
{
public:
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef double FT;
  /// the facet from which the search for the closest point starts; the first facet by default
  struct Hint
  {
    std::size_t triangle = 0;
  };

  /// \pre `input` is built, and outlives the oracle
  explicit Mesh_signed_distance_3(const Input_mesh_3& input);
  explicit Mesh_signed_distance_3(const Input_mesh_3&&) = delete; // the reference would dangle

  /// returns the signed distance
  FT operator()(const Point_3& p) const { return sign(p) * distance(p); }
  /// returns -1, 0, or 1; exact
  int sign(const Point_3& p) const;
  /// returns the distance without its sign
  FT distance(const Point_3& p) const;

  /// returns the signed distance, and stores the closest facet in `hint`. The search starts at `hint`, which is fast if
  /// the previous point was near. If the mesh intersects itself, the closest facet determines the side.
  FT signed_distance(const Point_3& p, Hint& hint) const;

private:
  class Trees;
  std::shared_ptr<const Trees> m_trees;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_MESH_SIGNED_DISTANCE_3_H
