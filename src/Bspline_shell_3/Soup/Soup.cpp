// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3_impl.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3_impl.h>
#include <CGAL/Bspline_shell_3/Soup/near_duplicates_impl.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup_impl.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup_impl.h>
#include <CGAL/Bspline_shell_3/Soup/wrap_soup_impl.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template Shell_status wrap_soup<Sequential_tag>(const Soup_mesh_3&, double, double, double, Soup_mesh_3::Mesh&,
                                                Proxy_report&);
#ifdef CGAL_LINKED_WITH_TBB
template Shell_status wrap_soup<Parallel_tag>(const Soup_mesh_3&, double, double, double, Soup_mesh_3::Mesh&,
                                              Proxy_report&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
