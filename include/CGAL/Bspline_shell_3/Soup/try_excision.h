// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_TRY_EXCISION_H
#define CGAL_BSPLINE_SHELL_3_SOUP_TRY_EXCISION_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include <CGAL/Bspline_shell_3/Soup/excise_until_certified.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether excision may remove the cause of an outcome.
inline bool may_help_excision(const Shell_of_soup_3& result)
{
  switch(result.mesh_status) {
    case Shell_status::NON_MANIFOLD:
    case Shell_status::NOT_ORIENTABLE:
    case Shell_status::NOT_CLOSABLE:
    case Shell_status::DEGENERATE_FACET:
    case Shell_status::SELF_INTERSECTION:
    case Shell_status::INCONSISTENT_ORIENTATION:
    case Shell_status::SINGULAR_VERTEX: return true;
    case Shell_status::SUCCESS: return !result.united && !result.shell_of_mesh.report().obstacles.empty();
    default: return false;
  }
}

// Returns the triangles of the polygons, or of the welded polygons if there are any. Their origins are the polygons in
// both cases.
inline Soup_triangles triangles_to_excise(const Polygon_soup& soup, const std::optional<Welded_soup>& welded)
{
  if(!welded) return different_triangles(soup);
  Soup_triangles triangles = different_triangles(welded->soup); // points keep their indices
  const std::vector<std::size_t>& polygon_of = welded->provenance.polygon_of;
  for(std::size_t& p : triangles.polygon_of) p = polygon_of[p];
  for(auto& duplicate : triangles.duplicates) duplicate.first = polygon_of[duplicate.first];
  return triangles;
}

// Excises triangles of a soup whose mesh has no certified shell, and stores the shell of the others if it is certified.
// \param build returns the shell of a mesh
template <typename Build>
void try_excision(const Polygon_soup& soup, const std::optional<Welded_soup>& welded, const Excision_limits& limits,
                  const Build& build, Shell_of_soup_3& result)
{
  if(!(limits.share > 0) || !may_help_excision(result)) return;
  Excised_soup_3 excised = choose_excision(triangles_to_excise(soup, welded));
  if(result.mesh_status == Shell_status::SUCCESS && excised) {
    const auto facets = facets_at_obstacles(excised.mesh(), result.shell_of_mesh.report().obstacles);
    if(!limits.permits(facets.size(), excised.mesh().number_of_faces())) return;
    std::vector<std::size_t> triangles;
    for(auto f : facets) triangles.push_back(excised.triangle_of(f));
    excised = excise_also(excised, triangles, Excision_reason::NOT_CERTIFIED);
  }
  const bool is_certified = excise_until_certified(excised, result.shell_of_excised, limits, build);
  result.excision_report = excised.report();
  result.excision_status = result.shell_of_excised.status();
  if(!result.invalid_parameter) result.invalid_parameter = result.shell_of_excised.report().invalid_parameter;
  if(!is_certified) return;
  result.excised = std::make_shared<const Excised_soup_3>(std::move(excised));
  if(!welded) return;
  result.weld = welded->report;
  result.weld_provenance = welded->provenance;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_TRY_EXCISION_H
