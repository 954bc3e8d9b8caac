// match_components.h: certificates, containment and the map decide whether certified meshes of a shell lie in the same
// components.
#include "coefficient_functions.h"
#include "shell_reports.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_containment_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Transfer/transfer_vertex_attribute.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace test_match_components {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Hierarchical_bspline_field_3<> Field;
typedef CGAL::Bspline_shell_3<Field> Shell;
typedef BS::Shell_certificate_3<Field> Certificate;
typedef BS::Certificate_witness Place;
using BS::Claim;
using BS::Verdict;

constexpr double small_radius = 0.6, large_radius = 1;

// Returns a field close to 4 (|x| - small) (large - |x|). It increases across the small sphere and decreases across the
// large one; there is a ridge between them.
const Field& two_spheres()
{
  static const Field field = radial_spline<Field>(
    12, 1. / 8, [](double r) { return 4 * (r - small_radius) * (large_radius - r) + 0.05; });
  return field;
}

Mesh small_sphere(double factor = 1)
{
  return sphere(3, factor * small_radius);
}
Mesh large_sphere(double factor = 1)
{
  return reversed(sphere(3, factor * large_radius));
}

// Returns the shell between two levels, with the certificate of a mesh.
Shell shell_of(const Mesh& mesh)
{
  const BS::Level_range levels{ -0.09, 0.09 };
  Certificate certificate(two_spheres(), BS::Constant_threshold(levels.min), BS::Constant_threshold(levels.max));
  REQUIRE(certificate.verify<CGAL::Sequential_tag>(mesh));
  const std::vector<BS::Cover_box>& boxes = certificate.cover()->boxes();
  Shell shell(two_spheres(), levels, cells_of_cover(boxes, two_spheres().number_of_cells()), {},
              successful_report(2 * large_radius, certificate.report()));
  BS::internal::Shell_access::set_proved_cover(shell, boxes);
  return shell;
}

bool has(const Certificate& certificate, Place::Reason reason, Verdict verdict)
{
  return std::any_of(certificate.witnesses().begin(), certificate.witnesses().end(),
                     [&](const Place& w) { return w.reason == reason && w.verdict == verdict; });
}

// Returns the number of facets whose test point has an image.
template <typename Map>
std::size_t number_of_images(const Map& map)
{
  std::size_t number = 0;
  for(auto f : map.source().faces()) number += bool(map({ f, { 0.2, 0.3, 0.5 } }));
  return number;
}

} // namespace

TEST_CASE("Components: certified meshes are assigned to the components of the mesh that the shell was built for")
{
  const Mesh mesh = joined(small_sphere(), large_sphere());
  const Shell shell = shell_of(mesh);
  REQUIRE(shell.is_certified());
  CHECK(shell.report().certificate.components == std::vector<std::size_t>{ 0, 1 });
  CHECK(shell.component_paths().size() > 2);

  Certificate certificate(shell);
  CHECK(certificate.verify(mesh));
  CHECK(certificate.verify(joined(small_sphere(1.02), large_sphere(0.99))));
  CHECK(certificate.components() == std::vector<std::size_t>{ 0, 1 });
  CHECK(certificate.verify(joined(large_sphere(0.99), small_sphere(1.02))));
  CHECK(certificate.components() == std::vector<std::size_t>{ 1, 0 });

  // Each component alone satisfies all conditions for a mesh without a shell.
  for(const Mesh& one : { small_sphere(1.02), large_sphere(0.99) }) {
    Certificate alone(shell.field(), shell.inner_threshold(), shell.outer_threshold());
    CHECK(alone.verify(one));
    CHECK_FALSE(certificate.verify(one));
    CHECK(certificate.verdict(Claim::ONE_SHEET) == Verdict::REFUTED);
    CHECK(has(certificate, Place::EMPTY_COMPONENT, Verdict::REFUTED));
  }
  // Two sheets in a component of the shell are both assigned to it.
  CHECK_FALSE(certificate.verify(joined(joined(small_sphere(), small_sphere(1.02)), large_sphere())));
  CHECK(certificate.components() == std::vector<std::size_t>{ 0, 0, 1 });
  CHECK_FALSE(has(certificate, Place::OTHER_COMPONENT, Verdict::REFUTED));
  CHECK(has(certificate, Place::SHELL_CROSSINGS, Verdict::REFUTED));
}

TEST_CASE("Components: a mesh in a level-set component that does not belong to the shell is rejected")
{
  const Shell shell = shell_of(small_sphere());
  Certificate certificate(shell);
  CHECK(certificate.verify(small_sphere(0.99)));
  for(const Mesh& other : { large_sphere(), joined(small_sphere(), large_sphere()) }) {
    CHECK_FALSE(certificate.verify(other));
    CHECK(certificate.verdict(Claim::CONTAINMENT) == Verdict::PROVED);
    CHECK(certificate.verdict(Claim::ONE_SHEET) == Verdict::REFUTED);
    CHECK(has(certificate, Place::OTHER_COMPONENT, Verdict::REFUTED));
    CHECK(std::count(certificate.components().begin(), certificate.components().end(), Place::none) == 1);
  }
}

TEST_CASE("Components: two certificates with equal thresholds decide whether their meshes are mapped onto each other")
{
  const auto certify = [](const Mesh& mesh) {
    Certificate certificate(two_spheres(), BS::Constant_threshold(-0.09), BS::Constant_threshold(0.09));
    certificate.verify(mesh);
    return certificate;
  };
  const Certificate small = certify(small_sphere()), other_small = certify(small_sphere(1.02)),
                    large = certify(large_sphere()), all = certify(joined(large_sphere(), small_sphere())),
                    none = certify(sphere(2, 0.2));
  for(const Certificate* c : { &small, &other_small, &large, &all }) REQUIRE(*c);
  CHECK(small.matches(other_small) == Verdict::PROVED);
  CHECK(other_small.matches(small) == Verdict::PROVED);
  CHECK(all.matches(all) == Verdict::PROVED);
  CHECK(small.matches(large) == Verdict::REFUTED);
  CHECK(small.matches(all) == Verdict::REFUTED);
  CHECK(all.matches(small) == Verdict::REFUTED);
  CHECK(small.matches(none) == Verdict::UNDECIDED);
  CHECK(none.matches(small) == Verdict::UNDECIDED);
}

TEST_CASE("Components: the map between meshes in different components is rejected")
{
  const Mesh mesh = joined(small_sphere(), large_sphere()), moved = joined(small_sphere(1.02), large_sphere(0.99)),
             one = small_sphere();
  const Shell shell = shell_of(mesh);
  const BS::Shell_map_3 map(shell, mesh, moved);
  CHECK(map.status() == BS::Flow_status::SUCCESS);
  CHECK(number_of_images(map) == mesh.number_of_faces());
  for(const auto& rejected : { BS::Shell_map_3(shell, mesh, one), BS::Shell_map_3(shell, one, mesh),
                               BS::Shell_map_3(shell, one, mesh).inverse() }) {
    CHECK(rejected.status() == BS::Flow_status::COMPONENTS_DIFFER);
    const BS::Shell_map_3<Shell, Mesh>::Source_location location(*rejected.source().faces().begin(), { 0.2, 0.3, 0.5 });
    CHECK(rejected(location).status == BS::Flow_status::COMPONENTS_DIFFER);
    for(const auto& image :
        rejected.project(std::vector<BS::Shell_map_3<Shell, Mesh>::Source_location>{ location, location }))
      CHECK(image.status == BS::Flow_status::COMPONENTS_DIFFER);
    CHECK_FALSE(std::string(message(rejected.status())).empty());
  }
  // Reversed orientation, or further parts outside the shell, do not change this.
  const Mesh turned = reversed(mesh);
  CHECK(BS::Shell_map_3(shell, mesh, turned).status() == BS::Flow_status::SUCCESS);
  const Mesh debris = joined(mesh, sphere(1, 0.1));
  CHECK(BS::Shell_map_3(shell, mesh, debris).status() == BS::Flow_status::SUCCESS);
}

TEST_CASE("Components: for an uncertified shell, paths through both meshes confirm a map or leave it unknown")
{
  const Shell certified = shell_of(joined(small_sphere(), large_sphere()));
  const Shell shell(certified.field(), BS::Level_range{ -0.09, 0.09 }, certified.shell_cells(), {},
                    successful_report(2));
  const Mesh mesh = joined(small_sphere(), large_sphere()), moved = joined(large_sphere(0.99), small_sphere(1.02)),
             small = small_sphere(), large = large_sphere();
  const auto status = [&](const Shell& s, const Mesh& source, const Mesh& target) {
    const BS::Shell_map_3 map(s, source, target);
    CHECK(map.inverse().status() == map.status());
    CHECK(map.maps_points());
    return map.status();
  };
  CHECK(status(shell, mesh, moved) == BS::Flow_status::SUCCESS);
  CHECK(status(shell, small, small_sphere(1.02)) == BS::Flow_status::SUCCESS);
  CHECK(status(shell, small, large) == BS::Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(shell, mesh, small) == BS::Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(shell, large, mesh) == BS::Flow_status::COMPONENTS_UNKNOWN);
  // A mesh outside the shell is in no component.
  CHECK(status(shell, mesh, joined(mesh, sphere(1, 0.1))) == BS::Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(shell, small, small_sphere(1.3)) == BS::Flow_status::COMPONENTS_UNKNOWN);
  // Points have images where the target has points.
  CHECK(number_of_images(BS::Shell_map_3(shell, mesh, small)) == small.number_of_faces());
  // Open meshes in a certified shell: half of a sphere is in the component of the sphere.
  Mesh half = small_sphere(1.01);
  remove_facets(half, [](const Point_3& p) { return p.z() > 0; });
  CHECK(status(certified, half, small) == BS::Flow_status::SUCCESS);
  CHECK(status(certified, small, half) == BS::Flow_status::SUCCESS);
  CHECK(status(certified, half, large) == BS::Flow_status::COMPONENTS_UNKNOWN);
  CHECK(status(certified, half, mesh) == BS::Flow_status::COMPONENTS_UNKNOWN);
}

TEST_CASE("Components: a component whose paths are all degenerate is identified by its vertices")
{
  Mesh mesh = joined(small_sphere(), large_sphere());
  const Shell shell = shell_of(mesh);
  BS::Shell_report report = shell.report();
  report.certificate.spare_paths.clear();
  for(BS::Crossing_path& path : report.certificate.paths)
    for(auto vertex : mesh.vertices()) {
      // The path leads through a vertex of the component.
      const Point_3& v = mesh.point(vertex);
      if((CGAL::squared_distance(v, Point_3(0, 0, 0)) < 0.64) != (path.component == 0)) continue;
      path.source = { v.x(), v.y(), v.z() - 0.1 };
      path.target = { v.x(), v.y(), v.z() + 0.1 };
    }
  Shell degenerate(shell.field(), BS::Level_range{ -0.09, 0.09 }, shell.shell_cells(), {}, report);
  BS::internal::Shell_access::set_proved_cover(degenerate, *shell.proved_cover());
  REQUIRE(degenerate.is_certified());
  CHECK(BS::Shell_map_3(degenerate, mesh, mesh).status() == BS::Flow_status::SUCCESS);
  const Mesh one = small_sphere();
  CHECK(BS::Shell_map_3(degenerate, mesh, one).status() != BS::Flow_status::SUCCESS);
}

TEST_CASE("Components: containment determines the component of the shell in which a mesh lies")
{
  const Mesh mesh = joined(small_sphere(), large_sphere());
  const Shell shell = shell_of(mesh), small_shell = shell_of(small_sphere());
  const BS::Shell_containment_3<Field> contains(shell), contains_small(small_shell);
  CHECK(contains(mesh));
  CHECK(contains.match(joined(large_sphere(), small_sphere())).component_of_shell == std::vector<std::size_t>{ 1, 0 });
  CHECK(contains.match(mesh).verdict() == Verdict::PROVED);
  CHECK(contains(large_sphere()));
  CHECK(contains.match(large_sphere()).verdict() == Verdict::REFUTED);
  CHECK(contains_small(small_sphere(1.02)));
  CHECK(contains_small.match(small_sphere(1.02)).verdict() == Verdict::PROVED);
  CHECK_FALSE(contains_small(large_sphere()));
  CHECK_FALSE(contains_small(mesh));
}

TEST_CASE("Components: a path through an edge or a vertex of a mesh is inconclusive, and other paths decide")
{
  // A square pyramid over the plane z = 0. The first path meets the diagonal of its base.
  const std::vector<std::array<double, 3> > points = {
    { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 0.5, -1 }
  };
  const std::vector<std::array<int, 3> > facets = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 0, 4 },
                                                    { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } };
  const auto triangle = [&](std::size_t n) {
    const auto point = [&](int v) { return Point_3(points[v][0], points[v][1], points[v][2]); };
    return std::array<Point_3, 3>{ point(facets[n][0]), point(facets[n][1]), point(facets[n][2]) };
  };
  const auto match = [&](std::vector<BS::Crossing_path> paths) {
    return BS::match_components(paths, 1, facets.size(), triangle, [](std::size_t) { return std::size_t(0); });
  };
  const BS::Crossing_path on_edge = { 0, 0, { 0.5, 0.5, -0.5 }, { 0.5, 0.5, 0.5 } },
                          inside = { 0, 0, { 0.6, 0.5, -0.1 }, { 0.6, 0.5, 0.5 } },
                          beside = { 0, 0, { 2, 0.5, -0.1 }, { 2, 0.5, 0.5 } },
                          on_vertex = { 0, 0, { 0, 0, -1 }, { 0, 0, 1 } };
  CHECK(match({ on_edge }).verdict() == Verdict::UNDECIDED);
  CHECK(match({ on_vertex }).verdict() == Verdict::UNDECIDED);
  CHECK(match({ inside }).verdict() == Verdict::PROVED);
  CHECK(match({ inside }).component_of_shell == std::vector<std::size_t>{ 0 });
  CHECK(match({ on_edge, inside }).verdict() == Verdict::PROVED);
  CHECK(match({ inside, on_edge }).verdict() == Verdict::PROVED);
  CHECK(match({ beside }).verdict() == Verdict::REFUTED);
  CHECK(match({ beside }).crossings == std::vector<std::optional<int> >{ 0 });
  CHECK(match({ beside, on_vertex, inside }).verdict() == Verdict::PROVED);
  // Paths with a count of one take precedence, in any order.
  for(const auto& paths :
      { std::vector<BS::Crossing_path>{ inside, beside }, { beside, inside }, { beside, inside, on_edge, beside } }) {
    CHECK(match(paths).verdict() == Verdict::PROVED);
    CHECK(match(paths).component_of_shell == std::vector<std::size_t>{ 0 });
  }
  CHECK(match({}).verdict() == Verdict::UNDECIDED);
  BS::Crossing_path second = inside;
  second.component = 1;
  CHECK(match({ on_edge, second }).verdict() == Verdict::UNDECIDED);
}

TEST_CASE("Components: a mesh that a path crosses twice, or from front to back, does not match")
{
  // Each triangle is a component; all cross the z-axis.
  const auto match = [](const std::vector<double>& heights, const BS::Crossing_path& path) {
    return BS::match_components(
      { path }, heights.size(), heights.size(),
      [&](std::size_t n) {
        return std::array<Point_3, 3>{ Point_3(-1, -1, heights[n]), Point_3(2, -1, heights[n]),
                                       Point_3(-1, 2, heights[n]) };
      },
      [](std::size_t n) { return n; });
  };
  const BS::Crossing_path up = { 0, 0, { 0, 0, -1 }, { 0, 0, 1 } }, down = { 0, 0, { 0, 0, 1 }, { 0, 0, -1 } };
  CHECK(match({ 0 }, up).verdict() == Verdict::PROVED);
  CHECK(match({ 0 }, down).crossings == std::vector<std::optional<int> >{ -1 });
  CHECK(match({ 0 }, down).verdict() == Verdict::REFUTED);
  CHECK(match({ 0, 0.5 }, up).crossings == std::vector<std::optional<int> >{ 2 });
  CHECK(match({ 0, 0.5 }, up).component_of_shell == std::vector<std::size_t>{ 0, 0 });
  CHECK(match({ 0, 0.5 }, up).verdict() == Verdict::REFUTED);
  CHECK(match({ 0, 2 }, up).component_of_shell == std::vector<std::size_t>{ 0, BS::Component_match::none });
  CHECK(match({ 0, 2 }, up).verdict() == Verdict::REFUTED);
}

TEST_CASE("Components: nothing is transferred through a rejected map")
{
  const Mesh mesh = joined(small_sphere(), large_sphere());
  Mesh one = small_sphere();
  const Shell shell = shell_of(mesh);
  auto values = one.add_property_map<Mesh::Vertex_index, double>("v:value", 7).first;
  Mesh source = mesh;
  const auto from = source.add_property_map<Mesh::Vertex_index, double>("v:value", 1).first;
  const auto rejected = [&](const BS::Transfer_report& report) {
    CHECK(report.failures.size() == one.number_of_vertices());
    for(const auto& failure : report.failures) CHECK(failure.second == BS::Flow_status::COMPONENTS_DIFFER);
    for(auto v : one.vertices()) CHECK(values[v] == 7);
  };
  const BS::Shell_map_3 map(shell, source, one);
  REQUIRE(map.status() == BS::Flow_status::COMPONENTS_DIFFER);
  rejected(BS::transfer_vertex_attribute(map, from, values));
  rejected(BS::average_vertex_attribute(map, from, values));
}
} // namespace test_match_components
