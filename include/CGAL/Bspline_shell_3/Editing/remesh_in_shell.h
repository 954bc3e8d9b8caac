// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H
#define CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H

#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/Bspline_shell_3/Editing/Remeshing_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Shell_remesher.h>
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the report of a remeshing, and the images of the vertices.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename TriangleMesh>
using Remeshing_result = Edit_result<Remeshing_report, TriangleMesh>;

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief remeshes a mesh in a shell: edges get about the requested length, and facets become nearly equilateral.
 *
 * After every operation, all facets still lie in the shell and face along the gradient. The result is certified anew:
 * it has no self-intersections, and the integral curves map it one-to-one onto the original mesh.
 *
 * The method follows M. Botsch, L. Kobbelt: A remeshing approach to multiresolution modeling, 2004. Each iteration
 * splits edges that are longer than 4/3 of the target length, and collapses edges that are shorter than 4/5 of it. It
 * then flips edges towards six edges at each vertex, and moves vertices within the tangent plane towards the centroid
 * of their neighbors. Moved vertices return to the original mesh, along the gradient. Before each iteration and at the
 * end, edges are flipped where this improves facets. Edges of more than about 25 degrees are not flipped, and their
 * vertices move only along them. An operation that the shell rejects is omitted or done in part.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`, for all proofs, and for the
 *   moves of vertices; the result is the same
 * \tparam TriangleMesh a model of `MutableFaceGraph`, `FaceListGraph` and `HalfedgeListGraph`, copyable, with points of
 *   any kernel whose `FT` is `double`
 * \tparam Sizing `double`, or a function from points to `double`
 *
 * \param mesh a closed mesh in the shell, or one that `Bspline_shell_3::closing()` closes; often the mesh that the
 *   shell was built for. If it is not edited, it is either untouched or restored. It is restored if the status is
 *   `NOT_CERTIFIED`, `TIME_LIMIT_EXCEEDED` or `NOT_CLOSABLE`, or `INVALID_PARAMETER` for a length that was requested
 *   between the vertices of the mesh. With the status `NOT_IN_SHELL`, it is restored in two cases: if it has tips that
 *   `Bspline_shell_3::truncation()` replaces, because it is truncated first; and if an estimate accepted all of its
 *   facets at first. The property maps of a restored `Surface_mesh` have their original values, and so has the map of
 *   constrained edges, wherever it stores them. The elements of other restored meshes are new: descriptors and other
 *   maps of the caller are invalid. Constrained edges that lead to a tip end where it is cut.
 * \param target_edge_length the length of edges, or a function that returns the length of edges near a point; user
 *   units, positive and finite. There must be less than 2^30 facets. `Edit_report::end` is the reason why edges may
 *   have other lengths at the end.
 * \param shell a shell; it may be certified for another mesh
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{number_of_iterations}
 *       \cgalParamType{`unsigned int`}
 *       \cgalParamDefault{3}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{number_of_relaxation_steps}
 *       \cgalParamDescription{number of times that vertices are moved in each iteration}
 *       \cgalParamType{`unsigned int`}
 *       \cgalParamDefault{2}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{edge_is_constrained_map}
 *       \cgalParamDescription{a model of `ReadWritePropertyMap`. Constrained edges are not flipped, and their vertices
 *         do not move. They are split into constrained halves, and collapsed along themselves where two of them meet.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_is_constrained_map}
 *       \cgalParamDescription{vertices that are neither removed nor moved}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{protect_constraints}
 *       \cgalParamDescription{if `true`, constrained edges are neither split nor collapsed; default `false`, unlike in
 *         `simplify_in_shell()`}
 *       \cgalParamType{`bool`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{freeze_rejected_facets}
 *       \cgalParamDescription{if `false`, the default, a mesh with facets that are not proved to lie in the shell and
 *         to face along the gradient is rejected. If `true`, these facets are frozen: none of their vertices is moved
 *         or removed, and none of their edges is flipped, split or collapsed. If all facets at a vertex are accepted,
 *         but their fan does not wind once, they are frozen, too. The other facets are edited; see
 *         `Edit_status::PARTIALLY_EDITED`.}
 *       \cgalParamType{`bool`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{do_project}
 *       \cgalParamDescription{whether vertices that move return to the original mesh}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{approximate number of bytes for the mesh, the result and its certificate. The estimate is
 *         1200 bytes for each facet of the mesh, and for each equilateral triangle of the requested size that fits into
 *         its area; a `Surface_mesh` takes about a third of this. If the limit is exceeded, the status is
 *         `MEMORY_LIMIT_EXCEEDED`, and the mesh is untouched.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{4e9}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the status is `TIME_LIMIT_EXCEEDED` and the mesh is restored;
 *         unlimited by default}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `RemeshingVisitor`, which can show progress or cancel. The operations that
 *         were done until then are certified and kept.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{locate_vertices}
 *       \cgalParamDescription{whether `Edit_result::locations` is filled}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{as in other \cgal packages. It is read by several threads at once, unless
 *         `ConcurrencyTag` is `Sequential_tag`. If the mesh is open, the map must accept new vertices, which close the
 *         mesh during the edit.}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \cgalHeading{Proofs} As for `simplify_in_shell()`. For a `Surface_mesh` without garbage and without frozen facets,
 *   facets are proved during the edit only where an estimate is doubtful. If the edit is repeated, `target_edge_length`
 *   is called again from the beginning, and the map of constrained edges has its original values.
 *
 * \cgalHeading{Cost} An operation costs the estimates or the proofs for the facets at one vertex, and a move also costs
 *   a projection. Moves take most of the time; vertices without a common edge are moved concurrently. Other operations
 *   are sequential. The certificate costs as much as for any mesh in the shell. Locations cost a tree of the result's
 *   facets, and a few microseconds per vertex and core.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename TriangleMesh, typename Sizing, typename Field,
          typename Threshold, typename CGAL_NP_TEMPLATE_PARAMETERS>
Remeshing_result<TriangleMesh> remesh_in_shell(TriangleMesh& mesh, const Sizing& target_edge_length,
                                               const Bspline_shell_3<Field, Threshold>& shell,
                                               const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  typedef typename GetGeomTraits<TriangleMesh, CGAL_NP_CLASS>::type Geom_traits;
  static_assert(std::is_same<typename Geom_traits::FT, double>::value,
                "The coordinates must be doubles: others would be rounded.");
  typedef typename GetVertexPointMap<TriangleMesh, CGAL_NP_CLASS>::type Vertex_point_map;
  typedef typename boost::property_traits<Vertex_point_map>::value_type Point; // the mesh's
  typedef typename boost::graph_traits<TriangleMesh>::edge_descriptor edge_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor;
  typedef Bspline_shell_3<Field, Threshold> Shell;
  typedef Edit_status Status;

  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, mesh));
  auto edge_is_constrained = choose_parameter(get_parameter(np, internal_np::edge_is_constrained),
                                              Static_boolean_property_map<edge_descriptor, false>());
  const auto vertex_is_constrained = choose_parameter(get_parameter(np, internal_np::vertex_is_constrained),
                                                      Static_boolean_property_map<vertex_descriptor, false>());

  Remeshing_result<TriangleMesh> result;
  const auto ended = [&](Status status) {
    result.status = status;
    return result;
  };
  result.facets_before = result.facets = faces(mesh).size();
  const Status usable = internal::check_before_edits(mesh, vpm, shell);
  if(usable != Status::SUCCESS) return ended(usable);

  // An edge with an invalid target length is not changed, as it might be split forever; there is no result.
  double shortest = std::numeric_limits<double>::infinity();
  const auto sizing = [&](const auto& p) -> double {
    double length = 0;
    if constexpr(std::is_arithmetic<Sizing>::value) (void)p, length = double(target_edge_length);
    else length = target_edge_length(internal::converted<Point>(p));
    result.invalid_parameter.check("target_edge_length", length, Parameter_bounds::positive());
    if(result.invalid_parameter) return std::numeric_limits<double>::quiet_NaN();
    shortest = (std::min)(shortest, length);
    return length;
  };
  for(auto v : vertices(mesh)) sizing(get(vpm, v));
  // Lengths in a wrong unit would require more facets than can be numbered or stored.
  constexpr double most_facets = double(1 << 30), area_of_equilateral = 0.433;
  // At the peak, with the certificate, a Surface_mesh takes 360 bytes for each facet, a Polyhedron_3 840; located
  // vertices add 280.
  constexpr double bytes_per_facet = 1200;
  double expected = 0;
  for(auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const Point &p = get(vpm, source(h, mesh)), &q = get(vpm, target(h, mesh)),
                &r = get(vpm, target(next(h, mesh), mesh));
    const double length = sizing(CGAL::centroid(p, q, r));
    expected += std::sqrt(CGAL::squared_area(p, q, r)) / length / length / area_of_equilateral;
  }
  const double memory_limit = choose_parameter(get_parameter(np, parameter_tags::memory_limit), 4e9);
  result.invalid_parameter.check("memory_limit", memory_limit, Parameter_bounds::positive_or_infinite());
  // scaled to the largest number of facets
  if(!(expected < most_facets))
    result.invalid_parameter.check("target_edge_length", shortest, { shortest * std::sqrt(expected / most_facets) });
  if(result.invalid_parameter) return ended(Status::INVALID_PARAMETER);
  if(!(bytes_per_facet * (double(result.facets_before) + expected) <= memory_limit))
    return ended(Status::MEMORY_LIMIT_EXCEEDED);

  auto&& visitor = internal::argument<Default_remeshing_visitor>(np, internal_np::visitor);
  const bool do_project = choose_parameter(get_parameter(np, internal_np::do_project), true);
  const bool protect = choose_parameter(get_parameter(np, internal_np::protect_constraints), false);
  const unsigned int iterations = choose_parameter(get_parameter(np, internal_np::number_of_iterations), 3u);
  const unsigned int relaxations = choose_parameter(get_parameter(np, internal_np::number_of_relaxation_steps), 2u);

  constexpr bool may_repeat = true;
  return ended(internal::edit_under_proof<ConcurrencyTag>(
    mesh, vpm, edge_is_constrained, shell, may_repeat, np, result,
    [&](const auto& oracle, const auto& frozen, const auto& all) {
      typedef std::remove_cv_t<std::remove_reference_t<decltype(oracle)> > Oracle;
      typedef Shell_projection_3<Shell, TriangleMesh> Projection;
      const Projection projection(shell, std::make_shared<const typename Projection::Target>(mesh, vpm));
      const auto project = [&](const auto& p) {
        const auto image = projection(p);
        return image ? image.point : p;
      };
      internal::Shell_remesher<TriangleMesh, Vertex_point_map, Oracle, std::remove_cv_t<decltype(sizing)>,
                               decltype(edge_is_constrained), std::remove_cv_t<decltype(vertex_is_constrained)> >
        remesher(
          mesh, vpm, oracle, sizing, frozen, edge_is_constrained, vertex_is_constrained, protect, all,
          [&] { return !result.invalid_parameter && bool(visitor.go_on()); }, result);
      for(unsigned int i = 0; i < iterations && remesher.goes_on(); ++i) {
        if(!visitor.start_iteration(i)) remesher.stop();
        remesher.flip_to_larger_angles();
        remesher.split_long_edges();
        remesher.collapse_short_edges();
        remesher.flip_to_regular_valences();
        for(unsigned int j = 0; j < relaxations; ++j)
          if(do_project) remesher.template relax<ConcurrencyTag>(project);
          else remesher.template relax<ConcurrencyTag>([](const auto& p) { return p; });
      }
      remesher.flip_to_larger_angles();
      result.images = remesher.images();
      if constexpr(!CGAL::parameters::is_default_parameter<CGAL_NP_CLASS, internal_np::edge_is_constrained_t>::value)
        for(auto e : edges(mesh)) result.constrained_edges += !frozen.closes(e) && get(edge_is_constrained, e) ? 1 : 0;
      result.end = remesher.end();
      return result.invalid_parameter ? Status::INVALID_PARAMETER : Status::SUCCESS;
    }));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H
