// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Soup/unite_parts_impl.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template Unite_report unite_parts<Sequential_tag>(const United_mesh::Mesh&, United_mesh&);
#ifdef CGAL_LINKED_WITH_TBB
template Unite_report unite_parts<Parallel_tag>(const United_mesh::Mesh&, United_mesh&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
