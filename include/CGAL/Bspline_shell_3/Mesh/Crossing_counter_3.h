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
 * \brief finds, exactly, the facets of a closed mesh that a segment crosses, with the direction of each crossing.
 *
 * For an open mesh, the number of crossings has no meaning. Const member functions may be called concurrently.
 *
 * \cgalHeading{Cost} The first segments are compared with all facets, which takes less time than building a tree; a
 *   tree is built for further segments.
 */
class Crossing_counter_3
{
public:
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef Surface_mesh<Point_3> Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;

  /// \pre `mesh` outlives this object
  explicit Crossing_counter_3(const Triangle_mesh& mesh);
  explicit Crossing_counter_3(const Triangle_mesh&&) = delete; // the reference would dangle

  /// returns the facets that the segment crosses in their interiors, in the order of `faces(mesh)`. The sign of each is
  /// 1 if the segment crosses from back to front, and -1 otherwise. Returns nothing if the segment touches an edge or a
  /// vertex or ends on a facet; use another segment.
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`, for the comparison with
  ///   all facets; the result is the same
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
