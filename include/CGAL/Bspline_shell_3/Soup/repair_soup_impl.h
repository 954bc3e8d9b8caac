// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/tidy_polygons.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE Shell_status
repair_soup(Polygon_soup soup, Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh,
            Soup_repairs& repairs, Offending_simplices& offenders)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  repairs = Soup_repairs();
  mesh.clear();
  const Shell_status checked = internal::check_soup(soup, offenders);
  if(checked != Shell_status::SUCCESS) return checked;
  const internal::Tidy_origins origin = internal::tidy_polygons(soup, repairs);
  if(soup.polygons.empty()) return Shell_status::EMPTY_MESH;

  const Shell_status status = internal::orient_soup(soup, offenders, repairs.reversed_polygons);
  if(status != Shell_status::SUCCESS) {
    for(std::size_t& f : offenders.facets) f = origin.polygon_of[f];
    for(std::size_t& v : offenders.vertices) v = origin.point_of[v];
    offenders.facets.erase(std::unique(offenders.facets.begin(), offenders.facets.end()), offenders.facets.end());
    return status;
  }
  if(!internal::triangulate(soup)) return Shell_status::DEGENERATE_FACET;
  internal::Run::poll();
  PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.polygons);
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  internal::Run::poll();
  const auto has_no_area = [&](auto f) { return PMP::is_degenerate_triangle_face(f, mesh); };
  repairs.degenerate_facets = std::size_t(std::count_if(mesh.faces().begin(), mesh.faces().end(), has_no_area));
  if(repairs.degenerate_facets > 0) {
    PMP::remove_degenerate_faces(mesh);
    mesh.collect_garbage();
    if(mesh.number_of_faces() == 0) return Shell_status::EMPTY_MESH;
    if(std::any_of(mesh.faces().begin(), mesh.faces().end(), has_no_area)) {
      mesh.clear();
      return Shell_status::DEGENERATE_FACET;
    }
  }
  return Shell_status::SUCCESS;
}

CGAL_BSPLINE_SHELL_3_INLINE bool orient_components(
  Surface_mesh<Exact_predicates_inexact_constructions_kernel::Point_3>& mesh)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  if(!CGAL::is_closed(mesh) || PMP::does_bound_a_volume(mesh)) return false;
  PMP::orient_to_bound_a_volume(mesh);
  return true;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_SOUP_IMPL_H
