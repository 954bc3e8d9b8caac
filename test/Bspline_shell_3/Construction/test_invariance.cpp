// If a mesh is scaled, moved, turned or reversed, so is its shell. The shell does not depend on threads, or on the run.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Fit/Conjugate_gradient_solver.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace test_invariance {
namespace {

namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shell_3<> Shell;
typedef std::function<Point_3(const Point_3&)> Map;

// Returns an asymmetric body. Coordinates are multiples of 2^-20, so it can be moved far without rounding.
Mesh asymmetric_body()
{
  return mapped(sphere(2), [](const Point_3& p) {
    const double r = 1 + 0.2 * p.x() * p.y() + 0.15 * p.z() * p.z() * p.x() + 0.1 * p.y();
    const auto rounded = [](double c) { return std::ldexp(std::nearbyint(std::ldexp(c, 20)), -20); };
    return Point_3(rounded(r * p.x()), rounded(0.8 * r * p.y()), rounded(1.2 * r * p.z()));
  });
}

Map scaling(double s)
{
  return [s](const Point_3& p) { return Point_3(s * p.x(), s * p.y(), s * p.z()); };
}

// Returns weights for which conjugate gradients converge well. Otherwise, the point where iterations stop would be
// compared.
CGAL::Bspline_shells::Energy_weights gentle_weights()
{
  CGAL::Bspline_shells::Energy_weights weights;
  weights.zeta = 10;
  weights.singular_hessian = 0;
  return weights;
}

Shell tight_shell(const Mesh& mesh, double spacing)
{
  const Shell shell = CGAL::bspline_shell_3<CGAL::Sequential_tag>(
    mesh, P::grid_spacing(spacing)
            .energy_weights(gentle_weights())
            .spd_solver(CGAL::Bspline_shells::Conjugate_gradient_solver<>(1e-12, 20000)));
  REQUIRE(shell);
  return shell;
}

// Returns points in and around the shell.
std::vector<Point_3> sample_points(const Mesh& mesh, double offset)
{
  std::vector<Point_3> points;
  for(auto f : mesh.faces()) {
    const auto [p, q, r] = corners(mesh, f);
    const Vector_3 n = CGAL::cross_product(q - p, r - p);
    const Point_3 c = CGAL::centroid(p, q, r);
    for(int side = -1; side <= 1; ++side) points.push_back(c + side * offset / std::sqrt(n.squared_length()) * n);
  }
  return points;
}

// Checks that `other` is `scale` times `shell` at the mapped points, up to `tolerance` (user units of `shell`).
void check_same(const Shell& shell, const Shell& other, const std::vector<Point_3>& points, const Map& map,
                double scale, double tolerance)
{
  CHECK(other.report().surface_cells == shell.report().surface_cells);
  CHECK(other.report().cells == shell.report().cells);
  CHECK(other.report().unknowns == shell.report().unknowns);
  // Bounds on the mesh are refined up to 1e-7 of their range.
  const double level_tolerance = tolerance + 2e-7 * shell.thickness();
  CHECK(std::abs(other.inner_level() / scale - shell.inner_level()) <= level_tolerance);
  CHECK(std::abs(other.outer_level() / scale - shell.outer_level()) <= level_tolerance);
  double worst = 0;
  for(const Point_3& p : points) // throws outside the domain
    worst = (std::max)(worst, std::abs(other.field().value(map(p)).value() / scale - shell.field().value(p).value()));
  CHECK(worst <= tolerance);
}

constexpr double spacing = 0.5; // few digits, so that the lattice is exact wherever the mesh is

// The lattice and the quadrature turn with the mesh. Only the order of sums differs (1e-16), and the solver has a
// tolerance of 1e-12. Condition numbers, of up to 1e5, amplify these errors.
constexpr double rounding = 1e-7 * spacing;

} // namespace

TEST_CASE("Scaling a mesh by a power of two scales its shell exactly")
{
  const Mesh mesh = asymmetric_body();
  const Shell shell = CGAL::bspline_shell_3<CGAL::Sequential_tag>(mesh, P::resolution(11));
  REQUIRE(shell);
  for(int exponent : { 1, 40, -40, -190 }) {
    CAPTURE(exponent);
    const double scale = std::ldexp(1., exponent);
    const Shell other = CGAL::bspline_shell_3<CGAL::Sequential_tag>(mapped(mesh, scaling(scale)), P::resolution(11));
    REQUIRE(other);
    CHECK(other.report().gamma == shell.report().gamma);
    CHECK(other.report().fit.iterations == shell.report().fit.iterations);
    REQUIRE(other.field().number_of_coefficients() == shell.field().number_of_coefficients());
    CHECK((other.field().coefficients() == scale * shell.field().coefficients()));
    CHECK(other.inner_level() == scale * shell.inner_level());
    CHECK(other.outer_level() == scale * shell.outer_level());
    CHECK(other.relative_thickness() == shell.relative_thickness());
  }
}

TEST_CASE("Scaling a mesh by any factor scales its shell up to rounding")
{
  const Mesh mesh = asymmetric_body();
  const std::vector<Point_3> points = sample_points(mesh, spacing / 2);
  const Shell shell = tight_shell(mesh, spacing);
  for(double scale : { 1e-6, 1e6, 3. }) {
    CAPTURE(scale);
    // The spacing is rounded to 20 bits, 1e-6 of a cell. Half the box has three cells, so a lattice plane moves by up
    // to 3e-6 of a cell. The field moves less: it is off by hundredths of a cell at the edges.
    const Shell other = tight_shell(mapped(mesh, scaling(scale)), scale * spacing);
    check_same(shell, other, points, scaling(scale), scale, 1e-5 * spacing);
  }
}

TEST_CASE("Scaling a box by any factor preserves the number of cells and the relative thickness, at every resolution",
          "[slow]")
{
  // At even resolutions, all sides would be in lattice planes, and rounding would move them to either side.
  const Mesh mesh = box(Point_3(-1, -1, -1), Point_3(1, 1, 1)), oblong = box(Point_3(0, 0, 0), Point_3(1, 0.5, 0.25));
  for(const Mesh& m : { mesh, oblong })
    for(double resolution : { 8., 9., 10., 11. }) {
      CAPTURE(resolution);
      const Shell shell = CGAL::bspline_shell_3(m, P::resolution(resolution).energy_weights(gentle_weights()));
      REQUIRE(shell);
      for(double scale : { 1e-6, 1e6, 0.3 }) {
        CAPTURE(scale);
        const Shell other = CGAL::bspline_shell_3(mapped(m, scaling(scale)),
                                                  P::resolution(resolution).energy_weights(gentle_weights()));
        REQUIRE(other);
        CHECK(other.report().surface_cells == shell.report().surface_cells);
        CHECK(other.report().cells == shell.report().cells);
        // The tolerance is that of the solver, as above.
        CHECK(std::abs(other.relative_thickness() - shell.relative_thickness()) < 1e-3 * shell.relative_thickness());
      }
    }
}

TEST_CASE("Moving a mesh far from the origin moves its shell up to rounding")
{
  Mesh mesh = asymmetric_body();
  // The lattice begins at the center of the box, which is rounded to fewer bits far from the origin. So the center is
  // moved to the origin first.
  const CGAL::Bbox_3 b = CGAL::Polygon_mesh_processing::bbox(mesh);
  const Vector_3 center((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
  mesh = mapped(mesh, [&](const Point_3& p) { return p - center; });
  const std::vector<Point_3> points = sample_points(mesh, spacing / 2);
  const Shell shell = tight_shell(mesh, spacing);
  for(double distance : { std::ldexp(1., 10), std::ldexp(1., 21) }) { // up to a million times the box
    CAPTURE(distance);
    const Map map = [distance](const Point_3& p) {
      return Point_3(p.x() + distance, p.y() - distance, p.z() + distance);
    };
    // Vertices and the spacing are exact. Computed values are rounded to 2^-53 of the coordinates. Bounds allow for 9 *
    // 64 eps * coordinates / width (level_bounds.h), times the range of the field on a cell, which is less than three
    // cells. The solver's tolerance is added.
    const double eps = std::ldexp(1., -52);
    const double tolerance = spacing * (1e-7 + 3 * 9 * 64 * eps * distance / spacing);
    check_same(shell, tight_shell(mapped(mesh, map), spacing), points, map, 1, tolerance);
  }
}

TEST_CASE("Rotating a mesh by right angles, or mirroring it, does the same to its shell")
{
  const Mesh mesh = asymmetric_body();
  const std::vector<Point_3> points = sample_points(mesh, spacing / 2);
  const Shell shell = tight_shell(mesh, spacing);
  const Map turn_x = [](const Point_3& p) { return Point_3(p.x(), -p.z(), p.y()); };
  const Map turn_y = [](const Point_3& p) { return Point_3(p.z(), p.y(), -p.x()); };
  const Map turn_z = [](const Point_3& p) { return Point_3(-p.y(), p.x(), p.z()); };
  for(const Map& turn : { turn_x, turn_y, turn_z }) {
    Map map = turn;
    for(int times = 1; times <= 3; ++times) {
      CAPTURE(times);
      check_same(shell, tight_shell(mapped(mesh, map), spacing), points, map, 1, rounding);
      map = [map, turn](const Point_3& p) { return turn(map(p)); };
    }
  }
  const Map mirror = [](const Point_3& p) { return Point_3(-p.x(), p.y(), p.z()); };
  check_same(shell, tight_shell(reversed(mapped(mesh, mirror)), spacing), points, mirror, 1, rounding);
}

TEST_CASE("Sides in lattice planes do not break the symmetry of the shell")
{
  // Two bricks of 4 x 5 x 5 cells each. Their sides are in lattice planes, which are at odd multiples of 1/4.
  const Mesh mesh = joined(box(Point_3(-2.5, -1, -1), Point_3(-0.75, 1, 1)),
                           box(Point_3(0.75, -1, -1), Point_3(2.5, 1, 1)));
  const std::vector<Point_3> points = sample_points(mesh, spacing / 2);
  const Shell shell = tight_shell(mesh, spacing);
  REQUIRE(shell.report().surface_cells == 2 * (4 * 5 * 5 - 2 * 3 * 3)); // all but the inner cells
  const Map turn = [](const Point_3& p) { return Point_3(-p.y(), p.x(), p.z()); };
  const Map mirror = [](const Point_3& p) { return Point_3(-p.x(), p.y(), p.z()); };
  check_same(shell, tight_shell(mapped(mesh, turn), spacing), points, turn, 1, rounding);
  check_same(shell, tight_shell(reversed(mapped(mesh, mirror)), spacing), points, mirror, 1, rounding);
}

TEST_CASE("Reversing the facets of a mesh negates the field")
{
  const Mesh body = asymmetric_body(), hole = reversed(mapped(body, scaling(0.25))),
             mesh = joined(body, hole); // with the hole, it differs from its inside-out mesh
  const std::vector<Point_3> points = sample_points(body, spacing / 2);
  const Shell shell = tight_shell(mesh, spacing), inverse = tight_shell(reversed(mesh), spacing);
  CHECK(inverse.report().cells == shell.report().cells);
  CHECK(std::abs(inverse.inner_level() + shell.outer_level()) < rounding);
  CHECK(std::abs(inverse.outer_level() + shell.inner_level()) < rounding);
  double worst = 0;
  for(const Point_3& p : points)
    worst = (std::max)(worst, std::abs(inverse.field().value(p).value() + shell.field().value(p).value()));
  CHECK(worst < rounding);
  CHECK(shell.thickness() > 1e-3 * spacing); // otherwise all levels above would be equal
}

TEST_CASE("The shell is bitwise identical in every run and for any number of threads", "[slow]")
{
  const Mesh mesh = asymmetric_body();
  const auto build = [&](auto tag) {
    typedef decltype(tag) Tag;
    CGAL::Bspline_shells::Energy_weights weights;
    weights.singular_hessian = 1;
    const Shell shell = CGAL::bspline_shell_3<Tag>(mesh, P::resolution(14).energy_weights(weights));
    REQUIRE(shell);
    return shell;
  };
  const Shell shell = build(CGAL::Sequential_tag());
  const auto check_identical = [&](const Shell& other) {
    REQUIRE(other.field().number_of_coefficients() == shell.field().number_of_coefficients());
    CHECK((other.field().coefficients() == shell.field().coefficients()));
    CHECK(other.inner_level() == shell.inner_level());
    CHECK(other.outer_level() == shell.outer_level());
    CHECK(other.report().edges.min == shell.report().edges.min);
    CHECK(other.report().edges.max == shell.report().edges.max);
    bool same = other.facet_ranges().size() == shell.facet_ranges().size();
    for(std::size_t n = 0; same && n < shell.facet_ranges().size(); ++n)
      same = other.facet_ranges()[n].min == shell.facet_ranges()[n].min
             && other.facet_ranges()[n].max == shell.facet_ranges()[n].max;
    CHECK(same);
  };
  check_identical(build(CGAL::Sequential_tag()));
  for(int run = 0; run < 3; ++run) check_identical(build(CGAL::Parallel_if_available_tag()));
}
} // namespace test_invariance
