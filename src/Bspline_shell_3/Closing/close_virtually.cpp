// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Closing/close_virtually_impl.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template Virtual_closing close_virtually<Sequential_tag>(const Mesh_with_origins::Triangle_mesh&, double,
                                                         Closing_report&, const Hole_predicate&);
#ifdef CGAL_LINKED_WITH_TBB
template Virtual_closing close_virtually<Parallel_tag>(const Mesh_with_origins::Triangle_mesh&, double, Closing_report&,
                                                       const Hole_predicate&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
