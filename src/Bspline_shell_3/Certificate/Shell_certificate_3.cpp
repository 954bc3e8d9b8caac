// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>

namespace CGAL {
namespace Bspline_shells {

template bool Shell_certificate_3<>::verify<Parallel_if_available_tag>(std::shared_ptr<const Input_mesh_3>);
template bool Shell_certificate_3<Hierarchical_bspline_field_3<>, Spline_threshold<Hierarchical_bspline_field_3<> > >::
  verify<Parallel_if_available_tag>(std::shared_ptr<const Input_mesh_3>);

} // namespace Bspline_shells
} // namespace CGAL
