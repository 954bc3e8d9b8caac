// bspline_shell_3.h, Bspline_shell_3.h, Named_parameters.h, Progress.h: from a mesh to its shell.
#include "coefficient_functions.h"
#include "input_of_mesh.h"
#include "shell_reports.h"

#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Fit_energy.h>
#include <CGAL/Bspline_shell_3/Fit/sample_signed_distance.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <unistd.h>

namespace test_bspline_shell_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shell_3<> Shell;
typedef BS::Shell_status Status;
typedef BS::Shell_step Step;

// Calls f(position of the facet, point) for points at most `distance` apart on each facet, including its edges and
// corners.
template <typename Function>
void for_each_point_on_mesh(const Mesh& mesh, double distance, const Function& f)
{
  std::size_t n = 0;
  for(auto face : mesh.faces()) {
    std::vector<Point_3> c;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(face))) c.push_back(mesh.point(v));
    for(std::size_t t = 1; t + 1 < c.size(); ++t) { // polygons are convex
      const double longest = std::sqrt(
        (std::max)({ CGAL::squared_distance(c[0], c[t]), CGAL::squared_distance(c[t], c[t + 1]),
                     CGAL::squared_distance(c[t + 1], c[0]) }));
      const int density = int(longest / distance) + 1;
      for(int i = 0; i <= density; ++i)
        for(int j = 0; j <= density - i; ++j)
          f(n, c[0] + double(i) / density * (c[t] - c[0]) + double(j) / density * (c[t + 1] - c[0]));
    }
    ++n;
  }
}

// Checks that the shell encloses the mesh, and that its data is consistent.
void check_shell(const Shell& shell, const Mesh& mesh)
{
  REQUIRE(shell.status() == Status::SUCCESS);
  REQUIRE(shell);
  CHECK(shell.report().unit > 0);
  CHECK(shell.inner_level() < shell.outer_level());
  CHECK(shell.thickness() == shell.outer_level() - shell.inner_level());
  CHECK(shell.relative_thickness() == shell.thickness() / shell.report().unit);

  REQUIRE(shell.facet_ranges().size() == mesh.number_of_faces());
  // Samples are rounded by a few units in the last place of coordinates and coefficients, which are less than ten
  // units.
  const double rounding = 1e-14 * shell.report().unit;
  bool in_levels = true, in_facet_ranges = true, bounded = true;
  BS::Level_range sampled;
  for_each_point_on_mesh(mesh, shell.field().cells().level_width(0) / 10, [&](std::size_t facet, const Point_3& p) {
    const double f = shell.field().value(p).value();
    sampled.include(f);
    in_levels = in_levels && f >= shell.inner_level() && f <= shell.outer_level();
    const BS::Level_range& range = shell.facet_ranges()[facet];
    in_facet_ranges = in_facet_ranges && f >= range.min - rounding && f <= range.max + rounding;
    bounded = bounded && shell.bounded_side(p) != CGAL::ON_UNBOUNDED_SIDE;
  });
  CHECK(in_levels);
  CHECK(in_facet_ranges);
  CHECK(bounded);
  // The shell is not thicker than necessary. With ten samples per cell, extrema are nearly attained.
  CHECK(shell.thickness() < 1.02 * (sampled.max - sampled.min));

  // Extrema on edges are values of f on the mesh.
  const BS::Shell_report& report = shell.report();
  CHECK(report.edges.min >= report.facets_bound.min);
  CHECK(report.edges.max <= report.facets_bound.max);
  // Levels are the bounds, rounded outwards by at most 1e-10, as in the paper.
  CHECK(shell.inner_level() <= report.facets_bound.min);
  CHECK(shell.outer_level() >= report.facets_bound.max);
  CHECK(report.facets_bound.min - shell.inner_level() <= 1.01e-10 * report.unit);
  CHECK(shell.outer_level() - report.facets_bound.max <= 1.01e-10 * report.unit);

  CHECK(report.cells == shell.field().number_of_cells());
  CHECK(report.unknowns == shell.field().number_of_coefficients());
  CHECK(report.surface_cells <= report.cells);
  CHECK(shell.shell_cells().size() == report.cells);
}

// Records the announced steps; cancels at a given one.
struct Step_recorder
{
  std::vector<Step> steps;
  std::size_t stop_at = 0; // counted from 1
  bool start_step(Step step)
  {
    steps.push_back(step);
    return steps.size() != stop_at;
  }
};

// The distance from a sphere, without a mesh.
struct Sphere_distance
{
  typedef ::Point_3 Point_3;
  typedef double FT;
  double radius = 1;
  FT operator()(const Point_3& p) const { return std::sqrt((p - CGAL::ORIGIN).squared_length()) - radius; }
};

// A distance that cannot be copied.
struct Pinned_distance : Sphere_distance
{
  Pinned_distance() = default;
  Pinned_distance(const Pinned_distance&) = delete;
};

bool same(const Shell& a, const Shell& b)
{
  return a.inner_level() == b.inner_level() && a.outer_level() == b.outer_level()
         && a.field().coefficients() == b.field().coefficients();
}

// Returns the text that a function writes to the standard output and error streams.
template <typename Function>
std::string printed_by(const Function& f)
{
  std::fflush(stdout);
  std::fflush(stderr);
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  const int out = dup(1), err = dup(2);
  dup2(fileno(file), 1);
  dup2(fileno(file), 2);
  f();
  std::cout.flush();
  std::cerr.flush();
  std::fflush(stdout);
  std::fflush(stderr);
  dup2(out, 1);
  dup2(err, 2);
  close(out);
  close(err);
  std::fseek(file, 0, SEEK_END);
  std::string text(std::size_t(std::ftell(file)), ' ');
  std::rewind(file);
  text.resize(std::fread(&text[0], 1, text.size(), file));
  std::fclose(file);
  return text;
}

} // namespace

TEST_CASE("A shell encloses its mesh")
{
  const auto check = [](const Mesh& mesh, double resolution) {
    check_shell(CGAL::bspline_shell_3(mesh, P::resolution(resolution)), mesh);
  };
  SECTION("a smooth mesh") check(sphere(2), 16);
  SECTION("a mesh of polygons") check(box(Point_3(0, 0, 0), Point_3(3, 2, 1), false), 16);
  SECTION("a torus") check(torus(3, 1.2, 20, 12), 16);
  SECTION("facets larger than cells, away from the origin") check(sphere(0, 2, Point_3(70, -30, 10)), 20);
  SECTION("a demo mesh of CGAL") check(demo_mesh("blobby.off"), 20);
}

TEST_CASE("A mesh with removed facets has one facet range per remaining facet")
{
  Mesh mesh;
  const auto f = mesh.add_face(mesh.add_vertex(Point_3(5, 0, 0)), mesh.add_vertex(Point_3(6, 0, 0)),
                               mesh.add_vertex(Point_3(5, 1, 0)));
  mesh = joined(mesh, box(Point_3(0, 0, 0), Point_3(1, 1, 1)));
  CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  REQUIRE(mesh.has_garbage());
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(10));
  check_shell(shell, mesh);
  CHECK(shell.facet_ranges().size() == 12);
}

TEST_CASE("bounded_side() places points away from the mesh, or beyond the levels, outside the shell")
{
  const Mesh mesh = sphere(3);
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(16));
  REQUIRE(shell);
  REQUIRE(shell.thickness() < 0.1);
  for(const Vector_3& d : { Vector_3(1, 0, 0), Vector_3(0.6, 0, -0.8), Vector_3(-0.48, 0.6, 0.64) }) {
    // |gradient| is close to one; points are well inside or outside the levels, or outside the domain
    CHECK(shell.bounded_side(CGAL::ORIGIN + (1 - 2 * shell.thickness() - 0.05) * d) == CGAL::ON_UNBOUNDED_SIDE);
    CHECK(shell.bounded_side(CGAL::ORIGIN + (1 + 2 * shell.thickness() + 0.05) * d) == CGAL::ON_UNBOUNDED_SIDE);
    CHECK(shell.bounded_side(CGAL::ORIGIN + 100 * d) == CGAL::ON_UNBOUNDED_SIDE);
  }
  CHECK(shell.bounded_side(CGAL::ORIGIN) == CGAL::ON_UNBOUNDED_SIDE);
  for(auto v : mesh.vertices()) REQUIRE(shell.bounded_side(mesh.point(v)) != CGAL::ON_UNBOUNDED_SIDE);
}

TEST_CASE("bounded_side() places points where f equals a level on the boundary, only in cells of the shell")
{
  // f = x - 1/2 on two cells; the levels are x = 1/2 and x = 3/4. The cell with x < 0 is not part of the shell.
  const BS::Lattice_3 lattice(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2), 1);
  Shell::Field field(all_cells(lattice, { -1, 0, 0 }, { 0, 0, 0 }));
  set_coefficients(field, [](const Point_3& p, double) { return p.x() - 0.5; });
  const BS::Level_range levels{ 0, 0.25 };
  const Shell shell(field, levels, { 0, 1 }, {}, successful_report(1));
  CHECK(shell.bounded_side(Point_3(0.5, 0.5, 0.5)) == CGAL::ON_BOUNDARY);
  CHECK(shell.bounded_side(Point_3(0.75, 0.5, 0.5)) == CGAL::ON_BOUNDARY);
  CHECK(shell.bounded_side(Point_3(0.625, 0.5, 0.5)) == CGAL::ON_BOUNDED_SIDE);
  CHECK(shell.bounded_side(Point_3(0.25, 0.5, 0.5)) == CGAL::ON_UNBOUNDED_SIDE);
  CHECK(shell.bounded_side(Point_3(0.875, 0.5, 0.5)) == CGAL::ON_UNBOUNDED_SIDE);
  CHECK(shell.bounded_side(Point_3(0.625, 2, 0.5)) == CGAL::ON_UNBOUNDED_SIDE);
  const Shell other(field, levels, { 1, 0 }, {}, successful_report(1));
  CHECK(other.bounded_side(Point_3(0.625, 0.5, 0.5)) == CGAL::ON_UNBOUNDED_SIDE);
}

TEST_CASE("resolution() and grid_spacing() can request the same cells")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(4, 2, 2));
  const Shell a = CGAL::bspline_shell_3(mesh, P::resolution(16)),
              b = CGAL::bspline_shell_3(mesh, P::grid_spacing(0.25)),
              c = CGAL::bspline_shell_3(mesh, CGAL::parameters::grid_spacing(0.25)),
              d = CGAL::bspline_shell_3(mesh, P::resolution(8));
  for(const Shell* shell : { &a, &b, &c, &d }) REQUIRE(*shell);
  CHECK(a.report().gamma == 16);
  CHECK(a.report().unit == 4);
  CHECK(a.field().cells().lattice().spacing() == 0.25);
  CHECK(same(a, b));
  CHECK(same(a, c));
  CHECK(d.field().cells().lattice().spacing() == 0.5);
}

TEST_CASE("The domain of the field consists of the cells of the mesh and the requested rings around them")
{
  const Mesh mesh = sphere(2);
  for(int rings : { 2, 3 }) {
    const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(16).number_of_rings(rings));
    REQUIRE(shell);
    const double w = shell.field().cells().lattice().spacing();
    // There are this many cells around the mesh, in every direction.
    bool covered = true;
    for(auto v : mesh.vertices())
      for(int axis = 0; axis < 3; ++axis)
        for(int side : { -1, 1 }) {
          double d[3] = { 0, 0, 0 };
          d[axis] = side * rings * w * (1 - 1e-12);
          covered = covered && shell.field().locate(mesh.point(v) + Vector_3(d[0], d[1], d[2])) != Shell::Field::npos;
        }
    CHECK(covered);
    CHECK(shell.field().locate(Point_3(0, 0, 0)) == Shell::Field::npos);
    CHECK(shell.field().locate(Point_3(1 + (rings + 1) * w, 0, 0)) == Shell::Field::npos);
    CHECK(shell.report().widenings == 0);
  }
}

TEST_CASE("A dense grid and a band of cells yield levels that agree to within 10 percent")
{
  const Mesh mesh = sphere(2);
  const Shell band = CGAL::bspline_shell_3(mesh, P::resolution(12)),
              dense = CGAL::bspline_shell_3(mesh, P::resolution(12).dense_grid(true));
  REQUIRE(band);
  check_shell(dense, mesh);
  CHECK(dense.field().locate(CGAL::ORIGIN) != Shell::Field::npos);
  CHECK(dense.field().locate(Point_3(0.99, 0.99, 0.99)) != Shell::Field::npos);
  CHECK(dense.report().cells > band.report().cells);
  CHECK(dense.inner_level() == Approx(band.inner_level()).epsilon(0.1));
  CHECK(dense.outer_level() == Approx(band.outer_level()).epsilon(0.1));
}

TEST_CASE("The fit uses the given energy weights")
{
  const Mesh mesh = sphere(1);
  const Shell paper = CGAL::bspline_shell_3(mesh, P::resolution(8).energy_weights(BS::Energy_weights::paper()));
  REQUIRE(paper);
  CHECK(paper.report().fit.linear_solves > 1);
  CHECK(paper.report().fit.energy[std::size_t(BS::Energy_term::SINGULAR_HESSIAN)] > 0);
  BS::Energy_weights none;
  none.mu = 0;
  const Shell distance_only = CGAL::bspline_shell_3(mesh, P::resolution(8).energy_weights(none));
  REQUIRE(distance_only);
  CHECK(distance_only.report().fit.linear_solves == 1);
  CHECK(distance_only.report().fit.energy[std::size_t(BS::Energy_term::ANGLE)] == 0);
  CHECK(distance_only.report().fit.energy[std::size_t(BS::Energy_term::NORMAL)] == 0);
}

TEST_CASE("A solver may be passed by value or by reference, and its failure is reported")
{
  const Mesh mesh = sphere(1);
  BS::Conjugate_gradient_solver<> solver(1e-8);
  const Shell by_value = CGAL::bspline_shell_3(mesh,
                                               P::resolution(8).spd_solver(BS::Conjugate_gradient_solver<>(1e-8))),
              by_reference = CGAL::bspline_shell_3(mesh, P::resolution(8).spd_solver(std::ref(solver)));
  REQUIRE(by_value);
  REQUIRE(by_reference);
  CHECK(same(by_value, by_reference));
  CHECK(solver.residual() <= 1e-8);
  CHECK(solver.residual() == by_reference.report().fit.residual);

  const Shell failed = CGAL::bspline_shell_3(mesh,
                                             P::resolution(8).spd_solver(BS::Conjugate_gradient_solver<>(1e-8, 1)));
  CHECK_FALSE(failed);
  CHECK(failed.status() == Status::SOLVER_FAILED);
  CHECK(failed.report().fit.status == BS::Solver_status::NOT_CONVERGED);
  CHECK(failed.message() == message(BS::Solver_status::NOT_CONVERGED));
}

TEST_CASE("A solver that returns zeros, garbage or a vector of the wrong size with SUCCESS is detected")
{
  struct Wrong_solver
  {
    BS::Solver_status compute(const Eigen::SparseMatrix<double>&, const BS::Unknown_blocks&)
    {
      return BS::Solver_status::SUCCESS;
    }
    BS::Solver_status solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
    {
      x = Eigen::VectorXd::Constant(b.size() + more, value);
      return BS::Solver_status::SUCCESS;
    }
    std::size_t iterations() const { return 1; }
    double residual() const { return 0; }
    double value = 0;
    Eigen::Index more = 0;
  };
  const Mesh mesh = sphere(1);
  for(const Wrong_solver& solver : { Wrong_solver{ 0, 0 }, Wrong_solver{ 1, 0 }, Wrong_solver{ -1e5, 0 },
                                     Wrong_solver{ 0, 1 }, Wrong_solver{ 0, -1 } }) {
    const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(8).spd_solver(solver));
    CHECK(shell.status() == Status::SOLVER_FAILED);
    CHECK(shell.report().fit.status == BS::Solver_status::WRONG_SOLUTION);
  }
}

TEST_CASE("A signed distance given by the user replaces the distance to the mesh")
{
  const Mesh mesh = sphere(2);
  const Pinned_distance pinned;
  const Shell by_value = CGAL::bspline_shell_3(mesh, P::resolution(10).signed_distance_oracle(Sphere_distance())),
              by_reference = CGAL::bspline_shell_3(mesh, P::resolution(10).signed_distance_oracle(std::cref(pinned))),
              default_distance = CGAL::bspline_shell_3(mesh, P::resolution(10));
  check_shell(by_value, mesh);
  REQUIRE(by_reference);
  REQUIRE(default_distance);
  CHECK(same(by_value, by_reference));
  CHECK_FALSE(same(by_value, default_distance));
  // The radius differs from the mesh: the values of the field follow the oracle.
  Sphere_distance larger;
  larger.radius = 1.05;
  BS::Energy_weights none;
  none.mu = 0;
  const Shell shifted = CGAL::bspline_shell_3(mesh,
                                              P::resolution(10).energy_weights(none).signed_distance_oracle(larger));
  REQUIRE(shifted);
  CHECK(*shifted.field().value(Point_3(1.05, 0, 0)) == Approx(0).margin(0.01));
  CHECK(*shifted.field().value(Point_3(0, 0, -1)) == Approx(-0.05).margin(0.01));
  // The package's own oracle can be passed, too. The result is the default one, up to rounding of distances and the
  // solver's tolerance.
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Mesh_signed_distance_3 distance(input);
  const Shell own = CGAL::bspline_shell_3(mesh, P::resolution(10).signed_distance_oracle(std::cref(distance)));
  REQUIRE(own);
  CHECK(own.report().cells == default_distance.report().cells);
  CHECK(own.inner_level() == Approx(default_distance.inner_level()).epsilon(1e-3));
  CHECK(own.outer_level() == Approx(default_distance.outer_level()).epsilon(1e-3));
}

TEST_CASE("The visitor is called for each step, in order, and can stop at each")
{
  const Mesh mesh = sphere(1);
  const std::vector<Step> all = { Step::CHECK, Step::CELLS, Step::DISTANCE, Step::FIT, Step::BOUNDS };
  Step_recorder recorder;
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(8).visitor(std::ref(recorder)));
  REQUIRE(shell);
  CHECK(recorder.steps == all);
  for(std::size_t n = 1; n <= all.size(); ++n) {
    Step_recorder stopper;
    stopper.stop_at = n;
    const Shell canceled = CGAL::bspline_shell_3(mesh, P::resolution(8).visitor(std::ref(stopper)));
    CHECK_FALSE(canceled);
    CHECK(canceled.status() == Status::CANCELED);
    CHECK(stopper.steps == std::vector<Step>(all.begin(), all.begin() + std::ptrdiff_t(n)));
    CHECK(canceled.facet_ranges().empty());
  }
  // A visitor that is passed by value is copied.
  Step_recorder copied;
  copied.stop_at = 2;
  CHECK(CGAL::bspline_shell_3(mesh, P::resolution(8).visitor(copied)).status() == Status::CANCELED);
  CHECK(copied.steps.empty());
  for(Step step : all) CHECK_FALSE(std::string(BS::name(step)).empty());
}

TEST_CASE("GRID_TOO_FINE is returned if cells are too small for the coordinates or the lattice's indices")
{
  const auto status = [](const Mesh& mesh, double resolution) {
    return CGAL::bspline_shell_3(mesh, P::resolution(resolution).memory_limit(1e8)).status();
  };
  const Mesh near = sphere(1), far = sphere(1, 1, Point_3(1e9, 0, 0));
  CHECK(status(near, 4e6) == Status::GRID_TOO_FINE); // more than 2^21 cells along an axis
  CHECK(status(near, 1e15) == Status::GRID_TOO_FINE);
  CHECK(status(near, 1e300) == Status::GRID_TOO_FINE);
  CHECK(status(far, 10) == Status::SUCCESS);
  CHECK(status(far, 1e3) == Status::GRID_TOO_FINE); // 1e9 * 500 exceeds 2^36 cells
  CHECK(CGAL::bspline_shell_3(near, P::grid_spacing(1e-12)).status() == Status::GRID_TOO_FINE);
}

TEST_CASE("MEMORY_LIMIT_EXCEEDED is returned before the memory is allocated")
{
  const Mesh mesh = sphere(1);
  const auto build = [&](double resolution, double limit, bool dense) {
    Step_recorder recorder;
    const Shell shell = CGAL::bspline_shell_3(
      mesh, P::resolution(resolution).memory_limit(limit).dense_grid(dense).visitor(std::ref(recorder)));
    if(shell.status() == Status::MEMORY_LIMIT_EXCEEDED) CHECK(recorder.steps.back() == Step::CELLS);
    return shell.status();
  };
  // These shells would take terabytes.
  CHECK(build(3e5, 1e9, false) == Status::MEMORY_LIMIT_EXCEEDED);
  CHECK(build(1e5, 1e9, true) == Status::MEMORY_LIMIT_EXCEEDED);
  CHECK(build(2000, 1e9, true) == Status::MEMORY_LIMIT_EXCEEDED);
  // These have a few thousand cells and unknowns, each of a few thousand bytes.
  CHECK(build(10, 1e5, false) == Status::MEMORY_LIMIT_EXCEEDED);
  CHECK(build(10, 1e6, false) == Status::MEMORY_LIMIT_EXCEEDED);
  CHECK(build(10, 1e8, false) == Status::SUCCESS);
  CHECK(build(10, 1e8, true) == Status::SUCCESS);
}

TEST_CASE("A shell that leaves its cells is rejected if the number of rings is given, and gets more cells otherwise")
{
  // The mesh is a flat double cone. Its rim is so sharp that f is off by many cells there.
  const Mesh mesh = bipyramid(12, 1, 0.1);
  for(int rings : { 1, 2 }) {
    const Shell narrow = CGAL::bspline_shell_3(mesh, P::resolution(10).number_of_rings(rings));
    CHECK_FALSE(narrow);
    CHECK(narrow.status() == Status::SHELL_REACHES_BOUNDARY);
    CHECK(narrow.report().widenings == 0);
  }

  Step_recorder recorder;
  const Shell shell = CGAL::bspline_shell_3(mesh, P::resolution(10).visitor(std::ref(recorder)));
  check_shell(shell, mesh);
  REQUIRE(shell.report().widenings > 0);
  std::vector<Step> expected = { Step::CHECK };
  for(int n = 0; n <= shell.report().widenings; ++n)
    expected.insert(expected.end(), { Step::CELLS, Step::DISTANCE, Step::FIT, Step::BOUNDS });
  CHECK(recorder.steps == expected);

  // At the end of the cells, the field is not between the levels.
  const double w = shell.field().cells().lattice().spacing();
  bool separated = true;
  for(Shell::Field::Cell_index c = 0; c < shell.field().number_of_cells(); ++c) {
    if(!shell.shell_cells()[c]) continue;
    const auto cell = shell.field().cell(c);
    for(int axis = 0; axis < 3; ++axis)
      for(bool positive : { false, true }) {
        if(shell.field().visit_neighbors(c, axis, positive, [](Shell::Field::Cell_index) {})) continue;
        for(int i = 0; i <= 4; ++i)
          for(int j = 0; j <= 4; ++j) {
            std::array<double, 3> p = cell.corner();
            p[axis] += positive ? w : 0;
            p[(axis + 1) % 3] += i * w / 4;
            p[(axis + 2) % 3] += j * w / 4;
            const double f = cell.value(p);
            separated = separated && (f < shell.inner_level() || f > shell.outer_level());
          }
      }
  }
  CHECK(separated);

  // The distance is sampled where cells are added; the fit uses all samples.
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Clipped_mesh_3 clipped = BS::clip_mesh_to_cells<CGAL::Sequential_tag>(input, shell.field().cells());
  const std::vector<double> samples = BS::sample_signed_distance<CGAL::Sequential_tag>(
    BS::Mesh_signed_distance_3(input), shell.field().cells());
  const BS::Fit_energy<Shell::Field> energy(shell.field(), samples, clipped, shell.report().gamma,
                                            BS::Energy_weights());
  CHECK(energy.value(BS::Energy_term::DISTANCE, Eigen::VectorXd(shell.field().coefficients() / w))
        == Approx(shell.report().fit.energy[std::size_t(BS::Energy_term::DISTANCE)]).epsilon(1e-9));

  // The visitor can also cancel at this point.
  Step_recorder stopper;
  stopper.stop_at = 6;
  CHECK(CGAL::bspline_shell_3(mesh, P::resolution(10).visitor(std::ref(stopper))).status() == Status::CANCELED);
  CHECK(stopper.steps.back() == Step::CELLS);
}

TEST_CASE("Rejected meshes are reported with their offending facets")
{
  Mesh open = box(Point_3(0, 0, 0), Point_3(1, 1, 1), false);
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  const Shell shell = CGAL::bspline_shell_3(open, P::resolution(8));
  CHECK_FALSE(shell);
  CHECK(shell.status() == Status::OPEN_MESH);
  CHECK(shell.report().offending_simplices.facets.size() == 4);
  CHECK(CGAL::bspline_shell_3(Mesh()).status() == Status::EMPTY_MESH);

  const Mesh crossing = joined(box(Point_3(0, 0, 0), Point_3(1, 1, 1)),
                               box(Point_3(0.5, 0.25, 0.25), Point_3(1.5, 0.75, 0.75)));
  const Shell rejected = CGAL::bspline_shell_3(crossing, P::resolution(8));
  CHECK(rejected.status() == Status::SELF_INTERSECTION);
  CHECK_FALSE(rejected.report().offending_simplices.facets.empty());
  const Shell allowed = CGAL::bspline_shell_3(crossing, P::resolution(8).allow_self_intersections(true));
  CHECK(allowed.status() != Status::SELF_INTERSECTION);
  CHECK(allowed.report().offending_simplices.facets.empty());
  CHECK(allowed.report().components == 2);
  if(allowed) check_shell(allowed, crossing);
}

TEST_CASE("The distance to another mesh can be used like any signed distance given by the user")
{
  // The larger sphere meets cells that the mesh of the smaller one does not enter. Their signs must come from the
  // oracle.
  const Mesh mesh = sphere(2, 1), larger = sphere(2, 1.25);
  const BS::Input_mesh_3 input = input_of(larger);
  const BS::Mesh_signed_distance_3 distance(input);
  BS::Energy_weights weights;
  weights.mu = 1e-6; // nearly interpolates the samples
  const Shell shell = CGAL::bspline_shell_3(
    mesh, P::resolution(10).energy_weights(weights).number_of_rings(4).allow_open_shell(true).signed_distance_oracle(
            std::cref(distance)));
  REQUIRE(shell);
  for(double r : { 0.8, 1., 1.2, 1.4 }) {
    const Point_3 p(0.6 * r, 0.64 * r, 0.48 * r);
    CHECK(std::abs(shell.field().value(p).value() - distance(p)) < 0.02);
  }
}

TEST_CASE("DISTANCE_NOT_FINITE is returned if the oracle returns NaN")
{
  struct Hole : Sphere_distance
  {
    double operator()(const ::Point_3& p) const
    {
      return p.x() > 0.9 ? std::numeric_limits<double>::quiet_NaN() : Sphere_distance::operator()(p);
    }
  };
  CHECK(CGAL::bspline_shell_3(sphere(1), P::resolution(8).signed_distance_oracle(Hole())).status()
        == Status::DISTANCE_NOT_FINITE);
}

TEST_CASE("INVALID_PARAMETER is returned for meaningless numbers, with the parameter's name, value and bounds")
{
  const Mesh mesh = sphere(0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto check = [](const Shell& shell, const std::string& name, double value) {
    CAPTURE(name, value);
    CHECK(shell.status() == Status::INVALID_PARAMETER);
    const BS::Invalid_parameter& parameter = shell.report().invalid_parameter;
    REQUIRE(parameter);
    CHECK(parameter.name == name);
    CHECK((parameter.value == value || (std::isnan(parameter.value) && std::isnan(value))));
    CHECK_FALSE(parameter.bounds.contains(value));
    CHECK(shell.message() == message(parameter));
  };
  for(double x : { nan, infinity, 0., -1., 1e-9 })
    check(CGAL::bspline_shell_3(mesh, P::resolution(x)), "resolution", x);
  for(double x : { nan, infinity, 0., -1., 1e6 })
    check(CGAL::bspline_shell_3(mesh, P::grid_spacing(x)), "grid_spacing", x);
  for(int rings : { 0, -3 }) check(CGAL::bspline_shell_3(mesh, P::number_of_rings(rings)), "number_of_rings", rings);
  for(double x : { nan, 0., -1. }) check(CGAL::bspline_shell_3(mesh, P::memory_limit(x)), "memory_limit", x);
  for(double x : { nan, infinity, -1. }) {
    BS::Energy_weights weights;
    weights.zeta = x;
    check(CGAL::bspline_shell_3(mesh, P::energy_weights(weights)), "energy_weights.zeta", x);
  }
  CHECK_FALSE(CGAL::bspline_shell_3(mesh, P::resolution(6)).report().invalid_parameter);
}

TEST_CASE("TOO_MANY_CELLS is returned before the cells are enumerated", "[slow]")
{
  const Mesh mesh = sphere(0);
  CHECK(CGAL::bspline_shell_3(mesh, P::resolution(3000).dense_grid(true)).status() == Status::TOO_MANY_CELLS);
  CHECK(CGAL::bspline_shell_3(mesh, P::resolution(10).number_of_rings(500)).status() == Status::TOO_MANY_CELLS);
  CHECK(CGAL::bspline_shell_3(mesh, P::resolution(10).number_of_rings(std::numeric_limits<int>::max())).status()
        == Status::TOO_MANY_CELLS);
}

TEST_CASE("A default-constructed shell is empty")
{
  const Shell shell;
  CHECK_FALSE(shell);
  CHECK(shell.status() == Status::NOT_BUILT);
  for(int s = 0; s <= int(Status::TIME_LIMIT_EXCEEDED); ++s) CHECK_FALSE(std::string(BS::message(Status(s))).empty());
}

TEST_CASE("The library prints nothing")
{
  const Mesh mesh = sphere(1);
  Mesh open = mesh;
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  // The capture of output works.
  REQUIRE(printed_by([]() {
            std::cerr << "a" << std::flush;
            std::printf("b");
          })
          == "ab");
  CHECK(printed_by([&]() {
          CGAL::bspline_shell_3(mesh, P::resolution(8));
          CGAL::bspline_shell_3(open, P::resolution(8));
          CGAL::bspline_shell_3(mesh, P::resolution(1e9));
          CGAL::bspline_shell_3(mesh, P::resolution(8).spd_solver(BS::Conjugate_gradient_solver<>(1e-8, 1)));
        }).empty());
}
} // namespace test_bspline_shell_3
