// transfer_vertex_attribute.h, transfer_face_labels.h, transfer_tangent_vectors.h, Barycentric_interpolation.h: values
// are those of the source where the curve meets it. If there is no such value, the target is unchanged, and the reason
// is reported.
#include "flat_and_round_maps.h"

#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/IO/Color.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <complex>
#include <functional>
#include <set>
#include <string>
#include <utility>

namespace test_transfer_attributes {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
using BS::Flow_status;
typedef Polynomial_map Map;
typedef Mesh::Vertex_index Vertex;
typedef Mesh::Face_index Face;

// Images are exact up to 2e-9; linear functions are off by at most that times their slope.
const double tolerance = 1e-8;

template <typename Simplex, typename Value>
Mesh::Property_map<Simplex, Value> map_of(Mesh& mesh, const std::string& name, const Value& value)
{
  return mesh.add_property_map<Simplex, Value>(name, value).first;
}
template <typename Simplex, typename Value>
Mesh::Property_map<Simplex, Value> map_of(Mesh& mesh, const std::string& name)
{
  return mesh.add_property_map<Simplex, Value>(name).first;
}

template <typename T, typename Function>
void check_identity(const char* name, const Function& value)
{
  INFO(name);
  Mesh mesh = sphere(2, 0.8);
  const Map map(ball(), mesh, mesh);
  auto before = map_of<Vertex, T>(mesh, "v:before"), after = map_of<Vertex, T>(mesh, "v:after");
  for(auto v : mesh.vertices()) before[v] = value(std::size_t(v));
  const BS::Transfer_report report = BS::transfer_vertex_attribute(map, before, after);
  CHECK(report);
  CHECK(report.transferred == mesh.number_of_vertices());
  std::size_t changed = 0;
  for(auto v : mesh.vertices()) changed += !(after[v] == before[v]);
  CHECK(changed == 0);
}

Mesh source_sheet()
{
  return sheet(steps(-0.8, 0.8, 7), steps(-0.8, 0.8, 9));
}
double tilt(double x, double y)
{
  return 0.2 + 0.3 * x - 0.25 * y;
}
Mesh tilted_sheet()
{
  return sheet(steps(-0.7, 0.65, 11), steps(-0.6, 0.7, 6), tilt);
}

} // namespace

TEST_CASE("Transfer: under the identity, integers and colors are unchanged")
{
  check_identity<int>("int", [](std::size_t n) { return int(n * 7919 % 1000003) - 500000; });
  check_identity<unsigned char>("unsigned char", [](std::size_t n) { return (unsigned char)(n * 37); });
  check_identity<CGAL::IO::Color>("Color", [](std::size_t n) {
    return CGAL::IO::Color((unsigned char)(n * 37), (unsigned char)(n % 2 ? 255 : 0), (unsigned char)(n),
                           (unsigned char)(n * 11));
  });
  check_identity<std::array<int, 2> >("array of int", [](std::size_t n) {
    return std::array<int, 2>{ int(n), -int(n * n) };
  });
  check_identity<std::array<CGAL::IO::Color, 2> >("array of Color", [](std::size_t n) {
    return std::array<CGAL::IO::Color, 2>{ CGAL::IO::Color((unsigned char)n, 0, 0),
                                           CGAL::IO::Color(0, (unsigned char)(3 * n), 255) };
  });
}

TEST_CASE("Transfer: under the identity, real values are unchanged up to rounding")
{
  Mesh mesh = sphere(2, 0.8);
  const Map map(ball(), mesh, mesh);
  auto d = map_of<Vertex, double>(mesh, "v:d"), d2 = map_of<Vertex, double>(mesh, "v:d2");
  auto f = map_of<Vertex, float>(mesh, "v:f"), f2 = map_of<Vertex, float>(mesh, "v:f2");
  auto a = map_of<Vertex, std::array<double, 3> >(mesh, "v:a"),
       a2 = map_of<Vertex, std::array<double, 3> >(mesh, "v:a2");
  auto w = map_of<Vertex, Vector_3>(mesh, "v:w"), w2 = map_of<Vertex, Vector_3>(mesh, "v:w2");
  auto p2 = map_of<Vertex, Point_3>(mesh, "v:p2");
  auto e = map_of<Vertex, Eigen::Vector2d>(mesh, "v:e", { 0, 0 }),
       e2 = map_of<Vertex, Eigen::Vector2d>(mesh, "v:e2", { 0, 0 });
  CGAL::Random random(1);
  for(auto v : mesh.vertices()) {
    d[v] = random.get_double(-1, 1);
    f[v] = float(d[v]);
    a[v] = { d[v], random.get_double(-1, 1), 1 };
    w[v] = Vector_3(d[v], a[v][1], 2);
    e[v] = Eigen::Vector2d(d[v], a[v][1]);
  }
  CHECK(BS::transfer_vertex_attribute(map, d, d2));
  CHECK(BS::transfer_vertex_attribute(map, f, f2));
  CHECK(BS::transfer_vertex_attribute(map, a, a2));
  CHECK(BS::transfer_vertex_attribute(map, w, w2));
  CHECK(BS::transfer_vertex_attribute(map, mesh.points(), p2));
  CHECK(BS::transfer_vertex_attribute(map, e, e2));
  const double rounding = 1e-13;
  for(auto v : mesh.vertices()) {
    CHECK(std::abs(d2[v] - d[v]) < rounding);
    CHECK(std::abs(f2[v] - f[v]) < 2e-7);
    for(int i = 0; i < 3; ++i) CHECK(std::abs(a2[v][i] - a[v][i]) < rounding);
    CHECK((w2[v] - w[v]).squared_length() < rounding * rounding);
    CHECK((p2[v] - mesh.point(v)).squared_length() < rounding * rounding);
    CHECK((e2[v] - e[v]).norm() < rounding);
  }
}

TEST_CASE("Transfer: linear functions are reproduced both ways, and vertices beyond the source keep their values")
{
  Mesh a = source_sheet(), b = tilted_sheet();
  const Map map(slab(), a, b);
  auto on_a = map_of<Vertex, double>(a, "v:d"), on_b = map_of<Vertex, double>(b, "v:d");
  const auto linear = [](const Point_3& p) { return 3 + 2 * p.x() - 5 * p.y(); };
  for(auto v : a.vertices()) on_a[v] = linear(a.point(v));
  BS::Transfer_report report = BS::transfer_vertex_attribute(map, on_a, on_b);
  CHECK(report);
  CHECK(report.transferred == b.number_of_vertices());
  for(auto v : b.vertices()) CHECK(on_b[v] == Approx(linear(b.point(v))).margin(6 * tolerance));

  // Transfer back to vertices, some of which are beyond the smaller sheet.
  const double before = -1000;
  auto again = map_of<Vertex, double>(a, "v:again", before);
  report = BS::transfer_vertex_attribute(map.inverse(), on_b, again);
  CHECK_FALSE(report);
  std::size_t outside = 0, position = 0;
  for(auto v : a.vertices()) {
    const Point_3& p = a.point(v);
    if(p.x() < -0.7 || p.x() > 0.65 || p.y() < -0.6 || p.y() > 0.7) {
      REQUIRE(outside < report.failures.size());
      CHECK(report.failures[outside].first == position);
      CHECK(report.failures[outside].second == Flow_status::LEAVES_SHELL);
      CHECK(again[v] == before);
      ++outside;
    } else CHECK(again[v] == Approx(linear(p)).margin(6 * tolerance));
    ++position;
  }
  CHECK(outside == report.failures.size());
  CHECK(outside > 10);
  CHECK(report.transferred + outside == a.number_of_vertices());
}

TEST_CASE("Transfer: between spheres, errors are bounded by the distance of the facets from the spheres")
{
  Mesh a = sphere(3, 0.7), b = turned(sphere(2, 0.85), 0.3);
  const Map map(ball(), a, b);
  auto on_a = map_of<Vertex, double>(a, "v:d"), on_b = map_of<Vertex, double>(b, "v:d"),
       average = map_of<Vertex, double>(b, "v:average");
  const auto direction = [](const Point_3& p) {
    return (p - CGAL::ORIGIN) * Vector_3(1, -2, 2) / std::sqrt((p - CGAL::ORIGIN).squared_length()) / 3;
  };
  for(auto v : a.vertices()) on_a[v] = direction(a.point(v));
  CHECK(BS::transfer_vertex_attribute(map, on_a, on_b));
  CHECK(BS::average_vertex_attribute(map, on_a, average));
  for(auto v : b.vertices()) {
    // Edges of a span angles of 0.14 to 0.17. The sagitta is at most 0.17^2 / 8, and slightly more at centers of
    // facets.
    CHECK(std::abs(on_b[v] - direction(b.point(v))) < 0.006);
    // Averages are over stars of b, whose edges are twice as long.
    CHECK(std::abs(average[v] - direction(b.point(v))) < 0.05);
  }
}

TEST_CASE("Transfer: averages of a constant equal the constant, whatever the numbers of vertices")
{
  for(int fine : { 1, 3 }) {
    Mesh a = sphere(fine, 0.7), b = turned(sphere(2, 0.85), 0.3);
    const Map map(ball(), a, b);
    auto d = map_of<Vertex, double>(a, "v:d", 0.7), d2 = map_of<Vertex, double>(b, "v:d");
    auto w = map_of<Vertex, Vector_3>(a, "v:w", Vector_3(1, 2, 3)), w2 = map_of<Vertex, Vector_3>(b, "v:w");
    auto i = map_of<Vertex, int>(a, "v:i", 41), i2 = map_of<Vertex, int>(b, "v:i");
    for(const BS::Transfer_report& report :
        { BS::average_vertex_attribute(map, d, d2), BS::average_vertex_attribute(map, w, w2),
          BS::average_vertex_attribute(map, i, i2) }) {
      CHECK(report);
      CHECK(report.transferred == b.number_of_vertices());
    }
    for(auto v : b.vertices()) {
      CHECK(d2[v] == Approx(0.7).epsilon(1e-12));
      CHECK((w2[v] - Vector_3(1, 2, 3)).squared_length() < 1e-24);
      CHECK(i2[v] == 41);
    }
  }
}

TEST_CASE("Transfer: averaging preserves the sum of the values, weighted by the areas around vertices")
{
  // A fine sheet is averaged to a coarse one in the same rectangle. The sums of (value times area around a vertex) are
  // compared.
  Mesh a = sheet(steps(-0.7, 0.7, 20), steps(-0.7, 0.7, 20), 0.1),
       b = sheet(steps(-0.7, 0.7, 3), steps(-0.7, 0.7, 2), tilt);
  const Map map(slab(), a, b);
  auto d = map_of<Vertex, double>(a, "v:d"), d2 = map_of<Vertex, double>(b, "v:d");
  CGAL::Random random(5);
  std::vector<double> area(a.number_of_vertices(), 0), weight(b.number_of_vertices(), 0);
  for(auto f : a.faces())
    for(auto v : a.vertices_around_face(a.halfedge(f))) area[v] += std::sqrt(normal(a, f).squared_length()) / 6;
  double sum = 0, sum2 = 0;
  for(auto v : a.vertices()) {
    d[v] = random.get_double(0, 1);
    const auto image = map.to_target()(a.point(v));
    if(!image) continue; // some vertices on the border, by rounding
    sum += d[v] * area[v];
    const auto h = b.halfedge(image.location.first);
    const Vertex corners[3] = { b.source(h), b.target(h), b.target(b.next(h)) };
    for(int i = 0; i < 3; ++i) weight[corners[i]] += area[v] * image.location.second[i];
  }
  CHECK(BS::average_vertex_attribute(map, d, d2));
  for(auto v : b.vertices()) sum2 += d2[v] * weight[v];
  CHECK(sum2 == Approx(sum).epsilon(1e-12));
}

TEST_CASE("Transfer: functors interpolate and map values, and receive the differential")
{
  Mesh a = source_sheet(), b = tilted_sheet();
  const Map map(slab(), a, b);
  auto displacement = map_of<Vertex, Vector_3>(a, "v:d", Vector_3(1, 2, 0)), on_b = map_of<Vertex, Vector_3>(b, "v:d");
  // The differential of the flow between levels of z is the identity. Tangent vectors of levels are kept; the vertical
  // part is lost.
  CHECK(BS::transfer_vertex_attribute(map, displacement, on_b, P::mapping(BS::Tangent_vector_mapping())));
  for(auto v : b.vertices()) CHECK((on_b[v] - Vector_3(1, 2, 0)).squared_length() < 1e-16);
  for(auto v : a.vertices()) displacement[v] = Vector_3(1, 2, 7);
  CHECK(BS::transfer_vertex_attribute(map, displacement, on_b, P::mapping(BS::Tangent_vector_mapping())));
  for(auto v : b.vertices()) CHECK((on_b[v] - Vector_3(1, 2, 0)).squared_length() < 1e-16);

  // the label of the nearest corner
  auto label = map_of<Vertex, std::string>(a, "v:label"), label_b = map_of<Vertex, std::string>(b, "v:label");
  for(auto v : a.vertices()) label[v] = a.point(v).x() < 0 ? "left" : "right";
  const auto nearest = [](const std::array<std::string, 3>& values, const std::array<double, 3>& w) {
    return values[std::size_t(std::max_element(w.begin(), w.end()) - w.begin())];
  };
  CHECK(BS::transfer_vertex_attribute(map, label, label_b, P::interpolation(nearest)));
  for(auto v : b.vertices())
    if(std::abs(b.point(v).x()) > 0.23) CHECK(label_b[v] == (b.point(v).x() < 0 ? "left" : "right"));

  // on spheres, the stretch
  Mesh inner = sphere(2, 0.7), outer = sphere(2, 0.85);
  auto one = map_of<Vertex, double>(inner, "v:one", 1.), stretch = map_of<Vertex, double>(outer, "v:stretch");
  const auto area = [](double value, const BS::Flow_differential& d) {
    const Eigen::Vector3d n = d.velocity.normalized(), u = n.unitOrthogonal();
    return value * (d.onto_level_set() * u).norm() * (d.onto_level_set() * n.cross(u)).norm();
  };
  CHECK(BS::transfer_vertex_attribute(Map(ball(), inner, outer), one, stretch, P::mapping(area)));
  for(auto v : outer.vertices()) CHECK(stretch[v] == Approx(0.85 * 0.85 / (0.7 * 0.7)).epsilon(1e-7));
}

TEST_CASE("Transfer: under the identity, labels of any type are unchanged")
{
  Mesh mesh = sphere(2, 0.8);
  const Map map(ball(), mesh, mesh);
  auto number = map_of<Face, int>(mesh, "f:n"), number2 = map_of<Face, int>(mesh, "f:n2", -1);
  auto name = map_of<Face, std::string>(mesh, "f:s"), name2 = map_of<Face, std::string>(mesh, "f:s2");
  auto flag = map_of<Face, bool>(mesh, "f:b"), flag2 = map_of<Face, bool>(mesh, "f:b2");
  for(auto f : mesh.faces()) {
    number[f] = int(f) * 3;
    name[f] = "material " + std::to_string(std::size_t(f) % 7);
    flag[f] = std::size_t(f) % 3 == 0;
  }
  for(std::size_t samples : { 1, 4, 10 }) {
    CHECK(BS::transfer_face_labels(map, number, number2, P::samples_per_facet(samples)));
    std::size_t changed = 0;
    for(auto f : mesh.faces()) changed += number2[f] != number[f];
    CHECK(changed == 0);
  }
  const BS::Transfer_report report = BS::transfer_face_labels(map, name, name2);
  CHECK(report.transferred == mesh.number_of_faces());
  CHECK(BS::transfer_face_labels(map, flag, flag2));
  std::size_t changed = 0;
  for(auto f : mesh.faces()) changed += name2[f] != name[f] || flag2[f] != flag[f];
  CHECK(changed == 0);
}

TEST_CASE("Transfer: a facet gets the label that covers most of it")
{
  // The source has strips along x with borders at 0.1 and 0.3. Each target is a single facet across them.
  Mesh a = sheet({ -0.8, 0.1, 0.3, 0.8 }, { -0.8, 0.8 });
  auto label = map_of<Face, int>(a, "f:l");
  const auto strip = [](double x) { return x < 0.1 ? 0 : x < 0.3 ? 1 : 2; };
  for(auto f : a.faces()) label[f] = strip(centroid(a, f).x());
  CGAL::Random random(4);
  int decided = 0;
  for(int n = 0; n < 60; ++n) {
    Mesh b;
    const auto at = [&]() {
      return Point_3(random.get_double(-0.7, 0.7), random.get_double(-0.7, 0.7), random.get_double(-0.5, 0.5));
    };
    Point_3 p = at(), q = at(), r = at();
    if(CGAL::cross_product(q - p, r - p).z() < 0) std::swap(q, r);
    b.add_face(b.add_vertex(p), b.add_vertex(q), b.add_vertex(r));
    auto found = map_of<Face, int>(b, "f:l", -1), at_centroid = map_of<Face, int>(b, "f:c", -1);
    const Map map(slab(), a, b);
    REQUIRE(BS::transfer_face_labels(map, label, found, P::samples_per_facet(std::size_t(400))));
    REQUIRE(BS::transfer_face_labels(map, label, at_centroid, P::samples_per_facet(std::size_t(1))));
    // Shares of the area are computed by many other samples.
    double share[3] = { 0, 0, 0 };
    const int parts = 200;
    for(int i = 0; i < parts; ++i)
      for(int j = 0; i + j < parts; ++j) {
        const double u = (i + 1 / 3.) / parts, v = (j + 1 / 3.) / parts;
        share[strip(p.x() + u * (q.x() - p.x()) + v * (r.x() - p.x()))] += 2. / (parts * (parts + 1));
      }
    const Face f(0);
    CHECK(at_centroid[f] == strip(centroid(b, f).x()));
    const int most = int(std::max_element(share, share + 3) - share);
    bool clear = true; // false if shares are too close for 400 samples: rows of 20 along a border
    for(int l = 0; l < 3; ++l) clear = clear && (l == most || share[most] - share[l] > 0.1);
    if(clear) {
      CHECK(found[f] == most);
      ++decided;
    }
  }
  CHECK(decided > 30);
}

TEST_CASE("Transfer: tangent vectors are mapped to tangent vectors of the target, between spheres and to tilted planes")
{
  // Concentric spheres have the same facets, so vectors are stretched by the ratio of the radii.
  Mesh a = sphere(2, 0.7), b = sphere(2, 0.85);
  const Map map(ball(), a, b);
  auto v = map_of<Face, Vector_3>(a, "f:v"), image = map_of<Face, Vector_3>(b, "f:v"),
       again = map_of<Face, Vector_3>(a, "f:again");
  CGAL::Random random(6);
  for(auto f : a.faces()) {
    const std::array<Point_3, 3> t = corners(a, f);
    v[f] = random.get_double(-5, 5) * (t[1] - t[0]) + random.get_double(-5, 5) * (t[2] - t[0]);
  }
  const double stretch = 0.85 / 0.7;
  for(int symmetry : { 1, 2, 3, 4, 6 }) {
    const BS::Transfer_report report = BS::transfer_tangent_vectors(map, v, image, P::symmetry(symmetry));
    CHECK(report);
    CHECK(report.transferred == b.number_of_faces());
    CHECK(BS::transfer_tangent_vectors(map.inverse(), image, again, P::symmetry(symmetry)));
    for(auto f : a.faces()) {
      CHECK((image[f] - stretch * v[f]).squared_length() < 1e-14 * v[f].squared_length());
      CHECK((again[f] - v[f]).squared_length() < 1e-14 * v[f].squared_length());
    }
  }

  // Over a tilted plane, x and y are kept.
  Mesh flat = source_sheet(), tilted = tilted_sheet();
  auto w = map_of<Face, Vector_3>(flat, "f:w", Vector_3(2, -1, 0)), w2 = map_of<Face, Vector_3>(tilted, "f:w");
  CHECK(BS::transfer_tangent_vectors(Map(slab(), flat, tilted), w, w2));
  for(auto f : tilted.faces()) {
    CHECK((w2[f] - Vector_3(2, -1, 0.3 * 2 + 0.25)).squared_length() < 1e-14);
    CHECK(std::abs(w2[f] * normal(tilted, f)) < 1e-9);
  }
}

TEST_CASE("Transfer: a sheared cross is mapped to the best-fitting cross")
{
  // The target is the plane z = slope x, with u along the slope and v across it. (x, y) is mapped to (stretch x, y).
  const double slope = 0.6, stretch = std::sqrt(1 + slope * slope);
  Mesh a = source_sheet(),
       b = sheet(steps(-0.7, 0.65, 3), steps(-0.6, 0.7, 2), [=](double x, double) { return slope * x; });
  const Map map(slab(), a, b);
  auto from = map_of<Face, Vector_3>(a, "f:v"), to = map_of<Face, Vector_3>(b, "f:v");
  const Vector_3 u(1 / stretch, 0, slope / stretch), v(0, 1, 0);
  for(int symmetry : { 1, 2, 3, 4 })
    for(int n = 0; n < 24; ++n) {
      const double angle = 2 * CGAL_PI * n / 24 + 0.01, length = 0.5;
      for(auto f : a.faces()) from[f] = length * Vector_3(std::cos(angle), std::sin(angle), 0);
      CHECK(BS::transfer_tangent_vectors(map, from, to, P::symmetry(symmetry)));
      // By search: among directions near the image of the first one, the one whose N-th power is closest to those of
      // all images.
      const auto sheared = [&](double alpha) {
        return std::complex<double>(stretch * std::cos(alpha), std::sin(alpha));
      };
      double least = 1e9, best = 0, product = 1;
      const double first = std::arg(sheared(angle));
      for(int k = 0; k < symmetry; ++k) product *= length * std::abs(sheared(angle + 2 * CGAL_PI * k / symmetry));
      for(int i = -20000; i <= 20000; ++i) {
        const double candidate = first + CGAL_PI / symmetry * i / 20000;
        double error = 0;
        for(int k = 0; k < symmetry; ++k)
          error += std::norm(std::polar(1., symmetry * candidate)
                             - std::polar(1., symmetry * std::arg(sheared(angle + 2 * CGAL_PI * k / symmetry))));
        if(error < least) {
          least = error;
          best = candidate;
        }
      }
      const Vector_3 expected = std::pow(product, 1. / symmetry) * (std::cos(best) * u + std::sin(best) * v);
      INFO("symmetry " << symmetry << ", angle " << angle);
      // The steps of the search are at most 1.6e-4.
      for(auto f : b.faces()) CHECK((to[f] - expected).squared_length() < 1e-6);
    }
}

TEST_CASE("Transfer: failures are reported, and values there are unchanged")
{
  Mesh a = sphere(2, 0.7), b = sphere(1, 0.85);
  auto d = map_of<Vertex, double>(a, "v:d", 1.), d2 = map_of<Vertex, double>(b, "v:d", -7.);
  auto l = map_of<Face, int>(a, "f:l", 1), l2 = map_of<Face, int>(b, "f:l", -7);
  auto w = map_of<Face, Vector_3>(a, "f:w", Vector_3(1, 0, 0)),
       w2 = map_of<Face, Vector_3>(b, "f:w", Vector_3(-7, -7, -7));
  const auto check_none = [&](const Map& map, Flow_status status) {
    for(const BS::Transfer_report& report :
        { BS::transfer_vertex_attribute(map, d, d2), BS::transfer_face_labels(map, l, l2),
          BS::transfer_tangent_vectors(map, w, w2) }) {
      CHECK_FALSE(report);
      CHECK(report.transferred == 0);
      REQUIRE((report.failures.size() == b.number_of_vertices() || report.failures.size() == b.number_of_faces()));
      for(std::size_t n = 0; n < report.failures.size(); ++n) {
        CHECK(report.failures[n].first == n);
        CHECK(report.failures[n].second == status);
      }
    }
    for(auto v : b.vertices()) CHECK(d2[v] == -7);
    for(auto f : b.faces()) {
      CHECK(l2[f] == -7);
      CHECK(w2[f] == Vector_3(-7, -7, -7));
    }
  };
  Mesh quads = a;
  CGAL::Euler::join_face(quads.halfedge(Face(0)), quads);
  const Map of_quads(ball(), quads, b);
  check_none(of_quads, Flow_status::INVALID_MESH);
  CHECK(BS::average_vertex_attribute(of_quads, d, d2).failures.size() == b.number_of_vertices());
  const Mesh reflected = mapped(a, [](const Point_3& p) { return CGAL::ORIGIN - (p - CGAL::ORIGIN); });
  check_none(Map(ball(), reflected, b), Flow_status::WRONG_ORIENTATION);
  const auto tripled = [](const Point_3& p) { return CGAL::ORIGIN + 3 * (p - CGAL::ORIGIN); };
  const Mesh elsewhere = mapped(a, tripled), too_far = mapped(b, tripled);
  const Map outside(ball(), elsewhere, b);
  const BS::Transfer_report left = BS::transfer_vertex_attribute(outside, d, d2);
  CHECK(left.transferred == 0);
  for(const auto& failure : left.failures) CHECK(failure.second == Flow_status::LEAVES_SHELL);
  const BS::Transfer_report none = BS::transfer_face_labels(Map(ball(), a, too_far), l, l2);
  CHECK(none.transferred == 0);
  for(const auto& failure : none.failures) CHECK(failure.second == Flow_status::STARTS_OUTSIDE);

  // The visitor stops the transfer. Finished values are set, others are unchanged.
  struct Stopping_visitor
  {
    std::size_t calls = 0, done = 0;
    bool advance(std::size_t n, std::size_t)
    {
      ++calls;
      done = n;
      return false;
    }
  };
  Mesh many = sphere(5, 0.85); // 10242 vertices, 20480 facets, 81920 samples
  auto labels = map_of<Face, int>(many, "f:l", -7);
  Stopping_visitor visitor;
  const BS::Transfer_report some = BS::transfer_face_labels(Map(ball(), a, many), l, labels,
                                                            P::visitor(std::ref(visitor)));
  CHECK(visitor.calls == 1);
  CHECK(some.transferred > 0);
  CHECK(some.transferred < many.number_of_faces());
  CHECK(some.failures.size() == many.number_of_faces() - some.transferred);
  for(const auto& failure : some.failures) {
    CHECK(failure.second == Flow_status::CANCELED);
    CHECK(labels[Face(Mesh::size_type(failure.first))] == -7);
  }
}

TEST_CASE("Transfer: failures over a hole are reported, and get the caller's default value, or keep their own")
{
  // The source has a hole in the middle; the target continues over it.
  Mesh a = source_sheet(), b = tilted_sheet();
  const std::vector<Face> facets(a.faces_begin(), a.faces_end());
  for(auto f : facets)
    if(std::abs(centroid(a, f).x()) < 0.3 && std::abs(centroid(a, f).y()) < 0.3)
      CGAL::Euler::remove_face(a.halfedge(f), a);
  REQUIRE(a.number_of_faces() < facets.size());
  a.collect_garbage();
  const Map map(slab(), a, b);
  const BS::Projection_target_3<Mesh> source(a, a.points());
  const auto is_over_hole = [&](const Point_3& p) {
    for(BS::Projection_target_3<Mesh>::Index f = 0; f < source.number_of_facets(); ++f)
      if(source.position(f, { p.x(), p.y(), 0 }).outside <= tolerance) return false; // some points are over the border
    return true;
  };
  std::vector<std::pair<std::size_t, Flow_status> > no_vertices, no_facets;
  std::set<std::size_t> vertices_in_hole, facets_in_hole;
  for(auto v : b.vertices())
    if(is_over_hole(b.point(v))) no_vertices.emplace_back(std::size_t(v), Flow_status::LEAVES_SHELL);
  for(auto f : b.faces())
    if(is_over_hole(centroid(b, f))) no_facets.emplace_back(std::size_t(f), Flow_status::LEAVES_SHELL);
  REQUIRE(no_vertices.size() > 3);
  REQUIRE(no_facets.size() > 3);
  for(const auto& failure : no_vertices) vertices_in_hole.insert(failure.first);
  for(const auto& failure : no_facets) facets_in_hole.insert(failure.first);

  auto d = map_of<Vertex, double>(a, "v:d", 1.), kept = map_of<Vertex, double>(b, "v:kept", -7.),
       set = map_of<Vertex, double>(b, "v:set", -7.);
  auto l = map_of<Face, std::string>(a, "f:l", "there"), l_kept = map_of<Face, std::string>(b, "f:kept", "before"),
       l_set = map_of<Face, std::string>(b, "f:set", "before");
  auto w = map_of<Face, Vector_3>(a, "f:w", Vector_3(1, 0, 0)),
       w_kept = map_of<Face, Vector_3>(b, "f:w1", Vector_3(-7, -7, -7)),
       w_set = map_of<Face, Vector_3>(b, "f:w2", Vector_3(-7, -7, -7));
  const auto check_vertices = [&](const BS::Transfer_report& keep, const BS::Transfer_report& replace) {
    for(const BS::Transfer_report& report : { keep, replace }) {
      CHECK_FALSE(report);
      CHECK(report.failures == no_vertices);
      CHECK(report.transferred + no_vertices.size() == b.number_of_vertices());
    }
    for(auto v : b.vertices()) {
      const bool lost = vertices_in_hole.count(std::size_t(v)) == 1;
      CHECK(kept[v] == Approx(lost ? -7. : 1.));
      CHECK(set[v] == Approx(lost ? -1. : 1.));
      kept[v] = set[v] = -7;
    }
  };
  // The default is an integer, the values are real.
  check_vertices(BS::transfer_vertex_attribute(map, d, kept),
                 BS::transfer_vertex_attribute(map, d, set, P::default_value(-1)));
  const auto twice = [](double value, const BS::Flow_differential&) { return value; };
  check_vertices(BS::transfer_vertex_attribute(map, d, kept, P::mapping(twice)),
                 BS::transfer_vertex_attribute(map, d, set, P::default_value(-1.).mapping(twice)));

  const BS::Transfer_report labels[] = {
    BS::transfer_face_labels(map, l, l_kept, P::samples_per_facet(std::size_t(1))),
    BS::transfer_face_labels(map, l, l_set, P::samples_per_facet(std::size_t(1)).default_value(std::string("none")))
  };
  const BS::Transfer_report vectors[] = { BS::transfer_tangent_vectors(map, w, w_kept),
                                          BS::transfer_tangent_vectors(map, w, w_set,
                                                                       P::default_value(Vector_3(0, 0, 0))) };
  for(const BS::Transfer_report& report : { labels[0], labels[1], vectors[0], vectors[1] }) {
    CHECK_FALSE(report);
    CHECK(report.failures == no_facets);
    CHECK(report.transferred + no_facets.size() == b.number_of_faces());
  }
  for(auto f : b.faces()) {
    const bool lost = facets_in_hole.count(std::size_t(f)) == 1;
    CHECK(l_kept[f] == (lost ? "before" : "there"));
    CHECK(l_set[f] == (lost ? "none" : "there"));
    CHECK((w_kept[f] == Vector_3(-7, -7, -7)) == lost);
    CHECK((w_set[f] == Vector_3(0, 0, 0)) == lost);
    CHECK_FALSE(w_set[f] == Vector_3(-7, -7, -7));
  }

  // Averages go the other way. Vertices of the source over a hole of the target are left out, and reported. Vertices of
  // the target get no value if nothing arrives at them, and nothing can be pulled back.
  auto back = map_of<Vertex, double>(b, "v:back", 1.), average = map_of<Vertex, double>(a, "v:average", -7.);
  const BS::Transfer_report report = BS::average_vertex_attribute(map.inverse(), back, average, P::default_value(-1));
  CHECK(report.left_out == no_vertices);
  CHECK_FALSE(report);
  for(const auto& failure : report.failures) CHECK(average[Vertex(Mesh::size_type(failure.first))] == -1);
  std::size_t lost = 0;
  for(auto v : a.vertices()) {
    CHECK((average[v] == -1 || average[v] == Approx(1)));
    lost += average[v] == -1;
  }
  CHECK(lost == report.failures.size());
}

TEST_CASE("Transfer: from and to an invalid mesh, all elements get the caller's default value")
{
  Mesh a = sphere(2, 0.7), b = sphere(1, 0.85);
  CGAL::Euler::join_face(b.halfedge(Face(0)), b);
  for(const Map& map : { Map(ball(), a, b), Map(ball(), b, a).inverse() }) {
    auto d = map_of<Vertex, double>(a, "v:d", 1.), d2 = map_of<Vertex, double>(b, "v:d", -7.);
    auto l = map_of<Face, int>(a, "f:l", 1), l2 = map_of<Face, int>(b, "f:l", -7);
    auto w = map_of<Face, Vector_3>(a, "f:w", Vector_3(1, 0, 0)),
         w2 = map_of<Face, Vector_3>(b, "f:w", Vector_3(-7, -7, -7));
    CHECK(BS::average_vertex_attribute(map, d, d2, P::default_value(5.)).failures.size() == b.number_of_vertices());
    for(auto v : b.vertices()) CHECK(d2[v] == 5);
    CHECK(BS::transfer_face_labels(map, l, l2, P::default_value(6)).failures.size() == b.number_of_faces());
    CHECK(BS::transfer_tangent_vectors(map, w, w2, P::default_value(Vector_3(7, 0, 0))).failures.size()
          == b.number_of_faces());
    for(auto f : b.faces()) {
      CHECK(l2[f] == 6);
      CHECK(w2[f] == Vector_3(7, 0, 0));
    }
  }
}

TEST_CASE("Transfer: a facet of zero area gets no tangent vector, and is reported")
{
  Mesh a = source_sheet(), b = tilted_sheet();
  const std::size_t before = b.number_of_faces();
  const Vertex p = b.add_vertex(Point_3(0, 0, 0.2)), q = b.add_vertex(Point_3(0.25, 0, 0.2)),
               r = b.add_vertex(Point_3(0.125, 0, 0.2));
  b.add_face(p, q, r);
  auto w = map_of<Face, Vector_3>(a, "f:w", Vector_3(1, 0, 0)),
       w2 = map_of<Face, Vector_3>(b, "f:w", Vector_3(-7, -7, -7));
  const BS::Transfer_report report = BS::transfer_tangent_vectors(Map(slab(), a, b), w, w2);
  REQUIRE(report.failures.size() == 1);
  CHECK(report.failures[0] == std::make_pair(before, Flow_status::WRONG_ORIENTATION));
  CHECK(w2[Face(Mesh::size_type(before))] == Vector_3(-7, -7, -7));
}

TEST_CASE("Transfer: results do not depend on the number of threads, bit for bit")
{
  Mesh a = sphere(3, 0.7), b = turned(sphere(3, 0.85), 0.2);
  const Map map(ball(), a, b);
  auto d = map_of<Vertex, double>(a, "v:d"), one = map_of<Vertex, double>(b, "v:1"),
       two = map_of<Vertex, double>(b, "v:2");
  auto w = map_of<Face, Vector_3>(a, "f:w"), w1 = map_of<Face, Vector_3>(b, "f:1"),
       w2 = map_of<Face, Vector_3>(b, "f:2");
  for(auto v : a.vertices()) d[v] = std::sin(5 * a.point(v).x());
  for(auto f : a.faces()) w[f] = corners(a, f)[1] - corners(a, f)[0];
  const auto compare = [&]() {
    std::size_t different = 0;
    for(auto v : b.vertices()) different += one[v] != two[v];
    for(auto f : b.faces()) different += w1[f] != w2[f];
    return different;
  };
  BS::transfer_vertex_attribute<CGAL::Sequential_tag>(map, d, one);
  BS::transfer_vertex_attribute<CGAL::Parallel_tag>(map, d, two);
  BS::transfer_tangent_vectors<CGAL::Sequential_tag>(map, w, w1, P::symmetry(4));
  BS::transfer_tangent_vectors<CGAL::Parallel_tag>(map, w, w2, P::symmetry(4));
  CHECK(compare() == 0);
  BS::average_vertex_attribute<CGAL::Sequential_tag>(map, d, one);
  BS::average_vertex_attribute<CGAL::Parallel_tag>(map, d, two);
  CHECK(compare() == 0);
}
} // namespace test_transfer_attributes
