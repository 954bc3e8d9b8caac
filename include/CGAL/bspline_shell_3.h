// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_H
#define CGAL_BSPLINE_SHELL_3_H

#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Fit/fit_field.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Construction/level_bounds.h>
#include <CGAL/Bspline_shell_3/Certificate/prove_containment.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Construction/shell_component.h>

#include <CGAL/tags.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {

namespace Bspline_shells {
namespace internal {

// cells of the whole box of the mesh, and `rings` more on each side
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

// adds rings of cells around some cells of the field
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

inline Cell_complex_3 cells_beyond(const Cell_complex_3& cells, const Cell_complex_3& known)
{
  std::vector<std::uint64_t> keys;
  for(Cell_complex_3::Index c = 0; c < cells.number_of_cells(); ++c) {
    const Lattice_3::Point& p = cells.lattice_point(c);
    if(known.cell(p) == Cell_complex_3::npos) keys.push_back(Lattice_key::encode(p[0], p[1], p[2]));
  }
  return Cell_complex_3(cells.lattice(), keys);
}

// the samples of cells, each from the one of two complexes that has the cell
inline std::vector<double> merge_samples(const Cell_complex_3& cells, const Cell_complex_3& first,
                                         const std::vector<double>& first_samples, const Cell_complex_3& second,
                                         const std::vector<double>& second_samples)
{
  constexpr std::size_t n = Distance_samples::per_cell;
  std::vector<double> samples(cells.number_of_cells() * n);
  for(Cell_complex_3::Index c = 0; c < cells.number_of_cells(); ++c) {
    const Cell_complex_3::Index old = first.cell(cells.lattice_point(c));
    const double* from = old != Cell_complex_3::npos ? &first_samples[old * n]
                                                     : &second_samples[second.cell(cells.lattice_point(c)) * n];
    std::copy(from, from + n, &samples[c * n]);
  }
  return samples;
}

// the coefficients, in cell units, of a field on fewer cells, where it has them
template <typename Field>
void take_over_coefficients(const Field& from, const Field& to, Eigen::VectorXd& guess)
{
  const double width = to.cells().width();
  for(typename Field::Cell_index n = 0; n < to.number_of_coefficients(); ++n) {
    const auto old = from.functions().index(to.functions().point(n));
    if(old != Field::npos) guess[n] = from.coefficients()[old] / width;
  }
}

// About how many bytes a shell takes at the peak, which is in the solver: per cell the samples, Bernstein coefficients
// and lookups, per unknown a column of the matrix with up to 172 entries of 12 bytes (twice while a term is added to a
// copy), its share of the preconditioner's blocks and the solver's vectors; per piece its points and quadrature points.
inline double estimated_bytes(double cells, double unknowns, double pieces, bool copies_matrix)
{
  return cells * 680 + unknowns * (copies_matrix ? 6200 : 3900) + pieces * 500;
}

} // namespace internal
} // namespace Bspline_shells

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a cubic B-spline shell of a closed mesh.
 *
 * The mesh is checked first; what a shell cannot be built for is refused with a status and the offending simplices.
 * Polygonal facets are triangulated. The field lives on the cells that the mesh enters and some rings of cells around
 * them, its coefficients minimize the paper's energy, and the two levels enclose it on the mesh, rounded outwards.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam PolygonMesh a model of `FaceListGraph`
 * \tparam NamedParameters a sequence of named parameters, begun in `CGAL::Bspline_shells::parameters` or
 *         `CGAL::parameters`
 *
 * \param mesh the mesh; its facets may face either side of the volume that it bounds, and the field grows the way they
 *        face
 * \param np optional named parameters:
 *   - `resolution(double)`: the paper's \f$\gamma\f$, cells per longest side of the mesh's box; default 50
 *   - `grid_spacing(double)`: instead, the edge length of a cell in user units
 *   - `number_of_rings(int)`: rings of cells around those that the mesh enters. By default two, and more where the shell
 *     would leave them, added up to five times
 *   - `dense_grid(bool)`: all cells of the mesh's box and some rings around it, as in the paper (whose energy is
 *     `Energy_weights::paper()`); default `false`
 *   - `energy_weights(Bspline_shells::Energy_weights)`: the paper's \f$\mu\f$ and
 *     \f$\zeta\f$ by default, without \f$E_{singularH}\f$
 *   - `spd_solver(S)`: a model of `SPDSolver`, default `Bspline_shells::Conjugate_gradient_solver`. Pass
 *     `std::ref(solver)` to look at it afterwards
 *   - `signed_distance_oracle(O)`: a model of `SignedDistanceOracle_3`, instead of the distance to the mesh. Pass
 *     `std::cref(oracle)` not to copy it
 *   - `memory_limit(double)`: bytes that the construction may take, about; unlimited by default
 *   - `allow_self_intersections(bool)`, `allow_singular_vertices(bool)`: do not refuse such meshes; default `false`. The
 *     side of a point is then that of its closest facet.
 *   - `allow_open_shell(bool)`: do not refuse a shell that runs into the end of the cells; default `false`
 *   - `visitor(V)`: a model of `ShellVisitor`; pass `std::ref(visitor)` to keep its state
 *   - `vertex_point_map(VPM)`: as in all of \cgal
 *
 * \return a shell that certainly contains the mesh, or none and the reason (`Bspline_shell_3::status()`)
 * \cgalHeading{Cost} time and memory grow with the number of cells, about the square of the resolution
 */
template <typename ConcurrencyTag = Parallel_if_available_tag,
          typename PolygonMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shell_3<> bspline_shell_3(const PolygonMesh& mesh, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  using CGAL::parameters::is_default_parameter;

  typedef BS::Uniform_bspline_field_3<> Field;
  typedef BS::Shell_status Status;
  typedef BS::Shell_step Step;
  constexpr int max_number_of_rings = 1000;
  constexpr double largest_relative_spacing = 1000;

  const double resolution = choose_parameter(get_parameter(np, tags::resolution), 50.);
  const double asked_spacing = choose_parameter(get_parameter(np, internal_np::grid_spacing), 0.);
  const int asked_rings = choose_parameter(get_parameter(np, tags::number_of_rings), 0);
  const bool dense = choose_parameter(get_parameter(np, tags::dense_grid), false);
  const BS::Energy_weights weights = choose_parameter(get_parameter(np, tags::energy_weights), BS::Energy_weights());
  const double memory_limit = choose_parameter(get_parameter(np, tags::memory_limit), std::numeric_limits<double>::infinity());
  const bool allow_open_shell = choose_parameter(get_parameter(np, tags::allow_open_shell), false);
  auto&& solver = BS::internal::argument<BS::Conjugate_gradient_solver<ConcurrencyTag> >(np, tags::spd_solver);
  auto&& visitor = BS::internal::argument<BS::Default_shell_visitor>(np, internal_np::visitor);

  BS::Shell_construction construction(visitor);
  BS::Shell_report& report = construction.report;
  const auto start = [&](Step step) { return construction.start(step); };
  const auto stop = [&](Status status) { return Bspline_shell_3<>(construction.end(status)); };

  constexpr bool default_spacing = is_default_parameter<CGAL_NP_CLASS, internal_np::grid_spacing_t>::value;
  constexpr bool default_rings = is_default_parameter<CGAL_NP_CLASS, tags::number_of_rings_t>::value;
  if(!(std::isfinite(resolution) && resolution > 0 && std::isfinite(asked_spacing) && (default_spacing || asked_spacing > 0)
       && (default_rings || asked_rings > 0) && memory_limit > 0
       && weights.are_valid()))
    return stop(Status::INVALID_PARAMETER);

  const Status checked = construction.template check<ConcurrencyTag>(mesh, np);
  if(checked != Status::SUCCESS) return stop(checked);
  const BS::Input_mesh_3& input = *construction.input;

  if(!start(Step::CELLS)) return stop(Status::CANCELED);
  const int rings = default_rings ? 2 : asked_rings;
  const double spacing = default_spacing ? input.unit() / resolution : asked_spacing;
  if(!(spacing < input.unit() * largest_relative_spacing)) return stop(Status::INVALID_PARAMETER);
  const Status has_lattice = construction.choose_lattice(spacing);
  if(has_lattice != Status::SUCCESS) return stop(has_lattice);
  const BS::Lattice_3& lattice = construction.lattice;
  if(rings > max_number_of_rings) return stop(Status::TOO_MANY_CELLS);
  const bool copies_matrix = weights.singular_hessian > 0;
  const double pieces = BS::Clipped_mesh_3::estimated_number_of_pieces(input, lattice.spacing());
  const auto exceeds_memory = [&](double cells, double unknowns) {
    return !(BS::internal::estimated_bytes(cells, unknowns, pieces, copies_matrix) <= memory_limit);
  };
  if(exceeds_memory(0, 0)) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  const std::vector<std::uint64_t> surface_keys = BS::cells_entered_by_mesh<ConcurrencyTag>(input, lattice);
  report.surface_cells = surface_keys.size();

  // Before the cells are listed: how many there are at least, each with its unknown.
  const Bbox_3 box = input.bbox();
  double at_least = dense ? 1 : (std::max)(double(surface_keys.size()), std::pow(2. * rings + 1, 3));
  for(int a = 0; dense && a < 3; ++a) at_least *= ((box.max)(a) - (box.min)(a)) / lattice.spacing() + 2 * rings;
  if(at_least > double(BS::Fit_energy<Field>::max_number_of_unknowns)) return stop(Status::TOO_MANY_CELLS);
  if(exceeds_memory(at_least, at_least)) return stop(Status::MEMORY_LIMIT_EXCEEDED);
  std::vector<std::uint64_t> keys = dense ? BS::internal::box_cells(lattice, box, rings)
                                          : BS::dilate(surface_keys, -rings, rings);

  // the signed distance at the samples of some cells, from the mesh or from the caller's oracle
  std::optional<BS::Mesh_signed_distance_3> distance;
  const auto sample = [&](const BS::Cell_complex_3& cells) {
    if constexpr(is_default_parameter<CGAL_NP_CLASS, tags::signed_distance_oracle_t>::value) {
      if(!distance) distance.emplace(input);
      return BS::sample_signed_distance<ConcurrencyTag>(*distance, cells);
    } else
      return BS::sample_signed_distance<ConcurrencyTag>(get_parameter_reference(np, tags::signed_distance_oracle), cells);
  };

  constexpr int max_widenings = 5;      // by 2 to 6 rings: twenty cells in all
  std::optional<Field> narrower;        // the field before the last widening
  std::vector<double> samples;
  for(;; ++report.widenings) {
    Field field(BS::Cell_complex_3(lattice, keys));
    report.cells = field.number_of_cells();
    report.unknowns = field.number_of_coefficients();
    if(report.unknowns > BS::Fit_energy<Field>::max_number_of_unknowns) return stop(Status::TOO_MANY_CELLS);
    if(exceeds_memory(double(report.cells), double(report.unknowns))) return stop(Status::MEMORY_LIMIT_EXCEEDED);
    const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<ConcurrencyTag>(input, field.cells());

    if(!start(Step::DISTANCE)) return stop(Status::CANCELED);
    // after a widening, only where there was no cell before
    const BS::Cell_complex_3 unsampled = narrower ? BS::internal::cells_beyond(field.cells(), narrower->cells()) : field.cells();
    std::vector<double> more_samples = sample(unsampled);
    if(!std::all_of(more_samples.begin(), more_samples.end(), [](double d) { return std::isfinite(d); }))
      return stop(Status::DISTANCE_NOT_FINITE);
    samples = narrower ? BS::internal::merge_samples(field.cells(), narrower->cells(), samples, unsampled, more_samples)
                       : std::move(more_samples);

    if(!start(Step::FIT)) return stop(Status::CANCELED);
    {
      BS::Fit_energy<Field> energy(field, samples, clipped, report.gamma, weights);
      Eigen::VectorXd guess = energy.template initial_guess<ConcurrencyTag>();
      if(narrower) BS::internal::take_over_coefficients(*narrower, field, guess);
      report.fit = BS::fit_field<ConcurrencyTag>(field, energy, solver, std::move(guess));
      if(report.fit.status != BS::Solver_status::SUCCESS) return stop(Status::SOLVER_FAILED);
    }

    if(!start(Step::BOUNDS)) return stop(Status::CANCELED);
    report.edges = BS::edge_range<ConcurrencyTag>(field, clipped);
    const BS::Facet_ranges triangles = BS::facet_ranges<ConcurrencyTag>(field, clipped);
    report.facets_bound = triangles.mesh;
    constexpr double tau = 1e10;
    const BS::Level_range levels = BS::round_outwards(triangles.mesh, report.unit / tau);
    BS::Shell_component component = BS::shell_component(field, clipped.cells(), levels);
    const bool is_open = !component.border_cells.empty();
    const bool may_widen = default_rings && report.widenings < max_widenings;
    if(is_open && !may_widen && !allow_open_shell) return stop(Status::SHELL_LEAVES_BAND);
    if(is_open && may_widen) {
      if(!start(Step::CELLS)) return stop(Status::CANCELED);
      BS::internal::widen(field, component.border_cells, 2 + report.widenings, keys);
      narrower = std::move(field);
      continue;
    }

    if(!BS::prove_containment<ConcurrencyTag>(field, BS::Constant_threshold(levels.min), BS::Constant_threshold(levels.max), input))
      return stop(Status::MESH_NOT_CONTAINED);
    // num_faces() may count removed facets
    std::vector<BS::Level_range> facets(std::size_t(std::distance(faces(mesh).begin(), faces(mesh).end())));
    for(auto f : input.mesh().faces()) facets[input.facet_of_origin(f)].include(triangles.facet[f]);
    return Bspline_shell_3<>(std::move(field), levels, std::move(component.cells), std::move(facets), construction.end(Status::SUCCESS));
  }
}

} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_H
