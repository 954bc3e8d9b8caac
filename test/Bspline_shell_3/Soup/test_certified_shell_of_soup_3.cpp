// Any polygons get a certified shell: around themselves, possibly repaired or virtually closed, or around a proxy.
#include <CGAL/Bspline_shell_3/Certificate/Shell_certificate_3.h>
#include <CGAL/Bspline_shell_3/Soup/write_report.h>
#include <CGAL/certified_shell_of_soup_3.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace test_certified_shell_of_soup_3 {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace parameters = CGAL::Bspline_shells::parameters;

BS::Polygon_soup soup_of(const Mesh& mesh)
{
  BS::Polygon_soup soup;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(mesh, soup.points, soup.polygons);
  return soup;
}

std::string report_of(const BS::Shell_of_soup_3& result)
{
  std::ostringstream out;
  CHECK(BS::write_report(out, result, BS::Soup_shares(), "a \"file\""));
  return out.str();
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

// Returns a strip of triangles with `halves` half twists.
BS::Polygon_soup band(int halves, int around = 48)
{
  BS::Polygon_soup soup;
  const auto number = [&](int i, int side) {
    return std::size_t(2 * (i % around) + (i >= around && halves % 2 == 1 ? 1 - side : side));
  };
  for(int i = 0; i < around; ++i)
    for(int side = 0; side < 2; ++side) {
      const double a = 2 * CGAL_PI * i / around, b = CGAL_PI * halves * i / around, w = side == 0 ? -0.3 : 0.3;
      soup.points.emplace_back((1 + w * std::cos(b)) * std::cos(a), (1 + w * std::cos(b)) * std::sin(a),
                               w * std::sin(b));
    }
  for(int i = 0; i < around; ++i) {
    soup.polygons.push_back({ number(i, 0), number(i + 1, 0), number(i + 1, 1) });
    soup.polygons.push_back({ number(i, 0), number(i + 1, 1), number(i, 1) });
  }
  return soup;
}

} // namespace

TEST_CASE("Shell of a soup: a closed mesh in pieces gets a shell of itself")
{
  BS::Polygon_soup soup = soup_of(sphere(3));
  BS::Polygon_soup pieces;
  for(const auto& polygon : soup.polygons) {
    pieces.polygons.emplace_back();
    for(std::size_t v : polygon) {
      pieces.polygons.back().push_back(pieces.points.size());
      pieces.points.push_back(soup.points[v]);
    }
  }
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(pieces);
  REQUIRE(result.is_certified());
  CHECK(result.kind() == BS::Shell_kind::CLOSED);
  CHECK(result.mesh_status == BS::Shell_status::SUCCESS);
  CHECK(result.repairs.merged_points == pieces.points.size() - soup.points.size());
  CHECK(result.mesh().number_of_vertices() == soup.points.size());
  const std::string report = report_of(result);
  CHECK(contains(report, "\"kind\": \"closed\""));
  CHECK(contains(report, "\"file\": \"a \\\"file\\\"\""));
  CHECK_FALSE(contains(report, "proxy"));
  CHECK_FALSE(contains(report, "united"));
  CHECK(result.unite_report.status == BS::Unite_status::NOT_TRIED);
}

TEST_CASE("Shell of a soup: facets with corners that do not quite meet are welded, and the message says so")
{
  BS::Polygon_soup soup = soup_of(sphere(3));
  for(std::size_t n = 0; n < soup.polygons.size(); n += 3) {
    std::size_t& v = soup.polygons[n][0];
    soup.points.push_back(soup.points[v] + Vector_3(1e-6, 0, 0));
    v = soup.points.size() - 1;
  }
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup, parameters::weld_tolerance(2e-6));
  REQUIRE(result.is_certified());
  CHECK(result.kind() == BS::Shell_kind::CLOSED);
  CHECK(result.weld.border_edges_after == 0);
  CHECK(result.weld_provenance.polygon_of.size() == soup.polygons.size());
  CHECK(contains(result.message(), " points were welded (within 2e-06)"));
  CHECK(contains(report_of(result), "\"weld\": {"));

  const BS::Shell_of_soup_3 invalid = CGAL::certified_shell_of_soup_3(soup, parameters::weld_tolerance(-1.));
  CHECK(invalid.status() == BS::Shell_status::INVALID_PARAMETER);
  CHECK(invalid.invalid_parameter.name == std::string("weld_tolerance"));
}

TEST_CASE("Shell of a soup: an open mesh is closed virtually, and wrongly oriented components are reversed")
{
  const BS::Shell_of_soup_3 open = CGAL::certified_shell_of_soup_3(band(0));
  REQUIRE(open.is_certified());
  CHECK(open.kind() == BS::Shell_kind::VIRTUALLY_CLOSED);
  CHECK(contains(report_of(open), "\"sheets\": 1"));

  const BS::Shell_of_soup_3 hollow = CGAL::certified_shell_of_soup_3(soup_of(joined(sphere(3, 1), sphere(2, 0.5))));
  REQUIRE(hollow.is_certified());
  CHECK(hollow.kind() == BS::Shell_kind::CLOSED);
  CHECK(hollow.repairs.reversed_components);
}

TEST_CASE("Shell of a soup: a rejected parameter is named with its value, even if the polygons do not form a mesh")
{
  BS::Polygon_soup finned = soup_of(sphere(3));
  finned.points.emplace_back(0, 0, 1.2);
  finned.polygons.push_back({ finned.polygons[0][0], finned.polygons[0][1], finned.points.size() - 1 });
  const auto check = [](const BS::Shell_of_soup_3& result, const std::string& name) {
    CHECK(result.status() == BS::Shell_status::INVALID_PARAMETER);
    CHECK(result.invalid_parameter.name == name);
    CHECK(result.invalid_parameter.value == -1);
    CHECK(contains(result.message(), name));
  };
  check(CGAL::certified_shell_of_soup_3(finned, parameters::relative_thickness(-1.)), "relative_thickness");
  check(CGAL::certified_shell_of_soup_3(finned, parameters::effort_limit(-1.)), "effort_limit");
  check(CGAL::certified_shell_of_soup_3(finned, parameters::largest_excised_share(-1.)), "largest_excised_share");
}

TEST_CASE("Shell of a soup: overlapping closed parts get a shell of their union")
{
  const BS::Polygon_soup soup = soup_of(joined(sphere(3), sphere(2, 0.7, Point_3(1.1, 0.2, 0.1))));
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup);
  REQUIRE(result.is_certified());
  CHECK(result.kind() == BS::Shell_kind::UNITED);
  REQUIRE(result.united);
  CHECK(&result.mesh() == &result.united->mesh);
  CHECK(result.repaired_mesh.number_of_faces() == soup.polygons.size());
  CHECK(contains(result.message(), "2 overlapping closed parts were united"));
  const std::string report = report_of(result);
  CHECK(contains(report, "\"kind\": \"united\""));
  CHECK(contains(report, "\"united_parts\": {"));
  CHECK_FALSE(contains(report, "proxy"));
}

TEST_CASE("Shell of a soup: if parts cannot be united, a proxy is built, and the message has the reason", "[slow]")
{
  const Mesh ball = sphere(2);
  Mesh spiked = ball;
  spiked.point(Mesh::Vertex_index(0)) = CGAL::ORIGIN - 2 * (ball.point(Mesh::Vertex_index(0)) - CGAL::ORIGIN);
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup_of(spiked), parameters::alpha(0.2));
  CHECK(result.mesh_status == BS::Shell_status::SELF_INTERSECTION);
  CHECK_FALSE(result.united);
  CHECK(result.unite_report.status == BS::Unite_status::PART_INTERSECTS_ITSELF);
  CHECK(contains(result.mesh_message(), "a connected component intersects itself"));
  CHECK(contains(report_of(result), "\"united_parts\": {"));
}

TEST_CASE("Near duplicates: points that are close to others, but not equal to them, are counted")
{
  BS::Polygon_soup::Points points;
  for(int x = 0; x < 10; ++x)
    for(int y = 0; y < 10; ++y) points.emplace_back(x, y, 0);
  CHECK(BS::number_of_near_duplicates({}) == 0);
  CHECK(BS::number_of_near_duplicates({ Point_3(1, 2, 3), Point_3(1, 2, 3) }) == 0);
  CHECK(BS::number_of_near_duplicates(points) == 0);
  points.push_back(points[5]); // equal
  CHECK(BS::number_of_near_duplicates(points) == 0);
  points.emplace_back(3 + 8e-6, 4 - 8e-6, 8e-6); // closer than 1e-6 of the box, whose longest side is 9
  points.emplace_back(7 - 1e-12, 7, 0);
  points.emplace_back(2 + 1e-5, 2, 0); // not as close
  CHECK(BS::number_of_near_duplicates(points) == 4);
}

TEST_CASE("Shell of a soup: the message on polygons that are not a mesh counts points that are almost equal")
{
  // The facets of a tetrahedron do not quite meet at one vertex, and another facet doubles an edge.
  BS::Polygon_soup soup{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1),
                           Point_3(0, 0, 1 + 1e-9) },
                         { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 4 }, { 0, 1, 4 } } };
  const BS::Shell_of_soup_3 shell = CGAL::certified_shell_of_soup_3(soup, parameters::relative_thickness(0.01));
  CHECK(shell.mesh_status == BS::Shell_status::NON_MANIFOLD);
  CHECK(shell.near_duplicates == 2);
  CHECK(contains(shell.mesh_message(), "2 points are closer"));
  CHECK(contains(report_of(shell), "\"near_duplicates\": 2"));
  REQUIRE(shell.is_certified());
  CHECK(contains(shell.message(), "thicker than requested")); // the proxy is farther away
  CHECK_FALSE(contains(shell.message(), "as thin as requested"));
}

TEST_CASE("Shell of a soup: a soup that is rejected as a mesh gets a proxy, and the reason is kept", "[slow]")
{
  const BS::Shell_of_soup_3 strip = CGAL::certified_shell_of_soup_3(band(1),
                                                                    parameters::alpha(0.1).largest_excised_share(0.));
  REQUIRE(strip.is_certified());
  CHECK(strip.kind() == BS::Shell_kind::PROXY);
  CHECK(strip.mesh_status == BS::Shell_status::NOT_ORIENTABLE);
  CHECK(contains(strip.mesh_message(), "not orientable"));
  CHECK_FALSE(contains(strip.mesh_message(), "build a proxy")); // there is a proxy already
  CHECK(CGAL::is_closed(strip.mesh()));
  BS::Shell_certificate_3<BS::Shell_of_soup_3::Shell::Field, BS::Shell_of_soup_3::Shell::Threshold> certificate(
    strip.shell());
  CHECK(certificate.verify(strip.mesh()));
  const std::string report = report_of(strip);
  CHECK(contains(report, "\"proxy\": {"));
  CHECK(contains(report, "\"status\": \"certified\""));
  CHECK(contains(report, strip.mesh_message()));

  // Two borders touch in a vertex.
  const BS::Polygon_soup bow{ { Point_3(0, 0, 0), Point_3(1, -0.5, 0), Point_3(1, 0.5, 0), Point_3(-1, 0.5, 0.1),
                                Point_3(-1, -0.5, 0) },
                              { { 0, 1, 2 }, { 0, 3, 4 } } };
  const BS::Shell_of_soup_3 touching = CGAL::certified_shell_of_soup_3(bow, parameters::alpha(0.2));
  CHECK(touching.mesh_status == BS::Shell_status::NON_MANIFOLD);
  CHECK(touching.kind() == BS::Shell_kind::PROXY);
  CHECK(touching.is_certified());
}

TEST_CASE("Shell of a soup: a soup without polygons, or without area, is rejected with a message")
{
  const BS::Polygon_soup points{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(2, 0, 0) }, {} };
  for(const BS::Polygon_soup& soup :
      { BS::Polygon_soup(), points, BS::Polygon_soup{ points.points, { { 0, 1, 2 } } } }) {
    const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup);
    CHECK_FALSE(result);
    CHECK_FALSE(result.is_certified());
    CHECK(
      (result.mesh_status == BS::Shell_status::EMPTY_MESH || result.mesh_status == BS::Shell_status::DEGENERATE_FACET));
    CHECK(std::string(result.message()) == message(result.mesh_status));
    const std::string report = report_of(result);
    CHECK(contains(report, "\"status\": \"refused\""));
    CHECK_FALSE(contains(report, "\"kind\""));
  }
}

TEST_CASE("Shell of a soup: the report of an uncertified shell has the limit that ended refinement, and the obstacles")
{
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(
    soup_of(box(Point_3(0, 0, 0), Point_3(1, 1, 0.002))), parameters::memory_limit(1.2e7));
  REQUIRE(result);
  REQUIRE_FALSE(result.is_certified());
  const std::string report = report_of(result);
  CHECK(contains(report, "\"limit\": \"Another round of refinement would have "));
  CHECK(contains(report, " MB, which exceeds the memory limit: raise it (memory_limit).\""));
  CHECK(contains(report, "\"obstacles\": ["));
}

TEST_CASE("Shell of a soup: points that are not finite, or do not exist, are reported")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Point_3> points{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, nan, 0) };
  const BS::Shell_of_soup_3 no_number = CGAL::certified_shell_of_soup_3({ points, { { 0, 1, 2 } } });
  CHECK(no_number.status() == BS::Shell_status::NOT_FINITE);
  CHECK(no_number.offending_simplices.vertices == std::vector<std::size_t>{ 2 });
  const BS::Shell_of_soup_3 no_point = CGAL::certified_shell_of_soup_3({ points, { { 0, 1 }, { 0, 1, 3 } } });
  CHECK(no_point.status() == BS::Shell_status::INVALID_PARAMETER);
  CHECK(no_point.offending_simplices.facets == std::vector<std::size_t>{ 1 });
  REQUIRE(no_point.invalid_parameter);
  CHECK(std::string(no_point.invalid_parameter.name) == "polygons");
  CHECK(no_point.message() == "The parameter polygons is 3. It must be at least 0 and less than 3.");
}

TEST_CASE("Shell of a soup: an invalid parameter, or a visitor that stops, has a status")
{
  const BS::Polygon_soup soup = soup_of(sphere(2));
  const BS::Shell_of_soup_3 negative = CGAL::certified_shell_of_soup_3(soup, parameters::relative_thickness(-1.));
  CHECK(negative.mesh_status == BS::Shell_status::INVALID_PARAMETER);
  REQUIRE(negative.invalid_parameter);
  CHECK(std::string(negative.invalid_parameter.name) == "relative_thickness");
  CHECK(negative.message() == message(negative.invalid_parameter));
  struct Stop : BS::Default_shell_visitor
  {
    bool start_step(BS::Shell_step) { return false; }
  };
  const BS::Shell_of_soup_3 canceled = CGAL::certified_shell_of_soup_3(soup, parameters::visitor(Stop()));
  CHECK(canceled.mesh_status == BS::Shell_status::CANCELED);
  CHECK_FALSE(canceled);
}
} // namespace test_certified_shell_of_soup_3
