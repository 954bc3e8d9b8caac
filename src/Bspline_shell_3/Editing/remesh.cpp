// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Editing/internal/remesh.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template Edit_status remesh<Parallel_if_available_tag>(
  Instance_mesh&, Instance_points, const Certified_bspline_shell_3&,
  const Remeshing_options<Instance_mesh, Instance_kernel::Point_3>&, Edit_result<Remeshing_report, Instance_mesh>&);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL
