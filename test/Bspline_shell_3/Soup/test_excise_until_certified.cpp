// Where no shell is built, more triangles are excised: more each time, and only as many as allowed.
#include <CGAL/Bspline_shell_3/Soup/excise_until_certified.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_shell_of_soup_3.h>
#include "excised_soups.h"

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace test_excise_until_certified {
namespace {

using namespace excised_soups;
namespace parameters = CGAL::Bspline_shells::parameters;
typedef BS::Excision_reason Reason;
typedef CGAL::Certified_bspline_shell_3 Shell;

// Returns a shell that was rejected with the given facets.
Shell rejected(BS::Shell_status status, std::vector<std::size_t> facets)
{
  BS::Shell_report report;
  report.status = status;
  report.offending_simplices.facets = std::move(facets);
  return Shell(report);
}

// Returns a sphere with a fin, of 321 triangles.
BS::Polygon_soup sphere_with_fin()
{
  const Mesh mesh = sphere(2);
  BS::Polygon_soup soup = soup_of(mesh);
  const auto h = mesh.halfedge(Mesh::Face_index(0));
  const Point_3 p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h));
  add_triangle(soup, p, q, CGAL::ORIGIN + 0.7 * ((p - CGAL::ORIGIN) + (q - CGAL::ORIGIN)));
  return soup;
}

} // namespace

TEST_CASE("Excision until certified: a soup of one sound mesh and a fin gets a certified shell except for the fin")
{
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(sphere_with_fin());
  REQUIRE(result);
  CHECK(result.kind() == BS::Shell_kind::EXCISED);
  CHECK(result.certification() == BS::Certification::EXCEPT_EXCISED);
  CHECK_FALSE(result.is_certified());
  CHECK(result.shell().is_certified());
  CHECK(result.mesh_status == BS::Shell_status::NON_MANIFOLD);
  CHECK(result.proxy_status == BS::Shell_status::NOT_BUILT);
  REQUIRE(result.excised);
  CHECK(result.excised->excised_triangles() == std::vector<std::size_t>{ 320 });
  CHECK(&result.mesh() == &result.excised->mesh());
  CHECK(CGAL::is_closed(result.mesh()));
  CHECK(result.message().find("1 of 321 triangles") != std::string::npos);
}

TEST_CASE("Excision until certified: where the proof fails in many places on few facets, these are excised")
{
  const BS::Polygon_soup soup = soup_of(grooved_block(1, 0.05));
  const auto limited = parameters::effort_limit(40000.);
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(soup, limited);
  REQUIRE(result);
  CHECK(result.mesh_status == BS::Shell_status::SUCCESS);
  CHECK_FALSE(result.shell_of_mesh.is_certified());
  CHECK(result.shell_of_mesh.report().obstacles.size() > 20);
  CHECK(result.kind() == BS::Shell_kind::EXCISED);
  REQUIRE(result.excised);
  CHECK(result.excised->report().number_of(Reason::NOT_CERTIFIED) > 0);
  // Each excised triangle touches the groove.
  const BS::Soup_triangles& triangles = result.excised->soup();
  for(std::size_t t : result.excised->excised_triangles())
    CHECK(std::any_of(triangles.triangles[t].begin(), triangles.triangles[t].end(),
                      [&](std::size_t v) { return std::abs(triangles.points[v].x() - 0.5) < 1e-3; }));
}

TEST_CASE("Excision until certified: a mesh is not excised if the proof fails on many facets")
{
  const Mesh plate = subdivided(subdivided(subdivided(box(Point_3(0, 0, 0), Point_3(1, 1, 0.002)))));
  const BS::Shell_of_soup_3 result = CGAL::certified_shell_of_soup_3(
    soup_of(plate), parameters::effort_limit(5000.).relative_thickness(0.05));
  CHECK(result.mesh_status == BS::Shell_status::SUCCESS);
  CHECK_FALSE(result.shell_of_mesh.is_certified());
  CHECK(result.shell_of_mesh.report().obstacles.size() > BS::Excision_limits().facets);
  CHECK(result.excision_report.excised == 0);
}

TEST_CASE("Excision until certified: nothing is excised if the proof fails on more facets than allowed")
{
  for(std::size_t facets : { 0, 20 }) {
    BS::Excised_soup_3 soup = chosen(soup_of(grooved_block(1, 0.05)));
    BS::Excision_limits limits;
    limits.facets = facets;
    limits.share_of_facets = 0;
    Shell shell;
    BS::excise_until_certified(soup, shell, limits, [&](const Mesh& mesh, const auto& caps) {
      return CGAL::certified_bspline_shell_3(mesh, parameters::effort_limit(20000.).hole_requires_cap(caps));
    });
    CHECK((soup.report().excised > 0) == (facets > 0));
  }
}

TEST_CASE("Excision until certified: no more than the allowed share of the area is excised")
{
  const BS::Polygon_soup soup = sphere_with_fin();
  const BS::Shell_of_soup_3 none = CGAL::certified_shell_of_soup_3(soup, parameters::largest_excised_share(0.));
  CHECK(none.kind() == BS::Shell_kind::PROXY);
  CHECK(none.certification() == BS::Certification::WHOLE);
  CHECK(none.excision_message().empty());
  const BS::Shell_of_soup_3 little = CGAL::certified_shell_of_soup_3(soup, parameters::largest_excised_share(1e-4));
  CHECK(little.kind() == BS::Shell_kind::PROXY);
  CHECK(little.excision_message().find("largest_excised_share") != std::string::npos);
  const BS::Shell_of_soup_3 invalid = CGAL::certified_shell_of_soup_3(soup, parameters::largest_excised_share(1.1));
  CHECK(invalid.status() == BS::Shell_status::INVALID_PARAMETER);
  CHECK(invalid.invalid_parameter.name == std::string("largest_excised_share"));
}

TEST_CASE("Excision until certified: nothing is tried if most facets are scattered")
{
  const auto number_of_shells = [](const Mesh& mesh) {
    BS::Excised_soup_3 soup = chosen(soup_of(mesh));
    std::size_t shells = 0;
    Shell shell;
    BS::excise_until_certified(soup, shell, BS::Excision_limits(), [&](const Mesh&, const auto&) {
      ++shells;
      return rejected(BS::Shell_status::CANCELED, {});
    });
    return shells;
  };
  BS::Polygon_soup scattered;
  for(int n = 0; n < 3; ++n)
    add_triangle(scattered, Point_3(2 * n, 0, 0), Point_3(2 * n + 1, 0, 0), Point_3(2 * n, 1, 0));
  const Mesh triangles = mesh_of(scattered.points, scattered.polygons), square = sheet(steps(0, 1, 1), steps(5, 6, 1));
  CHECK(number_of_shells(triangles) == 0);
  CHECK(number_of_shells(joined(triangles, square)) == 0);
  CHECK(number_of_shells(joined(triangles, sheet(steps(0, 2, 1), steps(5, 6, 1)))) == 1);
}

TEST_CASE("Excision until certified: more facets are excised each time that a place fails")
{
  BS::Excised_soup_3 soup = chosen(soup_of(sphere(3)));
  const Point_3 place = centroid(soup.mesh(), Mesh::Face_index(0));
  BS::Excision_limits limits;
  limits.share = 0.5;
  std::vector<std::size_t> excised;
  Shell shell;
  const bool is_certified = BS::excise_until_certified(soup, shell, limits, [&](const Mesh& mesh, const auto&) {
    excised.push_back(1280 - mesh.number_of_faces());
    std::size_t closest = 0;
    for(auto f : mesh.faces())
      if(distance(centroid(mesh, f), place) < distance(centroid(mesh, Mesh::Face_index(unsigned(closest))), place))
        closest = f;
    return rejected(BS::Shell_status::NOT_CLOSABLE, { closest });
  });
  CHECK_FALSE(is_certified);
  REQUIRE(excised.size() >= 3);
  CHECK(excised.size() <= limits.attempts);
  CHECK(excised[0] == 0);
  CHECK(excised[1] == 1);
  for(std::size_t n = 3; n < excised.size(); ++n) CHECK(excised[n] - excised[n - 1] > excised[n - 1] - excised[n - 2]);
  CHECK(soup.report().excised
        == soup.report().number_of(Reason::NOT_CLOSABLE) + soup.report().number_of(Reason::FRAGMENT)
             + soup.report().number_of(Reason::STEEP_BORDER) + soup.report().number_of(Reason::NON_MANIFOLD));
  CHECK(soup.report().excised_area > limits.share);
}

TEST_CASE("Excision until certified: if no facet is listed because a cap fails, those beside the last hole are excised")
{
  BS::Excised_soup_3 soup = chosen(soup_of(sphere(3)));
  std::vector<Point_3> hole;
  for(auto v : soup.mesh().vertices_around_face(soup.mesh().halfedge(Mesh::Face_index(0))))
    hole.push_back(soup.mesh().point(v));
  const auto is_at_hole = [&](const Mesh& mesh) {
    return std::any_of(mesh.vertices().begin(), mesh.vertices().end(), [&](Mesh::Vertex_index v) {
      return !mesh.is_isolated(v) && std::find(hole.begin(), hole.end(), mesh.point(v)) != hole.end();
    });
  };
  Shell shell;
  std::vector<bool> is_beside_hole;
  CHECK_FALSE(BS::excise_until_certified(soup, shell, {}, [&](const Mesh& mesh, const auto&) {
    is_beside_hole.push_back(is_at_hole(mesh));
    switch(is_beside_hole.size()) {
      case 1: return rejected(BS::Shell_status::NOT_CLOSABLE, { 0 });
      case 2: return rejected(BS::Shell_status::NOT_CLOSABLE, {});
      default: return rejected(BS::Shell_status::CANCELED, {});
    }
  }));
  CHECK(is_beside_hole == std::vector<bool>{ true, true, false });
}

TEST_CASE("Excision until certified: failures that excision cannot help end it")
{
  for(const BS::Shell_status status :
      { BS::Shell_status::CANCELED, BS::Shell_status::MEMORY_LIMIT_EXCEEDED, BS::Shell_status::NOT_CLOSABLE }) {
    BS::Excised_soup_3 soup = chosen(soup_of(sphere(1)));
    Shell shell;
    int calls = 0;
    CHECK_FALSE(BS::excise_until_certified(soup, shell, {}, [&](const Mesh&, const auto&) {
      ++calls;
      return rejected(status, {});
    }));
    CHECK(calls == 1);
    CHECK(shell.status() == status);
    CHECK(soup.report().excised == 0);
  }
}

TEST_CASE("Excision until certified: components on the wrong side are reversed once, and then excised")
{
  BS::Excised_soup_3 soup = chosen(soup_of(joined(sphere(2), sphere(1, 0.3))));
  Shell shell;
  int calls = 0;
  BS::excise_until_certified(soup, shell, {}, [&](const Mesh& mesh, const auto&) {
    ++calls;
    if(calls == 1) return rejected(BS::Shell_status::INCONSISTENT_ORIENTATION, { 320 });
    if(calls == 2) {
      CHECK(mesh.number_of_faces() == 400);
      return rejected(BS::Shell_status::INCONSISTENT_ORIENTATION, { 0 }); // the smaller component all the same
    }
    CHECK(mesh.number_of_faces() == 320);
    return rejected(BS::Shell_status::SOLVER_FAILED, {});
  });
  CHECK(calls == 3);
  CHECK(soup.report().number_of(Reason::WRONG_SIDE) == 80);
}

TEST_CASE("Excision until certified: holes that excision made are to be capped, and others need not be")
{
  Mesh mesh = sphere(2);
  const Point_3 excised_place = centroid(mesh, Mesh::Face_index(7));
  BS::Excised_soup_3 soup = excised(soup_of(mesh), { 7 });
  Shell shell;
  const auto& c = soup.soup().triangles[7];
  BS::excise_until_certified(soup, shell, {}, [&](const Mesh&, const auto& requires_cap) {
    const Point_3& p = soup_of(sphere(2)).points[c[0]];
    CHECK(requires_cap({ p.x(), p.y(), p.z() }));
    CHECK_FALSE(requires_cap({ 9, 9, 9 }));
    return rejected(BS::Shell_status::SOLVER_FAILED, {});
  });
  // With a hole of its own, the sphere may get a sheet.
  mesh = sphere(2);
  remove_facets(mesh,
                [&](const Point_3& p) { return distance(p, CGAL::ORIGIN - (excised_place - CGAL::ORIGIN)) < 0.3; });
  BS::Excised_soup_3 open = excised(soup_of(mesh), { 7 });
  BS::excise_until_certified(open, shell, {}, [&](const Mesh& remaining, const auto& requires_cap) {
    for(const Point_3& p : remaining.points()) CHECK_FALSE(requires_cap({ p.x(), p.y(), p.z() }));
    return rejected(BS::Shell_status::SOLVER_FAILED, {});
  });
}
} // namespace test_excise_until_certified
