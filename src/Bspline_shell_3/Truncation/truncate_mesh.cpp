// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh_impl.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template std::shared_ptr<const Shell_truncation_3> truncate_mesh<Sequential_tag>(
  const Mesh_with_origins&, const std::function<double(const std::array<double, 3>&)>&, double, Truncation_report&);
#ifdef CGAL_LINKED_WITH_TBB
template std::shared_ptr<const Shell_truncation_3> truncate_mesh<Parallel_tag>(
  const Mesh_with_origins&, const std::function<double(const std::array<double, 3>&)>&, double, Truncation_report&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
