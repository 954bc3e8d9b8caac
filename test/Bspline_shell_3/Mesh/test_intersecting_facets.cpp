// intersecting_facets.h: a grid finds the pairs that a search without it finds, whatever its cells, with any number of threads.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace {

namespace BS = CGAL::Bspline_shells;
typedef std::vector<std::pair<Mesh::Face_index, Mesh::Face_index> > Pairs;
constexpr unsigned int unlimited = 1000000;

Pairs sorted(Pairs pairs)
{
  for(auto& pair : pairs)
    if(pair.second < pair.first) std::swap(pair.first, pair.second);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs without_grid(const Mesh& mesh)
{
  Pairs pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(mesh, std::back_inserter(pairs));
  return sorted(pairs);
}

Mesh moved(Mesh mesh, const Kernel::Vector_3& v, double scale = 1)
{
  typedef CGAL::Aff_transformation_3<Kernel> Map;
  CGAL::Polygon_mesh_processing::transform(Map(CGAL::SCALING, scale), mesh);
  CGAL::Polygon_mesh_processing::transform(Map(CGAL::TRANSLATION, v), mesh);
  return mesh;
}

Mesh together(const Mesh& a, const Mesh& b)
{
  Mesh mesh = a;
  CGAL::copy_face_graph(b, mesh);
  return mesh;
}

void check(const Mesh& mesh, bool has_grid = true)
{
  const Pairs reference = without_grid(mesh);
  for(std::size_t size : { 1, 60, 150 }) {
    REQUIRE(mesh.number_of_faces() >= 16 * size);       // a grid is tried
    CAPTURE(size);
    CHECK(BS::internal::intersecting_facets<CGAL::Sequential_tag>(mesh, unlimited, size) == reference);
    CHECK(BS::internal::intersecting_facets<CGAL::Parallel_if_available_tag>(mesh, unlimited, size) == reference);
  }
  CHECK(BS::internal::Facet_grid<Mesh>(mesh, 150).fill(3 * mesh.number_of_faces()) == has_grid);
}

} // namespace

TEST_CASE("Intersecting facets: none in a sphere, and in two beside or inside of each other")
{
  const Mesh ball = sphere(4);
  CHECK(without_grid(ball).empty());
  check(ball);
  check(together(ball, moved(ball, Kernel::Vector_3(2.5, 0, 0))));
  check(together(ball, moved(ball, Kernel::Vector_3(0, 0, 0), 0.9)));
}

TEST_CASE("Intersecting facets: where spheres meet, touch, or coincide, on planes between cells and elsewhere")
{
  const Mesh ball = sphere(4);
  for(double x : { 0.5, 1., 1.3, 2. }) {
    const Mesh both = together(ball, moved(ball, Kernel::Vector_3(x, 0, 0)));
    CHECK_FALSE(without_grid(both).empty());
    check(both);
  }
  check(together(ball, ball));
}

TEST_CASE("Intersecting facets: a single facet through the surface is found wherever it is")
{
  CGAL::Random random(1);
  const Mesh ball = sphere(4);
  const double edge = 0.1;
  for(int n = 0; n < 50; ++n) {
    // a facet through the surface
    Mesh mesh = ball;
    const auto p = mesh.point(Mesh::Vertex_index(unsigned(random.get_int(0, int(mesh.number_of_vertices())))));
    const Kernel::Vector_3 out = p - CGAL::ORIGIN,
                           u = edge * CGAL::cross_product(out, Kernel::Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), 0.3));
    mesh.add_face(mesh.add_vertex(p - edge * out), mesh.add_vertex(p + edge * out), mesh.add_vertex(p + edge * out + u));
    CHECK_FALSE(without_grid(mesh).empty());
    check(mesh);
  }
}

TEST_CASE("Intersecting facets: facets of all sizes, also larger than many cells, and flat meshes")
{
  const Mesh ball = sphere(4);
  check(together(ball, moved(sphere(0), Kernel::Vector_3(0.3, 0.2, 0.1), 1.1)));
  Mesh flat = ball;
  for(auto v : flat.vertices()) flat.point(v) = Point_3(flat.point(v).x(), flat.point(v).y(), 0.01 * flat.point(v).z());
  check(flat);
  check(together(flat, moved(flat, Kernel::Vector_3(0, 0, 0.005))));
  // needles through everything: there would be too many copies of them
  Mesh needles = ball;
  for(int n = 0; n < 2000; ++n) {
    const double x = -1 + n / 1000.;
    needles.add_face(needles.add_vertex(Point_3(x, -2, -2)), needles.add_vertex(Point_3(x, 2, 2)), needles.add_vertex(Point_3(x + 1e-4, 2, 2)));
  }
  CHECK_FALSE(BS::internal::Facet_grid<Mesh>(needles, 100).fill(3 * needles.number_of_faces()));
  CHECK(BS::internal::intersecting_facets<CGAL::Sequential_tag>(needles, unlimited, 100) == without_grid(needles));
}

TEST_CASE("Intersecting facets: so many pairs as are asked for, the same with any number of threads; coordinates without a grid")
{
  const Mesh ball = sphere(4), both = together(ball, moved(ball, Kernel::Vector_3(0.5, 0, 0)));
  const Pairs all = without_grid(both);
  REQUIRE(all.size() > 50);
  const Pairs some = BS::internal::intersecting_facets<CGAL::Sequential_tag>(both, 50, 150);
  CHECK(some.size() == 50);
  CHECK(std::includes(all.begin(), all.end(), some.begin(), some.end()));
  CHECK(BS::internal::intersecting_facets<CGAL::Parallel_if_available_tag>(both, 50, 150) == some);
  // without a grid
  for(int n = 0; n < 10; ++n)
    CHECK(BS::internal::intersecting_facets<CGAL::Parallel_if_available_tag>(both, 50, 100000)
          == BS::internal::intersecting_facets<CGAL::Sequential_tag>(both, 50, 100000));
  // nearly all of the mesh in one cell
  check(together(moved(both, Kernel::Vector_3(0.5, 0.5, 0.5), 0.01), sphere(3)), false);
  for(double size : { 5e-324, 1.7e308 }) {
    Mesh extreme = ball;
    for(auto v : extreme.vertices()) extreme.point(v) = Point_3(size * extreme.point(v).x(), size * extreme.point(v).y(), size * extreme.point(v).z());
    CHECK_FALSE(BS::internal::Facet_grid<Mesh>(extreme, 150).fill(3 * extreme.number_of_faces()));
    CHECK(BS::internal::intersecting_facets<CGAL::Sequential_tag>(extreme, unlimited, 150) == without_grid(extreme));
  }
}
