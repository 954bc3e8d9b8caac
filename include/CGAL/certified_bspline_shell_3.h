// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_BSPLINE_SHELL_3_H
#define CGAL_CERTIFIED_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Closing/close_virtually.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/build_certified_shell.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Truncation/truncate_mesh.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a certified cubic B-spline shell of a mesh.
 *
 * An open mesh is closed first, by triangles that the shell keeps (`Bspline_shell_3::closing()`): caps of its holes, or
 * a sheet behind it. They are part of what is certified, and of no result: maps, edits and certificates take open
 * meshes with the same border, and leave it as it is.
 *
 * The mesh is checked first; what a shell cannot be built for is refused with a status and the offending simplices.
 * Polygonal facets are triangulated. A field is fitted on coarse cells around the mesh; cells are halved where the
 * field is too large on the mesh for the thickness asked for, and where the certificate fails, until all claims are
 * proved, no refinement can help, or a limit is reached (`Certified_refinement`). The thresholds are half the thickness
 * away from the mesh, and nearer where thin parts and narrow gaps demand it.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of named parameters, begun in `CGAL::Bspline_shells::parameters` or
 *         `CGAL::parameters`
 *
 * \param mesh the mesh; its facets may face either side of the volume that it bounds, and the field grows the way they
 *        face
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{relative_thickness}
 *       \cgalParamDescription{the largest thickness of the shell, as a part of the longest side of the mesh's box;
 *         positive, and less than twenty root cells}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0.01}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{thickness}
 *       \cgalParamDescription{instead, in user units; the same bounds}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{sizing}
 *       \cgalParamDescription{instead, a function that returns the thickness near a point, user units: positive and
 *         finite. Several threads call it at once, unless `ConcurrencyTag` is `Sequential_tag`.}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{constant_thresholds}
 *       \cgalParamDescription{the same two levels everywhere, the tightest ones, as in the paper. Thin parts and narrow
 *         gaps then ask for a thinner shell, and smaller cells, everywhere.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{resolution}
 *       \cgalParamDescription{root cells per longest side of the mesh's box, positive; default 30, or as few as 20
 *         where most of the mesh is nearly flat in wider cells (`Bspline_shells::choose_resolution()`)}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds, after which the construction ends with the status `TIME_LIMIT_EXCEEDED`, and no
 *         shell; unlimited by default. A limit that is not reached has no influence on the shell. The limit holds
 *         within each pass; the caller's own solver, oracle and sizing field are not interrupted.}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{effort_limit}
 *       \cgalParamDescription{the number of cells that may be fitted in all rounds of refinement together. After the
 *         first round, none begins that would exceed it. By default 1.5e6, which takes about a minute on two cores.
 *         Unlike a limit of time, it gives the same shell on every machine.}
 *       \cgalParamType{`double`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{memory_limit}
 *       \cgalParamDescription{bytes, about, above which no new round begins}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{4e9}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{virtual_closing}
 *       \cgalParamDescription{whether open meshes are closed, rather than refused}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`true`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{closing}
 *       \cgalParamDescription{instead, the triangles that close the mesh; they must have the same border, and only
 *         that}
 *       \cgalParamType{`Shell_closing_3`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{truncate}
 *       \cgalParamDescription{whether tips of the mesh are replaced (`Bspline_shell_3::truncation()`) where facets face
 *         no common direction, or hardly one; default `true`, unless self-intersections are allowed}
 *       \cgalParamType{`bool`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{least_cone_margin}
 *       \cgalParamDescription{for vertices with a smaller `Bspline_shells::vertex_cone_margin()`, between 0 and 1}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0.01}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{energy_weights}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *       \cgalParamType{`Bspline_shells::Energy_weights`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{spd_solver}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{signed_distance_oracle}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_self_intersections}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *       \cgalParamType{`bool`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{allow_singular_vertices}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *       \cgalParamType{`bool`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{vertex_point_map}
 *       \cgalParamDescription{as for `bspline_shell_3()`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *
 * \return a shell that certainly contains the mesh, or none and the reason (`Bspline_shell_3::status()`). If a
 *         parameter is not allowed, `Shell_report::invalid_parameter` has its name and its bounds. Whether it is
 *         certified, and why not, `Bspline_shell_3::is_certified()`, `Bspline_shell_3::message()` and the report tell.
 * \cgalHeading{Cost} linear in the number of cells, most of which are small ones along creases and thin parts, and in
 *   the number of facets
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
  // a copy, unless it was passed by reference
  [[maybe_unused]] auto&& sizing = get_parameter_reference(np, tags::sizing);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::sizing_t>::value)
    parameters.sizing = [&sizing](const Certified_bspline_shell_3::Point_3& p) { return double(sizing(p)); };
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
  BS::Input_mesh_3::Closer closer;
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::closing_t>::value)
    closer = BS::Input_mesh_3::closer(
      std::make_shared<const BS::Shell_closing_3>(get_parameter_reference(np, tags::closing)));
  else if(choose_parameter(get_parameter(np, tags::virtual_closing), true))
    closer = [&](const BS::Input_mesh_3::Triangle_mesh& open) {
      const Bbox_3 box = Polygon_mesh_processing::bbox(open);
      const double unit = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
      return BS::close_virtually<ConcurrencyTag>(open, parameters.closing_offset(unit), construction.report().closing);
    };
  BS::Input_mesh_3::Truncator truncator;
  if(choose_parameter(get_parameter(np, tags::truncate), true)
     && !choose_parameter(get_parameter(np, internal_np::allow_self_intersections), false))
    truncator = [&](const BS::Input_mesh_3& input) {
      const double thickness = parameters.largest_thickness(input.unit());
      return BS::truncate_mesh<ConcurrencyTag>(
        input,
        [&](const std::array<double, 3>& p) {
          const double here = parameters.sizing
                                ? parameters.sizing(Certified_bspline_shell_3::Point_3(p[0], p[1], p[2]))
                                : thickness;
          return parameters.largest_tip(here > 0 ? here : thickness);
        },
        parameters.least_cone_margin, construction.report().truncation);
    };
  return construction.run<Certified_bspline_shell_3>([&] {
    const BS::Shell_status checked = construction.check<ConcurrencyTag>(mesh, np, closer, truncator);
    if(checked != BS::Shell_status::SUCCESS) return Certified_bspline_shell_3(construction.end(checked));

    // a copy, unless it was passed by reference
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
