// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Construction/build_uniform_shell_impl.h>

#include <CGAL/tags.h>

#include <optional>

namespace CGAL {
namespace Bspline_shells {

template Bspline_shell_3<> build_uniform_shell<Sequential_tag>(Shell_construction&, const Uniform_shell_parameters&,
                                                               const std::optional<Any_signed_distance_3>&,
                                                               const Any_spd_solver&);
template Bspline_shell_3<> build_uniform_shell<Sequential_tag>(Shell_construction&, const Uniform_shell_parameters&,
                                                               const std::optional<Any_signed_distance_3>&);
#ifdef CGAL_LINKED_WITH_TBB
template Bspline_shell_3<> build_uniform_shell<Parallel_tag>(Shell_construction&, const Uniform_shell_parameters&,
                                                             const std::optional<Any_signed_distance_3>&,
                                                             const Any_spd_solver&);
template Bspline_shell_3<> build_uniform_shell<Parallel_tag>(Shell_construction&, const Uniform_shell_parameters&,
                                                             const std::optional<Any_signed_distance_3>&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
