// copy_in_morton_order.h: only the numbers of a mesh's elements change. The new numbers do not depend on the old ones.
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Mesh/copy_in_morton_order.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace test_copy_in_morton_order {
namespace {

namespace BSI = CGAL::Bspline_shells::internal;
typedef std::array<double, 3> Coordinates;
typedef std::vector<std::size_t> Polygon; // positions, the lowest one first

Coordinates coordinates(const Point_3& p)
{
  return { p.x(), p.y(), p.z() };
}

template <typename M>
std::vector<Coordinates> points(const M& mesh)
{
  std::vector<Coordinates> points;
  for(auto v : vertices(mesh)) points.push_back(coordinates(get(get(CGAL::vertex_point, mesh), v)));
  return points;
}

template <typename M>
std::pair<Mesh, BSI::Positions_of_origin> copied(const M& mesh)
{
  Mesh copy;
  const auto origin = BSI::copy_in_morton_order<CGAL::Sequential_tag>(mesh, points(mesh), copy);
  return { copy, origin };
}

// Returns all facets, as the numbers of their vertices.
template <typename M, typename Number>
std::vector<Polygon> polygons(const M& mesh, const Number& number)
{
  std::vector<Polygon> all;
  for(auto f : faces(mesh)) {
    Polygon polygon;
    for(auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) polygon.push_back(number(source(h, mesh)));
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    all.push_back(polygon);
  }
  return all;
}

template <typename M>
std::vector<Polygon> polygons(const M& mesh)
{
  std::vector<typename boost::graph_traits<M>::vertex_descriptor> all(vertices(mesh).begin(), vertices(mesh).end());
  return polygons(mesh, [&](auto v) { return std::size_t(std::find(all.begin(), all.end(), v) - all.begin()); });
}

template <typename M>
void check_same(const M& mesh, std::size_t number_of_vertices, std::size_t number_of_edges)
{
  const auto [copy, origin] = copied(mesh);
  CHECK(CGAL::is_valid_polygon_mesh(copy));
  const std::vector<Coordinates> expected_points = points(mesh), found_points = points(copy);
  REQUIRE(origin.vertices.size() == number_of_vertices);
  REQUIRE(found_points.size() == number_of_vertices);
  for(std::size_t n = 0; n < found_points.size(); ++n) CHECK(found_points[n] == expected_points[origin.vertices[n]]);
  const std::vector<Polygon> expected = polygons(mesh);
  const auto& of = origin.vertices;
  const std::vector<Polygon> found = polygons(copy, [&](Mesh::Vertex_index v) { return of[v]; });
  REQUIRE(origin.faces.size() == expected.size());
  REQUIRE(found.size() == expected.size());
  for(std::size_t n = 0; n < found.size(); ++n) CHECK(found[n] == expected[origin.faces[n]]);
  CHECK(copy.number_of_edges() == number_of_edges);
  // Each border vertex refers to a halfedge on the border.
  for(auto h : copy.halfedges())
    if(copy.is_border(h)) CHECK(copy.is_border(copy.halfedge(copy.target(h))));
}

// Returns the same mesh with its vertices and facets in another order. Facets begin at other corners.
Mesh shuffled(const Mesh& mesh, unsigned int seed)
{
  CGAL::Random random(seed);
  std::vector<std::size_t> order(mesh.number_of_vertices());
  std::iota(order.begin(), order.end(), 0);
  CGAL::cpp98::random_shuffle(order.begin(), order.end(), random);
  std::vector<Mesh::Vertex_index> vertex(order.size());
  const std::vector<Coordinates> all = points(mesh);
  Mesh result;
  for(std::size_t n : order) vertex[n] = result.add_vertex(Point_3(all[n][0], all[n][1], all[n][2]));
  std::vector<Polygon> facets = polygons(mesh);
  CGAL::cpp98::random_shuffle(facets.begin(), facets.end(), random);
  for(Polygon facet : facets) {
    std::rotate(facet.begin(), facet.begin() + random.get_int(0, int(facet.size())), facet.end());
    std::vector<Mesh::Vertex_index> corners;
    for(std::size_t v : facet) corners.push_back(vertex[v]);
    REQUIRE(result.add_face(corners) != Mesh::null_face());
  }
  return result;
}

} // namespace

TEST_CASE("Copy in Morton order: closed, open, and polygonal meshes, and meshes of other types, are unchanged")
{
  const Mesh ball = sphere(2), quads = box(Point_3(0, 0, 0), Point_3(1, 2, 3), false);
  check_same(ball, ball.number_of_vertices(), ball.number_of_edges());
  check_same(quads, quads.number_of_vertices(), quads.number_of_edges());
  const Mesh open = sheet({ 0, 1, 2, 4 }, { 0, 1, 3 }, [](double x, double y) { return x * y; });
  check_same(open, open.number_of_vertices(), open.number_of_edges());
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(ball, polyhedron);
  check_same(polyhedron, ball.number_of_vertices(), ball.number_of_edges());
}

TEST_CASE("Copy in Morton order: a copy has no removed elements, no isolated vertices and no edges without facets")
{
  Mesh mesh = sphere(2);
  for(int n : { 7, 100, 101 }) CGAL::Euler::remove_face(mesh.halfedge(Mesh::Face_index(n)), mesh);
  REQUIRE(mesh.has_garbage());
  const std::size_t vertices = mesh.number_of_vertices();
  const auto far = mesh.add_vertex(Point_3(1e9, 0, 0));
  check_same(mesh, vertices, mesh.number_of_edges());

  // An edge leads into the hole and back.
  const std::size_t before = mesh.number_of_edges();
  const auto h = *std::find_if(mesh.halfedges().begin(), mesh.halfedges().end(),
                               [&](auto x) { return mesh.is_border(x); });
  const auto e = mesh.add_edge(), n = mesh.next(h);
  mesh.set_target(e, far);
  mesh.set_target(mesh.opposite(e), mesh.target(h));
  mesh.set_next(h, e);
  mesh.set_next(e, mesh.opposite(e));
  mesh.set_next(mesh.opposite(e), n);
  REQUIRE(mesh.number_of_edges() == before + 1);
  check_same(mesh, vertices, before);
}

TEST_CASE("Copy in Morton order: a vertex with two fans remains one vertex")
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  CGAL::copy_face_graph(box(Point_3(1, 1, 1), Point_3(2, 2, 2)), mesh);
  std::vector<Mesh::Vertex_index> middle;
  for(auto v : mesh.vertices())
    if(mesh.point(v) == Point_3(1, 1, 1)) middle.push_back(v);
  REQUIRE(middle.size() == 2);
  const auto around = mesh.halfedges_around_target(mesh.halfedge(middle[1]));
  for(auto h : std::vector<Mesh::Halfedge_index>(around.begin(), around.end())) mesh.set_target(h, middle[0]);
  mesh.remove_vertex(middle[1]);
  const auto [copy, origin] = copied(mesh);
  CHECK(copy.number_of_vertices() == 15);
  const auto leads_to_middle = [](const Mesh& m) {
    return std::count_if(m.halfedges().begin(), m.halfedges().end(),
                         [&](auto h) { return m.point(m.target(h)) == Point_3(1, 1, 1); });
  };
  CHECK(leads_to_middle(copy) == leads_to_middle(mesh));
}

TEST_CASE("Copy in Morton order: a copy depends neither on the order of vertices, facets and corners, nor on threads")
{
  const Mesh mesh = demo_mesh("elephant.off");
  const auto [copy, origin] = copied(mesh);
  const auto numbers = [](const Mesh& m) { return polygons(m, [](Mesh::Vertex_index v) { return std::size_t(v); }); };
  for(unsigned int seed : { 1, 2 }) {
    const Mesh other = shuffled(mesh, seed);
    const auto [copy_of_other, origin_of_other] = copied(other);
    CHECK(points(copy_of_other) == points(copy));
    CHECK(numbers(copy_of_other) == numbers(copy));
    CHECK(origin_of_other.faces != origin.faces);
    Mesh parallel;
    BSI::copy_in_morton_order<CGAL::Parallel_if_available_tag>(other, points(other), parallel);
    CHECK(points(parallel) == points(copy));
    CHECK(numbers(parallel) == numbers(copy));
  }
}

TEST_CASE("Copy in Morton order: consecutive facets are close to each other, and begin at their lowest vertex")
{
  const Mesh mesh = shuffled(sphere(4), 3);
  const auto [copy, origin] = copied(mesh);
  std::size_t last = 0;
  double way = 0;
  Point_3 before(0, 0, 0);
  for(auto f : copy.faces()) {
    const auto h = copy.halfedge(f);
    const std::size_t lowest = copy.source(h);
    CHECK(lowest < std::size_t(copy.target(h)));
    CHECK(lowest < std::size_t(copy.target(copy.next(h))));
    CHECK(last <= lowest);
    last = lowest;
    way += std::sqrt(CGAL::squared_distance(before, copy.point(copy.source(h))));
    before = copy.point(copy.source(h));
  }
  // Sides of facets are 0.07 long; two random points of the sphere are 4/3 apart on average.
  CHECK(way < 0.1 * double(copy.number_of_faces()));
}

TEST_CASE("Copy in Morton order: a mesh with too many elements for 32-bit indices is detected")
{
  const auto size = [](std::size_t vertices, std::size_t edges) { return BSI::Mesh_size{ vertices, edges }; };
  const std::size_t half = std::size_t(1) << 31;
  CHECK(size(0, 0).has_numbers());
  CHECK(size(2 * half - 2, half - 1).has_numbers());
  CHECK_FALSE(size(2 * half - 1, 0).has_numbers());
  CHECK_FALSE(size(0, half).has_numbers());
  CHECK_FALSE(size(16 * half, 3).has_numbers());
  // A polygon with n corners gets n - 3 inner edges.
  const auto check = [](const Mesh& mesh, std::size_t edges) {
    CHECK(BSI::triangulated_size(mesh).vertices == mesh.number_of_vertices());
    CHECK(BSI::triangulated_size(mesh).edges == edges);
  };
  check(box(Point_3(0, 0, 0), Point_3(1, 2, 3), false), 12 + 6);
  check(box(Point_3(0, 0, 0), Point_3(1, 2, 3)), 18);
  check(sheet({ 0, 1, 2 }, { 0, 1 }), 9);
}
} // namespace test_copy_in_morton_order
