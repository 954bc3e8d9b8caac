// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H
#define CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H

#include <CGAL/Bspline_shell_3/Editing/Edit_result.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_status.h>
#include <CGAL/Bspline_shell_3/Editing/Remeshing_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edit_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_options.h>
#include <CGAL/Bspline_shell_3/Editing/internal/edit_under_proof.h>
#include <CGAL/Bspline_shell_3/Editing/internal/remesh.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief the result of `remesh_in_shell()`: the report, and the vertices of the result into which vertices were
 * collapsed.
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
 * An operation is done only if each facet that it creates is accepted, as in `simplify_in_shell()`; otherwise, it is
 * omitted or done in part. The result is certified as a whole; otherwise, the mesh is restored unless facets are
 * frozen. A certified result has no self-intersections. The integral curves map it one-to-one onto every other mesh
 * that is certified in the same shell, in particular the mesh for which a certified shell was built.
 *
 * The method follows *A remeshing approach to multiresolution modeling* (M. Botsch and L. Kobbelt, 2004). Each
 * iteration splits edges that are longer than 4/3 of the target length, and collapses edges that are shorter than 4/5
 * of it. It then flips edges toward six edges at each vertex, and moves vertices within the tangent plane toward the
 * centroid of their neighbors. Moved vertices return to the original mesh along the gradient. Before each iteration and
 * at the end, edges are flipped where this improves facets. Edges with an angle of more than about 25 degrees are not
 * flipped, and their vertices move only along them.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`, used for proofs and for
 *   moves of vertices; all give the same result
 * \tparam TriangleMesh a model of `MutableFaceGraph`, `FaceListGraph`, and `HalfedgeListGraph`; copyable, with points
 *   of a kernel whose `FT` is `double`
 * \tparam Sizing `double`, or a function from points to `double`
 *
 * \param mesh a closed mesh in the shell, or a mesh with the border of its closing (`closing`); often the mesh for
 *   which the shell was built. Unless it was edited, it is unchanged at the end. It may have been restored, in the
 *   cases and in the way that `simplify_in_shell()` describes. It was also restored if a length requested during the
 *   edit is invalid (`INVALID_PARAMETER`). Constrained edges that lead to a truncated tip end where the tip is cut off.
 * \param target_edge_length the length of edges, or a function that returns the length of edges near a point; in the
 *   units of the coordinates, positive and finite. There must be less than 2^30 facets. `Edit_report::end` is the
 *   reason why edges may have other lengths at the end.
 * \param shell a shell; it may be certified for another mesh
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{number_of_iterations}
 *       \cgalParamDescription{number of times that splits, collapses, flips, and moves are repeated}
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
 *         do not move. The edges are split into constrained halves, and collapsed along their polyline where two of
 *         them meet.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_is_constrained_map}
 *       \cgalParamDescription{vertices that are neither removed nor moved}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{protect_constraints}
 *       \cgalParamDescription{if `true`, constrained edges are neither split nor collapsed}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`, unlike in `simplify_in_shell()`}
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
 *         and their edges are not flipped, split, or collapsed. The facets at a vertex around which they do not wind
 *         exactly once are frozen as well, even if each of them is accepted. The other facets are edited; see
 *         `Edit_status::PARTIALLY_EDITED`.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{do_project}
 *       \cgalParamDescription{whether moved vertices return to the original mesh}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{approximate number of bytes for the mesh, the result, and its certificate. The estimate
 *         is 1200 bytes for each facet of the mesh, and for each equilateral triangle of the requested size that fits
 *         into its area; a `Surface_mesh` takes about a third of this. If the limit is exceeded, the status is
 *         `MEMORY_LIMIT_EXCEEDED`, and the mesh is untouched.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{4e9}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the status is `TIME_LIMIT_EXCEEDED` and the mesh is restored}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{filter}
 *       \cgalParamDescription{a model of `FacetFilter`, called for the facets that an operation would create, before
 *         the shell is tested. If it rejects one, the operation is omitted or done in part.}
 *       \cgalParamDefault{all facets may be created}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `RemeshingVisitor`, which can show progress or cancel; the mesh remeshed so
 *         far is then certified and kept}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{locate_vertices}
 *       \cgalParamDescription{whether `Edit_result::locations` is filled}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `mesh` to their points, which must accept new
 *         vertices. Unless `ConcurrencyTag` is `Sequential_tag`, it is read concurrently.}
 *       \cgalParamType{a model of `ReadWritePropertyMap`}
 *       \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \cgalHeading{Proofs} As for `simplify_in_shell()`. For a `Surface_mesh` without garbage and without frozen facets, a
 *   created facet is proved only if an estimate does not decide. If the edit is repeated, `target_edge_length` is
 *   called again from the beginning, and the map of constrained edges has its original values.
 *
 * \cgalHeading{Cost} An operation takes the time of the estimates or proofs for the facets at one vertex, and a move
 *   also that of a projection. Moves take most of the time; vertices without a common edge are moved concurrently.
 *   Other operations are sequential. The certificate takes as long as for any mesh in the shell. `locate_vertices`
 *   builds a search tree for the facets of the result, and projects each vertex.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename TriangleMesh, typename Sizing, typename Field,
          typename Threshold, typename CGAL_NP_TEMPLATE_PARAMETERS>
Remeshing_result<TriangleMesh> remesh_in_shell(TriangleMesh& mesh, const Sizing& target_edge_length,
                                               const Bspline_shell_3<Field, Threshold>& shell,
                                               const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  typedef typename GetGeomTraits<TriangleMesh, CGAL_NP_CLASS>::type Geom_traits;
  static_assert(std::is_same<typename Geom_traits::FT, double>::value,
                "The coordinates must be of type double: other types would be rounded.");
  typedef typename GetVertexPointMap<TriangleMesh, CGAL_NP_CLASS>::type Vertex_point_map;
  typedef typename boost::property_traits<Vertex_point_map>::value_type Point; // the mesh's
  typedef typename Field::Point_3 Point_3;                                     // the shell's
  typedef internal::Remeshing_options<TriangleMesh, Point_3> Options;

  Vertex_point_map vpm = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_property_map(vertex_point, mesh));
  Remeshing_result<TriangleMesh> result;
  const auto ended = [&](Edit_status status) {
    result.status = status;
    return result;
  };
  result.facets_before = result.facets = faces(mesh).size();
  Options options = internal::edit_options<ConcurrencyTag, Options>(mesh, vpm, shell, np, result);
  const Edit_status usable = internal::check_before_edits(mesh, vpm, shell, options.closing);
  if(usable != Edit_status::SUCCESS) return ended(usable);

  if constexpr(!is_default_parameter<CGAL_NP_CLASS, internal_np::edge_is_constrained_t>::value)
    static_assert(
      internal::is_writable_map<std::decay_t<decltype(get_parameter(np, internal_np::edge_is_constrained))> >,
      "The property map of constrained edges must be writable, because edges are split.");
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, internal_np::vertex_is_constrained_t>::value)
    options.is_vertex_constrained = [map = get_parameter(np, internal_np::vertex_is_constrained)](auto v) {
      return bool(get(map, v));
    };
  options.protects_constraints = choose_parameter(get_parameter(np, internal_np::protect_constraints),
                                                  options.protects_constraints);
  options.iterations = choose_parameter(get_parameter(np, internal_np::number_of_iterations), options.iterations);
  options.relaxations = choose_parameter(get_parameter(np, internal_np::number_of_relaxation_steps),
                                         options.relaxations);
  options.projects = choose_parameter(get_parameter(np, internal_np::do_project), options.projects);

  // An edge with an invalid target length is not changed, as it might be split forever; there is no result.
  double shortest = std::numeric_limits<double>::infinity();
  options.target_length = [&](const Point_3& p) {
    double length = 0;
    if constexpr(std::is_arithmetic<Sizing>::value) (void)p, length = double(target_edge_length);
    else length = target_edge_length(internal::converted<Point>(p));
    result.invalid_parameter.check("target_edge_length", length, Parameter_bounds::positive());
    if(result.invalid_parameter) return std::numeric_limits<double>::quiet_NaN();
    shortest = (std::min)(shortest, length);
    return length;
  };
  for(auto v : vertices(mesh)) options.target_length(internal::converted<Point_3>(get(vpm, v)));
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
    const double length = options.target_length(internal::converted<Point_3>(CGAL::centroid(p, q, r)));
    expected += std::sqrt(CGAL::squared_area(p, q, r)) / length / length / area_of_equilateral;
  }
  const double memory_limit = choose_parameter(get_parameter(np, parameter_tags::memory_limit), 4e9);
  result.invalid_parameter.check("memory_limit", memory_limit, Parameter_bounds::positive_or_infinite());
  // scaled to the largest number of facets
  if(!(expected < most_facets))
    result.invalid_parameter.check("target_edge_length", shortest, { shortest * std::sqrt(expected / most_facets) });
  if(result.invalid_parameter) return ended(Edit_status::INVALID_PARAMETER);
  if(!(bytes_per_facet * (double(result.facets_before) + expected) <= memory_limit))
    return ended(Edit_status::MEMORY_LIMIT_EXCEEDED);

  if constexpr(!is_default_parameter<CGAL_NP_CLASS, internal_np::filter_t>::value)
    options.permits_facet = [&](const Point_3& p, const Point_3& q, const Point_3& r) {
      return bool(get_parameter_reference(np, internal_np::filter)(
        internal::converted<Point>(p), internal::converted<Point>(q), internal::converted<Point>(r)));
    };
  auto&& visitor = internal::argument<Default_remeshing_visitor>(np, internal_np::visitor);
  options.start_iteration = [&](unsigned int n) { return bool(visitor.start_iteration(n)); };
  options.go_on = [&] { return !result.invalid_parameter && bool(visitor.go_on()); };
  const Edit_status status = internal::remesh<ConcurrencyTag>(mesh, vpm, shell, options, result);
  return ended(status);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_REMESH_IN_SHELL_H
