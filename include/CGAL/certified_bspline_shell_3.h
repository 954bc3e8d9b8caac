// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_BSPLINE_SHELL_3_H
#define CGAL_CERTIFIED_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/refine_until_certified.h>

#include <CGAL/tags.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/// \ingroup PkgBsplineShell3Ref
/// the shell that `certified_bspline_shell_3()` builds: a hierarchy of cells, and thresholds that vary in space
typedef Bspline_shell_3<Bspline_shells::Hierarchical_bspline_field_3<>,
                        Bspline_shells::Spline_threshold<Bspline_shells::Hierarchical_bspline_field_3<> > >
  Certified_bspline_shell_3;

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a certified cubic B-spline shell of a closed mesh.
 *
 * The mesh is checked first; what a shell cannot be built for is refused with a status and the offending simplices.
 * Polygonal facets are triangulated. A field is fitted on coarse cells around the mesh; cells are halved where the field is
 * too large on the mesh for the thickness asked for, and where the certificate fails, until all claims are proved, no
 * refinement can help, or a limit is reached (`Certified_refinement`). The thresholds are half the thickness away from the mesh,
 * and nearer where thin parts and narrow gaps demand it.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of named parameters, begun in `CGAL::Bspline_shells::parameters` or
 *         `CGAL::parameters`
 *
 * \param mesh the mesh; its facets may face either side of the volume that it bounds, and the field grows the way they
 *        face
 * \param np optional named parameters:
 *   - `relative_thickness(double)`: the largest thickness of the shell, as a part of the longest side of the mesh's box;
 *     default 0.01
 *   - `thickness(double)`: instead, in user units
 *   - `sizing(F)`: instead, a function that returns the thickness near a point, user units: positive and finite
 *   - `constant_thresholds(bool)`: the same two levels everywhere, the tightest ones, as in the paper; default `false`. Thin
 *     parts and narrow gaps then ask for a thinner shell, and smaller cells, everywhere.
 *   - `resolution(double)`: root cells per longest side of the mesh's box; default 30
 *   - `time_limit(double)`: seconds; no round of refinement begins that is expected to end later. Unlimited by default.
 *   - `memory_limit(double)`: bytes, about, above which no new round begins; default 4e9
 *   - `energy_weights(Bspline_shells::Energy_weights)`, `spd_solver(S)`, `signed_distance_oracle(O)`,
 *     `allow_self_intersections(bool)`, `allow_singular_vertices(bool)`, `visitor(V)`, `vertex_point_map(VPM)`: as for
 *     `bspline_shell_3()`
 *
 * \return a shell that certainly contains the mesh, or none and the reason (`Bspline_shell_3::status()`). Whether it is certified, and why
 *         not, `Bspline_shell_3::is_certified()`, `Bspline_shell_3::message()` and the report tell.
 * \cgalHeading{Cost} linear in the number of cells, most of which are small ones along creases and thin parts, and in the
 * number of facets
 */
template <typename ConcurrencyTag = Parallel_if_available_tag,
          typename PolygonMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
Certified_bspline_shell_3 certified_bspline_shell_3(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  typedef Certified_bspline_shell_3 Shell;
  typedef Shell::Field Field;
  typedef BS::Shell_status Status;
  typedef BS::Shell_step Step;
  constexpr double unlimited = std::numeric_limits<double>::infinity();

  const double resolution = choose_parameter(get_parameter(np, tags::resolution), 30.);
  const double relative_thickness = choose_parameter(get_parameter(np, tags::relative_thickness), 0.01);
  const double absolute_thickness = choose_parameter(get_parameter(np, tags::thickness), 0.);
  constexpr bool has_absolute_thickness = !is_default_parameter<CGAL_NP_CLASS, tags::thickness_t>::value;
  constexpr bool has_sizing = !is_default_parameter<CGAL_NP_CLASS, tags::sizing_t>::value;
  BS::Refinement_parameters parameters;
  parameters.weights = choose_parameter(get_parameter(np, tags::energy_weights), parameters.weights);
  parameters.constant_thresholds = choose_parameter(get_parameter(np, tags::constant_thresholds), false);
  parameters.max_seconds = choose_parameter(get_parameter(np, tags::time_limit), unlimited);
  parameters.max_bytes = choose_parameter(get_parameter(np, tags::memory_limit), 4e9);
  // the certificate makes the accuracy of the solver a matter of speed
  constexpr double tolerance = 1e-4;
  auto&& solver = BS::internal::argument<BS::Conjugate_gradient_solver<ConcurrencyTag> >(np, tags::spd_solver, tolerance);
  auto&& visitor = BS::internal::argument<BS::Default_shell_visitor>(np, internal_np::visitor);

  BS::Shell_construction construction(visitor);
  BS::Shell_report& report = construction.report;
  const auto start = [&](Step step) { return construction.start(step); };
  const auto stop = [&](Status status) { return Shell(construction.end(status)); };

  if(!(std::isfinite(resolution) && resolution > 0 && relative_thickness > 0 && std::isfinite(relative_thickness)
       && (!has_absolute_thickness || (absolute_thickness > 0 && std::isfinite(absolute_thickness)))
       && parameters.max_seconds > 0 && parameters.max_bytes > 0 && parameters.weights.are_valid()))
    return stop(Status::INVALID_PARAMETER);

  const Status checked = construction.template check<ConcurrencyTag>(mesh, np);
  if(checked != Status::SUCCESS) return stop(checked);
  const std::shared_ptr<const BS::Input_mesh_3>& input = construction.input;

  if(!start(Step::CELLS)) return stop(Status::CANCELED);
  const Status has_lattice = construction.choose_lattice(input->unit() / resolution);
  if(has_lattice != Status::SUCCESS) return stop(has_lattice);
  const BS::Lattice_3& lattice = construction.lattice;
  const double largest_thickness = has_absolute_thickness ? absolute_thickness : relative_thickness * input->unit();
  bool is_thickness_valid = true;
  const auto thickness = [&](const Field::Point_3& p) -> double {
    if constexpr(has_sizing) {
      const double t = get_parameter_reference(np, tags::sizing)(p);
      if(t > 0 && std::isfinite(t)) return t;
      is_thickness_valid = false;       // and nothing is done with what is returned
    }
    (void)p;
    return largest_thickness;
  };
  const std::vector<std::uint64_t> surface_keys = BS::cells_entered_by_mesh<ConcurrencyTag>(*input, lattice);
  report.surface_cells = surface_keys.size();
  // room for the shell beyond the cells at the mesh
  constexpr double most_rings = 20;
  const double rings = 1 + std::floor(has_sizing ? 0 : largest_thickness / lattice.spacing());
  if(!(rings <= most_rings)) return stop(Status::INVALID_PARAMETER);
  if(double(surface_keys.size()) * 1e4 > parameters.max_bytes) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  BS::Cell_hierarchy_3 cells(BS::Cell_complex_3(lattice, BS::dilate(surface_keys, -int(rings), int(rings))));

  const auto refine = [&](const auto& oracle) {
    typedef std::remove_cv_t<std::remove_reference_t<decltype(oracle)> > Oracle;
    BS::Certified_refinement<ConcurrencyTag, Oracle> refinement(input, oracle, parameters);
    const BS::Refinement_status refined = refinement(std::move(cells), thickness, solver,
                                                     [&](Step step) { return is_thickness_valid && start(step); });
    if(!is_thickness_valid) return stop(Status::INVALID_PARAMETER);
    report.rounds = refinement.rounds();
    report.refinement = refined;
    if(refined == BS::Refinement_status::CANCELED) return stop(Status::CANCELED);
    if(refined == BS::Refinement_status::DISTANCE_NOT_FINITE) return stop(Status::DISTANCE_NOT_FINITE);
    if(refined == BS::Refinement_status::SOLVER_FAILED) return stop(Status::SOLVER_FAILED);
    report.cells = refinement.field().number_of_cells();
    report.unknowns = refinement.field().number_of_coefficients();
    report.certificate = refinement.certificate()->report();
    if(refinement.certificate()->status() != Status::SUCCESS) return stop(refinement.certificate()->status());
    if(report.certificate.verdict(BS::Claim::CONTAINMENT) != BS::Verdict::PROVED) return stop(Status::MESH_NOT_CONTAINED);
    std::tie(report.thickness, report.narrowed_area) = refinement.thickness_on_mesh(thickness);
    std::vector<char> shell_cells(report.cells, 0);
    if(refinement.certificate()->cover())
      for(const BS::Cover_box& box : refinement.certificate()->cover()->boxes())
        if(box.component != BS::Cover_box::no_component) shell_cells[box.cell] = 1;
    std::vector<BS::Level_range> facets(input->number_of_facets_of_origin());
    for(auto f : input->mesh().faces()) facets[input->facet_of_origin(f)].include(refinement.ranges().facet[f]);
    Shell shell(refinement.field(), refinement.inner(), refinement.outer(), std::move(shell_cells), std::move(facets),
                construction.end(Status::SUCCESS));
    if(report.certificate.verdict(BS::Claim::GRADIENT) == BS::Verdict::PROVED)
      shell.set_proved_cover(refinement.certificate()->cover()->boxes());
    return shell;
  };
  if constexpr(is_default_parameter<CGAL_NP_CLASS, tags::signed_distance_oracle_t>::value)
    return refine(BS::Mesh_signed_distance_3(*input));
  else
    return refine(static_cast<const std::remove_reference_t<decltype(get_parameter_reference(np, tags::signed_distance_oracle))>&>(
      get_parameter_reference(np, tags::signed_distance_oracle)));
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_BSPLINE_SHELL_3_H
