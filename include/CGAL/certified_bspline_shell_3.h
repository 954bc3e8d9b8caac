// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_BSPLINE_SHELL_3_H
#define CGAL_CERTIFIED_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/build_certified_shell.h>
#include <CGAL/Bspline_shell_3/Construction/prepare_mesh.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a cubic B-spline shell of a mesh, and refines it until it is certified or a limit is reached.
 *
 * First, the mesh is checked: an invalid mesh is rejected, and the report lists the facets or vertices at fault.
 * Polygonal facets are triangulated. An open mesh is closed internally, by triangles that the shell stores
 * (`Bspline_shell_3::closing()`): caps of its holes, or a sheet behind it. These triangles are certified with the mesh,
 * but they are not part of any output. Maps, edits, and certificates accept every mesh with the same border. Edits keep
 * the border, unless `simplify_in_shell()` is called with `border_tolerance`.
 *
 * Then a smooth function \f$f\f$, the *field*, is fitted to the signed distance on coarse cells around the mesh. Cells
 * are split where \f$|f|\f$ is too large on the mesh for the requested thickness, and where the certificate fails.
 * Refinement ends when all claims are proved, when it no longer helps, or when a limit is reached;
 * `Bspline_shells::Shell_report::refinement` is the reason. The thresholds are values of \f$f\f$: minus and plus half
 * the requested thickness. They are closer to zero at thin parts and narrow gaps. If refinement ends early, they may be
 * farther from zero where \f$|f|\f$ is larger on the mesh.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 *
 * \param mesh a consistently oriented mesh; the field increases in the direction of the normals of its facets
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{relative_thickness}
 *       \cgalParamDescription{the requested thickness of the shell, as a fraction of the *box size*, the length of the
 *         longest side of the mesh's bounding box; positive, and less than 20 / `resolution`}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0.01}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{thickness}
 *       \cgalParamDescription{the requested thickness in the units of the coordinates, used instead of
 *         `relative_thickness`; same bounds, times the box size}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{`relative_thickness` of the box size}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{sizing}
 *       \cgalParamDescription{a function that returns the requested thickness near a point in the units of the
 *         coordinates, used instead of `relative_thickness` and `thickness`; its values must be positive and finite.
 *         Unless `ConcurrencyTag` is `Sequential_tag`, it is called concurrently.}
 *       \cgalParamType{a function object with `double operator()(const Certified_bspline_shell_3::Point_3&) const`}
 *       \cgalParamDefault{the constant `thickness`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{constant_thresholds}
 *       \cgalParamDescription{if `true`, the two thresholds are constant and as tight as possible. Thin parts and
 *         narrow gaps then require a thinner shell and smaller cells everywhere.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{resolution}
 *       \cgalParamDescription{number of cells along the longest side of the mesh's bounding box before any cell is
 *         split (*root cells*); positive}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{30; without `sizing`, 24 or 20 if the thickness is at least 1/110 of the box size and most of
 *         the mesh is nearly flat in wider cells (`Bspline_shells::choose_resolution()`)}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds after which the construction ends with the status `TIME_LIMIT_EXCEEDED` and
 *         without a shell. A limit that is not reached does not affect the shell. User-supplied solvers, oracles, and
 *         sizing fields are not interrupted.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{effort_limit}
 *       \cgalParamDescription{the total number of cells that may be fitted in all rounds of refinement. After the first
 *         round, a round that would exceed this number does not begin. Unlike a time limit, this limit does not make
 *         the shell depend on the speed of the machine; the default takes about a minute on two cores.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{1.5e6}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{approximate number of bytes. After the first round, a round that would need more does not
 *         begin. If the root cells that the mesh enters need more, no shell is built, and the status is
 *         `MEMORY_LIMIT_EXCEEDED`.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{4e9}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{virtual_closing}
 *       \cgalParamDescription{whether open meshes are closed; otherwise, they are rejected}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{hole_requires_cap}
 *       \cgalParamDescription{a function that returns, for a point on the border of the mesh as a
 *         `std::array<double, 3>`, whether its hole has to be closed by a cap. If this is impossible, the mesh is
 *         rejected; other holes may get a sheet behind the mesh instead. The points of a hole must have equal values.}
 *       \cgalParamType{a function object with `bool operator()(const std::array<double, 3>&) const`}
 *       \cgalParamDefault{`false` at all points}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{closing}
 *       \cgalParamDescription{triangles that close the mesh, used instead of a virtual closing; their border must equal
 *         that of the mesh}
 *       \cgalParamType{`Shell_closing_3`}
 *       \cgalParamDefault{a virtual closing}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{truncate}
 *       \cgalParamDescription{whether small discs replace the tips of the mesh internally
 *         (`Bspline_shell_3::truncation()`) at vertices with a small cone margin. Meshes are not truncated if
 *         self-intersections are allowed.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{least_cone_margin}
 *       \cgalParamDescription{vertices with a smaller `Bspline_shells::vertex_cone_margin()` are truncated if this at
 *         least doubles the margin; at least 0, and less than 1}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0.02}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{energy_weights}
 *       \cgalParamDescription{weights of the terms of the energy that the field minimizes. A given object replaces all
 *         defaults: members that are not set have the defaults of `bspline_shell_3()`.}
 *       \cgalParamType{`Bspline_shells::Energy_weights`}
 *       \cgalParamDefault{`normal` = 10, `surface` = 100, `coefficients` = 0.012, `mu` = 0, `singular_hessian` = 0}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{spd_solver}
 *       \cgalParamDescription{the linear solver, which is copied unless it is passed by `std::ref()`}
 *       \cgalParamType{a model of `SPDSolver`}
 *       \cgalParamDefault{`Bspline_shells::Conjugate_gradient_solver` with a tolerance of 1e-4}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{signed_distance_oracle}
 *       \cgalParamDescription{a function of a point, for example a lambda expression, used instead of the signed
 *         distance to the mesh; it is copied unless it is passed by `std::cref()`}
 *       \cgalParamType{a model of `SignedDistanceOracle_3`}
 *       \cgalParamDefault{the signed distance to the mesh (`Bspline_shells::Mesh_signed_distance_3`)}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_self_intersections}
 *       \cgalParamDescription{if `true`, self-intersecting meshes are accepted; the sign of the distance at a point is
 *         then that of its closest facet. The shell of a self-intersecting mesh is not certified.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_singular_vertices}
 *       \cgalParamDescription{if `true`, meshes with singular vertices that are not truncated are accepted; their
 *         shells are not certified}
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
 * \return the shell. It is proved to contain the mesh, or the truncated mesh if tips are truncated. If it is not
 *   certified (`Bspline_shell_3::is_certified()`), `Bspline_shell_3::message()` and the report give the reason. If no
 *   shell was built, the returned object converts to `false`, and `Bspline_shell_3::status()` is the reason. If a
 *   parameter is invalid, `Shell_report::invalid_parameter` contains its name and bounds.
 * \cgalHeading{Cost} Time and memory are about linear in the number of facets and in the number of cells. Most cells
 *   are small and lie along creases and thin parts.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename PolygonMesh,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Certified_bspline_shell_3 certified_bspline_shell_3(const PolygonMesh& mesh,
                                                    const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  BS::Certified_shell_parameters parameters;
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::resolution_t>::value)
    parameters.resolution = get_parameter(np, tags::resolution);
  parameters.relative_thickness = choose_parameter(get_parameter(np, tags::relative_thickness),
                                                   parameters.relative_thickness);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::thickness_t>::value)
    parameters.thickness = get_parameter(np, tags::thickness);
  // copied, unless passed by reference
  [[maybe_unused]] auto&& sizing = get_parameter_reference(np, tags::sizing);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::sizing_t>::value)
    parameters.sizing = [&sizing](const Certified_bspline_shell_3::Point_3& p) { return double(sizing(p)); };
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::closing_t>::value)
    parameters.closing = std::make_shared<const BS::Shell_closing_3>(get_parameter_reference(np, tags::closing));
  [[maybe_unused]] auto&& requires_cap = get_parameter_reference(np, tags::hole_requires_cap);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::hole_requires_cap_t>::value)
    parameters.hole_requires_cap = [&requires_cap](const std::array<double, 3>& p) { return bool(requires_cap(p)); };
  parameters.closes_virtually = choose_parameter(get_parameter(np, tags::virtual_closing), parameters.closes_virtually);
  parameters.truncates = choose_parameter(get_parameter(np, tags::truncate), parameters.truncates);
  parameters.least_cone_margin = choose_parameter(get_parameter(np, tags::least_cone_margin),
                                                  parameters.least_cone_margin);
  BS::Refinement_parameters& refinement = parameters.refinement;
  refinement.weights = choose_parameter(get_parameter(np, tags::energy_weights), refinement.weights);
  refinement.constant_thresholds = choose_parameter(get_parameter(np, tags::constant_thresholds),
                                                    refinement.constant_thresholds);
  refinement.max_cells = choose_parameter(get_parameter(np, tags::effort_limit), refinement.max_cells);
  refinement.max_bytes = choose_parameter(get_parameter(np, tags::memory_limit), 4e9);

  auto&& visitor = BS::internal::argument<BS::Default_shell_visitor>(np, internal_np::visitor);
  const double max_seconds = choose_parameter(get_parameter(np, internal_np::maximum_running_time),
                                              std::numeric_limits<double>::infinity());
  BS::Shell_construction construction(visitor, max_seconds);
  BS::Invalid_parameter invalid = parameters.invalid();
  invalid.check("time_limit", max_seconds, BS::Parameter_bounds::positive_or_infinite());
  if(invalid) return Certified_bspline_shell_3(construction.refuse(invalid));
  return construction.run<Certified_bspline_shell_3>([&] {
    const BS::Shell_status status = construction.take(BS::prepare_mesh<ConcurrencyTag>(
      mesh, choose_parameter(get_parameter(np, internal_np::vertex_point), get_const_property_map(vertex_point, mesh)),
      BS::tolerated_defects(np), parameters, construction.report()));
    if(status != BS::Shell_status::SUCCESS) return Certified_bspline_shell_3(construction.end(status));

    // copied, unless passed by reference
    [[maybe_unused]] auto&& distance = get_parameter_reference(np, tags::signed_distance_oracle);
    std::optional<BS::Any_signed_distance_3> oracle;
    if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::signed_distance_oracle_t>::value) oracle.emplace(distance);
    if constexpr(is_default_parameter<CGAL_NP_CLASS, tags::spd_solver_t>::value)
      return BS::build_certified_shell<ConcurrencyTag>(construction, parameters, oracle);
    else {
      auto&& solver = BS::internal::argument<void>(np, tags::spd_solver);
      return BS::build_certified_shell<ConcurrencyTag>(construction, parameters, oracle, solver);
    }
  });
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_BSPLINE_SHELL_3_H
