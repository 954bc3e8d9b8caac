// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3_impl.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3_impl.h>
#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup_impl.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3_impl.h>
#include <CGAL/Bspline_shell_3/Mesh/closable_fan_impl.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone_impl.h>

#include <CGAL/tags.h>

#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template std::optional<std::vector<std::pair<Crossing_counter_3::Face_index, int> > > Crossing_counter_3::crossings<
  Sequential_tag>(const Point_3&, const Point_3&) const;
#ifdef CGAL_LINKED_WITH_TBB
template std::optional<std::vector<std::pair<Crossing_counter_3::Face_index, int> > > Crossing_counter_3::crossings<
  Parallel_tag>(const Point_3&, const Point_3&) const;
#endif
template Shell_status Input_mesh_3::copy<Parallel_if_available_tag>(
  const Input_mesh_3::Triangle_mesh&, boost::property_map<Input_mesh_3::Triangle_mesh, vertex_point_t>::const_type);
template Shell_status Input_mesh_3::check<Sequential_tag>(const Tolerated_defects&, const Closer&, const Truncator&);
#ifdef CGAL_LINKED_WITH_TBB
template Shell_status Input_mesh_3::check<Parallel_tag>(const Tolerated_defects&, const Closer&, const Truncator&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
