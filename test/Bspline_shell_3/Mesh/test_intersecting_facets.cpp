// intersecting_facets.h: the pairs are those of CGAL's test of all pairs, for any cell size of the grid and any number
// of threads.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polygon_mesh_processing/transform.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace test_intersecting_facets {
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

Pairs of_all_pairs(const Mesh& mesh)
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

template <typename ConcurrencyTag>
Pairs found(const Mesh& mesh, unsigned int most_pairs, std::size_t facets_of_cell)
{
  return BS::internal::intersecting_facets<ConcurrencyTag>(mesh, BS::embedded_fans<ConcurrencyTag>(mesh), most_pairs,
                                                           facets_of_cell);
}

void check(const Mesh& mesh, bool has_grid = true)
{
  const Pairs reference = of_all_pairs(mesh);
  for(std::size_t size : { 1, 60, 150 }) {
    REQUIRE(mesh.number_of_faces() >= 16 * size); // enough facets for a grid
    CAPTURE(size);
    CHECK(found<CGAL::Sequential_tag>(mesh, unlimited, size) == reference);
    CHECK(found<CGAL::Parallel_if_available_tag>(mesh, unlimited, size) == reference);
  }
  CHECK(BS::internal::Facet_grid<Mesh>(mesh, 150).fill(3 * mesh.number_of_faces()) == has_grid);
}

} // namespace

TEST_CASE("Intersecting facets: there are none in a sphere, or in two spheres side by side or nested")
{
  const Mesh ball = sphere(4);
  CHECK(of_all_pairs(ball).empty());
  check(ball);
  check(together(ball, moved(ball, Kernel::Vector_3(2.5, 0, 0))));
  check(together(ball, moved(ball, Kernel::Vector_3(0, 0, 0), 0.9)));
}

TEST_CASE("Intersecting facets: spheres that meet, touch or coincide have the pairs that a test of all pairs finds")
{
  const Mesh ball = sphere(4);
  for(double x : { 0.5, 1., 1.3, 2. }) {
    const Mesh both = together(ball, moved(ball, Kernel::Vector_3(x, 0, 0)));
    CHECK_FALSE(of_all_pairs(both).empty());
    check(both);
  }
  check(together(ball, ball));
}

TEST_CASE("Intersecting facets: a single facet through the surface is found wherever it is", "[slow]")
{
  CGAL::Random random(1);
  const Mesh ball = sphere(4);
  const double edge = 0.1;
  for(int n = 0; n < 50; ++n) {
    // The facet crosses the surface.
    Mesh mesh = ball;
    const auto p = mesh.point(Mesh::Vertex_index(unsigned(random.get_int(0, int(mesh.number_of_vertices())))));
    const Kernel::Vector_3 out = p - CGAL::ORIGIN,
                           u = edge
                               * CGAL::cross_product(
                                 out, Kernel::Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), 0.3));
    mesh.add_face(mesh.add_vertex(p - edge * out), mesh.add_vertex(p + edge * out),
                  mesh.add_vertex(p + edge * out + u));
    CHECK_FALSE(of_all_pairs(mesh).empty());
    check(mesh);
  }
}

TEST_CASE("Intersecting facets: folded, doubly wound and embedded fans have the pairs that a test of all pairs finds")
{
  const Mesh ball = sphere(4);
  // A vertex is moved over its neighbors, or downwards.
  for(const Kernel::Vector_3& to :
      { Kernel::Vector_3(0.3, 0.2, 0.1), Kernel::Vector_3(0.1, -0.1, 0.4), Kernel::Vector_3(0, 0, -1) })
    for(unsigned int v : { 0u, 50u, 1000u }) {
      Mesh folded = ball;
      folded.point(Mesh::Vertex_index(v)) = folded.point(Mesh::Vertex_index(v)) + to;
      check(folded);
    }
  // All facets face the axis. Intersections are found only at common vertices.
  Mesh star;
  const int corners = 5;
  const auto north = star.add_vertex(Point_3(0, 0, 1.5)), south = star.add_vertex(Point_3(0, 0, -1.5));
  std::vector<Mesh::Vertex_index> link;
  for(int n = 0; n < corners; ++n)
    link.push_back(
      star.add_vertex(Point_3(2 * std::cos(4 * CGAL_PI * n / corners), 2 * std::sin(4 * CGAL_PI * n / corners), 0)));
  for(std::size_t n = 0; n < link.size(); ++n) {
    star.add_face(link[n], link[(n + 1) % link.size()], north);
    star.add_face(link[(n + 1) % link.size()], link[n], south);
  }
  CHECK_FALSE(of_all_pairs(star).empty());
  check(together(ball, star));
  // Noise ranges from levels that leave most fans embedded to levels that leave almost none.
  CGAL::Random random(2);
  for(double noise : { 0.01, 0.03, 0.1 }) {
    Mesh mesh = ball;
    for(auto v : mesh.vertices())
      mesh.point(
        v) = mesh.point(v)
             + noise * Kernel::Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), random.get_double(-1, 1));
    check(mesh);
  }
}

TEST_CASE("Intersecting facets: facets of all sizes, even larger than many cells, and flat meshes are tested correctly")
{
  const Mesh ball = sphere(4);
  check(together(ball, moved(sphere(0), Kernel::Vector_3(0.3, 0.2, 0.1), 1.1)));
  Mesh flat = ball;
  for(auto v : flat.vertices()) flat.point(v) = Point_3(flat.point(v).x(), flat.point(v).y(), 0.01 * flat.point(v).z());
  check(flat);
  check(together(flat, moved(flat, Kernel::Vector_3(0, 0, 0.005))));
  // Needles cross the whole grid, which would need too many copies of them.
  Mesh needles = ball;
  for(int n = 0; n < 2000; ++n) {
    const double x = -1 + n / 1000.;
    needles.add_face(needles.add_vertex(Point_3(x, -2, -2)), needles.add_vertex(Point_3(x, 2, 2)),
                     needles.add_vertex(Point_3(x + 1e-4, 2, 2)));
  }
  CHECK_FALSE(BS::internal::Facet_grid<Mesh>(needles, 100).fill(3 * needles.number_of_faces()));
  CHECK(found<CGAL::Sequential_tag>(needles, unlimited, 100) == of_all_pairs(needles));
}

TEST_CASE("Intersecting facets: the requested number of pairs is found, for any number of threads, even without a grid")
{
  const Mesh ball = sphere(4), both = together(ball, moved(ball, Kernel::Vector_3(0.5, 0, 0)));
  const Pairs all = of_all_pairs(both);
  REQUIRE(all.size() > 50);
  const Pairs some = found<CGAL::Sequential_tag>(both, 50, 150);
  CHECK(some.size() == 50);
  CHECK(std::includes(all.begin(), all.end(), some.begin(), some.end()));
  CHECK(found<CGAL::Parallel_if_available_tag>(both, 50, 150) == some);
  // There is no grid.
  for(int n = 0; n < 10; ++n)
    CHECK(found<CGAL::Parallel_if_available_tag>(both, 50, 100000) == found<CGAL::Sequential_tag>(both, 50, 100000));
  // Most of the mesh is in one cell.
  check(together(moved(both, Kernel::Vector_3(0.5, 0.5, 0.5), 0.01), sphere(3)), false);
  // Differences of coordinates, or their reciprocals, overflow.
  for(double size : { 5e-324, 1.7e308 }) {
    Mesh extreme = ball;
    for(auto v : extreme.vertices())
      extreme.point(v) = Point_3(size * extreme.point(v).x(), size * extreme.point(v).y(), size * extreme.point(v).z());
    CHECK_FALSE(BS::internal::Facet_grid<Mesh>(extreme, 150).fill(3 * extreme.number_of_faces()));
  }
}
} // namespace test_intersecting_facets
