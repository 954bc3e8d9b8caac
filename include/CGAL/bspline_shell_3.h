// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_H
#define CGAL_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/build_uniform_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <limits>
#include <optional>
#include <utility>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a cubic B-spline shell of a closed mesh.
 *
 * The mesh is checked first. Invalid meshes are rejected with a status and the offending simplices. Polygonal facets
 * are triangulated. The field is defined on the cells that the mesh intersects and on some rings of cells around them.
 * Its coefficients minimize the paper's energy. The two levels enclose the field's values on the mesh and are rounded
 * outwards.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of named parameters that begins in `CGAL::Bspline_shells::parameters` or
 *   `CGAL::parameters`
 *
 * \param mesh the mesh; its facets may be oriented either way, and the field increases in the direction that they face
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{resolution}
 *       \cgalParamDescription{the paper's \f$\gamma\f$: the number of cells per longest side of the mesh's bounding
 *         box}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{50}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{grid_spacing}
 *       \cgalParamDescription{edge length of a cell in user units, used instead of `resolution`}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{number_of_rings}
 *       \cgalParamDescription{rings of cells around the cells that the mesh intersects. By default two; rings are added
 *         up to five times if the shell would leave the cells.}
 *       \cgalParamType{`int`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{dense_grid}
 *       \cgalParamDescription{if `true`, all cells of the mesh's bounding box and some rings around it are used, as in
 *         the paper (whose energy is `Energy_weights::paper()`)}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{energy_weights}
 *       \cgalParamDescription{by default the paper's \f$\mu\f$ and \f$\zeta\f$, without \f$E_{singularH}\f$}
 *       \cgalParamType{`Bspline_shells::Energy_weights`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{spd_solver}
 *       \cgalParamDescription{a model of `SPDSolver`. Pass `std::ref(solver)` to inspect it afterwards.}
 *       \cgalParamDefault{`Bspline_shells::Conjugate_gradient_solver`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{signed_distance_oracle}
 *       \cgalParamDescription{a model of `SignedDistanceOracle_3`, used instead of the distance to the mesh. Pass
 *         `std::cref(oracle)` to avoid a copy.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{approximate number of bytes that the construction may use; unlimited by default}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the construction ends with the status `TIME_LIMIT_EXCEEDED` and
 *         without a shell; unlimited by default}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_self_intersections}
 *       \cgalParamDescription{if `true`, self-intersecting meshes are accepted. The side of a point is then that of its
 *         closest facet.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_singular_vertices}
 *       \cgalParamDescription{if `true`, meshes with singular vertices are accepted. The side of a point is then that
 *         of its closest facet.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_open_shell}
 *       \cgalParamDescription{if `true`, a shell that reaches the boundary of the cells is accepted}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `ShellVisitor`. Pass `std::ref(visitor)` to keep its state.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{as in other \cgal packages}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return a shell that is proved to contain the mesh, or no shell and the reason (`Bspline_shell_3::status()`). If a
 *   parameter is invalid, `Shell_report::invalid_parameter` contains its name and bounds.
 * \cgalHeading{Cost} Time and memory grow with the number of cells, which is about proportional to the square of the
 *   resolution.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename PolygonMesh,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shell_3<> bspline_shell_3(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  BS::Uniform_shell_parameters parameters;
  parameters.resolution = choose_parameter(get_parameter(np, tags::resolution), parameters.resolution);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, internal_np::grid_spacing_t>::value)
    parameters.spacing = get_parameter(np, internal_np::grid_spacing);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::number_of_rings_t>::value)
    parameters.rings = get_parameter(np, tags::number_of_rings);
  parameters.dense = choose_parameter(get_parameter(np, tags::dense_grid), parameters.dense);
  parameters.weights = choose_parameter(get_parameter(np, tags::energy_weights), parameters.weights);
  parameters.max_bytes = choose_parameter(get_parameter(np, tags::memory_limit), parameters.max_bytes);
  parameters.allow_open_shell = choose_parameter(get_parameter(np, tags::allow_open_shell),
                                                 parameters.allow_open_shell);

  auto&& visitor = BS::internal::argument<BS::Default_shell_visitor>(np, internal_np::visitor);
  const double max_seconds = choose_parameter(get_parameter(np, internal_np::maximum_running_time),
                                              std::numeric_limits<double>::infinity());
  BS::Shell_construction construction(visitor, max_seconds);
  BS::Invalid_parameter invalid = parameters.invalid();
  invalid.check("time_limit", max_seconds, BS::Parameter_bounds::positive_or_infinite());
  if(invalid) return Bspline_shell_3<>(construction.refuse(invalid));
  return construction.run<Bspline_shell_3<> >([&] {
    BS::Input_mesh_3 input;
    input.build<ConcurrencyTag>(
      mesh, choose_parameter(get_parameter(np, internal_np::vertex_point), get_const_property_map(vertex_point, mesh)),
      BS::tolerated_defects(np));
    const BS::Shell_status status = construction.take(std::move(input));
    if(status != BS::Shell_status::SUCCESS) return Bspline_shell_3<>(construction.end(status));

    // copied, unless passed by reference
    [[maybe_unused]] auto&& distance = get_parameter_reference(np, tags::signed_distance_oracle);
    std::optional<BS::Any_signed_distance_3> oracle;
    if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::signed_distance_oracle_t>::value) oracle.emplace(distance);
    if constexpr(is_default_parameter<CGAL_NP_CLASS, tags::spd_solver_t>::value)
      return BS::build_uniform_shell<ConcurrencyTag>(construction, parameters, oracle);
    else {
      auto&& solver = BS::internal::argument<void>(np, tags::spd_solver);
      return BS::build_uniform_shell<ConcurrencyTag>(construction, parameters, oracle, solver);
    }
  });
}

} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_H
