// Shell_map_3.h: one object for both directions and any number of calls; locations, parameters, and shared data.
#include "flat_and_round_maps.h"

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Projection/Soup_map_3.h>
#include <CGAL/Bspline_shell_3/Projection/project_points.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace test_Shell_map_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
using BS::Flow_status;
typedef Polynomial_map Map;
typedef Map::Source_location Location;

std::vector<Location> some_locations(const Mesh& mesh)
{
  std::vector<Location> locations;
  for(auto f : mesh.faces())
    for(const std::array<double, 3>& w :
        { std::array<double, 3>{ 1, 0, 0 }, { 0, 0.5, 0.5 }, { 0.25, 0.5, 0.25 }, { 0, 0, 1 } })
      locations.push_back(Location(f, w));
  return locations;
}

template <typename Image>
bool same(const Image& a, const Image& b)
{
  return a.status == b.status && a.point == b.point && a.value == b.value && a.location == b.location;
}

} // namespace

TEST_CASE("Shell map: a vertex has the same image as its point")
{
  const Mesh a = sphere(2, 0.7), b = turned(sphere(2, 0.85), 0.3);
  const Map map(ball(), a, b);
  for(auto v : a.vertices()) {
    const auto image = map(v);
    REQUIRE(image);
    // The location of a vertex is not unique; its coordinates sum to one up to rounding.
    const auto expected = map.to_target()(a.point(v));
    CHECK(CGAL::squared_distance(image.point, expected.point) < 1e-30);
  }
}

TEST_CASE("Shell map: locations agree with Polygon_mesh_processing, and have the images of their points")
{
  const Mesh a = sphere(2, 0.7), b = turned(sphere(2, 0.85), 0.3);
  const Map map(ball(), a, b);
  CHECK(&map.source() == &a);
  CHECK(&map.target() == &b);
  CHECK(&map.shell() == &ball());
  const std::vector<Location> locations = some_locations(a);
  std::vector<Point_3> points;
  for(const Location& l : locations) {
    const auto p = map.point(l);
    points.push_back(Point_3(p[0], p[1], p[2]));
    CHECK(CGAL::squared_distance(points.back(), CGAL::Polygon_mesh_processing::construct_point(l, a)) < 1e-30);
  }
  const auto images = map.project(locations), sequential = map.project<CGAL::Sequential_tag>(locations),
             of_points = BS::project_points(ball(), points, b);
  REQUIRE(images.size() == locations.size());
  for(std::size_t n = 0; n < locations.size(); ++n) {
    REQUIRE(images[n].status == Flow_status::SUCCESS);
    CHECK(same(images[n], sequential[n]));
    CHECK(same(images[n], of_points[n]));
    CHECK(same(images[n], map(locations[n])));
    // The image is on the ray through the point.
    CHECK(CGAL::cross_product(images[n].point - CGAL::ORIGIN, points[n] - CGAL::ORIGIN).squared_length() < 1e-16);
  }
}

TEST_CASE("Shell map: the inverse maps back, and shares the prepared data")
{
  const Mesh a = sphere(2, 0.7), b = turned(sphere(2, 0.85), 0.3);
  std::optional<Map> map(std::in_place, ball(), a, b);
  const Map inverse = map->inverse(), copy = *map;
  CHECK(&inverse.source() == &b);
  CHECK(&inverse.target() == &a);
  CHECK(&inverse.to_target().target() == &map->to_source().target());
  CHECK(&inverse.to_source().target() == &map->to_target().target());
  CHECK(&copy.to_target().target() == &map->to_target().target());
  CHECK(inverse.to_source().tolerance() == map->to_target().tolerance());
  map.reset(); // the copies remain valid
  for(const Location& l : some_locations(a)) {
    const auto there = copy(l);
    REQUIRE(there);
    const auto back = inverse(there.location);
    REQUIRE(back);
    CHECK(CGAL::squared_distance(back.point, CGAL::Polygon_mesh_processing::construct_point(l, a))
          <= CGAL::square(2 * copy.to_target().tolerance()));
  }
  // A map can be made of existing projections.
  const Map again(copy.to_source(), copy.to_target());
  CHECK(same(again(Location(Mesh::Face_index(3), { 0.2, 0.3, 0.5 })),
             copy(Location(Mesh::Face_index(3), { 0.2, 0.3, 0.5 }))));
}

TEST_CASE("Shell map: named parameters set the tolerance, the points and the visitor")
{
  Mesh a = sphere(1, 0.7), b = sphere(1, 0.85);
  const Map map(ball(), a, b);
  CHECK(map.to_target().tolerance() == 1e-9 * ball().report().unit);
  CHECK(map.to_source().tolerance() == 1e-9 * ball().report().unit);
  const Map loose(ball(), a, b, P::tolerance(1e-4));
  CHECK(loose.to_target().tolerance() == 1e-4);
  CHECK(loose.to_source().tolerance() == 1e-4);
  CHECK(loose.inverse().to_target().tolerance() == 1e-4);

  // Each mesh has a separate point map; its own points are useless.
  const std::vector<Location> locations = some_locations(a);
  const auto expected = map.project(locations);
  auto of_a = a.add_property_map<Mesh::Vertex_index, Point_3>("v:a").first,
       of_b = b.add_property_map<Mesh::Vertex_index, Point_3>("v:b").first;
  for(auto v : a.vertices()) {
    of_a[v] = a.point(v);
    a.point(v) = Point_3(0, 0, 0);
  }
  for(auto v : b.vertices()) {
    of_b[v] = b.point(v);
    b.point(v) = Point_3(0, 0, 0);
  }
  const Map elsewhere(ball(), a, b, P::vertex_point_map(of_a).tolerance(2e-9),
                      CGAL::parameters::vertex_point_map(of_b));
  const auto images = elsewhere.project(locations);
  for(std::size_t n = 0; n < locations.size(); ++n) CHECK(same(images[n], expected[n]));

  struct Visitor
  {
    std::size_t last = 0;
    bool advance(std::size_t done, std::size_t)
    {
      last = done;
      return true;
    }
  } visitor;
  elsewhere.project(locations, visitor);
  CHECK(visitor.last == locations.size());
}

TEST_CASE("Shell map: source and target may have different types, with their own types of locations")
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  const Mesh a = sphere(1, 0.7);
  Polyhedron b;
  CGAL::copy_face_graph(sphere(2, 0.85), b);
  const BS::Shell_map_3<Polynomial_shell, Mesh, Polyhedron> map(ball(), a, b);
  const BS::Shell_map_3<Polynomial_shell, Polyhedron, Mesh> inverse = map.inverse();
  for(const Location& l : some_locations(a)) {
    const auto there = map(l);
    REQUIRE(there);
    CHECK(CGAL::squared_distance(CGAL::Polygon_mesh_processing::construct_point(there.location, b), there.point)
          < 1e-28);
    const auto back = inverse(there.location);
    REQUIRE(back);
    CHECK(CGAL::squared_distance(back.point, CGAL::Polygon_mesh_processing::construct_point(l, a)) < 1e-16);
  }
}

TEST_CASE("Shell map: if one of the meshes is invalid, no point has an image")
{
  const Mesh good = sphere(1, 0.7), quads = box(Point_3(-0.5, -0.5, -0.5), Point_3(0.5, 0.5, 0.5), false);
  const Location l(*good.faces_begin(), { 0.2, 0.3, 0.5 }), m(*quads.faces_begin(), { 0.2, 0.3, 0.5 });
  const Map from(ball(), quads, good), to(ball(), good, quads);
  CHECK(from(m).status == Flow_status::INVALID_MESH);
  CHECK(to(l).status == Flow_status::INVALID_MESH);
  CHECK(from.project(std::vector<Location>(3, m))[2].status == Flow_status::INVALID_MESH);
  CHECK(from.inverse()(l).status == Flow_status::INVALID_MESH);
}

TEST_CASE("Shell map: without a shell, no point has an image, and the status states this")
{
  const Mesh a = sphere(1, 0.7), b = sphere(1, 0.85);
  const Polynomial_shell none;
  const Map map(none, a, b);
  CHECK(map.status() == Flow_status::NO_SHELL);
  CHECK_FALSE(map.maps_points());
  CHECK(map.inverse().status() == Flow_status::NO_SHELL);
  const Location location = some_locations(a).front();
  const auto image = map(location);
  CHECK(image.status == Flow_status::NO_SHELL);
  CHECK(map(*a.vertices().begin()).status == Flow_status::NO_SHELL);
  CHECK(map.differential(location, image).status == Flow_status::NO_SHELL);
  CHECK(map.to_target().differential(Point_3(0, 0, 0.7), image).status == Flow_status::NO_SHELL);
  for(const auto& i : map.project(some_locations(a))) CHECK(i.status == Flow_status::NO_SHELL);
  for(const auto& i : BS::project_points(none, std::vector<Point_3>{ Point_3(0, 0, 0.7), Point_3(0, 0, 0) }, b))
    CHECK(i.status == Flow_status::NO_SHELL);
  const BS::Gradient_flow_3<Polynomial_shell> flow(none);
  CHECK(flow.trace(Point_3(0, 0, 0.7), 0.5).status == Flow_status::NO_SHELL);
  CHECK(flow.differential(Point_3(0, 0, 0.7), 0.5).status == Flow_status::NO_SHELL);
  const auto target = std::make_shared<const BS::Projection_target_3<Mesh> >(b, get(CGAL::vertex_point, b));
  const Point_3 p(0, 0, 0.7);
  CHECK(BS::Soup_projection_3<Polynomial_shell, Mesh>(none, target)(p).status == Flow_status::NO_SHELL);
  CHECK(BS::Proxy_projection_3<Polynomial_shell, Mesh>(none, target)(p).status == Flow_status::NO_SHELL);
  CHECK(BS::Soup_map_3<Polynomial_shell, Mesh>(none, a, b).status() == Flow_status::NO_SHELL);
  CHECK(none.bounded_side(p) == CGAL::ON_UNBOUNDED_SIDE);
  CHECK_FALSE(std::string(message(Flow_status::NO_SHELL)).empty());
}

TEST_CASE("Shell map: the differential between homothetic spheres is the homothety")
{
  const Mesh a = sphere(2, 0.7), b = sphere(2, 0.85);
  const Map map(ball(), a, b);
  for(const Location& l : some_locations(a)) {
    const auto image = map(l);
    REQUIRE(image);
    const BS::Flow_differential d = map.differential(l, image);
    REQUIRE(d);
    const Vector_3 n = normal(b, image.location.first);
    const Eigen::Matrix3d onto = d.onto_plane({ n.x(), n.y(), n.z() });
    const std::array<Point_3, 3> t = corners(a, image.location.first); // both spheres have the same numbering
    for(int i : { 1, 2 }) {
      const Vector_3 e = t[std::size_t(i)] - t[0];
      const Eigen::Vector3d edge(e.x(), e.y(), e.z());
      CHECK((onto * edge - 0.85 / 0.7 * edge).norm() < 1e-7 * edge.norm());
    }
  }
}
} // namespace test_Shell_map_3
