// An excised soup consists of the mesh of the kept triangles and of the excised triangles, with their contact.
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include "excised_soups.h"

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace test_Excised_soup_3 {
namespace {

using namespace excised_soups;

} // namespace

TEST_CASE("Excised soup: the mesh has the kept triangles and their points, in order")
{
  const BS::Excised_soup_3 soup = excised(square(), { 1 });
  REQUIRE(soup);
  CHECK(soup.excised_triangles() == std::vector<std::size_t>{ 1 });
  CHECK(soup.mesh().number_of_faces() == 3);
  CHECK(soup.mesh().number_of_vertices() == 5);
  const std::vector<std::size_t> kept{ 0, 2, 3 };
  std::size_t n = 0;
  for(auto f : soup.mesh().faces()) {
    CHECK(soup.triangle_of(f) == kept[n]);
    CHECK(soup.facet_of(kept[n++]) == f);
  }
  CHECK(soup.facet_of(1) == Mesh::null_face());
  for(auto v : soup.mesh().vertices()) {
    CHECK(soup.mesh().point(v) == soup.soup().points[soup.point_of(v)]);
    CHECK(soup.vertex_at(soup.point_of(v)) == v);
  }
}

TEST_CASE("Excised soup: points of excised triangles only have no vertex")
{
  const BS::Excised_soup_3 soup = excised(cube_with_fin(), { 12 });
  REQUIRE(soup);
  CHECK(soup.mesh().number_of_vertices() == 8);
  CHECK(soup.vertex_at(8) == Mesh::null_vertex());
}

TEST_CASE("Excised soup: inner vertices and edges of excised triangles are pins, those on the border are not")
{
  const BS::Excised_soup_3 fin = excised(cube_with_fin(), { 12 });
  REQUIRE(fin.pinned_vertices().size() == 2);
  REQUIRE(fin.pinned_edges().size() == 1);
  for(auto v : fin.pinned_vertices()) {
    CHECK(fin.mesh().point(v).x() == 0);
    CHECK(fin.mesh().point(v).y() == 0);
  }
  CHECK(fin.report().pinned_vertices == 2);
  CHECK(fin.report().pinned_edges == 1);

  const BS::Excised_soup_3 hole = excised(square(), { 1 });
  CHECK(hole.pinned_vertices().empty());
  CHECK(hole.pinned_edges().empty());

  // The inner edge between two border vertices is pinned, and its vertices are not.
  BS::Polygon_soup chord{ { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0), Point_3(0, 0, 1) },
                          { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 2, 4 } } };
  const BS::Excised_soup_3 hanging = excised(chord, { 2 });
  CHECK(hanging.pinned_vertices().empty());
  CHECK(hanging.pinned_edges().size() == 1);
}

TEST_CASE("Excised soup: a facet is reversed if its triangle is")
{
  BS::Polygon_soup polygons = square();
  polygons.polygons[2] = { 2, 4, 3 };
  BS::Soup_triangles triangles = BS::different_triangles(polygons);
  const BS::Excised_soup_3 soup(triangles, std::vector<BS::Excision_reason>(4, BS::Excision_reason::KEPT),
                                { 0, 0, 1, 0 });
  REQUIRE(soup);
  CHECK(soup.report().reversed == 1);
  CHECK(soup.mesh().number_of_faces() == 4);
  CHECK(soup.soup().triangles[2] == BS::Soup_triangles::Triangle{ 2, 4, 3 });
  const auto h = soup.mesh().halfedge(soup.facet_of(2));
  CHECK(CGAL::orientation(Point_3(0, 0, -1), soup.mesh().point(soup.mesh().source(h)),
                          soup.mesh().point(soup.mesh().target(h)),
                          soup.mesh().point(soup.mesh().target(soup.mesh().next(h))))
        == CGAL::POSITIVE);
  CHECK_FALSE(
    BS::Excised_soup_3(triangles, std::vector<BS::Excision_reason>(4, BS::Excision_reason::KEPT), { 0, 0, 0, 0 }));
}

TEST_CASE("Excised soup: the report counts triangles by reason, and measures their share of the area")
{
  const BS::Excised_soup_3 fin = excised(cube_with_fin(), { 12 });
  const double area = std::sqrt(2.) / 2;
  CHECK(fin.report().triangles == 13);
  CHECK(fin.report().excised == 1);
  CHECK(fin.report().number_of(BS::Excision_reason::INTERSECTING) == 1);
  CHECK(fin.report().number_of(BS::Excision_reason::KEPT) == 12);
  CHECK(fin.report().excised_area == Approx(area / (6 + area)));
  CHECK(BS::message(excised(square(), { 1 }).report())
        == "1 of 4 triangles (25 % of the area) is excised, and stays exactly as it is: 1 intersecting.");
  CHECK(BS::message(excised(square(), { 1, 2 }).report())
        == "2 of 4 triangles (50 % of the area) are excised, and stay exactly as they are: 2 intersecting.");
}

TEST_CASE("Excised soup: each reason has a name of its own")
{
  std::vector<std::string> names;
  for(std::size_t n = 0; n < BS::number_of_excision_reasons; ++n) names.push_back(name(BS::Excision_reason(n)));
  std::sort(names.begin(), names.end());
  CHECK_FALSE(names.front().empty());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}
} // namespace test_Excised_soup_3
