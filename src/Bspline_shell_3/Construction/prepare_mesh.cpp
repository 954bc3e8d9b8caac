// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Construction/prepare_mesh_impl.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template Input_mesh_3 prepare_mesh<Sequential_tag>(Mesh_with_origins, const Input_mesh_3::Tolerated_defects&,
                                                   const Certified_shell_parameters&, Shell_report&);
#ifdef CGAL_LINKED_WITH_TBB
template Input_mesh_3 prepare_mesh<Parallel_tag>(Mesh_with_origins, const Input_mesh_3::Tolerated_defects&,
                                                 const Certified_shell_parameters&, Shell_report&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
