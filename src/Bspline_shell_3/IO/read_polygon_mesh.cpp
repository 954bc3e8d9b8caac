// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh_impl.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template void assign_soup(const Polygon_soup&, Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>&);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL
