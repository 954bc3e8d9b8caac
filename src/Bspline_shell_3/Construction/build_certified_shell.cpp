// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Construction/build_certified_shell_impl.h>

#include <CGAL/tags.h>

#include <optional>

namespace CGAL {
namespace Bspline_shells {

template Certified_bspline_shell_3 build_certified_shell<Sequential_tag>(Shell_construction&,
                                                                         const Certified_shell_parameters&,
                                                                         const std::optional<Any_signed_distance_3>&,
                                                                         const Any_spd_solver&);
template Certified_bspline_shell_3 build_certified_shell<Sequential_tag>(Shell_construction&,
                                                                         const Certified_shell_parameters&,
                                                                         const std::optional<Any_signed_distance_3>&);
#ifdef CGAL_LINKED_WITH_TBB
template Certified_bspline_shell_3 build_certified_shell<Parallel_tag>(Shell_construction&,
                                                                       const Certified_shell_parameters&,
                                                                       const std::optional<Any_signed_distance_3>&,
                                                                       const Any_spd_solver&);
template Certified_bspline_shell_3 build_certified_shell<Parallel_tag>(Shell_construction&,
                                                                       const Certified_shell_parameters&,
                                                                       const std::optional<Any_signed_distance_3>&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
