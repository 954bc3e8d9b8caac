// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_OPTIONS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_OPTIONS_H

#include <CGAL/Bspline_shell_3/Editing/internal/Edit_options.h>

#include <boost/graph/graph_traits.hpp>

#include <functional>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The options of remeshing; `Point` is that of shells.
template <typename TriangleMesh, typename Point>
struct Remeshing_options : Edit_options<TriangleMesh>
{
  std::function<double(const Point&)> target_length;
  // Vertices that must not move; empty if there are none.
  std::function<bool(typename boost::graph_traits<TriangleMesh>::vertex_descriptor)> is_vertex_constrained;
  bool protects_constraints = false;
  unsigned int iterations = 3, relaxations = 2;
  bool projects = true;
  // Returns whether a facet may be created; may be called concurrently. Empty if all may.
  std::function<bool(const Point&, const Point&, const Point&)> permits_facet;
  std::function<bool(unsigned int)> start_iteration;
  std::function<bool()> go_on; // returns false to end the edit
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_REMESHING_OPTIONS_H
