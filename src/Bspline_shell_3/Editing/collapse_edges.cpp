// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Editing/internal/collapse_edges.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template Edit_status collapse_edges<Parallel_if_available_tag>(
  Instance_mesh&, Instance_points, const Certified_bspline_shell_3&,
  const Collapse_options<Instance_mesh, Instance_points, Instance_kernel>&,
  Edit_result<Simplification_report, Instance_mesh>&);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL
