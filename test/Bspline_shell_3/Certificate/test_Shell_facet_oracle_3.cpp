// Shell_facet_oracle_3.h: facets that fail only in their inside are rejected, and cached results apply to the same
// facets only. (Oracles in edits: test_Shell_filter.cpp.)
#include "polynomial_fields.h"
#include "shell_reports.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>

#include <Eigen/Geometry>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

namespace test_Shell_facet_oracle_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Placement_verdict;
typedef BS::Shell_facet_oracle_3<Field> Oracle;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;

constexpr double pi = 3.141592653589793;

// Returns points of the sphere of radius 0.8, 60 degrees from its north pole, at the given longitudes.
std::vector<Point_3> band(std::initializer_list<double> degrees)
{
  std::vector<Point_3> link;
  for(double d : degrees)
    link.push_back(
      Point_3(0.8 * std::sin(pi / 3) * std::cos(d * pi / 180), 0.8 * std::sin(pi / 3) * std::sin(d * pi / 180), 0.4));
  return link;
}

const Point_3 pole(0, 0, 0.8);

// Returns the shell between spheres of radii 0.6 and 0.81.
CGAL::Bspline_shell_3<Field> ball_shell()
{
  return shell_of(uniform_field(squared_distance), 0.36, 0.6561);
}

} // namespace

TEST_CASE("Facet oracle: without a shell, all facets are rejected")
{
  const CGAL::Bspline_shell_3<Field> none;
  const Oracle oracle(none);
  const std::vector<Point_3> link = band({ 0, 120, 240 });
  Oracle::Memory memory;
  CHECK(oracle(pole, link, memory) != Placement_verdict::ACCEPTED);
  CHECK(oracle(pole, link[0], link[1]) != Placement_verdict::ACCEPTED);
  CHECK(oracle.winding_number(pole, link) == 0);
}

TEST_CASE("Facet oracle: a facet that leaves the shell at the middle of the link's edge is rejected")
{
  const auto shell = ball_shell();
  const Oracle oracle(shell);
  Oracle::Memory memory;
  CHECK(oracle(pole, band({ 0, 60, 120, 180, 240, 300 }), memory) == Placement_verdict::ACCEPTED);
  // a chord of 97 degrees
  CHECK(oracle(pole, band({ 0, 120, 240 }), memory) == Placement_verdict::LEAVES_SHELL);
  CHECK(oracle.winding_number(pole, band({ 0, 120, 240 })) == 1);
}

TEST_CASE("Facet oracle: the cached result of a facet or a link is not used for another one")
{
  const auto shell = ball_shell();
  const Oracle oracle(shell);
  Oracle::Memory memory;
  const std::vector<Point_3> link = band({ 0, 60, 120, 180, 240, 300 });
  REQUIRE(oracle(pole, link, memory) == Placement_verdict::ACCEPTED);
  // The corner at 120 degrees differs from the one at 60 degrees in one coordinate only.
  std::vector<Point_3> wide = band({ 0, 120, 180, 240, 300 });
  wide[1] = Point_3(-link[1].x(), link[1].y(), link[1].z());
  CHECK(oracle(pole, wide, memory) == Placement_verdict::LEAVES_SHELL);
  // same number of vertices, one of them moved
  std::vector<Point_3> other = link;
  other[2] = Point_3(1.1 * other[2].x(), 1.1 * other[2].y(), 1.1 * other[2].z());
  REQUIRE(oracle(pole, link, memory) == Placement_verdict::ACCEPTED);
  CHECK(oracle(pole, other, memory) == Placement_verdict::LEAVES_SHELL);
}

TEST_CASE("Facet oracle: a facet that faces away only between its corners and edge midpoints is rejected")
{
  // The slope of horizontal facets is 2 x^2 - 1e-9. Bisections do not come close enough to zero to find the negative
  // slope.
  const auto shell = shell_of(uniform_field({ { -1e-9, { 0, 0, 1 } }, { 2, { 2, 0, 1 } } }), -5, 5);
  const Oracle oracle(shell);
  Oracle::Memory memory;
  const double z = 0.1;
  CHECK(oracle(Point_3(0.31, 0, z),
               { Point_3(-0.47, -0.4, z), Point_3(0.83, -0.4, z), Point_3(0.61, 0.6, z), Point_3(-0.47, 0.4, z) },
               memory)
        != Placement_verdict::ACCEPTED);
  CHECK(oracle(Point_3(0.5, 0, z),
               { Point_3(0.2, -0.4, z), Point_3(0.9, -0.4, z), Point_3(0.9, 0.6, z), Point_3(0.2, 0.4, z) }, memory)
        == Placement_verdict::ACCEPTED);
}

TEST_CASE("Facet oracle: a cached rejection does not affect facets that share two of its corners")
{
  const auto shell = shell_of(uniform_field({ { -1e-9, { 0, 0, 1 } }, { 2, { 2, 0, 1 } } }), -5, 5);
  const Oracle oracle(shell);
  const auto at = [](double x, double y) { return Point_3(x, y, 0.1); };
  const Point_3 p = at(0.31, 0), a = at(0.83, -0.4), b = at(0.61, 0.6), c = at(-0.47, 0.4), d = at(-0.47, -0.4);
  const std::vector<Point_3> good = { a, b, at(0.08, 0.1), at(0.1, -0.3) };
  // Only the first rejected facet is cached: (p, b, c) and (p, d, a).
  for(const std::vector<Point_3>& bad : { std::vector<Point_3>{ a, b, c, d }, std::vector<Point_3>{ d, a, b, c } }) {
    Oracle::Memory memory;
    for(int times = 0; times < 2; ++times) {
      CHECK(oracle(p, bad, memory) == Placement_verdict::FACES_AWAY);
      CHECK(oracle(p, good, memory) == Placement_verdict::ACCEPTED);
    }
  }
}

TEST_CASE("Facet oracle: the cache does not change which fans are accepted")
{
  const auto shell = ball_shell();
  for(const auto proofs : { BS::Facet_proofs::ALL, BS::Facet_proofs::WHERE_DOUBTFUL }) {
    const Oracle oracle(shell, proofs);
    Oracle::Memory memory, short_memory(5);
    std::mt19937 random(1);
    const auto choose = [&](std::size_t n) { return random() % n; };
    // Fans have few apexes. Successive links usually differ in at most one vertex.
    std::vector<Point_3> places, link = band({ 0, 60, 120, 180, 240, 300 });
    for(double x : { 0., 0.1, 0.3, 0.5 })
      for(double z : { 0.62, 0.7, 0.8, 0.85 }) places.push_back(Point_3(x, 0, z));
    std::size_t accepted = 0;
    constexpr std::size_t questions = 4000;
    for(std::size_t n = 0; n < questions; ++n) {
      if(choose(50) == 0)
        link = choose(2) == 0 ? band({ 0, 60, 120, 180, 240, 300 }) : band({ 0, 50, 100, 150, 200, 250, 300 });
      if(choose(3) == 0) {
        const std::size_t v = choose(link.size());
        const Point_3 moved = band({ 360. * double(v) / double(link.size()) + 10. * double(choose(3)) })[0];
        const double scale = 0.86 + 0.02 * double(choose(10));
        link[v] = Point_3(scale * moved.x(), scale * moved.y(), scale * moved.z());
      }
      const Point_3& p = places[choose(places.size())];
      Oracle::Memory nothing;
      const bool is_accepted = oracle(p, link, nothing) == Placement_verdict::ACCEPTED;
      CHECK((oracle(p, link, memory) == Placement_verdict::ACCEPTED) == is_accepted);
      CHECK((oracle(p, link, short_memory) == Placement_verdict::ACCEPTED) == is_accepted);
      accepted += is_accepted ? 1 : 0;
    }
    CHECK(accepted > questions / 50);
    CHECK(accepted < questions / 2);
  }
}

TEST_CASE("Facet oracle: a facet that barely leaves the shell in its interior is rejected")
{
  // -(x^2 + y^2) in the plane z = 0.1
  const Field field = uniform_field(
    { { -1, { 2, 0, 0 } }, { -1, { 0, 2, 0 } }, { 1, { 0, 0, 1 } }, { -0.1, { 0, 0, 0 } } });
  const std::vector<Point_3> link = { Point_3(-0.21, -0.17, 0.1), Point_3(0.43, -0.13, 0.1), Point_3(0.37, 0.41, 0.1),
                                      Point_3(-0.19, 0.37, 0.1) };
  const Point_3 p(0.23, 0.13, 0.1);
  for(double outer : { -1e-9, 0.01 }) {
    const auto shell = shell_of(field, -5, outer);
    Oracle::Memory memory;
    const Oracle oracle(shell);
    for(int times = 0; times < 2; ++times) // the second verdict comes from the cache
      CHECK((oracle(p, link, memory) == Placement_verdict::ACCEPTED) == (outer > 0));
  }
}

TEST_CASE("Facet oracle: a single facet that barely leaves the shell, or is parallel to the gradient, is rejected")
{
  const Field field = uniform_field({ { 1, { 0, 0, 1 } } });
  const Point_3 p(0.1, 0.1, 0.25), q(0.3, 0.1, 0.25), r(0.1, 0.3, 0.25), up(0.1, 0.1, 0.35);
  const auto inside = shell_of(field, -0.5, 0.25 + 1e-12), outside = shell_of(field, -0.5, 0.25 - 1e-15),
             wide = shell_of(field, -0.5, 0.5);
  CHECK(Oracle(inside)(p, q, r) == Placement_verdict::ACCEPTED);
  CHECK(Oracle(outside)(p, q, r) == Placement_verdict::LEAVES_SHELL);
  CHECK(Oracle(wide)(p, q, r) == Placement_verdict::ACCEPTED);
  CHECK(Oracle(wide)(p, q, up) == Placement_verdict::FACES_AWAY);
  CHECK(Oracle(wide)(q, p, up) == Placement_verdict::FACES_AWAY);
}

TEST_CASE("Facet oracle: a steep fan has the winding number of its link, at any position")
{
  const auto shell = ball_shell();
  const Oracle oracle(shell);
  CGAL::Random random(3);
  for(int n = 0; n < 40; ++n) {
    const Eigen::Vector3d
      up = Eigen::Vector3d(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(0.1, 1)).normalized(),
      u = up.unitOrthogonal(), v = up.cross(u), p = 0.7 * up;
    const auto link = [&](std::initializer_list<int> order) {
      std::vector<Point_3> points;
      for(int k : order) {
        const Eigen::Vector3d x = p - 0.1 * up + 0.001 * (std::cos(2 * pi * k / 5) * u + std::sin(2 * pi * k / 5) * v);
        points.emplace_back(x[0], x[1], x[2]);
      }
      return points;
    };
    const Point_3 apex(p[0], p[1], p[2]);
    CHECK(oracle.winding_number(apex, link({ 0, 1, 2, 3, 4 })) == 1);
    CHECK(oracle.winding_number(apex, link({ 0, 2, 4, 1, 3 })) == 2);
    CHECK(oracle.winding_number(apex, link({ 4, 3, 2, 1, 0 })) == 0);
  }
}

TEST_CASE("Facet oracle: a fan that winds twice is rejected, even if squares of the gradient underflow or overflow")
{
  for(double scale : { 1., 1e-170, 1e160 }) {
    CAPTURE(scale);
    const Field field = uniform_field({ { scale, { 2, 0, 0 } }, { scale, { 0, 2, 0 } }, { scale, { 0, 0, 2 } } });
    const auto shell = shell_of(field, 0.36 * scale, 0.6561 * scale);
    const Oracle oracle(shell);
    const Point_3 apex(0, 0, 0.7);
    const auto link = [](std::initializer_list<int> order) {
      std::vector<Point_3> points;
      for(int k : order) points.emplace_back(0.1 * std::cos(2 * pi * k / 5), 0.1 * std::sin(2 * pi * k / 5), 0.68);
      return points;
    };
    const std::vector<Point_3> once = link({ 0, 1, 2, 3, 4 }), twice = link({ 0, 2, 4, 1, 3 });
    Oracle::Memory memory;
    CHECK(oracle(apex, twice, memory) != Placement_verdict::ACCEPTED);
    if(scale == 1) {
      CHECK(oracle(apex, twice, memory) == Placement_verdict::WINDS_TWICE);
      CHECK(oracle(apex, once, memory) == Placement_verdict::ACCEPTED);
      CHECK(oracle.winding_number(apex, twice) == 2);
      for(std::size_t n = 0; n < 5; ++n) // each facet alone is accepted
        CHECK(oracle(apex, twice[n], twice[(n + 1) % 5]) == Placement_verdict::ACCEPTED);
    }
  }
}

TEST_CASE("Facet oracle: a fan that winds twice is rejected where rounding hides it from the winding number")
{
  // Far from the origin, the axis is rounded. A steep fan winds around the exact gradient twice, and all of its facets
  // face the gradient; but one of them does not face the rounded axis.
  Frame far;
  far.center = Eigen::Vector3d::Constant(std::ldexp(1., 30));
  const double ulp = std::ldexp(1., -22);
  const Eigen::Vector3d gradient(0.3125, 0.1875, 1), u = gradient.unitOrthogonal(), v = gradient.cross(u).normalized();
  const auto shell = shell_of(
    uniform_field({ { gradient[0], { 1, 0, 0 } }, { gradient[1], { 0, 1, 0 } }, { gradient[2], { 0, 0, 1 } } }, far),
    -5, 5, far);
  const Oracle oracle(shell);
  const auto at = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector3d y = far.to_user(x);
    return Point_3(y[0], y[1], y[2]);
  };
  const Eigen::Vector3d apex(0, 0, 0.5);
  const Point_3 p = at(apex), on_axis = at(apex + gradient);
  CGAL::Random random(1);
  int hidden = 0;
  for(int attempt = 0; attempt < 20000; ++attempt) {
    std::vector<Point_3> link;
    for(int k : { 0, 2, 4, 1, 3 }) {
      const double angle = 2 * pi * k / 5 + random.get_double(-0.5, 0.5), radius = ulp * random.get_double(1, 4);
      link.push_back(at(apex - gradient + radius * (std::cos(angle) * u + std::sin(angle) * v)));
    }
    if(BS::link_winding_number(p, on_axis, link) != 2 || oracle.winding_number(p, link) != 0) continue;
    ++hidden;
    Oracle::Memory memory;
    CHECK(oracle(p, link, memory) != Placement_verdict::ACCEPTED);
  }
  CHECK(hidden > 0);
}

TEST_CASE("Facet oracle: facets between the thresholds, but outside the cells of the shell, are rejected")
{
  // The shell consists of the cells of a layer with positive x.
  const Field field = uniform_field({ { 1, { 0, 0, 1 } } });
  std::vector<char> cells(field.number_of_cells());
  for(Field::Cell_index c = 0; c < field.number_of_cells(); ++c) cells[c] = field.cell(c).corner()[0] >= 0;
  const CGAL::Bspline_shell_3<Field> shell(field, BS::Level_range{ -0.5, 0.5 }, cells, {}, successful_report(2));
  const Oracle oracle(shell);
  for(double x : { 0.4, 0., -0.4 }) {
    CAPTURE(x);
    const auto at = [&](double dx, double dy) { return Point_3(x + dx, 0.3 + dy, 0.1); };
    const bool is_in_shell = x > 0.1;
    CHECK((oracle(at(-0.1, -0.1), at(0.1, -0.1), at(0.1, 0.1)) == Placement_verdict::ACCEPTED) == is_in_shell);
    const std::vector<Point_3> link = { at(-0.1, -0.1), at(0.1, -0.1), at(0.1, 0.1), at(-0.1, 0.1) };
    Oracle::Memory memory;
    CHECK((oracle(at(0.01, 0.02), link, memory) == Placement_verdict::ACCEPTED) == is_in_shell);
  }
}

TEST_CASE("Facet oracle: a facet that is wrongly cleared by an estimate is rejected if all facets are proved")
{
  // The slope of horizontal facets is 0.01 + 2x (2x - 1/2) (2x - 1). It is the same at all corners and middles of
  // edges, and negative between some of them.
  const auto shell = shell_of(
    uniform_field({ { 0.01, { 0, 0, 1 } }, { 1, { 1, 0, 1 } }, { -6, { 2, 0, 1 } }, { 8, { 3, 0, 1 } } }), -5, 5);
  const double z = 0.1;
  const Point_3 p(0, -0.2, z), q(0.5, -0.2, z), r(0, 0.2, z);
  CHECK(Oracle(shell, BS::Facet_proofs::WHERE_DOUBTFUL)(p, q, r) == Placement_verdict::ACCEPTED);
  CHECK(Oracle(shell)(p, q, r) == Placement_verdict::FACES_AWAY);
  CHECK(Oracle(shell, BS::Facet_proofs::ALL)(p, q, r) == Placement_verdict::FACES_AWAY);
}

TEST_CASE("Facet oracle: scaling the gradient and the coordinates by powers of two does not change the answers")
{
  // Values, slopes and second derivatives are between 2^-920 and 2^1000.
  const auto check = [](int exponent, int size) {
    CAPTURE(exponent, size);
    const double scale = std::ldexp(1., exponent);
    Frame frame;
    frame.scale = std::ldexp(1., size);
    const auto moved = [&](const Point_3& p) {
      return Point_3(frame.scale * p.x(), frame.scale * p.y(), frame.scale * p.z());
    };
    const auto moved_band = [&](std::initializer_list<double> degrees) {
      std::vector<Point_3> link = band(degrees);
      for(Point_3& p : link) p = moved(p);
      return link;
    };
    Polynomial scaled = squared_distance;
    for(Monomial& m : scaled) m.factor *= scale;
    const auto shell = shell_of(uniform_field(scaled, frame), 0.36 * scale, 0.6561 * scale, frame);
    const Point_3 p = moved(pole);
    const std::vector<Point_3> close = moved_band({ 0, 60, 120, 180, 240, 300 }), wide = moved_band({ 0, 120, 240 });
    for(BS::Facet_proofs proofs : { BS::Facet_proofs::ALL, BS::Facet_proofs::WHERE_DOUBTFUL }) {
      const Oracle oracle(shell, proofs);
      Oracle::Memory memory;
      CHECK(oracle(p, close, memory) == Placement_verdict::ACCEPTED);
      CHECK(oracle(p, wide, memory) == Placement_verdict::LEAVES_SHELL);
      CHECK(oracle(p, close[0], close[1]) == Placement_verdict::ACCEPTED);
      CHECK(oracle(p, close[1], close[0]) == Placement_verdict::FACES_AWAY);
      CHECK(oracle.winding_number(p, wide) == 1);
    }
  };
  for(int exponent : { -900, -535, 0, 524, 900 }) check(exponent, 0);
  for(int size : { -190, 190 })
    for(int exponent : { -720, 720 }) check(exponent, size);
}
} // namespace test_Shell_facet_oracle_3
