// The hypotheses of the theorem on excision are checked exactly: each way to violate one is found.
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include "excised_soups.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace test_check_excision {
namespace {

using namespace excised_soups;
typedef BS::Excision_status Status;
typedef BS::internal::Excised_soup_access Access;

// Returns the square with a further triangle, which is excised.
BS::Excised_soup_3 square_with(const Point_3& p, const Point_3& q, const Point_3& r)
{
  BS::Polygon_soup soup = square();
  add_triangle(soup, p, q, r);
  return excised(soup, { 4 });
}

Status replaced(const BS::Excised_soup_3& soup, const std::vector<Point_3>& points,
                const std::vector<std::vector<std::size_t> >& triangles)
{
  return BS::check_replacement(soup, mesh_of(points, triangles)).status;
}

// Returns the points of the square, with its middle elsewhere.
std::vector<Point_3> corners_and(const Point_3& middle)
{
  std::vector<Point_3> points = square().points;
  points[4] = middle;
  return points;
}

const Point_3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), middle(0, 0, 0), up(0, 0, 1), far_up(0.5, 0.5, 2);
const std::vector<std::vector<std::size_t> > four{ { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };

} // namespace

TEST_CASE("Check of an excision: sound parts are valid, whatever the excised triangles look like")
{
  CHECK(BS::check_excision(excised(square(), {})));
  CHECK(BS::check_excision(excised(square(), { 0 })));
  CHECK(BS::check_excision(excised(square(), { 0, 1, 2, 3 })));
  CHECK(BS::check_excision(excised(cube_with_fin(), { 12 })));
  CHECK(BS::check_excision(square_with(a, c, up)));
  CHECK(BS::check_excision(square_with(Point_3(-2, 0, 0), middle, Point_3(2, 0, 0)))); // without area, in the square
}

TEST_CASE("Check of an excision: triangles that are not a simplicial complex are rejected")
{
  BS::Soup_triangles triangles = BS::different_triangles(square());
  const std::vector<BS::Excision_reason> reasons{ BS::Excision_reason::KEPT, BS::Excision_reason::NO_AREA,
                                                  BS::Excision_reason::NO_AREA, BS::Excision_reason::NO_AREA };
  const auto checked = [&](const BS::Soup_triangles& soup) {
    return BS::check_excision(BS::Excised_soup_3(soup, reasons, std::vector<char>(4, 0)));
  };
  REQUIRE(checked(triangles));
  BS::Soup_triangles wrong = triangles;
  wrong.triangles[2][0] = wrong.triangles[2][1];
  CHECK(checked(wrong).status == Status::REPEATED_CORNER);
  CHECK(checked(wrong).triangles == std::vector<std::size_t>{ 2 });
  wrong = triangles;
  wrong.triangles[2] = { 1, 0, 4 };
  CHECK(checked(wrong).status == Status::REPEATED_TRIANGLE);
  CHECK(checked(wrong).triangles == std::vector<std::size_t>{ 0, 2 });
  wrong = triangles;
  wrong.points[3] = wrong.points[1];
  CHECK(checked(wrong).status == Status::EQUAL_POINTS);
}

TEST_CASE("Check of an excision: a mesh that is not an oriented manifold is rejected")
{
  CHECK(BS::check_excision(excised(cube_with_fin(), {})).status == Status::NOT_MANIFOLD);
  CHECK(BS::check_excision(excised(square(), { 1, 3 })).status == Status::NOT_MANIFOLD); // two fans
  BS::Polygon_soup turned = square();
  std::swap(turned.polygons[2][0], turned.polygons[2][1]);
  const BS::Excision_verdict verdict = BS::check_excision(excised(turned, { 0 }));
  CHECK(verdict.status == Status::NOT_ORIENTED);
  CHECK(verdict.triangles == std::vector<std::size_t>{ 1, 2 });
  CHECK(BS::check_excision(excised(turned, { 1, 3 })).status == Status::NOT_MANIFOLD);
}

TEST_CASE("Check of an excision: the mesh has to be that of the kept triangles, bit for bit")
{
  BS::Excised_soup_3 moved = excised(square(), { 0 });
  Access::mesh(moved).point(Mesh::Vertex_index(0)) = Point_3(1, -1, 1e-300);
  CHECK(BS::check_excision(moved).status == Status::DIFFERENT_MESH);
  BS::Excised_soup_3 turned = excised(cube_with_fin(), { 12 });
  REQUIRE(BS::check_excision(turned));
  CGAL::Polygon_mesh_processing::reverse_face_orientations(Access::mesh(turned));
  CHECK(BS::check_excision(turned).status == Status::DIFFERENT_MESH);
  BS::Excised_soup_3 smaller = excised(square(), { 0 });
  CGAL::Euler::remove_face(Access::mesh(smaller).halfedge(Mesh::Face_index(2)), Access::mesh(smaller));
  CHECK(BS::check_excision(smaller).status == Status::DIFFERENT_MESH);
}

TEST_CASE("Check of an excision: inner vertices and edges of the contact have to be pinned")
{
  BS::Excised_soup_3 fin = excised(cube_with_fin(), { 12 });
  Access::pinned_edges(fin).clear();
  const BS::Excision_verdict verdict = BS::check_excision(fin);
  CHECK(verdict.status == Status::UNLISTED_PIN);
  CHECK(verdict.vertices.size() == 2);
  CHECK(verdict.triangles.size() == 3);
  fin = excised(cube_with_fin(), { 12 });
  Access::pinned_vertices(fin).pop_back();
  CHECK(BS::check_excision(fin).status == Status::UNLISTED_PIN);
  // An inner edge with both vertices on the border.
  BS::Polygon_soup chord{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0), Point_3(0, 0, 1) },
                          { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 2, 4 } } };
  BS::Excised_soup_3 hanging = excised(chord, { 2 });
  REQUIRE(BS::check_excision(hanging));
  Access::pinned_edges(hanging).clear();
  CHECK(BS::check_excision(hanging).status == Status::UNLISTED_PIN);
}

TEST_CASE("Check of an excision: no truncated vertex may belong to an excised triangle")
{
  const BS::Excised_soup_3 fin = excised(cube_with_fin(), { 12 });
  for(auto v : fin.mesh().vertices()) {
    const bool is_contact = fin.mesh().point(v).x() == 0 && fin.mesh().point(v).y() == 0;
    CHECK(BS::check_excision(fin, { v }).status == (is_contact ? Status::MOVED_TIP : Status::VALID));
  }
}

TEST_CASE("Check of a replacement: the mesh itself, and a mesh with the same border and pins, are valid")
{
  const BS::Excised_soup_3 fin = excised(cube_with_fin(), { 12 });
  CHECK(BS::check_replacement(fin, fin.mesh()));
  // The middle of the square has no contact with the excised triangle, so it may move or vanish.
  const BS::Excised_soup_3 soup = square_with(a, b, up);
  CHECK(replaced(soup, square().points, four) == Status::VALID);
  CHECK(replaced(soup, corners_and(Point_3(0.1, 0.2, 0.3)), four) == Status::VALID);
  CHECK(replaced(soup, square().points, { { 0, 1, 2 }, { 0, 2, 3 } }) == Status::VALID);
  CHECK(replaced(soup, square().points, { { 0, 1, 3 }, { 1, 2, 3 } }) == Status::VALID);
}

TEST_CASE("Check of a replacement: the border may not move, vanish, or turn round")
{
  const BS::Excised_soup_3 soup = square_with(a, b, up);
  std::vector<Point_3> points = square().points;
  points[2] = Point_3(1, 1, 1e-300);
  CHECK(replaced(soup, points, four) == Status::DIFFERENT_BORDER);
  CHECK(replaced(soup, square().points, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 } }) == Status::DIFFERENT_BORDER);
  CHECK(replaced(soup, square().points, { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } })
        == Status::DIFFERENT_BORDER);
}

TEST_CASE("Check of a replacement: pinned vertices and edges have to remain")
{
  const BS::Excised_soup_3 at_vertex = square_with(middle, up, far_up);
  REQUIRE(at_vertex.pinned_vertices().size() == 1);
  CHECK(replaced(at_vertex, square().points, four) == Status::VALID);
  CHECK(replaced(at_vertex, square().points, { { 0, 1, 2 }, { 0, 2, 3 } }) == Status::MISSING_PIN);
  CHECK(replaced(at_vertex, corners_and(Point_3(0, 0, 1e-300)), four) == Status::MISSING_PIN);

  // Without a proof of the edge, the excised triangle would come loose.
  const BS::Excised_soup_3 at_edge = square_with(a, middle, up);
  REQUIRE(at_edge.pinned_edges().size() == 1);
  CHECK(replaced(at_edge, square().points, four) == Status::VALID);
  CHECK(replaced(at_edge, square().points, { { 1, 2, 4 }, { 2, 3, 4 }, { 3, 1, 4 }, { 0, 1, 3 } })
        == Status::MISSING_PIN);
  // The edge between two border vertices.
  BS::Polygon_soup chord{ { a, b, c, Point_3(-1, 1, 0), up }, { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 2, 4 } } };
  const BS::Excised_soup_3 hanging = excised(chord, { 2 });
  CHECK(replaced(hanging, square().points, { { 0, 1, 3 }, { 1, 2, 3 } }) == Status::MISSING_PIN);
}

TEST_CASE("Check of a replacement: a chord, an edge that only the replacement shares with excised triangles, is found")
{
  const BS::Excised_soup_3 soup = square_with(a, c, up); // shares two vertices of the border, but no edge
  CHECK(replaced(soup, square().points, four) == Status::VALID);
  CHECK(replaced(soup, square().points, { { 0, 1, 3 }, { 1, 2, 3 } }) == Status::VALID);
  const BS::Excision_verdict verdict = BS::check_replacement(soup,
                                                             mesh_of(square().points, { { 0, 1, 2 }, { 0, 2, 3 } }));
  CHECK(verdict.status == Status::COMMON_EDGE);
  CHECK(verdict.triangles == std::vector<std::size_t>{ 4 });
  CHECK(verdict.vertices == std::vector<Mesh::Vertex_index>{ Mesh::Vertex_index(0), Mesh::Vertex_index(2) });
}

TEST_CASE("Check of a replacement: a pillow, a facet with the corners of an excised triangle, is found")
{
  // All three edges of the excised triangle are in contact: two on the border, one is pinned.
  BS::Polygon_soup polygons{ { a, b, c, Point_3(-1, 1, 0), Point_3(0.5, -0.5, 0.2) },
                             { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 0, 4 }, { 0, 2, 3 }, { 0, 2, 1 } } };
  const BS::Excised_soup_3 soup = excised(polygons, { 4 });
  REQUIRE(BS::check_excision(soup));
  CHECK(BS::check_replacement(soup, soup.mesh()));
  CHECK(replaced(soup, polygons.points, { { 0, 1, 2 }, { 0, 2, 3 } }) == Status::COMMON_FACET);
}

TEST_CASE("Check of a replacement: a vertex at a point that only excised triangles use is found")
{
  const BS::Excised_soup_3 soup = square_with(a, b, up);
  CHECK(replaced(soup, corners_and(Point_3(0, 0, 0.5)), four) == Status::VALID);
  CHECK(replaced(soup, corners_and(up), four) == Status::COMMON_FACET); // and so is a facet with it
  const BS::Excised_soup_3 apart = square_with(Point_3(2, 2, 2), Point_3(3, 2, 2), up);
  CHECK(replaced(apart, square().points, four) == Status::VALID);
  CHECK(replaced(apart, corners_and(up), four) == Status::COMMON_COORDINATES);
}

TEST_CASE("Check of a replacement: meshes that are not an oriented manifold by their coordinates are rejected")
{
  const BS::Excised_soup_3 soup = square_with(a, b, up);
  // The middle, twice at the same place: as two vertices, the facets look like a manifold.
  std::vector<Point_3> twice = square().points;
  twice.push_back(middle);
  CHECK(replaced(soup, twice, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 5 }, { 3, 0, 5 } }) == Status::EQUAL_POINTS);
  Mesh quadrangle;
  std::vector<Mesh::Vertex_index> v;
  for(std::size_t n = 0; n < 4; ++n) v.push_back(quadrangle.add_vertex(square().points[n]));
  quadrangle.add_face(v[0], v[1], v[2], v[3]);
  CHECK(BS::check_replacement(soup, quadrangle).status == Status::REPEATED_CORNER);
}
} // namespace test_check_excision
