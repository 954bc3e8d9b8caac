// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_EDGES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_EDGES_H

#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/Bspline_shell_3/Editing/Simplification_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Any_collapse_policies.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Collapse_rules.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edit_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/collapse_policies.h>
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_profile.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/tags.h>

#include <limits>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <typename TriangleMesh, typename VertexPointMap, typename GeomTraits>
struct Collapse_options : Edit_options<TriangleMesh>
{
  typedef Surface_mesh_simplification::Edge_profile<TriangleMesh, VertexPointMap, GeomTraits> Profile;

  bool protects_constraints = true;
  bool may_repeat = false;                              // only if the rollback cannot be observed
  const Any_collapse_policy<Profile>* policy = nullptr; // that of Garland and Heckbert if null
  Any_collapse_visitor<Profile>* visitor = nullptr;     // never null
  Collapse_stop_predicate<Profile> stop;
  Collapse_filter<Profile> filter;
};

// Collapses edges, cheapest first, as long as the shell allows it.
// pre: `check_before_edits()` accepts the mesh
template <typename ConcurrencyTag, typename TriangleMesh, typename VertexPointMap, typename GeomTraits, typename Field,
          typename Threshold>
Edit_status collapse_edges(TriangleMesh& mesh, VertexPointMap vpm, const Bspline_shell_3<Field, Threshold>& shell,
                           const Collapse_options<TriangleMesh, VertexPointMap, GeomTraits>& options,
                           Edit_result<Simplification_report, TriangleMesh>& result)
{
  namespace SMS = Surface_mesh_simplification;
  typedef typename Collapse_options<TriangleMesh, VertexPointMap, GeomTraits>::Profile Profile;
  typedef Collapse_rules<TriangleMesh, VertexPointMap> Rules;

  const auto edit = [&](const auto& oracle, auto& frozen, const auto& all) {
    typedef Shell_filter<std::decay_t<decltype(oracle)>, Collapse_filter<Profile> > Filter;
    const Filter filter(oracle, options.filter);
    Rules rules(mesh, vpm, options.constraints, options.protects_constraints, options.border_tolerance, frozen);
    Collapse_state state;
    state.closing_facets = rules.number_of_closing_facets();
    state.initial_edges = state.edges_without_closing(edges(mesh).size());
    Selecting_visitor<Profile, Rules> history(*options.visitor, mesh, rules, state);
    const auto collapse = [&](const Any_collapse_policy<Profile>& policy) {
      const Retrying_placement<Profile, Filter, Field, Rules> retrying(policy, filter, shell.field(), rules, state);
      history.start();
      // Placements that cost too much more than the policy's are deferred to later passes.
      for(double allowance : { 1., 16., 256., std::numeric_limits<double>::infinity() }) {
        state.allowance = allowance;
        state.has_deferred = false;
        SMS::edge_collapse(mesh, Continued_stop_predicate<Profile>{ &options.stop, &state },
                           CGAL::parameters::vertex_point_map(vpm)
                             .geom_traits(GeomTraits())
                             .edge_is_constrained_map(rules.kept_edges())
                             .get_cost(Continued_cost<Profile>{ &policy, &state })
                             .get_placement(retrying)
                             .filter(Accepted_filter{ &state })
                             .visitor(history));
        if(state.has_stopped || !state.has_deferred) break;
      }
      history.finish();
    };
    if(options.policy) {
      collapse(*options.policy);
    } else {
      const SMS::GarlandHeckbert_plane_policies<TriangleMesh, GeomTraits> policies(mesh);
      const Cost_with_length cost(policies.get_cost());
      const auto& placement = policies.get_placement();
      collapse(
        Collapse_policy_of<Profile, std::decay_t<decltype(cost)>, std::decay_t<decltype(placement)> >(cost, placement));
    }
    result.selected = history.history().selected;
    result.collapsed = history.history().collapsed;
    result.retried = state.retried;
    result.end = history.end();
    result.placements = filter.statistics();
    for(auto v : all) result.images.push_back(history.history().image(v));
    return Edit_status::SUCCESS;
  };
  return edit_under_proof<ConcurrencyTag>(mesh, vpm, shell, options.may_repeat, options, result, edit);
}

#ifdef CGAL_BSPLINE_SHELL_3_INSTANCES
extern template Edit_status collapse_edges<Parallel_if_available_tag>(
  Instance_mesh&, Instance_points, const Certified_bspline_shell_3&,
  const Collapse_options<Instance_mesh, Instance_points, Instance_kernel>&,
  Edit_result<Simplification_report, Instance_mesh>&);
#endif

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_COLLAPSE_EDGES_H
