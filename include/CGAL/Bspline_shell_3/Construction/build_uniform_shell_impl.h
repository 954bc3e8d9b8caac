// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_IMPL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_IMPL_H

#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Certificate/prove_containment.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/build_uniform_shell.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Construction/shell_component.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Fit/fit_field.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns the cells of the mesh's bounding box and of `rings` layers on each side.
inline std::vector<std::uint64_t> box_cells(const Lattice_3& lattice, const Bbox_3& box, int rings)
{
  Lattice_3::Point first, last;
  for(int a = 0; a < 3; ++a) {
    first[a] = lattice.interval(a, (box.min)(a)) - rings;
    last[a] = lattice.interval(a, (box.max)(a)) + rings;
  }
  std::vector<std::uint64_t> keys;
  for(int k = first[2]; k <= last[2]; ++k)
    for(int j = first[1]; j <= last[1]; ++j)
      for(int i = first[0]; i <= last[0]; ++i) keys.push_back(Lattice_key::encode(i, j, k));
  return keys;
}

// Adds layers of cells around the given cells of the field.
template <typename Field>
void widen(const Field& field, const std::vector<typename Field::Cell_index>& cells, int rings,
           std::vector<std::uint64_t>& keys)
{
  std::vector<std::uint64_t> more;
  for(typename Field::Cell_index c : cells) {
    const Lattice_3::Point& p = field.cells().lattice_point(c);
    more.push_back(Lattice_key::encode(p[0], p[1], p[2]));
  }
  sort_unique(more);
  more = dilate(std::move(more), -rings, rings);
  keys.insert(keys.end(), more.begin(), more.end());
  sort_unique(keys);
}

// Copies the coefficients of a field on fewer cells of the same size, and converts them to cell units.
template <typename Field>
void take_over_coefficients(const Field& from, const Field& to, Eigen::VectorXd& guess)
{
  const double width = to.cells().lattice().spacing();
  for(typename Field::Cell_index n = 0; n < to.number_of_coefficients(); ++n) {
    const auto old = from.points(0).index(to.points(0).point(n));
    if(old != Field::npos) guess[n] = from.coefficients()[old] / width;
  }
}

// Returns the approximate peak memory of a shell in bytes, which is reached in the solver. Per cell: the samples,
// Bernstein coefficients, and lookups. Per unknown: blocks of the preconditioner, the solver's vectors, and a
// column of the matrix with up to 172 entries of 12 bytes (twice while a term is added to a copy). Per piece: its
// points and quadrature points.
inline double estimated_bytes(double cells, double unknowns, double pieces, bool copies_matrix)
{
  return cells * 680 + unknowns * (copies_matrix ? 6200 : 3900) + pieces * 500;
}

} // namespace internal

template <typename ConcurrencyTag>
Bspline_shell_3<> build_uniform_shell(Shell_construction& construction, const Uniform_shell_parameters& parameters,
                                      const std::optional<Any_signed_distance_3>& oracle, const Any_spd_solver& solver)
{
  typedef Bspline_shell_3<>::Field Field;
  typedef Shell_status Status;
  constexpr int max_number_of_rings = 1000;
  constexpr double largest_relative_spacing = 1000;
  Shell_report& report = construction.report();
  const auto stop = [&](Status status) { return Bspline_shell_3<>(construction.end(status)); };

  construction.start(Shell_step::CELLS);
  const Input_mesh_3& input = *construction.input();
  const int rings = parameters.rings.value_or(2);
  const double spacing = parameters.spacing ? *parameters.spacing : input.unit() / parameters.resolution;
  const double largest_spacing = input.unit() * largest_relative_spacing;
  if(parameters.spacing) report.invalid_parameter.check("grid_spacing", spacing, { 0, largest_spacing });
  else report.invalid_parameter.check("resolution", parameters.resolution, { 1 / largest_relative_spacing });
  if(report.invalid_parameter) return stop(Status::INVALID_PARAMETER);
  const std::optional<Lattice_3> chosen_lattice = construction.choose_lattice(spacing);
  if(!chosen_lattice) return stop(Status::GRID_TOO_FINE);
  const Lattice_3& lattice = *chosen_lattice;
  if(rings > max_number_of_rings) return stop(Status::TOO_MANY_CELLS);
  const bool copies_matrix = parameters.weights.singular_hessian > 0;
  const double pieces = Clipped_mesh_3::estimated_number_of_pieces(input, lattice.spacing());
  const auto exceeds_memory = [&](double cells, double unknowns) {
    return !(internal::estimated_bytes(cells, unknowns, pieces, copies_matrix) <= parameters.max_bytes);
  };
  if(exceeds_memory(0, 0)) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  const std::vector<std::uint64_t> surface_keys = cells_entered_by_mesh<ConcurrencyTag>(input, lattice);
  report.surface_cells = surface_keys.size();

  // Checks lower bounds on the number of cells and unknowns before the cells are listed.
  const Bbox_3 box = input.bbox();
  double at_least = parameters.dense ? 1 : (std::max)(double(surface_keys.size()), std::pow(2. * rings + 1, 3));
  for(int a = 0; parameters.dense && a < 3; ++a)
    at_least *= ((box.max)(a) - (box.min)(a)) / lattice.spacing() + 2 * rings;
  if(at_least > double(Fit_energy<Field>::max_number_of_unknowns)) return stop(Status::TOO_MANY_CELLS);
  if(exceeds_memory(at_least, at_least)) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  std::vector<std::uint64_t> keys = parameters.dense ? internal::box_cells(lattice, box, rings)
                                                     : dilate(surface_keys, -rings, rings);

  std::optional<Mesh_signed_distance_3> mesh_distance;
  constexpr int max_widenings = 5; // by 2, 3, ..., 6 layers: 20 cells in total
  std::optional<Field> narrower;   // the field before the last widening
  std::vector<double> samples;
  for(;; ++report.widenings) {
    Field field(Cell_complex_3(lattice, keys));
    report.cells = field.number_of_cells();
    report.unknowns = field.number_of_coefficients();
    if(report.unknowns > Fit_energy<Field>::max_number_of_unknowns) return stop(Status::TOO_MANY_CELLS);
    if(exceeds_memory(double(report.cells), double(report.unknowns))) return stop(Status::MEMORY_LIMIT_EXCEEDED);
    const Clipped_mesh_3 clipped = clip_mesh_to_cells<ConcurrencyTag>(input, field.cells());

    construction.start(Shell_step::DISTANCE);
    if(!oracle && !mesh_distance) mesh_distance.emplace(input);
    const Any_signed_distance_3 distance = oracle ? *oracle : Any_signed_distance_3(*mesh_distance);
    // After a widening, only new cells are sampled.
    if(narrower) update_signed_distance<ConcurrencyTag>(distance, narrower->cells(), field.cells(), samples);
    else samples = sample_signed_distance<ConcurrencyTag>(distance, field.cells());
    if(!std::all_of(samples.begin(), samples.end(), [](double d) { return std::isfinite(d); }))
      return stop(Status::DISTANCE_NOT_FINITE);

    construction.start(Shell_step::FIT);
    {
      Fit_energy<Field> energy(field, samples, clipped, report.gamma, parameters.weights);
      Eigen::VectorXd guess = energy.template initial_guess<ConcurrencyTag>();
      if(narrower) internal::take_over_coefficients(*narrower, field, guess);
      report.fit = fit_field<ConcurrencyTag>(field, energy, solver, std::move(guess));
      if(report.fit.status != Solver_status::SUCCESS) return stop(Status::SOLVER_FAILED);
    }

    construction.start(Shell_step::BOUNDS);
    report.edges = edge_range<ConcurrencyTag>(field, clipped);
    const Facet_ranges triangles = facet_ranges<ConcurrencyTag>(field, clipped);
    report.facets_bound = triangles.mesh;
    const Level_range levels = round_outwards(triangles.mesh, report.unit / levels_per_box_size);
    Shell_component component = shell_component(field, clipped.cells(), levels);
    const bool is_open = !component.border_cells.empty();
    const bool may_widen = !parameters.rings && report.widenings < max_widenings;
    if(is_open && !may_widen && !parameters.allow_open_shell) return stop(Status::SHELL_REACHES_BOUNDARY);
    if(is_open && may_widen) {
      construction.start(Shell_step::CELLS);
      internal::widen(field, component.border_cells, 2 + report.widenings, keys);
      narrower = std::move(field);
      continue;
    }

    if(!prove_containment<ConcurrencyTag>(field, Constant_threshold(levels.min), Constant_threshold(levels.max), input))
      return stop(Status::MESH_NOT_CONTAINED);
    std::vector<Level_range> facets(input.number_of_facets_of_origin());
    for(auto f : input.mesh().faces()) facets[input.facet_of_origin(f)].include(triangles.facet[f]);
    return Bspline_shell_3<>(std::move(field), levels, std::move(component.cells), std::move(facets),
                             construction.end(Status::SUCCESS));
  }
}

template <typename ConcurrencyTag>
Bspline_shell_3<> build_uniform_shell(Shell_construction& construction, const Uniform_shell_parameters& parameters,
                                      const std::optional<Any_signed_distance_3>& oracle)
{
  Conjugate_gradient_solver<ConcurrencyTag> solver;
  return build_uniform_shell<ConcurrencyTag>(construction, parameters, oracle, Any_spd_solver(solver, false));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_IMPL_H
