// Shells of meshes with singular vertices are certified with truncated tips. Certificates, maps, transfers, edits and
// files accept the mesh itself.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Editing/remesh_in_shell.h>
#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/Bspline_shell_3/IO/read_shell.h>
#include <CGAL/Bspline_shell_3/IO/write_shell.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_corner_attribute.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_face_labels.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_tangent_vectors.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>
#include <CGAL/certified_bspline_shell_3.h>
#include "test_meshes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace test_truncated_shells {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef CGAL::Certified_bspline_shell_3 Shell;
typedef BS::Shell_certificate_3<Shell::Field, Shell::Threshold> Certificate;
typedef BS::Shell_map_3<Shell, Mesh> Map;

const Mesh& screw_mesh()
{
  static const Mesh mesh = subdivided(screw());
  return mesh;
}
const Shell& screw_shell()
{
  static const Shell shell = CGAL::certified_bspline_shell_3(screw_mesh(), parameters::relative_thickness(0.04));
  return shell;
}
Mesh::Vertex_index tip(const Mesh& mesh)
{
  return *std::find_if(mesh.vertices().begin(), mesh.vertices().end(),
                       [&](auto v) { return mesh.point(v) == Point_3(1, 1, 1); });
}

const Mesh& simplified()
{
  static const Mesh mesh = [] {
    Mesh m = screw_mesh();
    REQUIRE(BS::simplify_in_shell(m, screw_shell()).status == BS::Edit_status::SUCCESS);
    m.collect_garbage();
    return m;
  }();
  return mesh;
}

// Returns places in all facets, with many in the facets at the tip, increasingly close to it.
std::vector<Map::Source_location> places(const Mesh& mesh)
{
  std::vector<Map::Source_location> result;
  std::mt19937 random(1);
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()); };
  const auto v = tip(mesh);
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const std::array<Mesh::Vertex_index, 3> corner = { mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) };
    const auto at = std::find(corner.begin(), corner.end(), v) - corner.begin();
    for(int n = 0; n < (at == 3 ? 3 : 90); ++n) {
      double a = uniform(), b = uniform();
      if(a + b > 1) {
        a = 1 - a;
        b = 1 - b;
      }
      std::array<double, 3> barycentric = { 1 - a - b, a, b };
      if(at < 3) {
        const double scale = std::pow(0.1, n % 3);
        for(int i = 0; i < 3; ++i) barycentric[i] *= scale;
        barycentric[at] += 1 - scale;
      }
      result.emplace_back(f, barycentric);
    }
  }
  return result;
}

} // namespace

TEST_CASE("Truncated shells: a mesh with a singular vertex gets a certified shell")
{
  const Shell& shell = screw_shell();
  REQUIRE(shell.is_certified());
  REQUIRE(shell.truncation());
  CHECK(shell.truncation()->is_valid());
  const BS::Truncation_report& report = shell.report().truncation;
  REQUIRE(report.vertices.size() == 1);
  CHECK(Mesh::Vertex_index(report.vertices[0].vertex) == tip(screw_mesh()));
  CHECK(report.vertices[0].radius == Approx(0.04 * shell.report().unit)); // the thickness, because edges are long
  CHECK(shell.report().certificate.least_cone_margin > 0.5);

  Certificate certificate(shell);
  CHECK(certificate.verify(screw_mesh()));
  CHECK(certificate.verify<CGAL::Sequential_tag>(screw_mesh()));
  CHECK(certificate.examined_mesh().number_of_vertices() > screw_mesh().number_of_vertices());
  // Facets of discs count after those of the mesh.
  const std::size_t in_disc = shell.truncation()->discs()[0].triangles.size();
  CHECK(certificate.facets().size() == screw_mesh().number_of_faces() + in_disc);
  CHECK(shell.facet_ranges().size() == certificate.facets().size());
  for(const BS::Level_range& range : shell.facet_ranges()) CHECK(range.min <= range.max);
}

TEST_CASE("Truncated shells: without truncation, a singular vertex is rejected, or not certified")
{
  const Shell refused = CGAL::certified_bspline_shell_3(screw_mesh(), parameters::truncate(false));
  CHECK(refused.status() == BS::Shell_status::SINGULAR_VERTEX);
  CHECK(refused.report().offending_simplices.vertices == std::vector<std::size_t>{ std::size_t(tip(screw_mesh())) });
  CHECK(refused.report().truncation.vertices.empty());
  CHECK(CGAL::certified_bspline_shell_3(screw_mesh(), parameters::least_cone_margin(-0.1)).status()
        == BS::Shell_status::INVALID_PARAMETER);
  CHECK(CGAL::certified_bspline_shell_3(screw_mesh(), parameters::least_cone_margin(1.)).status()
        == BS::Shell_status::INVALID_PARAMETER);
  // This certificate does not truncate the mesh.
  Certificate certificate(screw_shell().field(), screw_shell().inner_threshold(), screw_shell().outer_threshold());
  CHECK_FALSE(certificate.verify(screw_mesh()));
  CHECK(certificate.verdict(BS::Claim::TRANSVERSALITY) == BS::Verdict::REFUTED);
}

TEST_CASE("Truncated shells: a mesh whose tip is elsewhere is not certified")
{
  Mesh moved = screw_mesh();
  moved.point(tip(moved)) = Point_3(1, 1, 1.0001);
  Certificate certificate(screw_shell());
  CHECK_FALSE(certificate.verify(moved));
}

TEST_CASE("Truncated shells: a self-intersecting mesh with tips is not certified")
{
  // The certificate examines the truncated mesh, in which an intersection with the tip could go unnoticed.
  Mesh mesh = screw_mesh();
  Mesh needle = box(Point_3(0.9999, 0.9999, 0.9999), Point_3(1.0001, 1.0001, 1.0001));
  mesh += needle;
  Certificate certificate(screw_shell());
  CHECK_FALSE(certificate.verify(mesh));
  CHECK(certificate.status() == BS::Shell_status::SELF_INTERSECTION);
}

TEST_CASE("Truncated shells: the shell of a mesh without bad vertices has no truncation")
{
  const Shell shell = CGAL::certified_bspline_shell_3(sphere(2));
  CHECK(shell.is_certified());
  CHECK_FALSE(shell.truncation());
}

TEST_CASE("Truncated shells: a mesh with tips is mapped to a simplified one, and back")
{
  const Mesh& mesh = screw_mesh();
  CHECK(simplified().number_of_faces() < mesh.number_of_faces());
  const Map map(screw_shell(), mesh, simplified());
  REQUIRE(map.status() == BS::Flow_status::SUCCESS);
  const auto inverse = map.inverse();
  double worst = 0;
  const auto locations = places(mesh);
  for(const auto& location : locations) {
    const auto image = map(location);
    REQUIRE(image);
    const auto back = inverse(image.location);
    REQUIRE(back);
    const auto p = map.point(location);
    worst = (std::max)(worst, std::sqrt(CGAL::squared_distance(Point_3(p[0], p[1], p[2]),
                                                               Point_3(back.point[0], back.point[1], back.point[2]))));
  }
  CHECK(worst < 1e-9 * screw_shell().report().unit);
  // all locations at once
  const auto images = map.project(locations);
  for(std::size_t n = 0; n < locations.size(); n += 17) CHECK(images[n].location == map(locations[n]).location);
  const auto at_tip = map(tip(mesh));
  REQUIRE(at_tip);
  const auto returned = inverse(at_tip.location);
  REQUIRE(returned);
  CHECK(CGAL::squared_distance(Point_3(returned.point[0], returned.point[1], returned.point[2]), Point_3(1, 1, 1))
        < 1e-20);

  // A circle around the tip is mapped to a curve without jumps.
  worst = 0;
  for(auto f : mesh.faces_around_target(mesh.halfedge(tip(mesh)))) {
    const auto h = mesh.halfedge(f);
    const std::array<Mesh::Vertex_index, 3> corner = { mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) };
    const auto at = std::find(corner.begin(), corner.end(), tip(mesh)) - corner.begin();
    std::vector<Point_3> curve;
    for(int n = 0; n <= 100; ++n) {
      Map::Source_location place(f, { 0, 0, 0 });
      place.second[at] = 0.999;
      place.second[(at + 1) % 3] = 0.001 * (100 - n) / 100;
      place.second[(at + 2) % 3] = 0.001 * n / 100;
      const auto image = map(place);
      REQUIRE(image);
      curve.push_back(Point_3(image.point[0], image.point[1], image.point[2]));
    }
    for(int n = 0; n < 100; ++n) worst = (std::max)(worst, std::sqrt(CGAL::squared_distance(curve[n], curve[n + 1])));
  }
  CHECK(worst < 1e-3);
}

TEST_CASE("Truncated shells: the differential of the map agrees with finite differences, even at the tip")
{
  const Mesh& mesh = screw_mesh();
  const Map map(screw_shell(), mesh, simplified());
  const auto coordinates = [](const Point_3& p) { return Eigen::Vector3d(p.x(), p.y(), p.z()); };
  int tried = 0;
  for(const auto& location : places(mesh)) {
    const auto image = map(location);
    REQUIRE(image);
    Map::Source_location moved = location;
    constexpr double step = 1e-6;
    if(!(location.second[0] > 2 * step)) continue;
    moved.second[0] -= step;
    moved.second[1] += step;
    const auto moved_image = map(moved);
    REQUIRE(moved_image);
    if(moved_image.location.first != image.location.first) continue;
    const auto p = map.point(location), q = map.point(moved);
    const auto& normal = map.to_target().target().normal(map.to_target().target().facet_of(image.location.first));
    const auto d = map.differential(location, image);
    REQUIRE(d);
    const Eigen::Vector3d change = d.onto_plane(Eigen::Vector3d(normal[0], normal[1], normal[2]))
                                   * Eigen::Vector3d(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    const Eigen::Vector3d expected = coordinates(moved_image.point) - coordinates(image.point);
    // The map of the tip has kinks; few of the short steps cross one.
    if((change - expected).norm() <= 1e-3 * expected.norm() + 1e-10) ++tried;
    else --tried;
  }
  CHECK(tried > 500);
}

TEST_CASE("Truncated shells: attributes are transferred from and to a mesh with tips")
{
  const Mesh& mesh = screw_mesh();
  Mesh from = mesh, to = simplified();
  const Map map(screw_shell(), from, to);
  auto source = from.add_property_map<Mesh::Vertex_index, double>("v:x").first;
  auto target = to.add_property_map<Mesh::Vertex_index, double>("v:x").first;
  for(auto v : from.vertices()) source[v] = from.point(v).x();
  CHECK(BS::transfer_vertex_attribute(map, source, target).failures.empty());
  for(auto v : to.vertices()) CHECK(std::abs(target[v] - to.point(v).x()) < 0.2);
  CHECK(BS::average_vertex_attribute(map.inverse(), target, source).failures.empty());
  CHECK(source[tip(from)] == Approx(1).margin(0.3));

  auto label = from.add_property_map<Mesh::Face_index, int>("f:label", 1).first;
  auto target_label = to.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
  CHECK(BS::transfer_face_labels(map, label, target_label).failures.empty());
  CHECK(std::all_of(to.faces().begin(), to.faces().end(), [&](auto f) { return target_label[f] == 1; }));
  CHECK(BS::transfer_face_labels(map.inverse(), target_label, label).failures.empty());

  typedef std::array<double, 2> Texture;
  auto corner = from.add_property_map<Mesh::Halfedge_index, Texture>("h:texture").first;
  auto target_corner = to.add_property_map<Mesh::Halfedge_index, Texture>("h:texture").first;
  for(auto h : to.halfedges()) target_corner[h] = { to.point(to.target(h)).x(), to.point(to.target(h)).y() };
  CHECK(BS::transfer_corner_attribute(map.inverse(), target_corner, corner).failures.empty());
  for(auto h : from.halfedges()) CHECK(std::abs(corner[h][0] - from.point(from.target(h)).x()) < 0.2);

  auto vector = from.add_property_map<Mesh::Face_index, Vector_3>("f:vector").first;
  auto target_vector = to.add_property_map<Mesh::Face_index, Vector_3>("f:vector").first;
  for(auto f : from.faces())
    vector[f] = from.point(from.target(from.halfedge(f))) - from.point(from.source(from.halfedge(f)));
  CHECK(BS::transfer_tangent_vectors(map, vector, target_vector).failures.empty());
  CHECK(BS::transfer_tangent_vectors(map.inverse(), target_vector, vector).failures.empty());
}

TEST_CASE("Truncated shells: a mesh with tips is simplified and remeshed")
{
  const Shell& shell = screw_shell();
  {
    Mesh mesh = screw_mesh();
    const std::size_t vertices = mesh.number_of_vertices();
    const auto result = BS::simplify_in_shell(mesh, shell, parameters::locate_vertices(true));
    CHECK(result.status == BS::Edit_status::SUCCESS);
    CHECK(result.facets_before == screw_mesh().number_of_faces());
    REQUIRE(result.images.size() == vertices);
    for(auto v : result.images) CHECK_FALSE(mesh.is_removed(v));
    REQUIRE(result.locations.size() == vertices);
    // Locations agree with the map. Remaining vertices are on edges, and thus in any facet there.
    const Map map(shell, screw_mesh(), mesh);
    const double tolerance = 2 * map.to_target().tolerance();
    for(auto v : screw_mesh().vertices()) {
      const Point_3 p = CGAL::Polygon_mesh_processing::construct_point(result.locations[v], mesh);
      CHECK(CGAL::squared_distance(p, map(v).point) <= tolerance * tolerance);
    }
  }
  {
    Mesh mesh = screw_mesh();
    const auto result = BS::remesh_in_shell(mesh, 0.2, shell);
    CHECK(result.status == BS::Edit_status::SUCCESS);
    CHECK(result.images.size() == screw_mesh().number_of_vertices());
    Certificate certificate(shell);
    CHECK(certificate.verify(mesh));
  }
  {
    typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
    Polyhedron mesh;
    CGAL::copy_face_graph(screw_mesh(), mesh);
    CHECK(BS::simplify_in_shell(mesh, shell).status == BS::Edit_status::SUCCESS);
    CHECK(CGAL::is_closed(mesh));
  }
}

TEST_CASE("Truncated shells: a mesh that is rejected after its truncation is restored")
{
  Mesh mesh = screw_mesh();
  // A vertex far from the tip is moved out of the shell.
  const auto far = *std::find_if(mesh.vertices().begin(), mesh.vertices().end(),
                                 [&](auto v) { return mesh.point(v) == Point_3(0, 0, 0); });
  mesh.point(far) = Point_3(-1, -1, -1);
  const Mesh before = mesh;
  const auto result = BS::simplify_in_shell(mesh, screw_shell());
  CHECK(result.status == BS::Edit_status::NOT_IN_SHELL);
  CHECK(is_equal(before, mesh));
  REQUIRE_FALSE(result.offending_simplices.facets.empty());
  std::vector<std::size_t> expected;
  for(auto f : mesh.faces_around_target(mesh.halfedge(far))) expected.push_back(std::size_t(f));
  std::sort(expected.begin(), expected.end());
  CHECK(result.offending_simplices.facets == expected);
}

TEST_CASE("Truncated shells: a shell with a truncation is written and read")
{
  for(BS::Shell_format format : { BS::Shell_format::BINARY, BS::Shell_format::ASCII }) {
    std::stringstream file;
    REQUIRE(BS::write_shell(file, screw_shell(), format) == BS::Shell_file_status::SUCCESS);
    const std::string text = file.str();
    Shell shell;
    REQUIRE(BS::read_shell(file, shell) == BS::Shell_file_status::SUCCESS);
    REQUIRE(shell.truncation());
    CHECK(shell.truncation()->points() == screw_shell().truncation()->points());
    CHECK(shell.truncation()->planar() == screw_shell().truncation()->planar());
    CHECK(shell.truncation()->cut_facets() == screw_shell().truncation()->cut_facets());
    Certificate certificate(shell);
    CHECK(certificate.verify(screw_mesh()));
    std::stringstream again;
    REQUIRE(BS::write_shell(again, shell, format) == BS::Shell_file_status::SUCCESS);
    CHECK(again.str() == text);
    // A truncated file is never read as a shell.
    for(std::size_t length = text.size() - 2000; length < text.size(); length += 37) {
      std::stringstream part(text.substr(0, length));
      CHECK(BS::read_shell(part, shell) != BS::Shell_file_status::SUCCESS);
    }
  }
}

TEST_CASE("Truncated shells: the result does not depend on the number of threads")
{
  const auto np = parameters::relative_thickness(0.04);
  const Shell one = CGAL::certified_bspline_shell_3<CGAL::Sequential_tag>(screw_mesh(), np);
  std::stringstream first, second;
  BS::write_shell(first, one, BS::Shell_format::BINARY);
  BS::write_shell(second, screw_shell(), BS::Shell_format::BINARY);
  CHECK(first.str() == second.str());
}

TEST_CASE("Truncated shells: an open mesh with a singular vertex is closed and truncated")
{
  // A facet far from the tip is removed; the hole gets a cap.
  Mesh mesh = screw_mesh();
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3 c = CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                     mesh.point(mesh.target(mesh.next(h))));
    if(c.z() == 0 && c.x() < 0.5 && c.y() < 0.5) {
      CGAL::Euler::remove_face(h, mesh);
      break;
    }
  }
  mesh.collect_garbage();
  const Shell shell = CGAL::certified_bspline_shell_3(mesh, parameters::relative_thickness(0.04));
  REQUIRE(shell.is_certified());
  CHECK(shell.closing());
  CHECK(shell.truncation());
  Mesh simple = mesh;
  CHECK(BS::simplify_in_shell(simple, shell).status == BS::Edit_status::SUCCESS);
  const Map map(shell, mesh, simple);
  CHECK(map.status() == BS::Flow_status::SUCCESS);
  for(auto v : mesh.vertices()) CHECK(map(v));
  std::stringstream file;
  REQUIRE(BS::write_shell(file, shell, BS::Shell_format::ASCII) == BS::Shell_file_status::SUCCESS);
  Shell read;
  REQUIRE(BS::read_shell(file, read) == BS::Shell_file_status::SUCCESS);
  CHECK(read.closing());
  CHECK(Certificate(read).verify(mesh));
}
} // namespace test_truncated_shells
