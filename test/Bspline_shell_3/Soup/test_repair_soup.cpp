// Polygons become a mesh if only little is missing, and repairs are counted. Otherwise, the status has the reason.
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace test_repair_soup {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;

// Returns a soup in which each triangle has its own points, as in STL files.
BS::Polygon_soup exploded(const Mesh& mesh)
{
  BS::Polygon_soup soup;
  for(auto f : mesh.faces()) {
    soup.polygons.emplace_back();
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      soup.polygons.back().push_back(soup.points.size());
      soup.points.push_back(mesh.point(v));
    }
  }
  return soup;
}

struct Repaired
{
  Mesh mesh;
  BS::Soup_repairs repairs;
  BS::Offending_simplices offenders;
  BS::Shell_status status;

  explicit Repaired(const BS::Polygon_soup& soup) : status(BS::repair_soup(soup, mesh, repairs, offenders)) {}
};

} // namespace

TEST_CASE("Soup repair: a clean mesh needs no repair")
{
  const BS::Polygon_soup soup{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1) },
                               { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } } };
  const auto [mesh, repairs, offenders, status] = Repaired(soup);
  CHECK(status == BS::Shell_status::SUCCESS);
  CHECK(repairs.is_none());
  CHECK(mesh.number_of_faces() == 4);
  CHECK(CGAL::is_closed(mesh));
}

TEST_CASE("Soup repair: separate triangles, some reversed, duplicated or degenerate, become the original sphere")
{
  const Mesh ball = sphere(2);
  BS::Polygon_soup soup = exploded(ball);
  const std::size_t facets = soup.polygons.size();
  for(std::size_t n = 0; n < facets; n += 5) std::reverse(soup.polygons[n].begin(), soup.polygons[n].end());
  for(std::size_t n = 0; n < 7; ++n) soup.polygons.push_back(soup.polygons[11 * n]);
  std::reverse(soup.polygons.back().begin(), soup.polygons.back().end());
  const std::size_t p = soup.polygons[3][0], q = soup.polygons[3][1];
  soup.polygons.push_back({ p, q, p });
  soup.polygons.push_back({ q, q });
  const auto [mesh, repairs, offenders, status] = Repaired(soup);
  REQUIRE(status == BS::Shell_status::SUCCESS);
  CHECK(mesh.number_of_faces() == facets);
  CHECK(mesh.number_of_vertices() == ball.number_of_vertices());
  CHECK(CGAL::is_closed(mesh));
  CHECK(repairs.merged_points == 3 * facets - ball.number_of_vertices());
  CHECK(repairs.duplicate_polygons == 7);
  CHECK(repairs.removed_polygons == 2);
  CHECK((std::min)(repairs.reversed_polygons, facets - repairs.reversed_polygons) == (facets + 4) / 5);
  CHECK(repairs.degenerate_facets == 0);
  CHECK_FALSE(repairs.is_none());
}

TEST_CASE("Soup repair: a degenerate facet between others is removed, and the mesh stays closed")
{
  // The point 4 is on the edge from 0 to 1.
  const BS::Polygon_soup soup{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1),
                                 Point_3(0.5, 0, 0) },
                               { { 0, 2, 4 }, { 4, 2, 1 }, { 0, 4, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } } };
  const auto [mesh, repairs, offenders, status] = Repaired(soup);
  REQUIRE(status == BS::Shell_status::SUCCESS);
  CHECK(repairs.degenerate_facets == 1);
  CHECK(CGAL::is_closed(mesh));
  CHECK(PMP::volume(mesh) == Approx(1. / 6));
}

TEST_CASE("Soup repair: three facets at an edge, a Moebius strip and an empty soup have a status")
{
  const std::vector<Point_3> points{ Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 1),
                                     Point_3(0, -1, -1) };
  CHECK(Repaired({ points, { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } } }).status == BS::Shell_status::NON_MANIFOLD);
  CHECK(Repaired({ points, {} }).status == BS::Shell_status::EMPTY_MESH);
  const Repaired none({ points, { { 0, 0, 1 } } });
  CHECK(none.status == BS::Shell_status::EMPTY_MESH);
  CHECK(none.repairs.removed_polygons == 1);
  // Five triangles form a strip; the last one is joined to the first one with a twist.
  CHECK(Repaired({ points, { { 0, 1, 2 }, { 1, 2, 3 }, { 2, 3, 4 }, { 3, 4, 0 }, { 4, 0, 1 } } }).status
        == BS::Shell_status::NOT_ORIENTABLE);
}

TEST_CASE("Soup repair: offending polygons have their numbers in the soup, despite earlier removals")
{
  const std::vector<Point_3> points{ Point_3(0, 0, 0), Point_3(0, 0, 0), Point_3(1, 0, 0),
                                     Point_3(0, 1, 0), Point_3(0, 0, 1), Point_3(0, -1, -1) };
  const Repaired result({ points, { { 0, 0, 2 }, { 0, 2, 3 }, { 3, 2, 1 }, { 1, 2, 4 }, { 3, 4, 5 }, { 0, 2, 5 } } });
  CHECK(result.status == BS::Shell_status::NON_MANIFOLD);
  CHECK(result.offenders.facets == std::vector<std::size_t>{ 1, 3, 5 });
  CHECK(result.repairs.duplicate_polygons == 1);
  CHECK(result.mesh.is_empty());
}

TEST_CASE("Soup repair: a plate with a hole, to which its facets have a bridge, becomes a closed mesh")
{
  BS::Polygon_soup soup;
  for(double z : { 0., 1. })
    for(const auto& [x, y] : std::vector<std::pair<double, double> >{
          { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 1, 1 }, { 1, 3 }, { 3, 3 }, { 3, 1 } })
      soup.points.emplace_back(x, y, z);
  soup.polygons = { { 8, 9, 10, 11, 8, 12, 13, 14, 15, 12 }, { 0, 4, 7, 6, 5, 4, 0, 3, 2, 1 } };
  for(std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    soup.polygons.push_back({ i, j, 8 + j, 8 + i });
    soup.polygons.push_back({ 4 + i, 4 + j, 12 + j, 12 + i });
  }
  const auto [mesh, repairs, offenders, status] = Repaired(soup);
  REQUIRE(status == BS::Shell_status::SUCCESS);
  CHECK(repairs.split_polygons == 2);
  CHECK(CGAL::is_closed(mesh));
  CHECK(std::abs(PMP::volume(mesh)) == Approx(12));
}

TEST_CASE("Soup repair: components are reversed until they bound a volume")
{
  Mesh mesh = joined(sphere(2, 1), sphere(2, 0.5)); // both face outwards
  CHECK_FALSE(PMP::does_bound_a_volume(mesh));
  CHECK(BS::orient_components(mesh));
  CHECK(PMP::does_bound_a_volume(mesh));
  CHECK_FALSE(BS::orient_components(mesh));
  Mesh open = sheet({ 0, 1 }, { 0, 1 });
  CHECK_FALSE(BS::orient_components(open));
}
} // namespace test_repair_soup
