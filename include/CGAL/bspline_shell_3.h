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
 * \brief builds a cubic B-spline shell of a closed mesh on equal cells, without a certificate.
 *
 * First, the mesh is checked: an invalid mesh is rejected, and the report lists the facets or vertices at fault.
 * Polygonal facets are triangulated. Then a smooth function \f$f\f$, the *field*, is fitted to the signed distance, on
 * the cells that the mesh intersects and on layers of cells around them; its coefficients minimize the energy of
 * `Bspline_shells::Energy_weights`. Two constant thresholds enclose the values of \f$f\f$ on the mesh.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 *
 * \param mesh a closed, consistently oriented mesh; the field increases in the direction of the normals of its facets
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{resolution}
 *       \cgalParamDescription{number of cells along the longest side of the mesh's bounding box}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{50}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{grid_spacing}
 *       \cgalParamDescription{edge length of a cell in the units of the coordinates, used instead of `resolution`}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{from `resolution`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{number_of_rings}
 *       \cgalParamDescription{number of layers of cells around the cells that the mesh intersects}
 *       \cgalParamType{`int`}
 *       \cgalParamDefault{2; if the shell reaches the boundary of the cells, layers are added there, up to five times}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{dense_grid}
 *       \cgalParamDescription{if `true`, all cells of the mesh's bounding box and the layers around it are used}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{energy_weights}
 *       \cgalParamDescription{weights of the terms of the energy}
 *       \cgalParamType{`Bspline_shells::Energy_weights`}
 *       \cgalParamDefault{`mu` = 0.1, `zeta` = 1e5, all others 0}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{spd_solver}
 *       \cgalParamDescription{the linear solver, which is copied unless it is passed by `std::ref()`}
 *       \cgalParamType{a model of `SPDSolver`}
 *       \cgalParamDefault{`Bspline_shells::Conjugate_gradient_solver` with a tolerance of 1e-6}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{signed_distance_oracle}
 *       \cgalParamDescription{a function of a point, for example a lambda expression, used instead of the signed
 *         distance to the mesh; it is copied unless it is passed by `std::cref()`}
 *       \cgalParamType{a model of `SignedDistanceOracle_3`}
 *       \cgalParamDefault{the signed distance to the mesh (`Bspline_shells::Mesh_signed_distance_3`)}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{approximate number of bytes that the construction may use}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the construction ends with the status `TIME_LIMIT_EXCEEDED` and
 *         without a shell}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_self_intersections}
 *       \cgalParamDescription{if `true`, self-intersecting meshes are accepted; the sign of the distance at a point is
 *         then that of its closest facet. The shell of a self-intersecting mesh is not certified.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_singular_vertices}
 *       \cgalParamDescription{if `true`, meshes with singular vertices are accepted; their shells are not certified}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_open_shell}
 *       \cgalParamDescription{if `true`, a shell that reaches the boundary of the cells is accepted}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{receives the progress and can cancel the construction; it is copied unless it is passed
 *         by `std::ref()`}
 *       \cgalParamType{a model of `ShellVisitor`}
 *       \cgalParamDefault{`Bspline_shells::Default_shell_visitor`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{a property map from the vertices of `mesh` to their points}
 *       \cgalParamType{a model of `ReadablePropertyMap`}
 *       \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return the shell, which is proved to contain the mesh. If none was built, the returned object converts to `false`,
 *   and `Bspline_shell_3::status()` is the reason. If a parameter is invalid, `Shell_report::invalid_parameter`
 *   contains its name and bounds.
 * \cgalHeading{Cost} Time and memory grow with the number of cells, which is about proportional to the square of the
 *   resolution, or to its cube with `dense_grid`.
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
