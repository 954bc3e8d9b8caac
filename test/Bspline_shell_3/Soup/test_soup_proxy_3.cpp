// Proxies of polygon soups: a soup that is not a surface gets a clean mesh that carries its attributes. Reports contain
// the carried share.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Soup/sample_soup_shares.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_soup_proxy_3.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Random.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/squared_distance_3.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace test_soup_proxy_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef BS::Polygon_soup::Points Points;
typedef BS::Polygon_soup::Polygons Polygons;
typedef Mesh::Property_map<Mesh::Vertex_index, double> Scalars;

struct Soup : BS::Polygon_soup
{
  void add(const Mesh& mesh)
  {
    const std::size_t first = points.size(), polygon = polygons.size();
    Points p;
    Polygons f;
    CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(mesh, p, f);
    points.insert(points.end(), p.begin(), p.end());
    polygons.insert(polygons.end(), f.begin(), f.end());
    for(std::size_t n = polygon; n < polygons.size(); ++n)
      for(std::size_t& v : polygons[n]) v += first;
  }
};

// The centers of two spheres of radius one that meet in a circle: Figure 16 of the paper.
const Point_3 left(-0.6, 0, 0), right(0.6, 0, 0);

const Soup& two_spheres()
{
  static const Soup soup = [] {
    Soup s;
    s.add(sphere(4, 1, left));
    s.add(sphere(4, 1, right));
    return s;
  }();
  return soup;
}

const BS::Soup_proxy_3& proxy_of_spheres()
{
  static const BS::Soup_proxy_3 proxy = CGAL::certified_soup_proxy_3(two_spheres().points, two_spheres().polygons);
  return proxy;
}

double linear(const Point_3& p)
{
  return 2 + p.x() - 3 * p.y() + 0.5 * p.z();
}

Soup random_triangles(int number)
{
  Soup soup;
  CGAL::Random random(7);
  const auto coordinate = [&] { return random.get_double(-1, 1); };
  for(int i = 0; i < number; ++i) {
    soup.polygons.push_back({ soup.points.size(), soup.points.size() + 1, soup.points.size() + 2 });
    for(int k = 0; k < 3; ++k) {
      const double x = coordinate(), y = coordinate(), z = coordinate();
      soup.points.emplace_back(x, y, z);
    }
  }
  return soup;
}

} // namespace

TEST_CASE("Soup mesh: three triangles at an edge become a mesh whose triangles and vertices refer to their origins")
{
  const Points points{ Point_3(9, 9, 9), Point_3(0, 0, 0),  Point_3(0, 0, 1),
                       Point_3(1, 0, 0), Point_3(-1, 1, 0), Point_3(-1, -1, 0) };
  const Polygons polygons{ { 1, 2, 3 }, { 1, 2, 4 }, { 1, 2, 5 } };
  const BS::Soup_mesh_3 soup(BS::Polygon_soup{ points, polygons });
  CHECK(CGAL::is_valid_polygon_mesh(soup.mesh()));
  REQUIRE(soup.mesh().number_of_faces() == 3);
  for(auto f : soup.mesh().faces()) {
    std::vector<std::size_t> corners;
    for(auto v : soup.mesh().vertices_around_face(soup.mesh().halfedge(f))) {
      corners.push_back(soup.point_of(v));
      CHECK(soup.mesh().point(v) == points[soup.point_of(v)]);
    }
    std::sort(corners.begin(), corners.end());
    CHECK(corners == polygons[soup.polygon_of(f)]);
  }
  CHECK(soup.polygons_left_out().empty());
}

TEST_CASE("Soup mesh: a polygon with a hole, whose bridge has two points twice, is triangulated")
{
  const Points points{ Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(4, 4, 0), Point_3(0, 4, 0),
                       Point_3(1, 1, 0), Point_3(1, 3, 0), Point_3(3, 3, 0), Point_3(3, 1, 0) };
  const BS::Soup_mesh_3 soup(BS::Polygon_soup{ points, { { 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 } } });
  CHECK(soup.polygons_left_out().empty());
  double area = 0;
  for(auto f : soup.mesh().faces()) {
    const auto [p, q, r] = corners(soup.mesh(), f);
    area += std::sqrt(CGAL::squared_area(p, q, r));
  }
  CHECK(area == Approx(12));
}

TEST_CASE("Soup mesh: polygons are triangulated, and degenerate polygons are left out and reported")
{
  const Points points{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0), Point_3(2, 0, 0) };
  const BS::Soup_mesh_3 soup(
    BS::Polygon_soup{ points, { { 0, 1, 4 }, { 0, 1, 2, 3 }, { 1, 1, 2 }, { 0, 1 }, { 2, 1, 4 } } });
  CHECK(soup.polygons_left_out() == std::vector<std::size_t>{ 0, 2, 3 });
  REQUIRE(soup.mesh().number_of_faces() == 3);
  std::vector<std::size_t> triangles(5, 0);
  for(auto f : soup.mesh().faces()) ++triangles[soup.polygon_of(f)];
  CHECK(triangles == std::vector<std::size_t>{ 0, 2, 0, 0, 1 });
}

TEST_CASE("Soup proxy: two intersecting spheres get a closed mesh with a certified shell")
{
  const BS::Soup_proxy_3& proxy = proxy_of_spheres();
  REQUIRE(proxy.is_certified());
  CHECK(CGAL::is_closed(proxy.mesh()));
  CHECK(proxy.report().wraps >= 1);
  for(auto v : proxy.mesh().vertices()) {
    const Point_3 p = proxy.mesh().point(v);
    CHECK((std::min)(distance(p, left), distance(p, right)) > 0.97);
  }
}

TEST_CASE("Soup proxy: visible parts of the spheres are carried, and hidden parts are not")
{
  const BS::Soup_proxy_3& proxy = proxy_of_spheres();
  const BS::Soup_shares shares = BS::sample_soup_shares(proxy.map());
  // Each sphere hides a cap of height 0.4 of the other one.
  CHECK(shares.hidden == Approx(0.2).margin(0.01));
  CHECK(shares.carried_of_visible() > 0.97);
  CHECK(shares.carried + shares.continued + shares.hidden == Approx(1));
  for(auto f : proxy.soup().mesh().faces()) {
    const Point_3 c = centroid(proxy.soup().mesh(), f);
    const double depth = 1 - (std::max)((std::min)(distance(c, left), 1.), (std::min)(distance(c, right), 1.));
    if((std::min)(distance(c, left), distance(c, right)) < 0.9) CHECK(shares.facets[f] == BS::Soup_point::HIDDEN);
    else if(depth == 0 && std::abs(c.x()) > 0.2) CHECK(shares.facets[f] == BS::Soup_point::CARRIED);
  }
  const BS::Soup_shares again = BS::sample_soup_shares<CGAL::Sequential_tag>(proxy.map());
  CHECK(again.carried == shares.carried);
  CHECK(again.facets == shares.facets);
}

TEST_CASE("Soup proxy: points of the soup are mapped to the proxy along curves, and back")
{
  const BS::Soup_proxy_3& proxy = proxy_of_spheres();
  const auto map = proxy.map();
  std::size_t carried = 0, hidden = 0;
  for(auto v : proxy.soup().mesh().vertices()) {
    const Point_3 p = proxy.soup().mesh().point(v);
    const auto image = map(v);
    REQUIRE(image);
    const bool is_hidden = (std::min)(distance(p, left), distance(p, right)) < 0.9;
    if(is_hidden) {
      ++hidden;
      continue;
    }
    if(image.is_continued) continue;
    const auto back = map.inverse()(image.location);
    REQUIRE(back);
    if(std::abs(p.x()) < 0.2) continue; // at the crease, the other sphere may be in front
    CHECK_FALSE(back.is_continued);
    CHECK(distance(back.point, p) < 1e-6);
    ++carried;
  }
  CHECK(carried > 3 * hidden);
}

TEST_CASE("Soup proxy: attributes of vertices, facets and corners are transferred to the proxy")
{
  BS::Soup_proxy_3 proxy = proxy_of_spheres();
  const auto to_proxy = proxy.map();
  const Mesh& soup = proxy.soup().mesh();
  const std::size_t first_of_right = two_spheres().polygons.size() / 2;

  std::vector<double> values;
  for(const Point_3& p : two_spheres().points) values.push_back(linear(p));
  const auto value_of = boost::make_function_property_map<Mesh::Vertex_index>(
    [&](Mesh::Vertex_index v) { return values[proxy.soup().point_of(v)]; });
  Mesh mesh = proxy.mesh();
  const auto map = proxy.map(mesh);
  Scalars scalars = mesh.add_property_map<Mesh::Vertex_index, double>("v:value", 1e9).first;
  const BS::Transfer_report vertices = BS::transfer_vertex_attribute(map, value_of, scalars);
  CHECK(vertices.failures.empty());
  CHECK(vertices.continued.size() < mesh.number_of_vertices() / 50);
  // The gradient is 3.2, and images are at most a few offsets away.
  for(auto v : mesh.vertices()) CHECK(std::abs(scalars[v] - linear(mesh.point(v))) < 3.3 * 8 * proxy.report().offset);

  const auto side_of = boost::make_function_property_map<Mesh::Face_index>(
    [&](Mesh::Face_index f) { return proxy.soup().polygon_of(f) >= first_of_right; });
  auto sides = mesh.add_property_map<Mesh::Face_index, bool>("f:side", false).first;
  CHECK(BS::transfer_face_labels(map, side_of, sides).failures.empty());
  for(auto f : mesh.faces()) {
    const double x = centroid(mesh, f).x();
    if(std::abs(x) > 0.1) CHECK(sides[f] == (x > 0));
  }

  const auto corner_of = boost::make_function_property_map<Mesh::Halfedge_index>(
    [&](Mesh::Halfedge_index h) { return values[proxy.soup().point_of(soup.target(h))]; });
  auto corners = mesh.add_property_map<Mesh::Halfedge_index, double>("h:value", 1e9).first;
  const BS::Transfer_report at_corners = BS::transfer_corner_attribute(map, corner_of, corners);
  CHECK(at_corners.failures.empty());
  for(auto h : mesh.halfedges())
    CHECK(std::abs(corners[h] - linear(mesh.point(mesh.target(h)))) < 3.3 * 20 * proxy.report().offset);

  // The way back, from the proxy to the soup.
  Mesh soup_copy = soup;
  BS::Soup_map_3<BS::Soup_proxy_3::Shell, Mesh> from_copy(proxy.shell(), soup_copy, mesh);
  Scalars back = soup_copy.add_property_map<Mesh::Vertex_index, double>("v:value", 1e9).first;
  const BS::Transfer_report to_soup = BS::transfer_vertex_attribute(from_copy.inverse(), scalars, back);
  CHECK(to_soup.failures.empty());
  for(auto v : soup_copy.vertices()) {
    const Point_3 p = soup_copy.point(v);
    if((std::min)(distance(p, left), distance(p, right)) > 0.999)
      CHECK(std::abs(back[v] - linear(p)) < 3.3 * 16 * proxy.report().offset);
  }

  // Vectors along the y-axis are transferred with few failures.
  const auto y_of = boost::make_function_property_map<Mesh::Face_index>(
    [&](Mesh::Face_index) { return Vector_3(0, 1, 0); });
  auto vectors = mesh.add_property_map<Mesh::Face_index, Vector_3>("f:vector").first;
  const BS::Transfer_report of_vectors = BS::transfer_tangent_vectors(map, y_of, vectors);
  CHECK(of_vectors.failures.size() < mesh.number_of_faces() / 50);
}

TEST_CASE("Soup proxy: a simplified proxy still carries the attributes of the soup")
{
  const BS::Soup_proxy_3& proxy = proxy_of_spheres();
  Mesh coarse = proxy.mesh();
  const auto result = BS::simplify_in_shell(coarse, proxy.shell());
  REQUIRE(result);
  coarse.collect_garbage();
  CHECK(coarse.number_of_faces() < proxy.mesh().number_of_faces() / 4);
  const auto map = proxy.map(coarse);
  std::vector<double> values;
  for(auto v : proxy.soup().mesh().vertices()) values.push_back(linear(proxy.soup().mesh().point(v)));
  const auto value_of = boost::make_function_property_map<Mesh::Vertex_index>(
    [&](Mesh::Vertex_index v) { return values[v]; });
  Scalars scalars = coarse.add_property_map<Mesh::Vertex_index, double>("v:value", 1e9).first;
  CHECK(BS::transfer_vertex_attribute(map, value_of, scalars).failures.empty());
  for(auto v : coarse.vertices())
    CHECK(std::abs(scalars[v] - linear(coarse.point(v))) < 3.3 * 10 * proxy.report().offset);
}

TEST_CASE("Soup projection: the image is on the outermost facet of the curve, whichever way the facets face")
{
  const Mesh ball = sphere(3);
  const auto shell = CGAL::certified_bspline_shell_3(ball, parameters::relative_thickness(0.2));
  REQUIRE(shell.is_certified());
  // Triangles are across the curves of the shell, at different depths and with gaps; some are reversed.
  Soup soup;
  CGAL::Random random(11);
  for(int i = 0; i < 300; ++i) {
    const double a = random.get_double(0, 2 * CGAL_PI), z = random.get_double(-1, 1), r = random.get_double(0.94, 1.06),
                 s = std::sqrt(1 - z * z);
    const double size = 0.15;
    soup.polygons.push_back({ soup.points.size(), soup.points.size() + 1, soup.points.size() + 2 });
    for(int k = 0; k < 3; ++k) {
      const double x = random.get_double(-size, size), y = random.get_double(-size, size),
                   w = random.get_double(-size, size);
      Point_3 p(s * std::cos(a) + x, s * std::sin(a) + y, z + w);
      const double length = std::sqrt((p - CGAL::ORIGIN).squared_length());
      soup.points.push_back(CGAL::ORIGIN + r / length * (p - CGAL::ORIGIN));
    }
  }
  const BS::Soup_mesh_3 mesh(soup);
  const auto triangle = [&](Mesh::Face_index f) {
    const std::array<Point_3, 3> t = corners(mesh.mesh(), f);
    return Kernel::Triangle_3(t[0], t[1], t[2]);
  };
  typedef BS::Soup_projection_3<BS::Soup_proxy_3::Shell, Mesh> Projection;
  const Projection projection(shell, std::make_shared<const Projection::Target>(mesh.mesh(), mesh.mesh().points()));
  const BS::Gradient_flow_3<BS::Soup_proxy_3::Shell> flow(shell);

  std::size_t hits = 0, continued = 0;
  for(auto v : ball.vertices()) {
    if(v % 4 != 0) continue;
    const Point_3 p = ball.point(v);
    // a polyline along the curve, beginning outside
    std::vector<Point_3> curve;
    const int parts = 100;
    for(int i = parts; i >= 0; --i) {
      const double inner = shell.inner_threshold().value(p), outer = shell.outer_threshold().value(p);
      const auto arrival = flow.trace(p, inner + (outer - inner) * i / parts);
      if(arrival) curve.push_back(arrival.point);
    }
    REQUIRE(curve.size() > 90);
    bool is_found = false;
    Point_3 first = p;
    for(std::size_t i = 0; i + 1 < curve.size() && !is_found; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for(auto f : mesh.mesh().faces()) {
        const Kernel::Triangle_3 t = triangle(f);
        const Kernel::Segment_3 s(curve[i], curve[i + 1]);
        if(!CGAL::do_intersect(t, s)) continue;
        const auto meet = CGAL::intersection(t, s);
        if(!meet) continue;
        if(const Point_3* q = BS::internal::get_if<Point_3>(*meet))
          if(distance(curve[i], *q) < least) {
            least = distance(curve[i], *q);
            first = *q;
            is_found = true;
          }
      }
    }
    const auto image = projection(p);
    REQUIRE(image);
    CHECK(image.is_continued == !is_found);
    if(is_found && !image.is_continued) {
      CHECK(distance(first, image.point) < 1e-3);
      ++hits;
    }
    if(image.is_continued) {
      const auto end = flow.trace(p, shell.inner_threshold().value(p));
      REQUIRE(end);
      double least = std::numeric_limits<double>::infinity();
      for(auto f : mesh.mesh().faces())
        least = (std::min)(least, std::sqrt(CGAL::squared_distance(end.point, triangle(f))));
      CHECK(distance(end.point, image.point) == Approx(least).margin(0.003));
      ++continued;
    }
  }
  CHECK(hits > 20);
  CHECK(continued > 20);
}

TEST_CASE("Soup proxy: a cube with a missing side is wrapped inside and outside")
{
  Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  Soup soup;
  soup.add(cube);
  soup.polygons.resize(10); // the cube has twelve facets
  const BS::Soup_proxy_3 proxy = CGAL::certified_soup_proxy_3(soup.points, soup.polygons, parameters::alpha(0.1));
  REQUIRE(proxy.is_certified());
  // Some vertices of the proxy are inside the cube.
  bool is_entered = false;
  for(auto v : proxy.mesh().vertices()) {
    const Point_3 p = proxy.mesh().point(v);
    is_entered = is_entered
                 || ((std::max)({ std::abs(p.x() - 0.5), std::abs(p.y() - 0.5), std::abs(p.z() - 0.5) }) < 0.49);
  }
  CHECK(is_entered);
  const BS::Soup_shares shares = BS::sample_soup_shares(proxy.map());
  CHECK(shares.hidden < 0.02);
  // Every vertex of the soup has an image on the proxy.
  for(auto v : proxy.soup().mesh().vertices()) CHECK(proxy.map()(v));
}

TEST_CASE("Soup proxy: random triangles get a certified proxy, and continued values are reported")
{
  const Soup soup = random_triangles(12);
  const BS::Soup_proxy_3 proxy = CGAL::certified_soup_proxy_3(soup.points, soup.polygons, parameters::alpha(0.25));
  REQUIRE(proxy.is_certified());
  const BS::Soup_shares shares = BS::sample_soup_shares(proxy.map(), 2000);
  CHECK(shares.continued > 0.3);
  Mesh mesh = proxy.mesh();
  const auto map = proxy.map(mesh);
  const auto polygon_of = boost::make_function_property_map<Mesh::Face_index>(
    [&](Mesh::Face_index f) { return proxy.soup().polygon_of(f); });
  auto labels = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:label", std::size_t(99)).first;
  const BS::Transfer_report report = BS::transfer_face_labels(map, polygon_of, labels);
  CHECK(report.failures.empty());
  CHECK_FALSE(report.continued.empty());
  for(auto f : mesh.faces()) CHECK(labels[f] < 12);
}

TEST_CASE("Soup proxy: an invalid soup or parameter is rejected with a status")
{
  const Points points{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(2, 0, 0) };
  const auto status = [](const Points& p, const Polygons& f, double alpha = 0.1) {
    return CGAL::certified_soup_proxy_3(p, f, parameters::alpha(alpha)).status();
  };
  CHECK(status({}, {}) == BS::Shell_status::EMPTY_MESH);
  CHECK(status(points, {}) == BS::Shell_status::EMPTY_MESH);
  CHECK(status(points, { { 0, 1, 3 } }) == BS::Shell_status::DEGENERATE_FACET);
  CHECK(status(points, { { 0, 1, 4 } }) == BS::Shell_status::INVALID_PARAMETER);
  CHECK(status(points, { { 0, 1, 2 } }, -1) == BS::Shell_status::INVALID_PARAMETER);
  CHECK(status(points, { { 0, 1, 2 } }, 1e-12) == BS::Shell_status::GRID_TOO_FINE);
  CHECK(status(points, { { 0, 1, 2 } }, 1e-6) == BS::Shell_status::MEMORY_LIMIT_EXCEEDED);
  const Polygons one{ { 0, 1, 2 } };
  const auto check = [](const BS::Soup_proxy_3& proxy, const std::string& name, double value) {
    CAPTURE(name);
    CHECK(proxy.status() == BS::Shell_status::INVALID_PARAMETER);
    REQUIRE(proxy.invalid_parameter());
    CHECK(proxy.invalid_parameter().name == name);
    CHECK(proxy.invalid_parameter().value == value);
    CHECK_FALSE(proxy.invalid_parameter().bounds.contains(value));
    CHECK(proxy.message() == message(proxy.invalid_parameter()));
  };
  check(CGAL::certified_soup_proxy_3(points, one, parameters::alpha(0.)), "alpha", 0);
  check(CGAL::certified_soup_proxy_3(points, one, parameters::offset(-2.)), "offset", -2);
  check(CGAL::certified_soup_proxy_3(points, one, parameters::time_limit(0.)), "time_limit", 0);
  check(CGAL::certified_soup_proxy_3(points, one, parameters::least_cone_margin(2.)), "least_cone_margin", 2);
  check(CGAL::certified_soup_proxy_3(points, std::vector<std::vector<std::size_t> >{ { 0, 1, 4 } }), "polygons", 4);
  CHECK(CGAL::certified_soup_proxy_3(points, one, parameters::thickness(-1)).status()
        == BS::Shell_status::INVALID_PARAMETER);
  CHECK(CGAL::certified_soup_proxy_3(points, one, parameters::resolution(0.)).status()
        == BS::Shell_status::INVALID_PARAMETER);
  Points large = points;
  large[1] = Point_3(1e200, 0, 0);
  CHECK(status(large, { { 0, 1, 2 } }) == BS::Shell_status::COORDINATES_OUT_OF_RANGE);
  Points wrong = points;
  wrong[2] = Point_3(0, std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK(status(wrong, { { 0, 1, 2 } }) == BS::Shell_status::NOT_FINITE);
  const BS::Soup_proxy_3 none = CGAL::certified_soup_proxy_3(wrong, Polygons{ { 0, 1, 3 }, { 0, 1, 2 } });
  CHECK(none.offending_simplices().vertices == std::vector<std::size_t>{ 2 });
  CHECK_FALSE(none);
  CHECK_FALSE(none.is_certified());
}
} // namespace test_soup_proxy_3
