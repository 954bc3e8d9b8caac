// Shells of open meshes are certified together with their closing. Certificates, edits, maps and files accept open
// meshes, and do not change their borders.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/IO/read_shell.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>
#include "test_meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_open_shells {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_certificate_3<Shell::Field, Shell::Threshold> Certificate;
typedef BS::Shell_map_3<Shell, Mesh> Map;

// Returns hills and hollows over the unit square. Any cap would intersect them, so the mesh gets a back sheet.
const Mesh& hill()
{
  static const Mesh mesh = sheet(steps(0, 1, 16), steps(0, 1, 16), [](double x, double y) {
    return 0.1 * std::sin(2 * CGAL_PI * x) * std::sin(2 * CGAL_PI * y);
  });
  return mesh;
}
const Shell& hill_shell()
{
  static const Shell shell = CGAL::certified_bspline_shell_3(hill());
  return shell;
}

// Returns a sphere with two holes, which get caps.
const Mesh& sphere_with_holes()
{
  static const Mesh mesh = [] {
    Mesh m = sphere(3);
    remove_facets(m, [](const Point_3& p) { return std::abs(p.z()) > 0.8; });
    return m;
  }();
  return mesh;
}
const Shell& shell_with_caps()
{
  static const Shell shell = CGAL::certified_bspline_shell_3(sphere_with_holes());
  return shell;
}

typedef std::set<std::pair<Point_3, Point_3> > Border;
Border border(const Mesh& mesh)
{
  Border result;
  for(auto h : mesh.halfedges())
    if(mesh.is_border(h)) result.emplace(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
  return result;
}

struct Throwing_predicate
{
  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t edges) const
  {
    if(edges < 700) throw std::runtime_error("enough");
    return false;
  }
};

// Checks that every vertex and facet is mapped there and back, and every border vertex to itself.
void check_round_trips(const Shell& shell, const Mesh& from, const Mesh& to)
{
  const Map map(shell, from, to);
  REQUIRE(map.status() == BS::Flow_status::SUCCESS);
  const auto back = map.inverse();
  const double tolerance = 1e-9 * shell.report().unit;
  std::size_t lost = 0, far = 0, moved = 0;
  const auto check = [&](const Map::Source_location& location, const Point_3& p) {
    const auto image = map(location);
    if(!image) {
      ++lost;
      return Point_3();
    }
    const auto again = back(image.location);
    if(!again) ++lost;
    else if(CGAL::squared_distance(again.point, p) > tolerance * tolerance) ++far;
    return image.point;
  };
  for(auto v : from.vertices()) {
    const Point_3 image = check(CGAL::Polygon_mesh_processing::locate_vertex<double>(v, from), from.point(v));
    if(from.is_border(v) && image != from.point(v)) ++moved;
  }
  for(auto f : from.faces())
    for(const std::array<double, 3>& b :
        { std::array<double, 3>{ 0.2, 0.3, 0.5 }, std::array<double, 3>{ 0.5, 0.5, 0 },
          std::array<double, 3>{ 0, 0.25, 0.75 }, std::array<double, 3>{ 0.75, 0, 0.25 } }) {
      const auto p = map.point({ f, b });
      check({ f, b }, Point_3(p[0], p[1], p[2]));
    }
  CHECK(lost == 0);
  CHECK(far == 0);
  CHECK(moved == 0);
}

} // namespace

TEST_CASE("Open meshes: the shell is certified together with the closing")
{
  REQUIRE(hill_shell().is_certified());
  CHECK(hill_shell().report().closing.sheets == 1);
  CHECK(hill_shell().report().closing.caps() == 0);
  REQUIRE(hill_shell().closing());
  CHECK(hill_shell().facet_ranges().size() == hill().number_of_faces() + hill_shell().closing()->triangles().size());
  CHECK(hill_shell().report().triangles == hill_shell().facet_ranges().size());

  REQUIRE(shell_with_caps().is_certified());
  CHECK(shell_with_caps().report().closing.caps() == 2);
  CHECK(shell_with_caps().report().closing.sheets == 0);

  CHECK_FALSE(CGAL::certified_bspline_shell_3(sphere(2)).closing());
  const Shell rejected = CGAL::certified_bspline_shell_3(hill(), parameters::virtual_closing(false));
  CHECK(rejected.status() == BS::Shell_status::OPEN_MESH);
  CHECK_FALSE(rejected.report().offending_simplices.facets.empty());
}

TEST_CASE("Open meshes: an open mesh of polygons is closed and certified")
{
  const Mesh whole = box(Point_3(0, 0, 0), Point_3(1, 1, 1), false);
  Mesh mesh = whole; // without the top
  for(auto f : whole.faces()) {
    bool is_top = true;
    for(auto v : whole.vertices_around_face(whole.halfedge(f))) is_top = is_top && whole.point(v).z() == 1;
    if(is_top) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  }
  mesh.collect_garbage();
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  CHECK(shell.report().closing.caps() == 1);
  CHECK(shell.facet_ranges().size() == 5 + 2);
  Certificate certificate(shell);
  CHECK(certificate.verify(mesh));
}

TEST_CASE("Open meshes: a certificate requires the exact border of the mesh, bit for bit")
{
  Certificate certificate(hill_shell());
  CHECK(certificate.verify(hill()));
  CHECK(certificate.facets().size() == hill_shell().facet_ranges().size());
  CHECK(CGAL::is_closed(certificate.examined_mesh()));
  for(auto v : hill().vertices()) {
    if(!hill().is_border(v)) continue;
    Mesh moved = hill();
    const Point_3 p = moved.point(v);
    moved.point(v) = Point_3(p.x(), p.y(), std::nextafter(p.z(), 1.));
    CHECK_FALSE(certificate.verify(moved));
    CHECK(certificate.status() == BS::Shell_status::OPEN_MESH);
    break;
  }
  Mesh smaller = hill(); // lacks a facet at the border
  for(auto h : smaller.halfedges())
    if(smaller.is_border(h)) {
      CGAL::Euler::remove_face(smaller.opposite(h), smaller);
      break;
    }
  CHECK_FALSE(certificate.verify(smaller));
  CHECK(certificate.status() == BS::Shell_status::OPEN_MESH);
  CHECK_FALSE(certificate.verify(reversed(hill())));
  Mesh closed = hill(); // closed in advance by the same triangles
  REQUIRE(hill_shell().closing()->attach(closed, closed.points()));
  CHECK(certificate.verify(closed));
}

TEST_CASE("Open meshes: simplification keeps the border, and every point maps to the result and back")
{
  for(const auto& [mesh, shell] :
      { std::make_pair(hill(), &hill_shell()), std::make_pair(sphere_with_holes(), &shell_with_caps()) }) {
    Mesh coarse = mesh;
    const auto result = BS::simplify_in_shell(coarse, *shell, parameters::locate_vertices(true));
    REQUIRE(result.status == BS::Edit_status::SUCCESS);
    CHECK(result.facets_before == mesh.number_of_faces());
    CHECK(result.facets < 0.7 * double(mesh.number_of_faces()));
    CHECK(result.facets == coarse.number_of_faces());
    CHECK(result.images.size() == mesh.number_of_vertices());
    CHECK(result.locations.size() == mesh.number_of_vertices());
    for(const auto& location : result.locations) CHECK(location.first != Mesh::null_face());
    for(auto v : result.images) CHECK_FALSE(coarse.is_removed(v));
    coarse.collect_garbage();
    CHECK(coarse.is_valid());
    CHECK(border(coarse) == border(mesh));
    check_round_trips(*shell, mesh, coarse);
    check_round_trips(*shell, coarse, mesh);
  }
}

TEST_CASE("Open meshes: the requested number of facets does not include the closing")
{
  const std::size_t requested = hill().number_of_faces() / 2;
  Mesh coarse = hill();
  const auto result = BS::simplify_in_shell(coarse, hill_shell(),
                                            parameters::stop(BS::Facet_count_stop_predicate(requested)));
  REQUIRE(result);
  CHECK(result.facets <= requested);
  CHECK(result.facets + 2 >= requested);
}

TEST_CASE("Open meshes: simplification keeps constrained edges, and freezes facets outside the shell")
{
  Mesh coarse = hill();
  auto is_constrained = coarse.add_property_map<Mesh::Edge_index, bool>("e:is_constrained", false).first;
  std::size_t constrained = 0;
  for(auto e : coarse.edges()) {
    const double x = coarse.point(coarse.source(coarse.halfedge(e))).x(),
                 y = coarse.point(coarse.target(coarse.halfedge(e))).x();
    if(x == 0.5 && y == 0.5) {
      is_constrained[e] = true;
      ++constrained;
    }
  }
  REQUIRE(constrained == 16);
  auto result = BS::simplify_in_shell(coarse, hill_shell(), parameters::edge_is_constrained_map(is_constrained));
  REQUIRE(result);
  CHECK(result.constrained_edges == constrained);
  coarse.collect_garbage();
  CHECK(border(coarse) == border(hill()));

  // A vertex is moved far out of the shell. Its facets stay, and so does the border.
  Mesh damaged = hill();
  const Point_3 out(0.5, 0.5, 2);
  for(auto v : damaged.vertices())
    if(damaged.point(v).x() == 0.5 && damaged.point(v).y() == 0.5) damaged.point(v) = out;
  const Mesh before = damaged;
  CHECK(BS::simplify_in_shell(damaged, hill_shell()).status == BS::Edit_status::NOT_IN_SHELL);
  CHECK(is_equal(damaged, before));
  result = BS::simplify_in_shell(damaged, hill_shell(), parameters::freeze_rejected_facets(true));
  CHECK(result.status == BS::Edit_status::PARTIALLY_EDITED);
  CHECK(result.facets < before.number_of_faces());
  CHECK(result.frozen_facets.size() == result.frozen_facets_before.size());
  damaged.collect_garbage();
  CHECK(damaged.is_valid());
  CHECK(border(damaged) == border(before));
}

TEST_CASE("Open meshes: after an exception, the mesh has its facets and border back")
{
  Mesh mesh = hill();
  REQUIRE(mesh.number_of_edges() > 700);
  CHECK_THROWS_AS(BS::simplify_in_shell(mesh, hill_shell(), parameters::stop(Throwing_predicate())),
                  std::runtime_error);
  mesh.collect_garbage();
  CHECK(mesh.is_valid());
  CHECK(mesh.number_of_faces() == hill().number_of_faces());
  CHECK(border(mesh) == border(hill()));
}

TEST_CASE("Open meshes: stacked sheets and a closed component near them share a shell and are mapped")
{
  const std::vector<double> xs = steps(0, 1, 4);
  Mesh sheets = joined(sheet(xs, xs, 0.12), sheet(xs, xs));
  const Mesh mesh = joined(sheets, sphere(2, 0.2, Point_3(1.5, 0.5, 0)));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh);
  REQUIRE(shell.is_certified());
  CHECK(shell.report().components == 3);
  CHECK(shell.report().closing.sheets == 2);
  Mesh coarse = mesh;
  const auto result = BS::simplify_in_shell(coarse, shell);
  REQUIRE(result);
  coarse.collect_garbage();
  check_round_trips(shell, mesh, coarse);
  // Without the sphere, the border is the same, but a component of the shell is empty.
  Certificate certificate(shell);
  CHECK_FALSE(certificate.verify(sheets));
  CHECK(certificate.verdict(BS::Claim::ONE_SHEET) == BS::Verdict::REFUTED);
  CHECK(Map(shell, mesh, sheets).status() == BS::Flow_status::COMPONENTS_DIFFER);
  CHECK(BS::simplify_in_shell(sheets, shell).status == BS::Edit_status::NOT_CERTIFIED);
  CHECK(sheets.number_of_faces() == 64);
}

TEST_CASE("Open meshes: remeshing keeps the border, and every point maps to the result and back")
{
  Mesh mesh = sphere_with_holes();
  const auto result = BS::remesh_in_shell(mesh, 0.2, shell_with_caps());
  REQUIRE(result.status == BS::Edit_status::SUCCESS);
  CHECK(result.images.size() == sphere_with_holes().number_of_vertices());
  for(auto v : result.images) CHECK_FALSE(mesh.is_removed(v));
  mesh.collect_garbage();
  CHECK(mesh.is_valid());
  CHECK(border(mesh) == border(sphere_with_holes()));
  check_round_trips(shell_with_caps(), sphere_with_holes(), mesh);
}

TEST_CASE("Open meshes: a Polyhedron_3 can be edited, and a mesh with another border is rejected")
{
  CGAL::Polyhedron_3<Kernel> mesh;
  CGAL::copy_face_graph(hill(), mesh);
  const auto result = BS::simplify_in_shell(mesh, hill_shell());
  CHECK(result.status == BS::Edit_status::SUCCESS);
  CHECK(mesh.is_valid());
  CHECK(mesh.size_of_facets() == result.facets);
  CHECK(mesh.size_of_border_edges() == 0); // counts the normalized part only
  mesh.normalize_border();
  CHECK(mesh.size_of_border_edges() == border(hill()).size());

  Mesh other = sphere_with_holes();
  CHECK(BS::simplify_in_shell(other, hill_shell()).status == BS::Edit_status::OPEN_MESH);
  CHECK(BS::remesh_in_shell(other, 0.2, hill_shell()).status == BS::Edit_status::OPEN_MESH);
  CHECK(is_equal(other, sphere_with_holes()));
}

TEST_CASE("Open meshes: attributes are transferred, exactly at border vertices")
{
  Mesh source = hill(), target = hill();
  REQUIRE(BS::simplify_in_shell(target, hill_shell()));
  target.collect_garbage();
  auto value = source.add_property_map<Mesh::Vertex_index, double>("v:value").first;
  auto got = target.add_property_map<Mesh::Vertex_index, double>("v:value").first;
  for(auto v : source.vertices()) value[v] = 3 * source.point(v).x() - source.point(v).y();
  const Map map(hill_shell(), source, target);
  const auto report = BS::transfer_vertex_attribute(map, value, got);
  CHECK(report);
  for(auto v : target.vertices()) {
    const double expected = 3 * target.point(v).x() - target.point(v).y();
    if(target.is_border(v)) CHECK(got[v] == expected);
    else CHECK(got[v] == Approx(expected).margin(0.05));
  }
}

TEST_CASE("Open meshes: images beyond the border by less than the tolerance are snapped to it, and flagged")
{
  const Map map(hill_shell(), hill(), hill());
  std::size_t snapped = 0;
  for(auto h : hill().halfedges()) {
    if(!hill().is_border(h)) continue;
    const Point_3 p = CGAL::midpoint(hill().point(hill().source(h)), hill().point(hill().target(h)));
    if(p.x() != 0) continue;
    // `out` is in the plane of the facet, across its edge
    const Vector_3 edge = hill().point(hill().target(h)) - hill().point(hill().source(h));
    Vector_3 out = p - hill().point(hill().target(hill().next(hill().opposite(h))));
    out = out - (out * edge) / edge.squared_length() * edge;
    out = map.to_target().tolerance() / std::sqrt(out.squared_length()) * out;
    const auto inside = map.to_target()(p - 0.4 * out);
    REQUIRE(inside);
    CHECK_FALSE(inside.is_snapped);
    const auto beyond = map.to_target()(p + 0.4 * out);
    REQUIRE(beyond);
    CHECK(beyond.is_snapped);
    CHECK(std::abs(beyond.point.x()) < 1e-15);
    CHECK_FALSE(map.to_target()(p + 4 * out));
    ++snapped;
  }
  CHECK(snapped == 16);
}

TEST_CASE("Open meshes: shell files keep the closing")
{
  for(BS::Shell_format format : { BS::Shell_format::BINARY, BS::Shell_format::ASCII }) {
    std::stringstream file;
    REQUIRE(BS::write_shell(file, shell_with_caps(), format) == BS::Shell_file_status::SUCCESS);
    const std::string text = file.str();
    Shell back;
    REQUIRE(BS::read_shell(file, back) == BS::Shell_file_status::SUCCESS);
    REQUIRE(back.closing());
    CHECK(back.closing()->points() == shell_with_caps().closing()->points());
    CHECK(back.closing()->number_of_border_points() == shell_with_caps().closing()->number_of_border_points());
    CHECK(back.closing()->triangles() == shell_with_caps().closing()->triangles());
    CHECK(back.closing()->kinds() == shell_with_caps().closing()->kinds());
    Certificate certificate(back);
    CHECK(certificate.verify(sphere_with_holes()));
    Mesh coarse = sphere_with_holes();
    CHECK(BS::simplify_in_shell(coarse, back));
    std::stringstream again;
    REQUIRE(BS::write_shell(again, back, format) == BS::Shell_file_status::SUCCESS);
    CHECK(again.str() == text);
    for(std::size_t size : { text.size() / 2, text.size() - 200, text.size() - 1 }) {
      std::istringstream cut(text.substr(0, size));
      Shell none;
      CHECK(BS::read_shell(cut, none) == BS::Shell_file_status::DAMAGED);
    }
  }
}

TEST_CASE("Open meshes: a closing given by the user is used if it fits, and rejected otherwise")
{
  // The closing is a tent under the square.
  const Mesh mesh = sheet({ 0, 1 }, { 0, 1 });
  const BS::Shell_closing_3 tent({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, -0.5 } }, 4,
                                 { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } },
                                 std::vector<BS::Shell_closing_3::Kind>(4, BS::Shell_closing_3::Kind::CAP));
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::closing(tent));
  REQUIRE(shell.is_certified());
  CHECK(shell.closing()->points() == tent.points());
  CHECK(shell.report().triangles == 6);
  Certificate certificate(shell);
  CHECK(certificate.verify(mesh));
  const BS::Shell_closing_3 other({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, 1, 0 } }, 3, { { 0, 1, 2 } },
                                  { BS::Shell_closing_3::Kind::CAP });
  CHECK(CGAL::certified_bspline_shell_3(mesh, parameters::closing(other)).status() == BS::Shell_status::OPEN_MESH);
}

TEST_CASE("Open meshes: one thread and several threads build the same shell")
{
  const Shell one = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(sphere_with_holes()),
              several = CGAL::certified_bspline_shell_3<CGAL::Parallel_if_available_tag>(sphere_with_holes());
  CHECK(one.closing()->triangles() == several.closing()->triangles());
  CHECK(BS::shell_checksum(one) == BS::shell_checksum(several));
}
} // namespace test_open_shells
