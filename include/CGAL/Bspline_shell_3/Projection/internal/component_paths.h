// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_COMPONENT_PATHS_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_COMPONENT_PATHS_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Certificate/segment_through_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The facets of a mesh with its components.
struct Facets_by_component
{
  explicit Facets_by_component(const Projection_facets_3& all) : facets(all)
  {
    component = all.components(number_of_components);
  }

  const Projection_facets_3& facets;
  std::size_t number_of_components;
  std::vector<Projection_facets_3::Index> component; // by facet
};

// Returns paths through the components of a shell in which the components of a mesh lie, each through a large facet. A
// path has the index of the mesh's component. The predicates prove the paths; no certificate of the shell is needed.
template <typename Shell>
std::vector<Crossing_path> component_paths(const Shell& shell, const Facets_by_component& mesh)
{
  typedef typename Shell::Point_3 Point_3;
  typedef Projection_facets_3::Index Index;
  constexpr std::size_t max_paths = 3, max_facets = 16; // paths per component; facets to try
  std::vector<std::vector<std::pair<double, Index> > > facets(mesh.number_of_components);
  for(Index f = 0; f < mesh.facets.number_of_facets(); ++f) {
    const auto& n = mesh.facets.normal(f);
    facets[mesh.component[f]].emplace_back(-dot(n, n), f);
  }
  const Field_predicates_3<typename Shell::Field> predicates(shell.field());
  const auto& inner = shell.inner_threshold();
  const auto& outer = shell.outer_threshold();
  std::vector<Crossing_path> paths;
  for(std::size_t c = 0; c < facets.size(); ++c) {
    const std::size_t tries = (std::min)(max_facets, facets[c].size()), before = paths.size();
    std::partial_sort(facets[c].begin(), facets[c].begin() + std::ptrdiff_t(tries), facets[c].end());
    for(std::size_t n = 0; n < tries && paths.size() < before + max_paths; ++n) {
      // The centroid is avoided, because edges of regular meshes may project onto it.
      const auto p = mesh.facets.point(facets[c][n].second, { 0.29, 0.33, 0.38 });
      const Point_3 middle(p[0], p[1], p[2]);
      if(shell.bounded_side(middle) == ON_UNBOUNDED_SIDE) continue;
      const auto segment = segment_through_shell(predicates, inner, outer, middle);
      if(!segment) continue;
      const auto coordinates = [](const Point_3& q) { return std::array<double, 3>{ q[0], q[1], q[2] }; };
      paths.push_back({ c, std::size_t(facets[c][n].second), coordinates((*segment)[0]), coordinates((*segment)[1]) });
    }
  }
  return paths;
}

// Returns whether each component of two meshes shares a component of the shell with a component of the other mesh. If
// the two meshes are in the shell, a path through one of them that crosses the other proves this. `false` means
// unknown.
template <typename Shell>
bool share_components(const Shell& shell, const Projection_facets_3& first, const Projection_facets_3& second)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point;
  if(arithmetic_self_test() != Arithmetic_status::SOUND) return false;
  Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // required by exact predicates
  const std::array<Facets_by_component, 2> meshes = { Facets_by_component(first), Facets_by_component(second) };
  std::array<std::vector<char>, 2> has_partner;
  for(int i = 0; i < 2; ++i) has_partner[i].assign(meshes[i].number_of_components, 0);
  for(int i = 0; i < 2; ++i) {
    const Facets_by_component& other = meshes[1 - i];
    const auto triangle = [&](std::size_t n) {
      std::array<Point, 3> t;
      for(int j = 0; j < 3; ++j) {
        const auto& p = other.facets.vertex(Projection_facets_3::Index(n), j);
        t[j] = Point(p[0], p[1], p[2]);
      }
      return t;
    };
    const auto component = [&](std::size_t n) { return std::size_t(other.component[n]); };
    // partners of the components of the other mesh among those of this mesh
    const std::vector<std::size_t> partner = match_components(component_paths(shell, meshes[i]),
                                                              other.number_of_components,
                                                              other.facets.number_of_facets(), triangle, component)
                                               .component_of_shell;
    for(std::size_t c = 0; c < partner.size(); ++c)
      if(partner[c] != Component_match::none) has_partner[1 - i][c] = has_partner[i][partner[c]] = 1;
  }
  return std::all_of(has_partner.begin(), has_partner.end(),
                     [](const std::vector<char>& all) { return std::find(all.begin(), all.end(), 0) == all.end(); });
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template bool share_components(const Bspline_shell_3<>&, const Projection_facets_3&, const Projection_facets_3&);
extern template bool share_components(const Certified_bspline_shell_3&, const Projection_facets_3&,
                                      const Projection_facets_3&);
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_COMPONENT_PATHS_H
