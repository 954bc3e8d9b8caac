// intersecting_facets.h: the pairs are those of CGAL's test of all pairs, for any cell size of the grid and any number
// of threads.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/fan_winding.h>
#include <CGAL/Bspline_shell_3/Mesh/intersecting_facets.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
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

Mesh moved(const Mesh& mesh, const Vector_3& v, double scale = 1)
{
  return mapped(mesh, [&](const Point_3& p) { return CGAL::ORIGIN + scale * (p - CGAL::ORIGIN) + v; });
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
  check(joined(ball, moved(ball, Vector_3(2.5, 0, 0))));
  check(joined(ball, moved(ball, Vector_3(0, 0, 0), 0.9)));
}

TEST_CASE("Intersecting facets: spheres that meet, touch or coincide have the pairs that a test of all pairs finds")
{
  const Mesh ball = sphere(4);
  for(double x : { 0.5, 1., 1.3, 2. }) {
    const Mesh two = joined(ball, moved(ball, Vector_3(x, 0, 0)));
    CHECK_FALSE(of_all_pairs(two).empty());
    check(two);
  }
  check(joined(ball, ball));
}

TEST_CASE("Intersecting facets: a single facet through the surface is found wherever it is", "[slow]")
{
  CGAL::Random random(1);
  const Mesh ball = sphere(4);
  const double edge = 0.1;
  for(int n = 0; n < 50; ++n) {
    // The facet crosses the surface.
    Mesh mesh = ball;
    const Point_3 p = mesh.point(Mesh::Vertex_index(unsigned(random.get_int(0, int(mesh.number_of_vertices())))));
    const Vector_3 out = p - CGAL::ORIGIN,
                   u = edge
                       * CGAL::cross_product(out, Vector_3(random.get_double(-1, 1), random.get_double(-1, 1), 0.3));
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
  for(const Vector_3& to : { Vector_3(0.3, 0.2, 0.1), Vector_3(0.1, -0.1, 0.4), Vector_3(0, 0, -1) })
    for(unsigned int v : { 0u, 50u, 1000u }) {
      Mesh folded = ball;
      folded.point(Mesh::Vertex_index(v)) = folded.point(Mesh::Vertex_index(v)) + to;
      check(folded);
    }
  // All facets face the axis. Intersections are found only at common vertices.
  const Mesh star = moved(bipyramid(5, 2, 0.75), Vector_3(0, 0, 0), 2);
  CHECK_FALSE(of_all_pairs(star).empty());
  check(joined(ball, star));
  // Noise ranges from levels that leave most fans embedded to levels that leave almost none.
  CGAL::Random random(2);
  for(double noise : { 0.01, 0.03, 0.1 }) {
    const auto shifted = [&](double x) { return x + noise * random.get_double(-1, 1); };
    check(mapped(ball, [&](const Point_3& p) { return Point_3(shifted(p.x()), shifted(p.y()), shifted(p.z())); }));
  }
}

TEST_CASE("Intersecting facets: facets of all sizes, even larger than many cells, and flat meshes are tested correctly")
{
  const Mesh ball = sphere(4);
  check(joined(ball, moved(sphere(0), Vector_3(0.3, 0.2, 0.1), 1.1)));
  const Mesh flat = mapped(ball, [](const Point_3& p) { return Point_3(p.x(), p.y(), 0.01 * p.z()); });
  check(flat);
  check(joined(flat, moved(flat, Vector_3(0, 0, 0.005))));
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
  const Mesh ball = sphere(4), two = joined(ball, moved(ball, Vector_3(0.5, 0, 0)));
  const Pairs all = of_all_pairs(two);
  REQUIRE(all.size() > 50);
  const Pairs some = found<CGAL::Sequential_tag>(two, 50, 150);
  CHECK(some.size() == 50);
  CHECK(std::includes(all.begin(), all.end(), some.begin(), some.end()));
  CHECK(found<CGAL::Parallel_if_available_tag>(two, 50, 150) == some);
  // No grid is used.
  for(int n = 0; n < 10; ++n)
    CHECK(found<CGAL::Parallel_if_available_tag>(two, 50, 100000) == found<CGAL::Sequential_tag>(two, 50, 100000));
  // Most of the mesh is in one cell.
  check(joined(moved(two, Vector_3(0.5, 0.5, 0.5), 0.01), sphere(3)), false);
  // Differences of coordinates, or their reciprocals, overflow.
  for(double size : { 5e-324, 1.7e308 }) {
    const Mesh extreme = moved(ball, Vector_3(0, 0, 0), size);
    CHECK_FALSE(BS::internal::Facet_grid<Mesh>(extreme, 150).fill(3 * extreme.number_of_faces()));
  }
}
} // namespace test_intersecting_facets
