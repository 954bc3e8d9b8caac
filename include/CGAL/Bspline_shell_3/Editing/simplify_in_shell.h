// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFY_IN_SHELL_H
#define CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFY_IN_SHELL_H

#include <CGAL/Bspline_shell_3/Editing/Collapse_visitor.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Editing/Shell_filter.h>
#include <CGAL/Bspline_shell_3/Editing/Simplification_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Any_collapse_policies.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edit_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/collapse_edges.h>
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include <CGAL/Bspline_shell_3/Editing/stop_predicates.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <functional>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the result of `simplify_in_shell()`: the report, and for each original vertex, the vertex into which it was
 * merged.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename TriangleMesh>
using Simplification_result = Edit_result<Simplification_report, TriangleMesh>;

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief simplifies a mesh in a shell by edge collapses.
 *
 * An edge of positive length is collapsed only if all new facets are accepted, and wind exactly once around the new
 * vertex. A facet is accepted if it is proved or estimated (see *Proofs* below) to lie in the shell and to face along
 * the gradient. A facet faces along the gradient if its normal and the gradient form an acute angle at each of its
 * points. The result is certified as a whole; otherwise, the mesh is restored, or the status is `PARTIALLY_EDITED`
 * (`freeze_rejected_facets`). A certified result has no self-intersections. In a certified shell, the integral curves
 * map the result one-to-one onto every other mesh that is certified in it, such as the mesh for which it was
 * built. For simplified borders, see `border_tolerance`.
 *
 * Edges are collapsed by `CGAL::Surface_mesh_simplification::edge_collapse()` with `Shell_filter`, cheapest first. If
 * the policy's placement is rejected, up to five others are tried in order of increasing cost. Three are the ends and
 * the midpoint of the edge. The other two are the policy's placement and the midpoint, moved along the gradient to the
 * mean value of the field at the ends. A rejected edge is considered again when its neighborhood has changed. Edges of
 * length zero are collapsed first, which does not change the surface.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`, used for proofs; all give
 *   the same result
 * \tparam TriangleMesh a model of `MutableFaceGraph`, `FaceListGraph`, and `HalfedgeListGraph`; copyable, with points
 *   of a kernel whose `FT` is `double`
 *
 * \param mesh a closed mesh in the shell, or an open mesh whose border is that of `closing`; for example, the mesh for
 *   which the shell was built. If the status is neither `SUCCESS` nor `PARTIALLY_EDITED`, the surface is unchanged. It
 *   may have been edited and restored, namely with the statuses `NOT_CERTIFIED`, `TIME_LIMIT_EXCEEDED`, `NOT_CLOSABLE`,
 *   and sometimes `NOT_IN_SHELL`. A restored `Surface_mesh` has its original property maps. Other mesh types have new
 *   elements: descriptors and property maps of the caller are invalid, except for the map of constrained edges. In a
 *   result, constrained edges that lead to a truncated tip end where the tip is cut off.
 * \param shell a shell; it may be certified for another mesh
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{stop}
 *       \cgalParamDescription{a model of `StopPredicate`, such as `Facet_count_stop_predicate` or a predicate of \cgal.
 *         It is called for each edge that is considered, and can thus show progress or cancel; the mesh simplified so
 *         far is then certified and kept. By default, the mesh becomes as coarse as the shell allows.
 *         `Edit_report::end` is the reason why the simplification ended.}
 *       \cgalParamDefault{`Never_stop_predicate`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{get_cost}
 *       \cgalParamDescription{a model of `GetCost`, for example of another policy of \cgal; it must be given together
 *         with `get_placement`}
 *       \cgalParamDefault{`CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies`, plus 1e-10 times the
 *         squared length of the edge. Of the edges within a plane, short ones are thus collapsed first.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{get_placement}
 *       \cgalParamDescription{a model of `GetPlacement`; it must be given together with `get_cost`}
 *       \cgalParamDefault{`CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{filter}
 *       \cgalParamDescription{a model of `PlacementFilter`, called before the shell's filter for every placement that
 *         is tried; it is copied unless it is passed by `std::cref()`}
 *       \cgalParamDefault{`Permissive_filter`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `EdgeCollapseSimplificationVisitor`, which is copied unless it is passed by
 *         `std::ref()`. For a selected edge, the calls are `OnSelected()`, the stop predicate, the filter once for each
 *         placement that is tried, and then either `OnCollapsing()` and `OnCollapsed()`, or `OnNonCollapsable()`. A
 *         placement that costs much more than the policy's is deferred to a later pass over the edges, in which
 *         `OnCollected()` is called again.}
 *       \cgalParamDefault{`Default_collapse_visitor`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{edge_is_constrained_map}
 *       \cgalParamDescription{the constrained edges. Unless `protect_constraints` is `false`, they are kept, and their
 *         vertices do not move.}
 *       \cgalParamType{a model of `ReadablePropertyMap` from edges to `bool`; a model of `ReadWritePropertyMap` if
 *         `protect_constraints` is given}
 *       \cgalParamDefault{no edge is constrained}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{protect_constraints}
 *       \cgalParamDescription{if `true`, each constrained edge is kept. If `false`, as in `remesh_in_shell()` by
 *         default, polylines of constrained edges are simplified: a vertex where exactly two constrained edges meet may
 *         be merged into one of its neighbors along them. Ends, and vertices where more constrained edges meet, do not
 *         move. The vertices of a simplified polyline are vertices of the original one, at their positions;
 *         `Edit_report::constrained_edges` is the number of constrained edges of the result. The shell bounds the
 *         distance of a polyline from the mesh, but not its motion along the mesh, which only the costs or a `filter`
 *         limit. A constrained edge that shares a vertex with an edge of length zero is kept as long as the latter
 *         exists.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{border_tolerance}
 *       \cgalParamDescription{if positive, the border of an open mesh is simplified within this distance, in the units
 *         of the coordinates. A border vertex without constrained edges may be merged into one of its neighbors along
 *         the border; the remaining ones do not move. It is proved that every point of the original border is within
 *         this distance of the simplified border, and vice versa. `Edit_report::removed_border_edges` is the number of
 *         edges that the border loses. The result is certified with its own closing (`Edit_report::closing`). The map
 *         to it is one-to-one except for strips along the border (\ref BsplineShell3OpenBorder). If 0, the border is
 *         kept, bit for bit.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{closing}
 *       \cgalParamDescription{triangles that close the mesh if it is open, used instead of the shell's; often
 *         `Edit_report::closing` of an earlier edit}
 *       \cgalParamType{`Shell_closing_3`, or a shared pointer to one, which may be null}
 *       \cgalParamDefault{`Bspline_shell_3::closing()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{freeze_rejected_facets}
 *       \cgalParamDescription{if `false`, a mesh with facets that are not proved to lie in the shell and to face along
 *         the gradient is rejected. If `true`, these facets are frozen: their vertices are neither moved nor removed,
 *         and edges with a frozen vertex are not collapsed. If the facets around a vertex do not wind exactly once
 *         around it, they are frozen as well, even if each of them is accepted. The other facets are edited; see
 *         `Edit_status::PARTIALLY_EDITED`.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the status is `TIME_LIMIT_EXCEEDED` and the mesh is restored. To keep
 *         a partial result, use `stop`.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{locate_vertices}
 *       \cgalParamDescription{whether `Edit_result::locations` is filled}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `mesh` to their points. Unless `ConcurrencyTag` is
 *         `Sequential_tag`, it is read concurrently. If the mesh is open, or the shell is truncated, vertices are added
 *         during the edit, and the map must be able to store their points.}
 *       \cgalParamType{a model of `ReadWritePropertyMap`}
 *       \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return a report, which converts to `true` if the mesh was edited and the result is certified, and the images of the
 *   original vertices
 *
 * \cgalHeading{Proofs} The certificate proves the result, whatever was accepted before. Most facets that are created
 *   are removed later. During the edit, a facet is therefore proved only if an estimate from a few points is
 *   inconclusive. If the certificate then fails, and not because of the shell itself, the mesh is restored and
 *   simplified again with a proof for each facet (`Edit_report::is_repeated`). This is done only if the caller cannot
 *   observe it: for a `Surface_mesh` without garbage, and without a visitor, a filter, frozen facets, and stop
 *   predicates that may not be repeated (`Is_repeatable_stop_predicate`). Otherwise, every created facet is proved
 *   immediately. The costs of the policy are initialized again for the repetition, and a map of constrained edges has
 *   its original values.
 *
 * \cgalHeading{Cost} For each facet at the new vertex, a collapse evaluates the field at a few points, or proves it
 *   with a bound for each cell that it meets. The certificate takes as long as for any mesh in the shell. If it fails,
 *   the mesh may be simplified twice. `locate_vertices` builds a search tree for the facets of the result, and projects
 *   each vertex.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename TriangleMesh, typename Field,
          typename Threshold, typename CGAL_NP_TEMPLATE_PARAMETERS>
Simplification_result<TriangleMesh> simplify_in_shell(TriangleMesh& mesh,
                                                      const Bspline_shell_3<Field, Threshold>& shell,
                                                      const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace tags = parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  typedef typename GetGeomTraits<TriangleMesh, CGAL_NP_CLASS>::type Geom_traits;
  static_assert(std::is_same<typename Geom_traits::FT, double>::value,
                "The coordinates must be of type double: other types would be rounded.");
  typedef typename GetVertexPointMap<TriangleMesh, CGAL_NP_CLASS>::type Vertex_point_map;
  typedef internal::Collapse_options<TriangleMesh, Vertex_point_map, Geom_traits> Options;
  typedef typename Options::Profile Profile;

  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, mesh));
  Simplification_result<TriangleMesh> result;
  result.facets_before = result.facets = faces(mesh).size();
  Options options = internal::edit_options<ConcurrencyTag, Options>(mesh, vpm, shell, np, result);
  result.status = internal::check_before_edits(mesh, vpm, shell, options.closing);
  if(result.status != Edit_status::SUCCESS) return result;

  options.border_tolerance = choose_parameter(get_parameter(np, tags::border_tolerance), options.border_tolerance);
  result.invalid_parameter.check("border_tolerance", options.border_tolerance, Parameter_bounds::not_negative());
  constexpr bool has_constraints = !is_default_parameter<CGAL_NP_CLASS, internal_np::edge_is_constrained_t>::value;
  if constexpr(has_constraints && !is_default_parameter<CGAL_NP_CLASS, internal_np::protect_constraints_t>::value) {
    static_assert(
      internal::is_writable_map<std::decay_t<decltype(get_parameter(np, internal_np::edge_is_constrained))> >,
      "With protect_constraints, the property map of constrained edges must be writable.");
    options.protects_constraints = get_parameter(np, internal_np::protect_constraints);
  }
  auto&& visitor = internal::argument<Default_collapse_visitor>(np, internal_np::visitor);
  internal::Collapse_visitor_of<Profile, std::remove_reference_t<decltype(visitor)> > any_visitor(visitor);
  options.visitor = &any_visitor;
  const auto stop = choose_parameter<Never_stop_predicate>(get_parameter(np, tags::stop));
  options.stop = std::cref(stop);
  // a copy of a filter that was passed by value
  const auto& filter = [&]() -> decltype(auto) {
    if constexpr(is_default_parameter<CGAL_NP_CLASS, internal_np::filter_t>::value) return Permissive_filter();
    else return get_parameter_reference(np, internal_np::filter);
  }();
  options.filter = std::cref(filter);
  // The rollback before a repetition must not be observable.
  options.may_repeat = is_default_parameter<CGAL_NP_CLASS, internal_np::visitor_t>::value
                       && is_default_parameter<CGAL_NP_CLASS, internal_np::filter_t>::value
                       && Is_repeatable_stop_predicate<std::decay_t<decltype(stop)> >::value;

  constexpr bool has_cost = !is_default_parameter<CGAL_NP_CLASS, internal_np::get_cost_policy_t>::value;
  constexpr bool has_placement = !is_default_parameter<CGAL_NP_CLASS, internal_np::get_placement_policy_t>::value;
  static_assert(has_cost == has_placement,
                "Cost and placement belong together: pass both get_cost and get_placement, or neither.");
  if constexpr(has_cost) {
    const auto& cost = get_parameter_reference(np, internal_np::get_cost_policy);
    const auto& placement = get_parameter_reference(np, internal_np::get_placement_policy);
    const internal::Collapse_policy_of<Profile, std::decay_t<decltype(cost)>, std::decay_t<decltype(placement)> >
      policy(cost, placement);
    options.policy = &policy;
    result.status = internal::collapse_edges<ConcurrencyTag>(mesh, vpm, shell, options, result);
  } else {
    result.status = internal::collapse_edges<ConcurrencyTag>(mesh, vpm, shell, options, result);
  }
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_SIMPLIFY_IN_SHELL_H
