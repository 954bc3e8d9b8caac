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

#include <memory>
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
template Mesh_with_origins copy_mesh<Parallel_if_available_tag>(
  const Mesh_with_origins::Triangle_mesh&,
  boost::property_map<Mesh_with_origins::Triangle_mesh, vertex_point_t>::const_type);
template Shell_status Input_mesh_3::build<Sequential_tag>(Mesh_with_origins, const Tolerated_defects&,
                                                          std::shared_ptr<const Shell_closing_3>,
                                                          std::shared_ptr<const Shell_truncation_3>);
template Shell_status Input_mesh_3::take<Sequential_tag>(Mesh_with_origins, const Tolerated_defects&);
#ifdef CGAL_LINKED_WITH_TBB
template Shell_status Input_mesh_3::build<Parallel_tag>(Mesh_with_origins, const Tolerated_defects&,
                                                        std::shared_ptr<const Shell_closing_3>,
                                                        std::shared_ptr<const Shell_truncation_3>);
template Shell_status Input_mesh_3::take<Parallel_tag>(Mesh_with_origins, const Tolerated_defects&);
#endif

} // namespace Bspline_shells
} // namespace CGAL
