// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>

#include <CGAL/tags.h>

namespace CGAL {
namespace Bspline_shells {

template class Shell_facet_oracle_3<>;
template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>, Spline_threshold<Hierarchical_bspline_field_3<> > >;
#ifdef CGAL_LINKED_WITH_TBB
template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>, Constant_threshold, Parallel_tag>;
template class Shell_facet_oracle_3<Hierarchical_bspline_field_3<>, Spline_threshold<Hierarchical_bspline_field_3<> >,
                                    Parallel_tag>;
#endif

} // namespace Bspline_shells
} // namespace CGAL
