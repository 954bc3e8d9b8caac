// certified_bspline_shell_3(): the shell is certified, or the report has the reason. Thickness, thin parts, limits.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace test_certified_bspline_shell_3 {
namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_certificate_3<Shell::Field, Shell::Threshold> Certificate;
typedef BS::Refinement_status Refinement_status;

namespace {

// Returns the width of the shell at a point of the mesh.
double width_at(const Shell& shell, const Point_3& p)
{
  return shell.outer_threshold().value(p) - shell.inner_threshold().value(p);
}

void check_certified(const Mesh& mesh, const Shell& shell)
{
  REQUIRE(shell);
  CHECK(shell.is_certified());
  CHECK(shell.report().refinement == Refinement_status::CERTIFIED);
  CHECK(shell.report().certificate.witnesses.empty());
  // Verify again, with the stored data.
  Certificate certificate(shell);
  CHECK(certificate.verify<CGAL::Sequential_tag>(mesh));
  REQUIRE(shell.proved_cover());
  CHECK(certificate.number_of_covers() == shell.report().certificate.covers);
  CHECK(certificate.statistics().cover_boxes == shell.report().certificate.statistics.cover_boxes);
  CHECK(certificate.least_gradient() == shell.report().certificate.least_gradient);
  CHECK(certificate.displacement_bound() == shell.report().certificate.displacement_bound);
  CHECK(certificate.report().largest_gradient == shell.report().certificate.largest_gradient);
  CHECK(certificate.least_angle() == shell.report().certificate.least_angle);
  BS::Shell_containment_3<Shell::Field, Shell::Threshold> is_in_shell(shell);
  CHECK(is_in_shell(mesh));
  for(auto v : mesh.vertices()) CHECK(shell.bounded_side(mesh.point(v)) != CGAL::ON_UNBOUNDED_SIDE);
}

// Returns a sheet in the plane z = 0, of triangles between circles around the origin.
Mesh rings(const std::vector<double>& radii, int sectors)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(double r : radii)
    for(int s = 0; s < sectors; ++s) {
      const double angle = 2 * std::acos(-1.) * s / sectors;
      v.push_back(mesh.add_vertex(Point_3(r * std::cos(angle), r * std::sin(angle), 0)));
    }
  for(std::size_t r = 0; r + 1 < radii.size(); ++r)
    for(int s = 0; s < sectors; ++s) {
      const auto at = [&](std::size_t ring, int sector) {
        return v[ring * std::size_t(sectors) + std::size_t(sector % sectors)];
      };
      mesh.add_face(at(r, s), at(r + 1, s), at(r + 1, s + 1));
      mesh.add_face(at(r, s), at(r + 1, s + 1), at(r, s + 1));
    }
  return mesh;
}

// Returns an L of 10 x 10 squares with two triangles each, without a quarter.
Mesh angle()
{
  Mesh mesh = sheet(steps(0, 1, 10), steps(0, 1, 10));
  remove_facets(mesh, [](const Point_3& p) { return p.x() > 0.5 && p.y() > 0.5; });
  return mesh;
}

} // namespace

TEST_CASE("Certified shells: flat and symmetric meshes are certified, axis-aligned and rotated, at any size", "[slow]")
{
  const std::pair<Mesh, double> meshes[] = { { rings({ 0.9, 0.925, 0.95, 0.975, 1. }, 80),
                                               1 }, // the 80 largest facets of its closing are alike, at a crease
                                             { rings({ 0.5, 1. }, 7), 1e6 },
                                             { sheet({ 0, 1 }, { 0, 1 }), 1e-6 },
                                             { angle(), 1 },
                                             { subdivided(subdivided(box(Point_3(0, 0, 0), Point_3(1, 1, 1)))), 1e-6 },
                                             { pyramid(6, 1.), 1e6 },
                                             { torus(1, 0.4, 32, 16), 1 } };
  const double c = std::cos(0.4), s = std::sin(0.4);
  for(const auto& [mesh, size] : meshes)
    for(bool is_turned : { false, true }) {
      const double factor = size;
      const auto map = [&](const Point_3& point) {
        const Vector_3 p = factor * (point - CGAL::ORIGIN), q(p.x(), c * p.y() - s * p.z(), s * p.y() + c * p.z());
        return CGAL::ORIGIN + (is_turned ? Vector_3(c * q.x() - s * q.y(), s * q.x() + c * q.y(), q.z()) : p);
      };
      CHECK(CGAL::certified_bspline_shell_3(mapped(mesh, map)).is_certified());
    }
}

TEST_CASE("Certified shells: copies share the bounds on cells, which outlive the original and change no certificate")
{
  const Mesh mesh = torus(2, 0.7, 24, 12);
  std::optional<Shell> built(CGAL::certified_bspline_shell_3(mesh));
  REQUIRE(*built);
  const Shell copy = *built, moved = std::move(*built);
  built.reset();
  REQUIRE(copy.cell_bounds());
  CHECK(copy.cell_bounds() == moved.cell_bounds());
  CHECK(&copy.field() == &moved.field());
  const BS::Shell_facet_oracle_3<Shell::Field, Shell::Threshold> oracle(copy);
  CHECK(oracle.bounds() == copy.cell_bounds());
  Certificate sharing(copy), alone(moved.field(), moved.inner_threshold(), moved.outer_threshold());
  for(double factor : { 1., 1.001, 1.1 }) {
    const Mesh scaled = mapped(mesh, [&](const Point_3& p) { return CGAL::ORIGIN + factor * (p - CGAL::ORIGIN); });
    CHECK(sharing.verify(scaled) == (factor < 1.1));
    CHECK(alone.verify(scaled) == (factor < 1.1));
    CHECK(sharing.bounds() == copy.cell_bounds());
    CHECK(alone.bounds() != copy.cell_bounds());
    CHECK(sharing.report().largest_gradient == alone.report().largest_gradient);
    CHECK(sharing.least_angle() == alone.least_angle());
    REQUIRE(sharing.facets().size() == alone.facets().size());
    for(std::size_t n = 0; n < sharing.facets().size(); ++n) {
      CHECK(sharing.facets()[n].containment == alone.facets()[n].containment);
      CHECK(sharing.facets()[n].transversality == alone.facets()[n].transversality);
      CHECK(sharing.facets()[n].slope == alone.facets()[n].slope);
    }
  }
}

TEST_CASE("Certified shells: simple solids are certified at the default thickness, without narrowing")
{
  for(const Mesh& mesh :
      { sphere(2), box(Point_3(0, 0, 0), Point_3(3, 2, 1)), pyramid(12, 1.), torus(2, 0.7, 24, 12) }) {
    const Shell shell = CGAL::certified_bspline_shell_3(mesh);
    check_certified(mesh, shell);
    CHECK(shell.relative_thickness() <= 0.01 * (1 + 1e-9));
    CHECK(shell.relative_thickness() > 0.009);
    CHECK(shell.report().narrowed_area == 0);
    CHECK(shell.report().rounds.back().thickness <= shell.thickness());
  }
}

TEST_CASE("Certified shells: the result does not depend on the number of threads")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(2, 1, 1));
  const Shell one = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(mesh);
  const Shell two = CGAL::certified_bspline_shell_3<CGAL::Parallel_if_available_tag>(mesh);
  CHECK(one.field().coefficients() == two.field().coefficients());
  CHECK(one.outer_threshold().field().coefficients() == two.outer_threshold().field().coefficients());
  CHECK(one.report().certificate.least_gradient == two.report().certificate.least_gradient);
}

TEST_CASE("Certified shells: a smaller thickness takes more cells, and may be given in units or as a function",
          "[slow]")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(2, 1, 1));
  const Shell coarse = CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(0.02));
  const Shell fine = CGAL::certified_bspline_shell_3(mesh, parameters::thickness(0.003));
  check_certified(mesh, coarse);
  check_certified(mesh, fine);
  CHECK(coarse.relative_thickness() == Approx(0.02));
  CHECK(fine.thickness() == Approx(0.003));
  CHECK(fine.report().cells > coarse.report().cells);
  const Shell varying = CGAL::certified_bspline_shell_3(
    mesh, parameters::sizing([](const Point_3& p) { return p.x() < 1 ? 0.01 : 0.04; }));
  check_certified(mesh, varying);
  CHECK(width_at(varying, Point_3(0.2, 0.5, 1)) == Approx(0.01).epsilon(0.01));
  CHECK(width_at(varying, Point_3(1.8, 0.5, 1)) == Approx(0.04).epsilon(0.01));
}

TEST_CASE("Certified shells: between two plates the shell is narrowed as needed, however small the gap", "[slow]")
{
  for(double gap : { 0.1, 0.008 }) {
    const Mesh mesh = joined(box(Point_3(0, 0, 0), Point_3(1, 1, 0.2)),
                             box(Point_3(0.3, 0.3, 0.2 + gap), Point_3(0.7, 0.7, 0.5)));
    const Shell shell = CGAL::certified_bspline_shell_3(mesh);
    check_certified(mesh, shell);
    CHECK(shell.relative_thickness() == Approx(0.01).epsilon(1e-6));
    const double in_gap = width_at(shell, Point_3(0.5, 0.5, 0.2)), outside = width_at(shell, Point_3(0.5, 0.5, 0));
    CHECK(outside == Approx(0.01).epsilon(1e-6));
    if(gap > 0.01) CHECK(in_gap == Approx(0.01).epsilon(1e-6));
    else {
      CHECK(in_gap < 0.0095);
      CHECK(shell.report().narrowed_area > 0);
      CHECK(shell.report().narrowed_area < 0.5);
    }
  }
}

TEST_CASE("Certified shells: nested and separate components are certified together")
{
  const Mesh mesh = joined(joined(sphere(2, 1), reversed(sphere(2, 0.8))), sphere(2, 0.3, Point_3(0.1, 0, 0)));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  check_certified(mesh, shell);
  CHECK(shell.report().components == 3);
}

TEST_CASE("Certified shells: a pyramid with a sharp apex is certified")
{
  for(double height : { 2., 5. }) {
    const Mesh mesh = pyramid(8, height);
    const Shell shell = CGAL::certified_bspline_shell_3(mesh);
    check_certified(mesh, shell);
    CHECK(shell.report().certificate.least_cone_margin < 0.9);
  }
}

TEST_CASE("Certified shells: without truncation, a mesh with a singular vertex is rejected, and the vertex is reported")
{
  const Mesh mesh = demo_mesh("femur.off");
  const Shell rejected = CGAL::certified_bspline_shell_3(mesh, parameters::truncate(false));
  CHECK(rejected.status() == BS::Shell_status::SINGULAR_VERTEX);
  CHECK(rejected.report().offending_simplices.vertices.size() == 1);
}

TEST_CASE("Certified shells: a limit ends refinement with the shell reached so far, and is reported")
{
  const Mesh mesh = demo_mesh("elephant.off");
  const double thin = 0.003;
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(thin).memory_limit(5e7));
  REQUIRE(shell);
  CHECK(shell.relative_thickness() > thin); // less than requested was reached, certified or not
  CHECK(shell.report().refinement == Refinement_status::LIMIT_REACHED);
  CHECK(shell.report().rounds.size() == 1);
  CHECK(shell.report().certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED);
  CHECK(shell.is_certified() == shell.report().certificate.witnesses.empty());
  // The cover is stored only if the shell is proved to be free of critical points.
  CHECK(bool(shell.proved_cover()) == (shell.report().certificate.verdict(BS::Claim::GRADIENT) == BS::Verdict::PROVED));
  CHECK(shell.report().limit.cells > shell.report().cells);
  const BS::Refinement_limit memory = shell.report().limit;
  CHECK(memory.resource == BS::Refinement_resource::MEMORY);
  const Shell little_effort = CGAL::certified_bspline_shell_3(mesh,
                                                              parameters::relative_thickness(thin).effort_limit(1));
  REQUIRE(little_effort);
  CHECK(little_effort.report().limit.resource == BS::Refinement_resource::EFFORT);
  CHECK(little_effort.report().rounds.size() == 1);
  CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::effort_limit(0)).status()
        == BS::Shell_status::INVALID_PARAMETER);
  CHECK(memory.bytes > 5e7);
  CHECK(memory.bytes < 5e9);
  CHECK(CGAL::certified_bspline_shell_3(mesh).report().limit.resource == BS::Refinement_resource::NONE);
  CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::memory_limit(1e4)).status()
        == BS::Shell_status::MEMORY_LIMIT_EXCEEDED);
}

TEST_CASE("Certified shells: a sharp fin is certified within two rounds")
{
  // At the tip of a wing, facets at an angle of 16 degrees are a few hundredths of a cell apart.
  const Mesh mesh = demo_mesh("mech-holes-shark.off");
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  CHECK(shell.is_certified());
  // In further rounds, cells would only become smaller than the fin.
  CHECK(shell.report().rounds.size() <= 2);
}

TEST_CASE("Certified shells: each limit of refinement has a message")
{
  BS::Refinement_limit limit = { BS::Refinement_resource::NONE, 1200, 4.2e9 };
  CHECK(message(limit).empty());
  limit.resource = BS::Refinement_resource::MEMORY;
  CHECK(message(limit)
        == "Another round of refinement would have 1200 cells and need about 4200 MB, which exceeds the memory limit: "
           "raise it (memory_limit).");
  limit.resource = BS::Refinement_resource::NUMBERS;
  CHECK(message(limit)
        == "Another round of refinement would have 1200 cells and more unknowns than can be numbered: see the "
           "obstacles in the report.");
  limit.resource = BS::Refinement_resource::EFFORT;
  CHECK(message(limit)
        == "Another round of refinement would have 1200 cells, and all rounds together would exceed the effort limit: "
           "raise it (effort_limit).");
  limit.resource = BS::Refinement_resource::ROUNDS;
  CHECK(message(limit) == "The maximum number of refinement rounds was reached.");
}

TEST_CASE("Certified shells: constant thresholds are two levels, closer than the requested thickness")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(2, 1, 1));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::constant_thresholds(true));
  check_certified(mesh, shell);
  CHECK(shell.relative_thickness() < 0.01);
  CHECK(width_at(shell, Point_3(0, 0, 0)) == Approx(width_at(shell, Point_3(1, 0.5, 1))).epsilon(1e-9));
}

TEST_CASE("Certified shells: constant thresholds are provable for a box, whatever its diagonals")
{
  // Extrema of the field on the mesh are at corners of the box, so that bounds on the field are sharp there.
  const Mesh quads = box(Point_3(0, 0, 0), Point_3(2, 1, 1), false);
  for(int diagonals : { 0, 21, 32, 42, 63 }) {
    Mesh mesh = quads;
    int n = 0;
    for(auto f : quads.faces()) {
      auto h = mesh.halfedge(f);
      if(diagonals >> n++ & 1) h = mesh.next(h);
      CGAL::Euler::split_face(h, mesh.next(mesh.next(h)), mesh);
    }
    check_certified(mesh, CGAL::certified_bspline_shell_3(mesh, parameters::constant_thresholds(true)));
  }
}

TEST_CASE("Certified shells: invalid parameters, rejected meshes and cancellation have a status")
{
  const Mesh mesh = sphere(1);
  typedef BS::Shell_status Status;
  const auto check = [](const CGAL::Certified_bspline_shell_3& shell, const std::string& name, double value) {
    CAPTURE(name, value);
    CHECK(shell.status() == Status::INVALID_PARAMETER);
    const BS::Invalid_parameter& parameter = shell.report().invalid_parameter;
    REQUIRE(parameter);
    CHECK(parameter.name == name);
    CHECK(parameter.value == value);
    CHECK_FALSE(parameter.bounds.contains(value));
    CHECK(shell.message() == message(parameter));
  };
  check(CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(0.)), "relative_thickness", 0);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::thickness(-1.)), "thickness", -1);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::resolution(0.)), "resolution", 0);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::time_limit(0.)), "time_limit", 0);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::memory_limit(-1.)), "memory_limit", -1);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::least_cone_margin(1.)), "least_cone_margin", 1);
  // The thickness must be less than twenty root cells.
  check(CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(5.)), "relative_thickness", 5);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::thickness(10.)), "thickness", 10);
  check(CGAL::certified_bspline_shell_3(mesh, parameters::sizing([](const Point_3&) { return -0.5; })), "sizing", -0.5);
  CHECK(CGAL::certified_bspline_shell_3(Mesh()).status() == Status::EMPTY_MESH);
  // A solver that returns zeros.
  struct Zeros
  {
    BS::Solver_status compute(const Eigen::SparseMatrix<double>&, const BS::Unknown_blocks&)
    {
      return BS::Solver_status::SUCCESS;
    }
    BS::Solver_status solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
    {
      x = Eigen::VectorXd::Zero(b.size());
      return BS::Solver_status::SUCCESS;
    }
    std::size_t iterations() const { return 1; }
    double residual() const { return 0; }
  };
  const auto unsolved = CGAL::certified_bspline_shell_3(mesh, parameters::spd_solver(Zeros()));
  CHECK(unsolved.status() == Status::SOLVER_FAILED);
  CHECK(unsolved.message() == message(BS::Solver_status::WRONG_SOLUTION));
  CHECK(CGAL::certified_bspline_shell_3(joined(sphere(1), sphere(1))).status() == Status::SELF_INTERSECTION);
  struct Canceling
  {
    bool start_step(BS::Shell_step step) { return step != BS::Shell_step::CERTIFICATE; }
  };
  CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::visitor(Canceling())).status() == Status::CANCELED);
}

TEST_CASE("Certified shells: wherever a limit ends refinement, the shell contains the mesh, even if it self-intersects",
          "[slow]")
{
  // Limits end refinement after the first or the second round. In the second round, the field was changed after it was
  // bounded on the mesh.
  struct Case
  {
    Mesh mesh;
    double megabytes;
  };
  const auto two_spheres = [](int rings) {
    const Mesh mesh = sliced_sphere(2 * rings, rings);
    return joined(mesh, mapped(mesh, [](const Point_3& p) { return p + Vector_3(1.2, 0, 0); }));
  };
  const Mesh overlapping = two_spheres(8), other = two_spheres(4),
             plate = box(Point_3(-1, -1, -0.004), Point_3(1, 1, 0.004));
  std::size_t shells = 0;
  for(const Case& c : { Case{ overlapping, 1 }, Case{ overlapping, 40 }, Case{ overlapping, 80 }, Case{ other, 60 },
                        Case{ plate, 80 } }) {
    CAPTURE(c.megabytes);
    const Shell shell = CGAL::certified_bspline_shell_3(c.mesh, parameters::allow_self_intersections(true)
                                                                  .memory_limit(c.megabytes * 1e6)
                                                                  .resolution(10)
                                                                  .relative_thickness(0.04));
    if(!shell) {
      CHECK((shell.status() == BS::Shell_status::MEMORY_LIMIT_EXCEEDED
             || shell.status() == BS::Shell_status::MESH_NOT_CONTAINED));
      continue;
    }
    ++shells;
    CHECK(shell.report().certificate.verdict(BS::Claim::CONTAINMENT) == BS::Verdict::PROVED);
    const BS::Shell_containment_3<Shell::Field, Shell::Threshold> is_in_shell(shell);
    CHECK(is_in_shell(c.mesh));
    for(auto v : c.mesh.vertices()) CHECK(shell.bounded_side(c.mesh.point(v)) != CGAL::ON_UNBOUNDED_SIDE);
    if(!shell.is_certified()) CHECK(std::string(shell.message()).find("not certified") != std::string::npos);
  }
  CHECK(shells == 4);
}
} // namespace test_certified_bspline_shell_3
