// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Projection/Flow_differential_impl.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Facet_on_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncated_facets_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map_impl.h>
#include <CGAL/Bspline_shell_3/Projection/internal/component_paths.h>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template class Facet_on_curve<Bspline_shell_3<> >;
template class Facet_on_curve<
  Bspline_shell_3<Hierarchical_bspline_field_3<>, Spline_threshold<Hierarchical_bspline_field_3<> > > >;

template bool share_components(const Bspline_shell_3<>&, const Projection_facets_3&, const Projection_facets_3&);
template bool share_components(
  const Bspline_shell_3<Hierarchical_bspline_field_3<>, Spline_threshold<Hierarchical_bspline_field_3<> > >&,
  const Projection_facets_3&, const Projection_facets_3&);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL
