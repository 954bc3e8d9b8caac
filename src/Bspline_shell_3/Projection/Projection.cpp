// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Projection/Flow_differential_impl.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Facet_on_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Outermost_facet_on_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncated_facets_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/component_paths.h>
#include <CGAL/Bspline_shell_3/Projection/internal/trace_to_level.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template class Facet_on_curve<Bspline_shell_3<> >;
template class Facet_on_curve<Certified_bspline_shell_3>;
template class Outermost_facet_on_curve<Certified_bspline_shell_3>;

template bool share_components(const Bspline_shell_3<>&, const Projection_facets_3&, const Projection_facets_3&);
template bool share_components(const Certified_bspline_shell_3&, const Projection_facets_3&,
                               const Projection_facets_3&);

template Flow_status trace_to_level(const Bspline_shell_3<>&, double, const Flow_velocity::State&, double,
                                    Traced<Flow_velocity>&);
template Flow_status trace_to_level(const Certified_bspline_shell_3&, double, const Flow_velocity::State&, double,
                                    Traced<Flow_velocity>&);
template Flow_status trace_to_level(const Bspline_shell_3<>&, double, const Flow_velocity_with_differential::State&,
                                    double, Traced<Flow_velocity_with_differential>&);
template Flow_status trace_to_level(const Certified_bspline_shell_3&, double,
                                    const Flow_velocity_with_differential::State&, double,
                                    Traced<Flow_velocity_with_differential>&);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL
