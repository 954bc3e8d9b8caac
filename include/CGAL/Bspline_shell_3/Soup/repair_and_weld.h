// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_AND_WELD_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_AND_WELD_H

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/boost/graph/helpers.h>

#include <optional>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Makes the mesh of a soup. If the repaired polygons have borders or are not manifold, they are welded and repaired
// again. The welded mesh is used if cracks were closed and it is a mesh. Returns the welded polygons if cracks were
// closed, even if they are not a mesh.
inline std::optional<Welded_soup> repair_and_weld(const Polygon_soup& soup, const Weld_parameters& parameters,
                                                  Shell_of_soup_3& result)
{
  result.mesh_status = repair_soup(soup, result.repaired_mesh, result.repairs, result.offending_simplices);
  const bool may_have_cracks = result.mesh_status == Shell_status::NON_MANIFOLD
                               || (result.mesh_status == Shell_status::SUCCESS
                                   && !CGAL::is_closed(result.repaired_mesh));
  if(!may_have_cracks) return std::nullopt;
  Welded_soup welded = weld_soup(soup, parameters);
  if(!welded.report.is_none()) {
    Shell_of_soup_3::Mesh mesh;
    Soup_repairs repairs; // the same repairs, but for the steps after welding
    Offending_simplices offenders;
    if(repair_soup(welded.soup, mesh, repairs, offenders) != Shell_status::SUCCESS) return welded;
    result.mesh_status = Shell_status::SUCCESS;
    result.offending_simplices = Offending_simplices();
    result.repaired_mesh = std::move(mesh);
    result.repairs.reversed_polygons = repairs.reversed_polygons;
    result.repairs.degenerate_facets = repairs.degenerate_facets;
    result.weld_provenance = welded.provenance;
  }
  result.weld = welded.report;
  if(welded.report.is_none()) return std::nullopt;
  return welded;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REPAIR_AND_WELD_H
