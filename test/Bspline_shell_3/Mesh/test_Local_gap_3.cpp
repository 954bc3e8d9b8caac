// Local_gap_3.h: walls and gaps of known width, and arbitrary meshes compared with a search through pairs of points.
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include "input_of_mesh.h"

#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Local_gap_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Local_gap_3::Point Point;

const double infinity = std::numeric_limits<double>::infinity();

Point random_point(CGAL::Random& random, const std::array<Point_3, 3>& t)
{
  double u = random.get_double(), v = random.get_double();
  if(u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  Point p;
  for(int a = 0; a < 3; ++a) p[a] = t[0][a] + u * (t[1][a] - t[0][a]) + v * (t[2][a] - t[0][a]);
  return p;
}

Point unit_normal(const std::array<Point_3, 3>& t)
{
  Point n = BS::facet_normal(t[0], t[1], t[2]).direction;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for(double& x : n) x /= length;
  return n;
}

} // namespace

TEST_CASE("Local gap: a plate has its thickness behind the large sides, and no gap in front")
{
  for(double t : { 0.1, 1e-3, 1e-6 }) {
    const BS::Input_mesh_3 input = input_of(box(Point_3(0, 0, 0), Point_3(1, 2, t)));
    const BS::Local_gap_3 gap(input);
    for(auto f : input.mesh().faces()) {
      const Point n = unit_normal(input.triangle(f));
      if(std::abs(n[2]) > 0.5) CHECK(gap(f, CGAL::NEGATIVE) == Approx(t).epsilon(1e-9));
      else CHECK(gap(f, CGAL::NEGATIVE) > 0.9);
      CHECK(gap(f, CGAL::POSITIVE) == infinity);
    }
  }
}

TEST_CASE("Local gap: two boxes have their distance where they face each other, and a larger gap beside this area")
{
  const BS::Input_mesh_3 input = input_of(
    joined(box(Point_3(0, 0, 0), Point_3(4, 4, 1)), box(Point_3(1, 1, 1.25), Point_3(2, 2, 3))));
  const BS::Local_gap_3 gap(input);
  for(auto f : input.mesh().faces()) {
    const Point n = unit_normal(input.triangle(f));
    const double z = input.triangle(f)[0].z();
    if(n[2] > 0.5 && z == 1) {
      const Point below[3] = { { 1.1, 1.1, 1 }, { 1.5, 1.2, 1 }, { 1.4, 1.8, 1 } };
      CHECK(gap(f, below, 3, CGAL::POSITIVE) == Approx(0.25).epsilon(1e-9));
      // The ball touches the plane at distance d beside the box, and the edge of the box.
      const Point beside = { 2.5, 1.5, 1 };
      CHECK(gap(f, &beside, 1, CGAL::POSITIVE) == Approx((0.25 + 0.0625) / 0.25).epsilon(1e-6));
      CHECK(gap(f, &beside, 1, CGAL::POSITIVE, 1.) == 1);
      CHECK(gap(f, &beside, 1, CGAL::NEGATIVE) == Approx(1).epsilon(1e-6));
    }
    if(n[2] < -0.5 && z == 1.25) CHECK(gap(f, CGAL::POSITIVE) == Approx(0.25).epsilon(1e-9));
  }
}

TEST_CASE("Local gap: a large slanted facet is found, wherever the search starts, even if balls reach through it")
{
  // The facet is below a lid that falls from z = 20 to z = 0.5.
  Mesh mesh;
  const double z[2] = { 20, 0.5 };
  std::vector<Mesh::Vertex_index> v;
  for(double x : { 0., 100. })
    for(double y : { 0., 100. })
      for(int top = 0; top < 2; ++top) v.push_back(mesh.add_vertex(Point_3(x, y, top == 1 ? z[x > 0] : 0)));
  const auto add = [&](int a, int b, int c, int d) {
    mesh.add_face(v[a], v[b], v[c]);
    mesh.add_face(v[a], v[c], v[d]);
  };
  add(0, 2, 6, 4);
  add(1, 5, 7, 3);
  add(0, 4, 5, 1);
  add(4, 6, 7, 5);
  add(6, 2, 3, 7);
  add(2, 0, 1, 3);
  const BS::Input_mesh_3 input = input_of(mesh);
  const BS::Local_gap_3 gap(input);
  for(auto f : input.mesh().faces()) {
    if(unit_normal(input.triangle(f))[2] > -0.5) continue;
    // The gap is narrowest where the lid is lowest. A ball of diameter D on the point p touches the lid if the distance
    // of its center from the lid is D / 2.
    const Point part[4] = { { 10, 40, 0 }, { 40, 40, 0 }, { 40, 60, 0 }, { 10, 60, 0 } };
    for(double most : { infinity, 1000., 100., 30., 20. }) {
      const double at_40 = 20 - 0.195 * 40, cosine = 1 / std::sqrt(1 + 0.195 * 0.195);
      CHECK(gap(f, part, 4, CGAL::NEGATIVE, most) == Approx(2 * at_40 * cosine / (1 + cosine)).epsilon(1e-6));
    }
  }
}

TEST_CASE("Local gap: the gap inside a ball is the diameter everywhere")
{
  const BS::Input_mesh_3 input = input_of(sphere(3, 0.5));
  const BS::Local_gap_3 gap(input);
  double least = infinity, most = 0;
  for(auto f : input.mesh().faces()) {
    const double g = gap(f, CGAL::NEGATIVE);
    least = (std::min)(least, g);
    most = (std::max)(most, g);
    CHECK(gap(f, CGAL::POSITIVE) == infinity);
  }
  CHECK(least > 0.9);
  CHECK(most <= 1);
}

TEST_CASE("Local gap: the gap does not exceed the gap of any pair of points, and some pair nearly attains it")
{
  CGAL::Random random(7);
  constexpr double facing_away = -0.5;
  for(const Mesh& mesh : { dumbbell(0.03), torus(1, 0.3, 12, 8), demo_mesh("rotor.off"), demo_mesh("dragknob.off") }) {
    const BS::Input_mesh_3 input = input_of(mesh);
    const BS::Local_gap_3 gap(input);
    const auto& m = input.mesh();
    std::size_t too_large = 0, found = 0;
    std::vector<double> ratios;
    for(int n = 0; n < 60; ++n) {
      const BS::Input_mesh_3::Face_index f(random.get_int(0, int(m.number_of_faces())));
      const std::array<Point_3, 3> t = input.triangle(f);
      const Point normal = unit_normal(t);
      for(CGAL::Sign side : { CGAL::NEGATIVE, CGAL::POSITIVE }) {
        const double g = gap(f, side);
        double least = infinity;
        for(auto other : m.faces()) {
          const std::array<Point_3, 3> u = input.triangle(other);
          const Point o = unit_normal(u);
          if(!(normal[0] * o[0] + normal[1] * o[1] + normal[2] * o[2] < facing_away)) continue;
          bool adjacent = false;
          for(const Point_3& p : t)
            for(const Point_3& q : u) adjacent = adjacent || p == q;
          if(adjacent) continue;
          for(int k = 0; k < 40; ++k) {
            const Point p = random_point(random, t), q = random_point(random, u);
            double squared = 0, height = 0;
            for(int a = 0; a < 3; ++a) {
              squared += (q[a] - p[a]) * (q[a] - p[a]);
              height += (q[a] - p[a]) * normal[a] * side;
            }
            if(height > 0) least = (std::min)(least, squared / height);
          }
        }
        too_large += g > least * (1 + 1e-6);
        found += std::isfinite(g);
        if(std::isfinite(g)) ratios.push_back(least / g);
      }
    }
    CHECK(too_large == 0);
    REQUIRE(found > 20);
    // Random points usually come close to the gap.
    std::sort(ratios.begin(), ratios.end());
    CHECK(ratios[ratios.size() / 2] < 1.25);
  }
}

TEST_CASE("Local gap: a part of a facet has at least the gap of the facet")
{
  CGAL::Random random(8);
  const BS::Input_mesh_3 input = input_of(dumbbell(0.05));
  const BS::Local_gap_3 gap(input);
  for(auto f : input.mesh().faces()) {
    const std::array<Point_3, 3> t = input.triangle(f);
    const Point part[3] = { random_point(random, t), random_point(random, t), random_point(random, t) };
    for(CGAL::Sign side : { CGAL::NEGATIVE, CGAL::POSITIVE }) {
      const double whole = gap(f, side), of_part = gap(f, part, 3, side);
      CHECK(of_part >= whole * (1 - 1e-4));
      for(const Point& p : part) CHECK(gap(f, &p, 1, side) >= of_part * (1 - 1e-4));
    }
  }
}
} // namespace test_Local_gap_3
