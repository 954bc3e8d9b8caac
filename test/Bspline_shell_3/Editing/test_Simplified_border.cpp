// Simplified_border.h: with a border tolerance, simplify_in_shell() merges border vertices into their neighbors along
// the border. The result is certified with its own closing, and mapped except for strips along the border.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/Mesh/count_removed_border_points.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>
#include "test_meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_Simplified_border {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_certificate_3<Shell::Field, Shell::Threshold> Certificate;
typedef BS::Shell_map_3<Shell, Mesh> Map;
typedef BS::Simplification_result<Mesh> Result;

struct Model
{
  Mesh mesh;
  Shell shell;
};

// Returns a flat square, cut into 12 x 12 squares.
const Model& flat()
{
  static const Mesh mesh = sheet(steps(0, 1, 12), steps(0, 1, 12));
  static const Model model = { mesh, CGAL::certified_bspline_shell_3(mesh) };
  return model;
}

// Returns hills over the unit square. All vertices, also those on the border, are moved at random.
const Model& terrain()
{
  static const Mesh mesh = [] {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> noise(-0.001, 0.001);
    return mapped(sheet(steps(0, 1, 40), steps(0, 1, 40)), [&](const Point_3& p) {
      const double z = 0.05 * std::sin(5 * p.x()) * std::cos(4 * p.y());
      const double dx = noise(generator), dy = noise(generator), dz = noise(generator);
      return Point_3(p.x() + dx, p.y() + dy, z + dz);
    });
  }();
  static const Model model = { mesh, CGAL::certified_bspline_shell_3(mesh) };
  return model;
}

// Returns a flat ring between the circles of radii 0.4 and 1, in 48 sectors.
const Model& ring()
{
  static const Mesh mesh = [] {
    Mesh m;
    constexpr int sectors = 48, circles = 7;
    std::vector<Mesh::Vertex_index> v;
    for(int i = 0; i < circles; ++i)
      for(int j = 0; j < sectors; ++j) {
        const double r = 0.4 + 0.1 * i, a = 2 * CGAL_PI * j / sectors;
        v.push_back(m.add_vertex(Point_3(r * std::cos(a), r * std::sin(a), 0)));
      }
    for(int i = 0; i + 1 < circles; ++i)
      for(int j = 0; j < sectors; ++j) {
        const auto at = [&](int k, int l) { return v[k * sectors + l % sectors]; };
        m.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        m.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    return m;
  }();
  static const Model model = { mesh, CGAL::certified_bspline_shell_3(mesh) };
  return model;
}

// Returns the upper half of the unit sphere, in 64 slices. A cap closes it.
constexpr int slices = 64;
const Model& hemisphere()
{
  static const Mesh mesh = [] {
    Mesh m = sliced_sphere(slices, 16); // has a ring of vertices on the equator
    remove_facets(m, [](const Point_3& p) { return p.z() < 0; });
    return m;
  }();
  static const Model model = { mesh, CGAL::certified_bspline_shell_3(mesh) };
  return model;
}

typedef std::vector<Kernel::Segment_3> Border;
Border border(const Mesh& mesh)
{
  Border result;
  for(auto h : mesh.halfedges())
    if(mesh.is_border(h)) result.emplace_back(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  return result;
}
std::set<Point_3> border_points(const Mesh& mesh)
{
  std::set<Point_3> points;
  for(const Kernel::Segment_3& s : border(mesh)) points.insert(s.source());
  return points;
}
std::set<std::array<Point_3, 2> > border_edges(const Mesh& mesh)
{
  std::set<std::array<Point_3, 2> > edges;
  for(const Kernel::Segment_3& s : border(mesh)) edges.insert({ s.source(), s.target() });
  return edges;
}

// Returns the largest distance of samples of a border from another border.
double farthest(const Border& from, const Border& to)
{
  double largest = 0;
  for(const Kernel::Segment_3& s : from)
    for(double t = 0; t < 1; t += 0.0625) {
      const Point_3 p = s.source() + t * s.to_vector();
      double least = std::numeric_limits<double>::infinity();
      for(const Kernel::Segment_3& other : to) least = (std::min)(least, CGAL::squared_distance(p, other));
      largest = (std::max)(largest, std::sqrt(least));
    }
  return largest;
}

// Simplifies a mesh, and checks the result and its border.
Result simplify(Mesh& mesh, const Shell& shell, double tolerance)
{
  const Mesh before = mesh;
  const Result result = BS::simplify_in_shell(mesh, shell, parameters::border_tolerance(tolerance));
  REQUIRE(result.status == BS::Edit_status::SUCCESS);
  mesh.collect_garbage();
  CHECK(mesh.is_valid());
  CHECK(result.facets == mesh.number_of_faces());
  const std::set<Point_3> points = border_points(before), kept = border_points(mesh);
  CHECK(std::includes(points.begin(), points.end(), kept.begin(), kept.end()));
  CHECK(result.removed_border_edges == points.size() - kept.size());
  CHECK(farthest(border(before), border(mesh)) <= tolerance * (1 + 1e-12));
  CHECK(farthest(border(mesh), border(before)) <= tolerance * (1 + 1e-12));
  REQUIRE(result.closing);
  CHECK(result.closing->number_of_border_points() == kept.size());
  Certificate certificate(shell);
  CHECK(certificate.verify(mesh, parameters::closing(result.closing)));
  return result;
}

} // namespace

TEST_CASE("Simplified borders: straight sides of a flat square become single edges")
{
  Mesh mesh = flat().mesh;
  const Result result = simplify(mesh, flat().shell, 1e-4);
  CHECK(result.removed_border_edges == 44);
  CHECK(border_points(mesh)
        == std::set<Point_3>{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(1, 1, 0) });
  CHECK(mesh.number_of_faces() == 2);
}

TEST_CASE("Simplified borders: without a tolerance, the border is kept, and the result is the same as before")
{
  Mesh mesh = terrain().mesh, zero = terrain().mesh;
  const Result result = BS::simplify_in_shell(mesh, terrain().shell);
  REQUIRE(result);
  CHECK(result.removed_border_edges == 0);
  CHECK(result.closing == terrain().shell.closing());
  REQUIRE(BS::simplify_in_shell(zero, terrain().shell, parameters::border_tolerance(0.)));
  mesh.collect_garbage();
  zero.collect_garbage();
  CHECK(is_equal(mesh, zero));
  CHECK(border_edges(mesh) == border_edges(terrain().mesh));
}

TEST_CASE("Simplified borders: the border of a terrain stays within the tolerance, and a larger one removes more edges")
{
  const std::size_t all = border(terrain().mesh).size();
  REQUIRE(all == 160);
  std::size_t removed = 0;
  for(double tolerance : { 0.0005, 0.002, 0.005 }) {
    Mesh mesh = terrain().mesh;
    const Result result = simplify(mesh, terrain().shell, tolerance);
    CHECK(result.removed_border_edges > removed);
    removed = result.removed_border_edges;
  }
  CHECK(removed > all / 2);
}

TEST_CASE("Simplified borders: a certificate needs the closing of the result")
{
  Mesh mesh = terrain().mesh;
  const Result result = simplify(mesh, terrain().shell, 0.002);
  REQUIRE(result.removed_border_edges > 0);
  CHECK(result.closing->number_of_border_points() + result.removed_border_edges
        == terrain().shell.closing()->number_of_border_points());
  CHECK(BS::count_removed_border_points(*terrain().shell.closing(), *result.closing, 0.002)
        == result.removed_border_edges);
  Certificate certificate(terrain().shell), original(terrain().shell);
  CHECK_FALSE(certificate.verify(mesh));
  CHECK(certificate.status() == BS::Shell_status::OPEN_MESH);
  // A null pointer stands for the shell's closing.
  CHECK_FALSE(certificate.verify(mesh, parameters::closing(std::shared_ptr<const BS::Shell_closing_3>())));
  CHECK(original.verify(terrain().mesh, parameters::closing(std::shared_ptr<const BS::Shell_closing_3>())));
  CHECK_FALSE(certificate.verify(terrain().mesh, parameters::closing(*result.closing)));
  CHECK(certificate.verify(mesh, parameters::closing(*result.closing)));
  CHECK(certificate.matches(original) == BS::Verdict::PROVED);
  Mesh closed = mesh;
  REQUIRE(result.closing->attach(closed, closed.points()));
  CHECK(certificate.verify(closed));
}

TEST_CASE("Simplified borders: chords of a circle are within the tolerance of its arcs")
{
  // The original border is a regular polygon. A chord over k of its edges is 1 - cos(pi k / n) from the farthest corner
  // if k is even.
  constexpr double tolerance = 0.006;
  int most = 1;
  while(1 - std::cos(CGAL_PI * (most + 1) / slices) <= tolerance) ++most;
  Mesh mesh = hemisphere().mesh;
  REQUIRE(border(mesh).size() == std::size_t(slices));
  REQUIRE(hemisphere().shell.report().closing.caps() == 1);
  const Result result = simplify(mesh, hemisphere().shell, tolerance);
  CHECK(result.removed_border_edges >= std::size_t(slices) / 4);
  CHECK(border(mesh).size() * std::size_t(most) >= std::size_t(slices));
}

TEST_CASE("Simplified borders: each closed curve of a border is kept")
{
  for(double tolerance : { 0.005, 10. }) {
    Mesh mesh = ring().mesh;
    REQUIRE(border(mesh).size() == 96);
    BS::simplify_in_shell(mesh, ring().shell, parameters::border_tolerance(tolerance));
    mesh.collect_garbage();
    std::size_t inner = 0, outer = 0;
    for(const Point_3& p : border_points(mesh)) (p.x() * p.x() + p.y() * p.y() < 0.5 ? inner : outer) += 1;
    CHECK(inner >= 3);
    CHECK(outer >= 3);
    CHECK(inner + outer < 96);
  }
}

TEST_CASE("Simplified borders: a triangular hole in a flat square is kept, although the shell would allow closing it")
{
  const Point_3 middle(0.5, 0.5, 0);
  Mesh mesh = flat().mesh;
  bool is_removed = false;
  remove_facets(mesh, [&](const Point_3& p) {
    const bool is_first = !is_removed && distance(p, middle) < 0.08;
    is_removed = is_removed || is_first;
    return is_first;
  });
  REQUIRE(border(mesh).size() == 48 + 3);
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  simplify(mesh, shell, 0.1);
  std::size_t inside = 0;
  for(const Point_3& p : border_points(mesh)) inside += distance(p, middle) < 0.25 ? 1 : 0;
  CHECK(inside == 3);
}

TEST_CASE("Simplified borders: a hole with three edges and a single triangle keep their borders")
{
  Mesh open = sphere(2);
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  open.collect_garbage();
  REQUIRE(border(open).size() == 3);
  const Shell shell = CGAL::certified_bspline_shell_3(open);
  REQUIRE(shell.is_certified());
  const auto edges = border_edges(open);
  const Result result = simplify(open, shell, 1);
  CHECK(result.removed_border_edges == 0);
  CHECK(result.closing == shell.closing());
  CHECK(border_edges(open) == edges);

  Mesh triangle;
  triangle.add_face(triangle.add_vertex(Point_3(0, 0, 0)), triangle.add_vertex(Point_3(1, 0, 0)),
                    triangle.add_vertex(Point_3(0, 1, 0)));
  const Shell around = CGAL::certified_bspline_shell_3(triangle);
  REQUIRE(around.is_certified());
  CHECK(simplify(triangle, around, 1).removed_border_edges == 0);
  CHECK(triangle.number_of_faces() == 1);
}

TEST_CASE("Simplified borders: every point is mapped to the result and back, or marked near the border")
{
  constexpr double tolerance = 0.004;
  Mesh coarse = terrain().mesh;
  const Result result = simplify(coarse, terrain().shell, tolerance);
  const Map map(terrain().shell, terrain().mesh, coarse, parameters::closing(terrain().shell.closing()),
                parameters::closing(result.closing));
  REQUIRE(map.status() == BS::Flow_status::SUCCESS);
  const auto back = map.inverse();
  const double precision = 1e-9 * terrain().shell.report().unit;
  // A point in a strip is beyond one of the borders. The sum bounds the way to the border along curves and across.
  const double near = 2 * (tolerance + result.certificate.displacement_bound);
  const auto check = [&](const auto& there, const auto& again, const Mesh& from, const Border& target) {
    std::size_t lost = 0, failed = 0, continued = 0, far = 0, all = 0;
    for(auto f : from.faces())
      for(const std::array<double, 3>& b :
          { std::array<double, 3>{ 0.2, 0.3, 0.5 }, std::array<double, 3>{ 0.5, 0.5, 0 },
            std::array<double, 3>{ 0, 0.25, 0.75 }, std::array<double, 3>{ 0.01, 0.98, 0.01 } }) {
        ++all;
        const auto image = there({ f, b });
        const auto x = there.point({ f, b });
        const Point_3 p(x[0], x[1], x[2]);
        if(!image) {
          ++lost;
        } else if(image.is_continued) {
          ++continued;
          double least = std::numeric_limits<double>::infinity();
          for(const Kernel::Segment_3& s : target)
            least = (std::min)(least, std::sqrt(CGAL::squared_distance(image.point, s)));
          if(!(least <= precision) || !(distance(image.point, p) <= near)) ++far;
        } else {
          const auto last = again(image.location);
          if(!last || last.is_continued || !(distance(last.point, p) <= precision)) ++failed;
        }
      }
    CHECK(lost == 0);
    CHECK(failed == 0);
    CHECK(far == 0);
    CHECK(continued < all / 20);
    return continued;
  };
  CHECK(check(map, back, terrain().mesh, border(coarse)) > 0);
  check(back, map, coarse, border(terrain().mesh));

  // Without closings, points in strips have no image; all others have the same image.
  const Map plain(terrain().shell, terrain().mesh, coarse);
  CHECK(plain.maps_points());
  std::size_t different = 0;
  const std::set<Point_3> kept = border_points(coarse);
  for(auto v : terrain().mesh.vertices()) {
    const auto image = map(v), other = plain(v);
    if(image.is_continued ? other.status != BS::Flow_status::LEAVES_SHELL : image.point != other.point) ++different;
    if(kept.count(terrain().mesh.point(v)) > 0 && image.point != terrain().mesh.point(v)) ++different;
  }
  CHECK(different == 0);
}

TEST_CASE("Simplified borders: components are compared with the closings of both meshes")
{
  const Mesh sheets = joined(sheet(steps(0, 1, 6), steps(0, 1, 6), 0.2), sheet(steps(0, 1, 6), steps(0, 1, 6)));
  const Mesh mesh = joined(sheets, sphere(2, 0.2, Point_3(1.5, 0.5, 0)));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  Mesh coarse = mesh;
  const Result result = simplify(coarse, shell, 0.001);
  REQUIRE(result.removed_border_edges == 40);
  const auto of_source = parameters::closing(shell.closing()), of_target = parameters::closing(result.closing);
  CHECK(Map(shell, mesh, coarse, of_source, of_target).status() == BS::Flow_status::SUCCESS);
  // The sphere of the result is left out.
  Mesh lacking = coarse;
  remove_facets(lacking, [](const Point_3& p) { return p.x() > 1.1; });
  CHECK(Map(shell, mesh, lacking, of_source, of_target).status() == BS::Flow_status::COMPONENTS_DIFFER);
  Certificate certificate(shell);
  CHECK_FALSE(certificate.verify(lacking, of_target));
}

TEST_CASE("Simplified borders: attributes and locations in strips are those at the border, and are marked")
{
  Mesh source = terrain().mesh, coarse = terrain().mesh;
  const auto result = BS::simplify_in_shell(coarse, terrain().shell,
                                            parameters::border_tolerance(0.004).locate_vertices(true));
  REQUIRE(result);
  REQUIRE(result.removed_border_edges > 0);
  for(const auto& location : result.locations) CHECK(location.first != Mesh::null_face());
  coarse.collect_garbage();
  auto height = coarse.add_property_map<Mesh::Vertex_index, double>("v:height").first;
  auto got = source.add_property_map<Mesh::Vertex_index, double>("v:height", -1).first;
  for(auto v : coarse.vertices()) height[v] = coarse.point(v).z();
  const Map map(terrain().shell, coarse, source, parameters::closing(result.closing),
                parameters::closing(terrain().shell.closing()));
  const auto report = BS::transfer_vertex_attribute(map, height, got);
  CHECK(report);
  CHECK_FALSE(report.continued.empty());
  for(auto v : source.vertices()) CHECK(got[v] == Approx(source.point(v).z()).margin(0.02));
}

TEST_CASE("Simplified borders: vertices of constrained edges stay")
{
  for(bool protects : { true, false }) {
    Mesh mesh = flat().mesh;
    auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
    for(auto e : mesh.edges()) {
      const Point_3 p = mesh.point(mesh.source(mesh.halfedge(e))), q = mesh.point(mesh.target(mesh.halfedge(e)));
      is_constrained[e] = p.x() == 0.5 && q.x() == 0.5;
    }
    const auto result = BS::simplify_in_shell(
      mesh, flat().shell,
      parameters::border_tolerance(0.001).edge_is_constrained_map(is_constrained).protect_constraints(protects));
    REQUIRE(result);
    mesh.collect_garbage();
    CHECK(result.removed_border_edges == 42);
    CHECK(border_points(mesh).count(Point_3(0.5, 0, 0)) == 1);
    CHECK(border_points(mesh).count(Point_3(0.5, 1, 0)) == 1);
    CHECK(result.constrained_edges == (protects ? 12 : 2));
    std::size_t constrained = 0;
    for(auto e : mesh.edges()) constrained += is_constrained[e] ? 1 : 0;
    CHECK(constrained == result.constrained_edges);
  }
}

TEST_CASE("Simplified borders: constrained border edges stay")
{
  Mesh mesh = flat().mesh;
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
  for(auto e : mesh.edges()) {
    const Point_3 p = mesh.point(mesh.source(mesh.halfedge(e))), q = mesh.point(mesh.target(mesh.halfedge(e)));
    is_constrained[e] = p.y() == 0 && q.y() == 0;
  }
  const auto result = BS::simplify_in_shell(
    mesh, flat().shell, parameters::border_tolerance(0.001).edge_is_constrained_map(is_constrained));
  REQUIRE(result);
  mesh.collect_garbage();
  CHECK(result.constrained_edges == 12);
  CHECK(result.removed_border_edges == 33);
  for(int i = 0; i <= 12; ++i) CHECK(border_points(mesh).count(Point_3(steps(0, 1, 12)[i], 0, 0)) == 1);
}

TEST_CASE("Simplified borders: an invalid tolerance is rejected")
{
  for(double tolerance : { -1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() }) {
    Mesh mesh = flat().mesh;
    const auto result = BS::simplify_in_shell(mesh, flat().shell, parameters::border_tolerance(tolerance));
    CHECK(result.status == BS::Edit_status::INVALID_PARAMETER);
    REQUIRE(result.invalid_parameter);
    CHECK(std::string(result.invalid_parameter.name) == "border_tolerance");
    CHECK(is_equal(mesh, flat().mesh));
  }
}

TEST_CASE("Simplified borders: the result can be edited again with its closing")
{
  Mesh mesh = terrain().mesh;
  const Result first = simplify(mesh, terrain().shell, 0.001);
  Mesh again = mesh;
  CHECK(BS::simplify_in_shell(again, terrain().shell).status == BS::Edit_status::OPEN_MESH);
  CHECK(BS::remesh_in_shell(again, 0.1, terrain().shell).status == BS::Edit_status::OPEN_MESH);
  const Result second = BS::simplify_in_shell(again, terrain().shell,
                                              parameters::border_tolerance(0.004).closing(first.closing));
  REQUIRE(second);
  CHECK(second.removed_border_edges > 0);
  again.collect_garbage();
  CHECK(border(again).size() == border(mesh).size() - second.removed_border_edges);
  CHECK(farthest(border(mesh), border(again)) <= 0.004 * (1 + 1e-12));
  Certificate certificate(terrain().shell);
  CHECK(certificate.verify(again, parameters::closing(second.closing)));

  Mesh remeshed = mesh;
  const auto result = BS::remesh_in_shell(remeshed, 0.1, terrain().shell, parameters::closing(first.closing));
  REQUIRE(result);
  CHECK(result.closing == first.closing);
  remeshed.collect_garbage();
  CHECK(border_edges(remeshed) == border_edges(mesh));
}

TEST_CASE("Simplified borders: the requested number of facets does not include the closing")
{
  const std::size_t requested = terrain().mesh.number_of_faces() / 3;
  Mesh mesh = terrain().mesh;
  const auto result = BS::simplify_in_shell(
    mesh, terrain().shell, parameters::border_tolerance(0.004).stop(BS::Facet_count_stop_predicate(requested)));
  REQUIRE(result);
  CHECK(result.facets <= requested);
  CHECK(result.facets + 2 >= requested);
}

TEST_CASE("Simplified borders: frozen facets at the border stay")
{
  // A border vertex is moved out of the shell, in its plane.
  const Point_3 out(-0.5, 0.5, 0);
  Mesh mesh = flat().mesh;
  BS::Shell_closing_3 moved = *flat().shell.closing();
  std::vector<BS::Shell_closing_3::Point> points = moved.points();
  for(auto& p : points)
    if(p == BS::Shell_closing_3::Point{ 0, 0.5, 0 }) p = { out.x(), out.y(), out.z() };
  moved = BS::Shell_closing_3(points, moved.number_of_border_points(), moved.triangles(), moved.kinds());
  for(auto v : mesh.vertices())
    if(mesh.point(v) == Point_3(0, 0.5, 0)) mesh.point(v) = out;
  const Mesh before = mesh;
  const auto result = BS::simplify_in_shell(
    mesh, flat().shell, parameters::border_tolerance(0.001).closing(moved).freeze_rejected_facets(true));
  REQUIRE(result.status == BS::Edit_status::PARTIALLY_EDITED);
  CHECK(result.removed_border_edges > 0);
  mesh.collect_garbage();
  CHECK(border_points(mesh).count(out) == 1);
  CHECK(farthest(border(before), border(mesh)) <= 0.001 * (1 + 1e-12));
  REQUIRE(result.closing);
  CHECK(result.closing->match_border(mesh, mesh.points()));
}

namespace {
struct Throwing_predicate
{
  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t edges) const
  {
    if(edges < 200) throw std::runtime_error("enough");
    return false;
  }
};
} // namespace

TEST_CASE("Simplified borders: after an exception, the mesh has its border back")
{
  Mesh mesh = flat().mesh;
  CHECK_THROWS_AS(
    BS::simplify_in_shell(mesh, flat().shell, parameters::border_tolerance(0.001).stop(Throwing_predicate())),
    std::runtime_error);
  mesh.collect_garbage();
  CHECK(mesh.is_valid());
  CHECK(border_edges(mesh) == border_edges(flat().mesh));
}

TEST_CASE("Simplified borders: a Polyhedron_3 can be simplified, and a closed mesh has no border")
{
  CGAL::Polyhedron_3<Kernel> mesh;
  CGAL::copy_face_graph(flat().mesh, mesh);
  const auto result = BS::simplify_in_shell(mesh, flat().shell, parameters::border_tolerance(0.001));
  REQUIRE(result);
  CHECK(mesh.is_valid());
  CHECK(mesh.size_of_facets() == result.facets);
  CHECK(result.removed_border_edges == 44);

  Mesh closed = sphere(2), same = sphere(2);
  const Shell shell = CGAL::certified_bspline_shell_3(closed);
  const auto with = BS::simplify_in_shell(closed, shell, parameters::border_tolerance(0.1));
  REQUIRE(with);
  CHECK(with.removed_border_edges == 0);
  CHECK_FALSE(with.closing);
  REQUIRE(BS::simplify_in_shell(same, shell));
  CHECK(is_equal(closed, same));
}
} // namespace test_Simplified_border
