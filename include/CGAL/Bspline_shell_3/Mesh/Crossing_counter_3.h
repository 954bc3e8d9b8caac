// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H

#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief counts, exactly, how often a segment passes through a mesh from the back of its facets to their front.
 *
 * The mesh is closed; otherwise the count means nothing. Const member functions may be called from several threads at
 * once.
 *
 * \cgalHeading{Cost} the first segments are compared with all facets, which is less work than a tree of them; when
 *   there are more, the tree is built.
 */
class Crossing_counter_3
{
public:
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef Surface_mesh<Point_3> Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;

  /// \pre `mesh` outlives this object
  explicit Crossing_counter_3(const Triangle_mesh& mesh);
  explicit Crossing_counter_3(const Triangle_mesh&&) = delete; // it would dangle

  /// the facets that the segment crosses in their interiors, with the sign of each: 1 if it comes out at the front, -1
  /// if it goes in; in the order of `faces(mesh)`. Nothing if it touches an edge, a vertex, or a facet that one of its
  /// ends lies on: take another segment.
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`, for a comparison with all
  ///   facets; the result is the same
  template <typename ConcurrencyTag = Sequential_tag>
  std::optional<std::vector<std::pair<Face_index, int> > > crossings(const Point_3& p, const Point_3& q) const;

private:
  class Facets;
  std::shared_ptr<const Facets> m_facets;
};

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_CROSSING_COUNTER_3_H
