// map_polyline.h, Polyline_image.h: images of polylines are compared with curves in closed form, with the edges that
// these cross, and with images of many points.
#include "flat_and_round_maps.h"

#include <CGAL/Bspline_shell_3/Transfer/map_polyline.h>

#include <CGAL/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace test_map_polyline {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
namespace PMP = CGAL::Polygon_mesh_processing;
using BS::Flow_status;
using BS::Polyline_status;
typedef Polynomial_map Map;
typedef Map::Source_location Location;
typedef BS::Polyline_image<Mesh, Point_3> Image;
typedef Image::Vertex Vertex;

const double map_tolerance = 2e-9; // the default for a box size of 2

Point_3 point_of(const Location& location, const Mesh& mesh)
{
  return PMP::construct_point(location, mesh);
}

int zeros(const Location& location)
{
  return int(std::count(location.second.begin(), location.second.end(), 0.));
}

// Returns the facets that contain a location, found from the vertices of the facets.
std::set<Mesh::Face_index> facets_of(const Location& location, const Mesh& mesh)
{
  std::set<Mesh::Vertex_index> carrier;
  auto h = mesh.halfedge(location.first);
  for(double w : location.second) {
    if(w != 0) carrier.insert(mesh.source(h));
    h = mesh.next(h);
  }
  std::set<Mesh::Face_index> result;
  for(auto f : mesh.faces()) {
    std::size_t found = 0;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) found += carrier.count(v);
    if(found == carrier.size()) result.insert(f);
  }
  return result;
}

bool have_common_facet(const Location& a, const Location& b, const Mesh& mesh)
{
  const auto of_a = facets_of(a, mesh), of_b = facets_of(b, mesh);
  return std::any_of(of_a.begin(), of_a.end(), [&](auto f) { return of_b.count(f) > 0; });
}

// Claims that hold for every image.
void check_polylines(const Image& image, const Mesh& target)
{
  double last = -1;
  for(const auto& part : image.parts) {
    REQUIRE_FALSE(part.empty());
    for(std::size_t n = 0; n < part.size(); ++n) {
      const Vertex& v = part[n];
      CHECK(v.parameter >= last);
      last = v.parameter;
      CHECK(CGAL::squared_distance(v.point, point_of(v.location, target)) < 1e-30);
      if(zeros(v.location) > 0) CHECK(v.location.second[0] + v.location.second[1] + v.location.second[2] == 1);
      if(n > 0) {
        CHECK(part[n - 1].point != v.point);
        CHECK(have_common_facet(part[n - 1].location, v.location, target));
      }
    }
  }
}

double distance_from(const std::vector<Vertex>& part, const Point_3& p)
{
  double least = CGAL::squared_distance(part[0].point, p);
  for(std::size_t n = 1; n < part.size(); ++n)
    least = (std::min)(least, CGAL::squared_distance(Kernel::Segment_3(part[n - 1].point, part[n].point), p));
  return std::sqrt(least);
}

// Maps points between the vertices, and returns their largest distance from the image.
double largest_distance(const Map& map, const std::vector<Location>& polyline, const Image& image, int points)
{
  double largest = 0;
  for(std::size_t n = 0; n + 1 < polyline.size(); ++n)
    for(int i = 0; i <= points; ++i) {
      Location a = polyline[n], b = polyline[n + 1];
      REQUIRE(BS::internal::move_to_common_facet(map.source(), a, b));
      for(int k = 0; k < 3; ++k) a.second[k] = a.second[k] * (points - i) / points + b.second[k] * i / points;
      const auto exact = map(a);
      REQUIRE(exact);
      largest = (std::max)(largest, distance_from(image.parts[0], exact.point));
    }
  return largest;
}

// Returns the closed polyline in which a plane through the origin meets a mesh around it. It crosses edges, not
// vertices.
std::vector<Location> section(const Mesh& mesh, const Vector_3& normal)
{
  const auto height = [&](Mesh::Vertex_index v) { return normal * (mesh.point(v) - CGAL::ORIGIN); };
  const auto rises = [&](Mesh::Halfedge_index h) { return height(mesh.source(h)) < 0 && height(mesh.target(h)) > 0; };
  Mesh::Halfedge_index first;
  for(auto h : mesh.halfedges())
    if(rises(h)) {
      first = h;
      break;
    }
  std::vector<Location> result;
  auto h = first;
  do {
    const double a = height(mesh.source(h)), b = height(mesh.target(h)), t = a / (a - b);
    result.push_back(PMP::locate_on_halfedge<double>(h, t, mesh));
    // The facet of h lies to its left. The curve leaves it over the other edge that it crosses.
    auto next = mesh.next(h);
    if((height(mesh.source(next)) > 0) == (height(mesh.target(next)) > 0)) next = mesh.next(next);
    h = mesh.opposite(next);
  } while(h != first);
  result.push_back(result.front());
  return result;
}

std::size_t edges_across(const Mesh& mesh, const Vector_3& normal)
{
  std::size_t number = 0;
  for(auto e : mesh.edges())
    number += (normal * (mesh.point(mesh.vertex(e, 0)) - CGAL::ORIGIN) > 0)
              != (normal * (mesh.point(mesh.vertex(e, 1)) - CGAL::ORIGIN) > 0);
  return number;
}

Location locate(const Mesh& mesh, const Point_3& p)
{
  Location location = PMP::locate(p, mesh);
  for(double& w : location.second)
    if(std::abs(w) < 1e-14) w = 0;
  return location;
}

// Returns the polyline on a flat mesh that meets the segments between the points.
std::vector<Location> flat_polyline(const Mesh& mesh, const std::vector<Point_3>& points)
{
  std::vector<Location> result;
  for(std::size_t n = 0; n + 1 < points.size(); ++n) {
    std::vector<std::pair<double, Location> > crossings;
    const Vector_3 along = points[n + 1] - points[n];
    for(auto e : mesh.edges()) {
      const Point_3 p = mesh.point(mesh.source(mesh.halfedge(e))), q = mesh.point(mesh.target(mesh.halfedge(e)));
      const auto side = [&](const Point_3& x) { return CGAL::cross_product(along, x - points[n]).z(); };
      if((side(p) > 0) == (side(q) > 0)) continue;
      const double t = side(p) / (side(p) - side(q));
      const double s = (p + t * (q - p) - points[n]) * along / along.squared_length();
      if(s > 0 && s < 1) crossings.emplace_back(s, PMP::locate_on_halfedge<double>(mesh.halfedge(e), t, mesh));
    }
    std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    result.push_back(locate(mesh, points[n]));
    for(const auto& c : crossings) result.push_back(c.second);
  }
  result.push_back(locate(mesh, points.back()));
  return result;
}

} // namespace

TEST_CASE("Map polyline: on the source itself, the image is the polyline")
{
  const Mesh mesh = sphere(2, 0.8);
  const Map map(ball(), mesh, mesh);
  const std::vector<Location> polyline = section(mesh, { 1, 2, 3.1 });
  const Image image = BS::map_polyline(map, polyline);
  REQUIRE(image);
  check_polylines(image, mesh);
  REQUIRE(image.parts.size() == 1);
  REQUIRE(image.parts[0].size() == polyline.size());
  for(std::size_t n = 0; n < polyline.size(); ++n) {
    const Vertex& v = image.parts[0][n];
    CHECK(v.parameter == double(n));
    CHECK(CGAL::squared_distance(v.point, point_of(polyline[n], mesh)) < map_tolerance * map_tolerance);
    CHECK(zeros(v.location) == 1);
  }
}

TEST_CASE("Map polyline: on a subdivided mesh, the image gains the vertices at new edges")
{
  const Mesh mesh = sheet(steps(-0.8, 0.8, 5), steps(-0.8, 0.8, 4)), fine = subdivided(subdivided(mesh));
  const Map map(slab(), mesh, fine);
  const std::vector<Point_3> points = { { -0.7, -0.65, 0 }, { 0.55, 0.61, 0 }, { 0.1, -0.7, 0 } };
  const std::vector<Location> polyline = flat_polyline(mesh, points), expected = flat_polyline(fine, points);
  const Image image = BS::map_polyline(map, polyline);
  REQUIRE(image);
  check_polylines(image, fine);
  // Edges of the coarse mesh are edges of the fine mesh.
  REQUIRE(image.parts[0].size() == expected.size());
  for(std::size_t n = 0; n < expected.size(); ++n)
    CHECK(CGAL::squared_distance(image.parts[0][n].point, point_of(expected[n], fine)) < 1e-16);
}

TEST_CASE("Map polyline: between sheets, all crossed edges are found at their parameters")
{
  CGAL::Random random(3);
  const Mesh source = sheet(steps(-0.8, 0.8, 3), steps(-0.8, 0.8, 2)),
             target = sheet(steps(-0.8, 0.8, 13), steps(-0.8, 0.8, 17),
                            [](double x, double y) { return 0.3 * x - 0.2 * y * y; });
  const Map map(slab(), source, target);
  for(int repetition = 0; repetition < 10; ++repetition) {
    std::vector<Point_3> points;
    for(int i = 0; i < 4; ++i) points.emplace_back(random.get_double(-0.75, 0.75), random.get_double(-0.75, 0.75), 0);
    const std::vector<Location> polyline = flat_polyline(source, points);
    const Image image = BS::map_polyline(map, polyline);
    REQUIRE(image);
    check_polylines(image, target);
    std::vector<double> found, expected;
    for(const Vertex& v : image.parts[0]) {
      const std::size_t n = (std::min)(std::size_t(v.parameter), polyline.size() - 2);
      const Point_3 p = point_of(polyline[n], source), q = point_of(polyline[n + 1], source);
      const Point_3 preimage = p + (v.parameter - double(n)) * (q - p);
      CHECK(std::hypot(v.point.x() - preimage.x(), v.point.y() - preimage.y()) < map_tolerance);
      if(zeros(v.location) == 1) found.push_back(v.parameter);
    }
    for(std::size_t n = 0; n + 1 < polyline.size(); ++n) {
      const Point_3 p = point_of(polyline[n], source), q = point_of(polyline[n + 1], source);
      for(auto e : target.edges()) {
        const auto side = [&](const Point_3& a, const Point_3& b, const Point_3& x) {
          return (b.x() - a.x()) * (x.y() - a.y()) - (b.y() - a.y()) * (x.x() - a.x());
        };
        const Point_3 a = target.point(target.vertex(e, 0)), b = target.point(target.vertex(e, 1));
        const double s = side(a, b, p), t = side(a, b, q);
        if((side(p, q, a) > 0) != (side(p, q, b) > 0) && (s > 0) != (t > 0))
          expected.push_back(double(n) + s / (s - t));
      }
    }
    std::sort(expected.begin(), expected.end());
    REQUIRE(found.size() == expected.size());
    for(std::size_t n = 0; n < found.size(); ++n) CHECK(std::abs(found[n] - expected[n]) < 1e-6);
  }
}

TEST_CASE("Map polyline: great circles are mapped to great circles, and back")
{
  const Mesh a = sphere(2, 0.7), b = turned(sphere(3, 0.85), 0.3);
  const Map map(ball(), a, b);
  for(const Vector_3& normal : { Vector_3(1, 2, 3.1), Vector_3(-1, 0.3, 0.2), Vector_3(0.01, 0.02, 1) }) {
    const std::vector<Location> polyline = section(a, normal);
    const Image image = BS::map_polyline(map, polyline);
    REQUIRE(image);
    check_polylines(image, b);
    const std::vector<Vertex>& vertices = image.parts[0];
    CHECK(vertices.front().point == vertices.back().point);
    CHECK(vertices.front().location == vertices.back().location);
    std::size_t on_edges = 0;
    for(std::size_t n = 0; n + 1 < vertices.size(); ++n) on_edges += zeros(vertices[n].location) == 1;
    CHECK(on_edges == edges_across(b, normal));
    for(const Vertex& v : vertices) {
      CHECK(std::abs(normal * (v.point - CGAL::ORIGIN)) / CGAL::sqrt(normal.squared_length()) < 2 * map_tolerance);
    }
    CHECK(largest_distance(map, polyline, image, 20) < 4 * map_tolerance);

    std::vector<Location> there;
    for(const Vertex& v : vertices) there.push_back(v.location);
    const Image back = BS::map_polyline(map.inverse(), there);
    REQUIRE(back);
    check_polylines(back, a);
    CHECK(back.parts[0].front().point == back.parts[0].back().point);
    double largest = 0;
    for(const Location& l : polyline) largest = (std::max)(largest, distance_from(back.parts[0], point_of(l, a)));
    CHECK(largest < 8 * map_tolerance);
  }
}

TEST_CASE("Map polyline: images that bend keep the tolerance")
{
  const Polynomial cubic = { { 1, { 0, 0, 1 } }, { 0.4, { 3, 0, 0 } }, { 0.3, { 0, 2, 1 } }, { 0.2, { 1, 1, 0 } } };
  const Polynomial_shell shell = shell_of(uniform_field(cubic), -0.9, 0.9);
  const Mesh source = sheet(steps(-0.6, 0.6, 3), steps(-0.6, 0.6, 3), -0.3),
             target = sheet(steps(-0.9, 0.9, 4), steps(-0.9, 0.9, 3), 0.3);
  const Map map(shell, source, target);
  const std::vector<Location> polyline = flat_polyline(source, { { -0.55, -0.5, -0.3 }, { 0.5, 0.45, -0.3 } });
  std::size_t fewer = 0;
  for(double tolerance : { 1e-3, 1e-5, 1e-7 }) {
    INFO(tolerance);
    const Image image = BS::map_polyline(map, polyline, P::tolerance(tolerance));
    REQUIRE(image);
    check_polylines(image, target);
    const double largest = largest_distance(map, polyline, image, 200);
    CHECK(largest <= tolerance);
    CHECK(image.parts[0].size() > fewer);
    CHECK(image.traced_points < 20 * image.parts[0].size());
    fewer = image.parts[0].size();
    std::vector<Location> there;
    for(const Vertex& v : image.parts[0]) there.push_back(v.location);
    const Image back = BS::map_polyline(map.inverse(), there, P::tolerance(tolerance));
    REQUIRE(back);
    for(const Location& l : polyline) CHECK(distance_from(back.parts[0], point_of(l, source)) <= 2 * tolerance);
  }
}

TEST_CASE("Map polyline: curves along edges and through vertices")
{
  const Mesh coarse = sphere(1, 0.8), mesh = subdivided(coarse);
  const Map map(ball(), coarse, mesh);
  // a path along edges of the coarse mesh, whose midpoints are vertices of the fine mesh
  std::vector<Location> path;
  auto h = *coarse.halfedges().begin();
  path.push_back(PMP::locate_vertex<double>(coarse.source(h), coarse));
  for(int i = 0; i < 6; ++i) {
    path.push_back(PMP::locate_vertex<double>(coarse.target(h), coarse));
    h = coarse.opposite(coarse.next(coarse.opposite(coarse.next(h))));
    h = coarse.next(h);
    while(point_of(path.back(), coarse) != coarse.point(coarse.source(h))) h = coarse.next(h);
  }
  const Image image = BS::map_polyline(map, path);
  REQUIRE(image);
  check_polylines(image, mesh);
  std::size_t at_vertices = 0;
  for(const Vertex& v : image.parts[0]) at_vertices += zeros(v.location) == 2;
  CHECK(at_vertices == image.parts[0].size());
  CHECK(image.parts[0].size() == 2 * path.size() - 1);

  // straight over the vertices of a sheet, along its edges, and over its diagonals
  const Mesh squares = sheet(steps(-0.5, 0.5, 4), steps(-0.5, 0.5, 4)),
             above = sheet(steps(-0.5, 0.5, 4), steps(-0.5, 0.5, 4), 0.5),
             large = sheet(steps(-0.5, 0.5, 2), steps(-0.5, 0.5, 2));
  const Map lifted(slab(), large, above);
  const auto mapped = [&](const Point_3& p, const Point_3& q, const Point_3& r) {
    const Image result = BS::map_polyline(
      lifted, std::vector<Location>{ locate(large, p), locate(large, q), locate(large, r) });
    REQUIRE(result);
    check_polylines(result, above);
    return result.parts[0];
  };
  const auto diagonal = mapped({ -0.5, -0.5, 0 }, { 0, 0, 0 }, { 0.5, 0.5, 0 });
  CHECK(diagonal.size() == 5);
  for(const Vertex& v : diagonal) CHECK(zeros(v.location) == 2);
  const auto edges = mapped({ -0.5, 0, 0 }, { 0, 0, 0 }, { 0.5, 0, 0 });
  CHECK(edges.size() == 5);
  for(const Vertex& v : edges) CHECK(zeros(v.location) == 2);
  // across the diagonals, through every vertex
  const auto across = mapped({ -0.5, 0, 0 }, { 0, 0, 0 }, { 0, 0.5, 0 });
  CHECK(across.size() == 5);
}

TEST_CASE("Map polyline: single and repeated points are mapped")
{
  const Mesh a = sphere(1, 0.7), b = turned(sphere(2, 0.85), 0.3);
  const Map map(ball(), a, b);
  const Location p(Mesh::Face_index(5), { 0.2, 0.3, 0.5 }), q(Mesh::Face_index(5), { 0.5, 0.3, 0.2 });
  const Image none = BS::map_polyline(map, std::vector<Location>());
  CHECK(none);
  CHECK(none.parts.empty());
  for(const auto& polyline : { std::vector<Location>{ p }, std::vector<Location>{ p, p, p } }) {
    const Image single = BS::map_polyline(map, polyline);
    CHECK(single);
    REQUIRE(single.parts.size() == 1);
    REQUIRE(single.parts[0].size() == 1);
    CHECK(single.parts[0][0].point == map(p).point);
  }
  const Image once = BS::map_polyline(map, std::vector<Location>{ p, q }),
              repeated = BS::map_polyline(map, std::vector<Location>{ p, p, q, q });
  REQUIRE(once);
  REQUIRE(repeated);
  REQUIRE(once.parts[0].size() == repeated.parts[0].size());
  for(std::size_t n = 0; n < once.parts[0].size(); ++n) CHECK(once.parts[0][n].point == repeated.parts[0][n].point);
}

TEST_CASE("Map polyline: parts without an image are reported, and the rest is mapped")
{
  const Mesh source = sheet(steps(-0.8, 0.8, 2), steps(-0.8, 0.8, 2));
  Mesh target = sheet(steps(-0.6, 0.6, 6), steps(-0.6, 0.6, 6), 0.4);
  remove_facets(target, [](const Point_3& p) { return std::abs(p.x()) < 0.2 && std::abs(p.y()) < 0.2; });
  const Map map(slab(), source, target);
  const std::vector<Location> polyline = flat_polyline(source, { { -0.75, 0.05, 0 }, { 0.75, 0.05, 0 } });
  const Image image = BS::map_polyline(map, polyline);
  CHECK_FALSE(image);
  check_polylines(image, target);
  REQUIRE(image.parts.size() == 2);
  REQUIRE(image.gaps.size() == 3);
  CHECK(std::abs(image.parts[0].front().point.x() + 0.6) < 1e-8);
  CHECK(std::abs(image.parts[0].back().point.x() + 0.2) < 1e-8);
  CHECK(std::abs(image.parts[1].front().point.x() - 0.2) < 1e-8);
  CHECK(std::abs(image.parts[1].back().point.x() - 0.6) < 1e-8);
  CHECK(image.gaps[0].begin == 0);
  CHECK(image.gaps[0].end == image.parts[0].front().parameter);
  CHECK(image.gaps[1].begin == image.parts[0].back().parameter);
  CHECK(image.gaps[1].end == image.parts[1].front().parameter);
  CHECK(image.gaps[2].end == double(polyline.size() - 1));
  for(const auto& gap : image.gaps) {
    CHECK(gap.status == Polyline_status::NO_IMAGE);
    CHECK(gap.flow == Flow_status::LEAVES_SHELL);
    CHECK(std::string(gap.message()) == message(Flow_status::LEAVES_SHELL));
  }
  // Both ends of a segment may have no image.
  const Mesh square = sheet({ -0.8, 0.8 }, { -0.8, 0.8 });
  const Map from_square(slab(), square, target);
  const Image middle = BS::map_polyline(
    from_square, std::vector<Location>{ locate(square, { 0.78, -0.7, 0 }), locate(square, { 0.3, -0.75, 0 }) });
  CHECK(middle.parts.empty());
  REQUIRE(middle.gaps.size() == 1);
  CHECK(middle.gaps[0].end == 1);
  const Image through = BS::map_polyline(from_square, std::vector<Location>{ locate(square, { 0.75, -0.75, 0 }),
                                                                             locate(square, { 0.4, 0.25, 0 }),
                                                                             locate(square, { 0.75, 0.75, 0 }) });
  CHECK(through.parts.size() == 1);
  CHECK(through.gaps.size() == 2);
  const Image point = BS::map_polyline(from_square, std::vector<Location>{ locate(square, { 0.75, -0.75, 0 }) });
  CHECK(point.parts.empty());
  REQUIRE(point.gaps.size() == 1);
  CHECK(point.gaps[0].end == 0);
}

TEST_CASE("Map polyline: segments across edges, and maps that map no points")
{
  const Mesh a = sphere(1, 0.7), b = sphere(2, 0.85);
  const Map map(ball(), a, b);
  const Location p(Mesh::Face_index(5), { 0.2, 0.3, 0.5 });
  const Location q(a.face(a.opposite(a.halfedge(p.first))), { 0.2, 0.3, 0.5 }), r(q.first, { 0.5, 0.25, 0.25 });
  const Image image = BS::map_polyline(map, std::vector<Location>{ p, q, r });
  check_polylines(image, b);
  REQUIRE(image.gaps.size() == 1);
  CHECK(image.gaps[0].status == Polyline_status::NO_COMMON_FACET);
  CHECK(image.gaps[0].begin == 0);
  CHECK(image.gaps[0].end == 1);
  REQUIRE(image.parts.size() == 2);
  CHECK(image.parts[0].size() == 1);
  CHECK(image.parts[1].front().parameter == 1);
  CHECK(image.parts[1].back().parameter == 2);

  const Polynomial_shell no_shell;
  const Map no_map(no_shell, a, b);
  const Image no_image = BS::map_polyline(no_map, std::vector<Location>{ p, p });
  CHECK(no_image.parts.empty());
  REQUIRE(no_image.gaps.size() == 1);
  CHECK(no_image.gaps[0].flow == Flow_status::NO_SHELL);
}

TEST_CASE("Map polyline: the result does not depend on the number of threads")
{
  const Mesh a = sphere(2, 0.7), b = turned(sphere(3, 0.85), 0.3);
  const Map map(ball(), a, b);
  const std::vector<Location> polyline = section(a, { 1, 2, 3.1 });
  const Image first = BS::map_polyline<CGAL::Sequential_tag>(map, polyline),
              second = BS::map_polyline<CGAL::Parallel_if_available_tag>(map, polyline);
  REQUIRE(first.parts[0].size() == second.parts[0].size());
  CHECK(first.traced_points == second.traced_points);
  for(std::size_t n = 0; n < first.parts[0].size(); ++n) {
    CHECK(first.parts[0][n].point == second.parts[0][n].point);
    CHECK(first.parts[0][n].location == second.parts[0][n].location);
    CHECK(first.parts[0][n].parameter == second.parts[0][n].parameter);
  }
}

} // namespace test_map_polyline
