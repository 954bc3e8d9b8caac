// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_IMPL_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_problem.h>
#include <CGAL/Bspline_shell_3/Construction/Resolution_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/build_certified_shell.h>
#include <CGAL/Bspline_shell_3/Construction/choose_resolution.h>
#include <CGAL/Bspline_shell_3/Construction/refine_until_certified.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>

#include <CGAL/tags.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Certified_bspline_shell_3 build_certified_shell(Shell_construction& construction,
                                                const Certified_shell_parameters& parameters,
                                                const std::optional<Any_signed_distance_3>& oracle,
                                                const Any_spd_solver& solver)
{
  typedef Certified_bspline_shell_3 Shell;
  typedef Shell_status Status;
  typedef Certified_refinement<ConcurrencyTag> Refinement;
  Shell_report& report = construction.report();
  const auto stop = [&](Status status) { return Shell(construction.end(status)); };

  construction.start(Shell_step::CELLS);
  const std::shared_ptr<const Input_mesh_3>& input = construction.input();
  const double largest_thickness = parameters.largest_thickness(input->unit());
  const double resolution = parameters.resolution ? *parameters.resolution
                            : parameters.sizing   ? resolution_tuning.finest
                                                  : choose_resolution<ConcurrencyTag>(*input, largest_thickness);
  const std::optional<Lattice_3> lattice = construction.choose_lattice(input->unit() / resolution);
  if(!lattice) return stop(Status::GRID_TOO_FINE);
  std::atomic<bool> is_thickness_valid(true); // read and written by several threads
  double invalid_thickness = 0;               // written by one thread
  const Refinement_problem::Thickness thickness = [&](const Shell::Point_3& p) -> double {
    if(!parameters.sizing) return largest_thickness;
    const double t = parameters.sizing(p);
    if(t > 0 && std::isfinite(t)) return t;
    if(is_thickness_valid.exchange(false)) invalid_thickness = t;
    return largest_thickness; // without effect: the construction fails
  };
  // Room for the shell and a margin, because the shell is thicker at edges. On the mesh, a field that is fitted to the
  // caller's distance may have any value between the thresholds. The values of a sizing field are not known yet.
  constexpr double thickest = 20, more = 0.3; // cells
  const double spacing = lattice->spacing();
  if(!parameters.sizing) {
    const double largest = thickest * spacing, relative = largest / input->unit();
    Invalid_parameter& invalid = report.invalid_parameter;
    if(parameters.thickness) invalid.check("thickness", *parameters.thickness, { 0, largest });
    else invalid.check("relative_thickness", parameters.relative_thickness, { 0, relative });
    if(invalid) return stop(Status::INVALID_PARAMETER);
  }
  const double room = parameters.sizing ? spacing
                                        : (oracle ? largest_thickness : largest_thickness / 2) + more * spacing;
  const double rings = std::floor(room / spacing);
  Cells_near_mesh at_mesh = cells_near_mesh<ConcurrencyTag>(*input, *lattice, room - rings * spacing);
  report.surface_cells = at_mesh.entered.size();
  if(double(report.surface_cells) * 1e4 > parameters.refinement.max_bytes) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  Cell_hierarchy_3 cells(Cell_complex_3(*lattice, dilate(std::move(at_mesh.near), -int(rings), int(rings))));

  std::optional<Mesh_signed_distance_3> mesh_distance;
  if(!oracle) mesh_distance.emplace(*input);
  struct Invalid_thickness
  {};
  const Refinement_problem::Start start = [&](Shell_step step) {
    if(!is_thickness_valid) throw Invalid_thickness();
    construction.start(step);
  };
  Refinement_problem problem(ConcurrencyTag(), input, oracle ? *oracle : Any_signed_distance_3(*mesh_distance),
                             thickness, solver, start, parameters.refinement);
  Refinement refinement(problem);
  Refinement_status refined = Refinement_status::NOT_REFINED;
  try {
    refined = refinement(std::move(cells));
  } catch(const internal::Run::Ended&) {
    report.rounds = refinement.rounds();
    throw;
  } catch(const Invalid_thickness&) {}
  if(!is_thickness_valid) {
    report.invalid_parameter.check("sizing", invalid_thickness, Parameter_bounds::positive());
    return stop(Status::INVALID_PARAMETER);
  }
  report.rounds = refinement.rounds();
  report.refinement = refined;
  report.fit.status = refinement.solver_status();
  if(refined == Refinement_status::LIMIT_REACHED) report.limit = refinement.limit();
  if(refined == Refinement_status::DISTANCE_NOT_FINITE) return stop(Status::DISTANCE_NOT_FINITE);
  if(refined == Refinement_status::SOLVER_FAILED) return stop(Status::SOLVER_FAILED);
  report.cells = refinement.field()->number_of_cells();
  report.unknowns = refinement.field()->number_of_coefficients();
  const typename Refinement::Certificate& certificate = *refinement.certificate();
  report.certificate = certificate.report();
  if(!certificate.is_certified()) report.obstacles = refinement.obstacles();
  if(certificate.status() != Status::SUCCESS) return stop(certificate.status());
  if(certificate.verdict(Claim::CONTAINMENT) != Verdict::PROVED) return stop(Status::MESH_NOT_CONTAINED);
  const Thickness_on_mesh on_mesh = refinement.thickness_on_mesh();
  report.thickness = on_mesh.largest;
  report.narrowed_area = on_mesh.narrowed_area;
  std::vector<char> shell_cells(report.cells, 0);
  if(certificate.cover())
    for(const Cover_box& box : certificate.cover()->boxes())
      if(box.component != Cover_box::no_component) shell_cells[box.cell] = 1;
  std::vector<Level_range> facets(input->number_of_facets_of_origin());
  const std::vector<Level_range> ranges = refinement.facet_ranges();
  for(auto f : input->mesh().faces()) facets[input->facet_of_origin(f)].include(ranges[f]);
  Shell shell(refinement.field(), refinement.inner(), refinement.outer(), std::move(shell_cells), std::move(facets),
              construction.end(Status::SUCCESS));
  internal::Shell_access::set_closing(shell, input->closing());
  internal::Shell_access::set_truncation(shell, input->truncation());
  internal::Shell_access::set_cell_bounds(shell, certificate.bounds());
  if(certificate.verdict(Claim::GRADIENT) == Verdict::PROVED)
    internal::Shell_access::set_proved_cover(shell, certificate.cover()->boxes());
  return shell;
}

template <typename ConcurrencyTag>
Certified_bspline_shell_3 build_certified_shell(Shell_construction& construction,
                                                const Certified_shell_parameters& parameters,
                                                const std::optional<Any_signed_distance_3>& oracle)
{
  // The accuracy of the solver only affects speed, because the certificate examines the actual field.
  constexpr double tolerance = 1e-4;
  Conjugate_gradient_solver<ConcurrencyTag> solver(tolerance);
  return build_certified_shell<ConcurrencyTag>(construction, parameters, oracle, Any_spd_solver(solver, false));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_IMPL_H
