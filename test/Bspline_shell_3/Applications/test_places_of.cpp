// places_of.h of the plugin for the Polyhedron demo: the places that a report names are points on the mesh.
#include "../../../examples/polyhedron_demo/places_of.h"
#include "test_meshes.h"

#include <CGAL/Bspline_shell_3/Editing/simplify_in_shell.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <vector>

namespace test_places_of {
namespace {

namespace BS = CGAL::Bspline_shells;

TEST_CASE("places: they are centroids of facets, vertices, and points of obstacles")
{
  const Mesh mesh = box(Point_3(0, 0, 0), Point_3(2, 4, 6), false); // quadrangles
  BS::Shell_report report;
  for(std::size_t n = 0; n < 6; ++n) report.offending_simplices.facets.push_back(n);
  report.offending_simplices.vertices = { 3 };
  report.obstacles.resize(1);
  report.obstacles[0].point = { 1, 2, 3 };
  const std::vector<Point_3> places = places_of(report, mesh);
  REQUIRE(places.size() == 8);
  for(std::size_t n = 0; n < 6; ++n) {
    const Vector_3 from_center = places[n] - Point_3(1, 2, 3);
    CHECK((from_center.x() != 0) + (from_center.y() != 0) + (from_center.z() != 0) == 1);
  }
  CHECK(places[6] == mesh.point(Mesh::Vertex_index(3)));
  CHECK(places[7] == Point_3(1, 2, 3));
}

TEST_CASE("places: self-intersections are located, and certified shells have none")
{
  const Mesh crossing = joined(sphere(1), sphere(1, 1, Point_3(1.5, 0, 0)));
  const auto rejected = CGAL::certified_bspline_shell_3(crossing);
  REQUIRE(rejected.status() == BS::Shell_status::SELF_INTERSECTION);
  const std::vector<Point_3> places = places_of(rejected.report(), crossing);
  CHECK(places.size() == rejected.report().offending_simplices.facets.size());
  CHECK_FALSE(places.empty());
  for(const Point_3& p : places) CHECK((p.x() > 0 && p.x() < 1.5));

  const Mesh ball = sphere(2);
  const auto certified = CGAL::certified_bspline_shell_3(ball);
  REQUIRE(certified.is_certified());
  CHECK(places_of(certified.report(), ball).empty());
}

TEST_CASE("places: facets that are not in the shell before an edit")
{
  const Mesh ball = sphere(2);
  const auto shell = CGAL::certified_bspline_shell_3(ball);
  Mesh larger = sphere(2, 1.5);
  const auto result = BS::simplify_in_shell(larger, shell);
  REQUIRE(result.status == BS::Edit_status::NOT_IN_SHELL);
  CHECK(places_of(result, larger).size() >= larger.number_of_faces());
}

} // namespace
} // namespace test_places_of
