// fan_winding.h, Crossing_counter_3.h, vertex_cone.h (margins), arithmetic_self_test.h: exact counts with known
// results.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/Crossing_counter_3.h>
#include <CGAL/Bspline_shell_3/Support/arithmetic_self_test.h>
#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <CGAL/Random.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <optional>
#include <vector>

namespace test_exact_mesh_predicates {
namespace {

namespace BS = CGAL::Bspline_shells;

std::size_t winding_number(const Mesh& mesh, Mesh::Vertex_index v, const Point_3& on_axis)
{
  return BS::link_winding_number(mesh.point(v), on_axis, BS::internal::vertex_link(mesh, v));
}

} // namespace

TEST_CASE("Fan winding: the winding number is the number of turns of the link")
{
  for(int corners : { 3, 4, 5, 7, 12 })
    for(int step = 1; 2 * step < corners; ++step) {
      if(corners == 12 && step != 1 && step != 5) continue; // otherwise the polygon would close too early
      CAPTURE(corners, step);
      const Mesh mesh = bipyramid(corners, step);
      CHECK(winding_number(mesh, Mesh::Vertex_index(0), Point_3(0, 0, 2)) == std::size_t(step));
      CHECK(winding_number(mesh, Mesh::Vertex_index(1), Point_3(0, 0, -2)) == std::size_t(step));
      // The facets face the other way.
      CHECK(winding_number(mesh, Mesh::Vertex_index(0), Point_3(0, 0, -2)) == 0);
    }
  // A facet whose plane contains the axis does not face it.
  const std::vector<Point_3> link = { Point_3(0, -1, -1), Point_3(0, 1, -1), Point_3(-1, 0, -1) };
  CHECK(BS::link_winding_number(Point_3(0, 0, 0), Point_3(0, 0, 1), link) == 0);
  CHECK(BS::link_winding_number(Point_3(0, 0, 0), Point_3(0.1, 0, 1), link) == 1);
  // Fans of ordinary meshes wind once, from any initial halfedge.
  Mesh mesh = torus(3, 1, 9, 7);
  for(auto v : mesh.vertices()) {
    const auto g = BS::vertex_cone(mesh, v);
    REQUIRE(g);
    for(auto h : CGAL::halfedges_around_target(v, mesh)) {
      mesh.set_halfedge(v, h);
      CHECK(winding_number(mesh, v, mesh.point(v) + *g) == 1);
    }
  }
}

TEST_CASE("Embedded fans: a fan is embedded if all facets face their mean normal, and the fan winds once around it")
{
  const auto are_tips_embedded = [](const Mesh& mesh) {
    const std::vector<char> sequential = BS::embedded_fans<CGAL::Sequential_tag>(mesh);
    CHECK(BS::embedded_fans<CGAL::Parallel_if_available_tag>(mesh) == sequential);
    CHECK(bool(sequential[0]) == BS::is_fan_embedded(mesh, Mesh::Vertex_index(0)));
    CHECK(sequential[0] == sequential[1]);
    return bool(sequential[0]);
  };
  for(double size : { 1e-200, 1e-60, 1., 1e55 })
    for(double height : { 1e-3, 1., 1e3 }) {
      CAPTURE(size, height);
      const auto scaled = [&](const Mesh& mesh) {
        return mapped(mesh, [&](const Point_3& p) { return CGAL::ORIGIN + size * (p - CGAL::ORIGIN); });
      };
      CHECK(are_tips_embedded(scaled(bipyramid(3, 1, height))));
      CHECK(are_tips_embedded(scaled(bipyramid(12, 1, height))));
      CHECK_FALSE(are_tips_embedded(scaled(bipyramid(5, 2, height))));  // winds twice
      CHECK_FALSE(are_tips_embedded(scaled(bipyramid(12, 5, height)))); // winds five times
    }
  // A corner of the link is on the other side of the tip, and of other edges.
  Mesh folded = bipyramid(6, 1);
  folded.point(Mesh::Vertex_index(2)) = Point_3(-1.5, 0, 0);
  CHECK_FALSE(are_tips_embedded(folded));
  // The normals cancel.
  Mesh flat;
  const auto a = flat.add_vertex(Point_3(0, 0, 0)), b = flat.add_vertex(Point_3(1, 0, 0)),
             c = flat.add_vertex(Point_3(0, 1, 0));
  flat.add_face(a, b, c);
  flat.add_face(a, c, b);
  CHECK_FALSE(are_tips_embedded(flat));
  // All fans of ordinary meshes are embedded, except at vertices that are on a border, without facets, or removed.
  const Mesh ring = torus(3, 1, 9, 7);
  CHECK(BS::embedded_fans<CGAL::Sequential_tag>(ring) == std::vector<char>(ring.num_vertices(), 1));
  Mesh open = ring;
  CGAL::Euler::remove_face(open.halfedge(Mesh::Face_index(0)), open);
  const auto removed = open.add_vertex(), isolated = open.add_vertex();
  open.remove_vertex(removed);
  const std::vector<char> is_embedded = BS::embedded_fans<CGAL::Sequential_tag>(open);
  CHECK(std::count(is_embedded.begin(), is_embedded.end(), 0) == 5);
  CHECK_FALSE(is_embedded[isolated]);
}

TEST_CASE("Cones: two opposite facets have no cone direction, however directions between them are rounded")
{
  // Coordinates are so large that products of two are rounded, but differences are not.
  CGAL::Random random(5);
  const auto wide = [&] { return std::floor(random.get_double(-1, 1) * 0x1p40); };
  for(int n = 0; n < 1000; ++n) {
    const Point_3 p(wide(), wide(), wide());
    const Vector_3 u(std::floor(wide() / 0x1p20), std::floor(wide() / 0x1p20), std::floor(wide() / 0x1p20));
    const Vector_3 v(std::floor(wide() / 0x1p20), std::floor(wide() / 0x1p20), std::floor(wide() / 0x1p20));
    const Vector_3 normal = CGAL::cross_product(u, v); // exact
    const Vector_3 across(wide(), wide(), wide());
    BS::internal::Vertex_fan fan;
    fan.apex = p;
    fan.wings = { { p + 1023 * u, p + 1021 * v }, { p + (u + 509 * v), p + 511 * u }, { p + normal, p + across } };
    CHECK_FALSE(BS::internal::exact_cone_direction(fan));
    CHECK_FALSE(BS::internal::cone_direction(fan));
    CHECK_FALSE(BS::internal::bounded_cone_margin(fan, 0.5));
    fan.wings.erase(fan.wings.begin());
    CHECK(BS::internal::cone_direction(fan));
  }
  // Here, the mean of the normals is in the planes of both facets.
  const Point_3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  BS::internal::Vertex_fan upright;
  upright.apex = Point_3(0, 0, 0);
  upright.wings = { { z, x }, { x, z }, { x, y } };
  CHECK_FALSE(BS::internal::cone_direction(upright));
}

TEST_CASE("Cone margin: the margin of a pyramid is the cosine of its slope")
{
  for(double height : { 1e-3, 0.5, 1., 20. })
    for(int corners : { 3, 4, 9 }) {
      CAPTURE(height, corners);
      const Mesh mesh = bipyramid(corners, 1, height);
      const double apothem = std::cos(CGAL_PI / corners);
      CHECK(BS::vertex_cone_margin(mesh, Mesh::Vertex_index(0))
            == Approx(apothem == 0 ? 0 : height / std::hypot(height, apothem) * apothem / height).epsilon(1e-9));
    }
  // In a plane, the margin is one; at the corner of a cube, it is 1 / sqrt(3).
  const Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  for(auto v : cube.vertices()) CHECK(BS::vertex_cone_margin(cube, v) == Approx(1 / std::sqrt(3.)));
}

TEST_CASE("Bounded cone margin: the result is the margin up to the bound, and missing at a singular vertex")
{
  Mesh mesh = torus(3, 1, 9, 7);
  CGAL::Random random(3);
  const auto shifted = [&](double x) { return x + random.get_double(-0.6, 0.6); };
  for(auto v : mesh.vertices())
    mesh.point(v) = Point_3(shifted(mesh.point(v).x()), shifted(mesh.point(v).y()), shifted(mesh.point(v).z()));
  std::size_t singular = 0, below = 0;
  for(auto v : mesh.vertices())
    for(double bound : { 0., 0.01, 0.5, 0.7, 0.9, 1. }) {
      const std::optional<double> margin = BS::bounded_vertex_cone_margin(mesh, v, bound);
      REQUIRE(bool(margin) == bool(BS::vertex_cone(mesh, v)));
      singular += margin ? 0 : 1;
      if(!margin) continue;
      CHECK(*margin == Approx((std::min)(bound, BS::vertex_cone_margin(mesh, v))).margin(1e-12));
      CHECK(*margin <= bound);
      below += *margin < bound ? 1 : 0;
    }
  CHECK(below > 100);
  CHECK(singular > 0);
}

TEST_CASE(
  "Crossings: crossings are signed and exact, and undefined if a segment touches an edge or vertex, or ends on a facet")
{
  const Mesh mesh = joined(sphere(2), sphere(1, 0.5));
  const BS::Crossing_counter_3 counter(mesh);
  const auto count = [&](const Point_3& p, const Point_3& q) {
    const auto crossings = counter.crossings(p, q);
    REQUIRE(crossings);
    int sum = 0;
    for(const auto& c : *crossings) sum += c.second;
    return sum;
  };
  CHECK(count(Point_3(0.013, 0.021, 0.007), Point_3(3, 1, 0.5)) == 2);
  CHECK(count(Point_3(3, 1, 0.5), Point_3(0.013, 0.021, 0.007)) == -2);
  CHECK(count(Point_3(0.5, 0.4, 0.45), Point_3(3, 1, 0.5)) == 1);
  CHECK(count(Point_3(-3, 0.11, 0.12), Point_3(3, 0.13, 0.14)) == 0);
  CHECK(counter.crossings(Point_3(-3, 0.11, 0.12), Point_3(3, 0.13, 0.14))->size() == 4);
  CHECK(counter.crossings(Point_3(3, 3, 3), Point_3(4, 3, 3))->empty());

  const Mesh cube = box(Point_3(-1, -1, -1), Point_3(1, 1, 1));
  const BS::Crossing_counter_3 of_cube(cube);
  CHECK_FALSE(of_cube.crossings(Point_3(0, 0, 0), Point_3(2, 2, 0)));         // through an edge
  CHECK_FALSE(of_cube.crossings(Point_3(0, 0, 0), Point_3(2, 2, 2)));         // through a vertex
  CHECK_FALSE(of_cube.crossings(Point_3(0.1, 0.2, 0), Point_3(0.1, 0.2, 1))); // ends on a facet
  CHECK_FALSE(of_cube.crossings(Point_3(-2, 0.25, 1), Point_3(2, 0.5, 1)));   // in the plane of a facet
  CHECK_FALSE(of_cube.crossings(Point_3(0.5, 1, 3), Point_3(0.5, 1, 0.5)));   // along a side
  REQUIRE(of_cube.crossings(Point_3(0.1, 0.2, 0), Point_3(0.1, 0.2, 1 + 1e-15)));
  CHECK(of_cube.crossings(Point_3(0.1, 0.2, 0), Point_3(0.1, 0.2, 1 + 1e-15))->size() == 1);
  CHECK(of_cube.crossings(Point_3(0.1, 0.2, 0), Point_3(0.1, 0.2, std::nextafter(1., 0.)))->empty());
}

TEST_CASE("Crossings: comparing all facets and searching the tree yield the same crossings")
{
  Mesh mesh = joined(sphere(5), sphere(1, 0.5)); // more facets than a thread compares at once
  mesh.add_face(mesh.add_vertex(Point_3(-2, -2, 0.02)), mesh.add_vertex(Point_3(4, -2, 0.03)),
                mesh.add_vertex(Point_3(-2, 4, 0.04)));
  mesh.remove_face(Mesh::Face_index(mesh.num_faces() - 1));
  const BS::Crossing_counter_3 many(mesh);
  for(int n = 0; n < 100; ++n) many.crossings(Point_3(0, 0, 0.01), Point_3(3, 1, 0.5));
  CGAL::Random random(7);
  const auto point = [&] {
    return Point_3(random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2));
  };
  for(int n = 0; n < 200; ++n) {
    const Point_3 p = point(), q = point();
    const BS::Crossing_counter_3 few(mesh);
    const auto crossings = few.crossings(p, q);
    CHECK(crossings == many.crossings(p, q));
    CHECK(crossings == few.crossings<CGAL::Parallel_if_available_tag>(p, q));
    REQUIRE(crossings);
    CHECK(std::is_sorted(crossings->begin(), crossings->end()));
  }
}

TEST_CASE("Arithmetic: this build passes its self-test in every rounding mode, and the mode is preserved")
{
  CHECK(BS::arithmetic_self_test() == BS::Arithmetic_status::SOUND);
  for(int n = 0; n <= int(BS::Arithmetic_status::NO_DIRECTED_ROUNDING); ++n)
    CHECK_FALSE(std::string(BS::message(BS::Arithmetic_status(n))).empty());
  for(int mode : { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO }) {
    REQUIRE(std::fesetround(mode) == 0);
    const BS::Arithmetic_status status = BS::arithmetic_self_test();
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(after == mode);
    CHECK(status == BS::Arithmetic_status::SOUND);
  }
}

TEST_CASE("Crossings: touching an edge, a vertex or a facet is detected, whichever corner of a facet is the first")
{
  Mesh cube = box(Point_3(-1, -1, -1), Point_3(1, 1, 1));
  for(int turn = 0; turn < 3; ++turn) {
    for(auto f : cube.faces()) cube.set_halfedge(f, cube.next(cube.halfedge(f)));
    const BS::Crossing_counter_3 counter(cube);
    for(double x : { -1., 1. })
      for(double y : { -1., 1. }) {
        CHECK_FALSE(counter.crossings(Point_3(0, 0, 0), Point_3(2 * x, 2 * y, 0.5))); // through an edge along z
        CHECK_FALSE(counter.crossings(Point_3(0, 0, 0), Point_3(2 * x, 0.5, 2 * y)));
        CHECK_FALSE(counter.crossings(Point_3(0, 0, 0), Point_3(0.5, 2 * x, 2 * y)));
        for(double z : { -1., 1. }) CHECK_FALSE(counter.crossings(Point_3(0, 0, 0), Point_3(2 * x, 2 * y, 2 * z)));
      }
    CHECK_FALSE(counter.crossings(Point_3(0.1, 0.2, 1), Point_3(0.1, 0.2, 0)));
    CHECK_FALSE(counter.crossings(Point_3(0.1, 0.2, 1), Point_3(0.1, 0.2, 2)));
    CHECK_FALSE(counter.crossings(Point_3(0.1, 0.2, 2), Point_3(0.1, 0.2, 1)));
  }
  // One end is beyond a vertex that is never the first corner of a facet; another corner is first.
  for(int corner = 0; corner < 3; ++corner) {
    Mesh pyramid = bipyramid(5, 1);
    for(auto f : pyramid.faces())
      for(int n = 0; n < 3; ++n) {
        auto h = pyramid.halfedge(f);
        const Mesh::Vertex_index of_corner = corner == 0   ? pyramid.source(h)
                                             : corner == 1 ? pyramid.target(h)
                                                           : pyramid.target(pyramid.next(h));
        if(of_corner != Mesh::Vertex_index(0) && of_corner != Mesh::Vertex_index(1))
          pyramid.set_halfedge(f, pyramid.next(h));
      }
    const BS::Crossing_counter_3 counter(pyramid);
    CHECK_FALSE(counter.crossings(Point_3(0.01, 0.02, 0), Point_3(-0.01, -0.02, 2)));
    CHECK_FALSE(counter.crossings(Point_3(0.01, 0.02, 0), Point_3(-0.01, -0.02, -2)));
  }
}

TEST_CASE("Fan winding: an axis in the plane of a facet is not faced, and an axis 1e-12 away is decided correctly")
{
  const std::vector<Point_3> link = { Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(0, -1, 0) };
  const Point_3 apex(0, 0, 1);
  for(std::size_t n = 0; n < 4; ++n) {
    const Vector_3 back = 0.5 * ((link[n] - apex) + (link[(n + 1) % 4] - apex));
    CHECK(BS::link_winding_number(apex, apex - back, link) == 0);
    CHECK(BS::link_winding_number(apex, apex - back + Vector_3(0, 0, 1e-12), link) == 1);
    CHECK(BS::link_winding_number(apex, apex - back - Vector_3(0, 0, 1e-12), link) == 0);
  }
}
} // namespace test_exact_mesh_predicates
