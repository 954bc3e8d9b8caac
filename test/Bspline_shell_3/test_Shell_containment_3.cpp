// Shell_containment_3.h: the call shapes of Polyhedral_envelope, with answers that are proofs.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Shell_containment_3.h>
#include <CGAL/bspline_shell_3.h>

#include <CGAL/Random.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

namespace P = CGAL::Bspline_shells::parameters;
typedef CGAL::Bspline_shells::Shell_containment_3<> Containment;

const CGAL::Bspline_shell_3<>& shell()
{
  static const CGAL::Bspline_shell_3<> shell = CGAL::bspline_shell_3(sphere(1), P::resolution(12));
  return shell;
}

} // namespace

TEST_CASE("Containment: of points it agrees with the field")
{
  REQUIRE(shell());
  const Containment contains(shell());
  CHECK_FALSE(contains.is_empty());
  CGAL::Random random(7);
  std::size_t inside = 0;
  for(int n = 0; n < 3000; ++n) {
    const Point_3 p(random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2), random.get_double(-1.2, 1.2));
    const bool in = shell().bounded_side(p) != CGAL::ON_UNBOUNDED_SIDE;
    inside += in;
    CHECK(contains(p) == in);
  }
  CHECK(inside > 50);
  CHECK_FALSE(contains(Point_3(100, 0, 0)));
  CHECK_FALSE(contains(Point_3(0, 0, 0)));
}

TEST_CASE("Containment: of segments, triangles, meshes and soups it holds at every point")
{
  const Containment contains(shell());
  const Mesh mesh = sphere(1);
  CHECK(contains(mesh));
  CHECK(contains(mesh, CGAL::parameters::vertex_point_map(mesh.points())));
  CHECK_FALSE(contains(sphere(1, 1.5)));
  CHECK_FALSE(contains(sphere(1, 0.5)));
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3> > triangles;
  for(auto v : mesh.vertices()) points.push_back(mesh.point(v));
  for(auto f : mesh.faces()) {
    std::array<std::size_t, 3> t;
    std::size_t n = 0;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[n++] = std::size_t(v);
    triangles.push_back(t);
  }
  CHECK(contains(points, triangles));
  points[3] = Point_3(0, 0, 0);
  CHECK_FALSE(contains(points, triangles));
  for(auto e : mesh.edges()) CHECK(contains(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));

  // ends in the shell are not enough, nor are corners
  const auto v = *mesh.vertices().begin(), w = *(mesh.vertices().begin() + 5);
  const Point_3 &p = mesh.point(v), &q = mesh.point(w);
  REQUIRE(contains(p));
  REQUIRE(contains(q));
  CHECK_FALSE(contains(p, q));
  CHECK_FALSE(contains(p, q, CGAL::midpoint(p, q)));
  CGAL::Random random(3);
  std::size_t contained = 0, not_contained = 0;
  for(int n = 0; n < 300; ++n) {
    const auto f = *(mesh.faces().begin() + random.get_int(0, int(mesh.number_of_faces())));
    const auto h = mesh.halfedge(f);
    const double size = std::ldexp(0.06, -(n % 10));
    const auto shifted = [&](const Point_3& x) {
      return x + size * Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    };
    const Point_3 a = shifted(mesh.point(mesh.source(h))), b = shifted(mesh.point(mesh.target(h))), c = shifted(mesh.point(mesh.target(mesh.next(h))));
    bool in = true;
    for(int i = 0; i <= 10; ++i)
      for(int j = 0; i + j <= 10; ++j)
        in = in && shell().bounded_side(a + i / 10. * (b - a) + j / 10. * (c - a)) != CGAL::ON_UNBOUNDED_SIDE;
    if(contains(a, b, c)) { ++contained; CHECK(in); }
    else ++not_contained;
    if(!in) CHECK_FALSE(contains(a, b, c));
  }
  CHECK(contained > 20);
  CHECK(not_contained > 20);
}

TEST_CASE("Containment: no shell contains nothing")
{
  const CGAL::Bspline_shell_3<> none;
  CHECK(Containment(none).is_empty());
}
