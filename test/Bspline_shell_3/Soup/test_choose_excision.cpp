// Few triangles are excised, and the others are an embedded manifold that can be closed.
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include "excised_soups.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace test_choose_excision {
namespace {

using namespace excised_soups;
typedef BS::Excision_reason Reason;

// Returns the excision, and checks the properties of all results.
BS::Excised_soup_3 checked(const BS::Polygon_soup& soup)
{
  BS::Excised_soup_3 result = chosen(soup);
  REQUIRE(result);
  CHECK(BS::check_excision(result));
  CHECK(BS::check_replacement(result, result.mesh()));
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(result.mesh()));
  return result;
}

BS::Polygon_soup joined_soup(const Mesh& a, const Mesh& b)
{
  return soup_of(joined(a, b)); // equal points are merged by `different_triangles()`
}

} // namespace

TEST_CASE("Choice of an excision: a sound mesh is kept, closed or open")
{
  for(const Mesh& mesh :
      { sphere(2), box(Point_3(0, 0, 0), Point_3(1, 2, 3)), sheet(steps(0, 1, 4), steps(0, 1, 4)) }) {
    const BS::Excised_soup_3 soup = checked(soup_of(mesh));
    CHECK(soup.report().excised == 0);
    CHECK(soup.report().reversed == 0);
    CHECK(is_equal(soup.mesh(), checked(soup_of(soup.mesh())).mesh()));
  }
}

TEST_CASE("Choice of an excision: equal points are merged, duplicates represented, and polygons triangulated")
{
  BS::Polygon_soup soup;
  add_triangle(soup, Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0));
  add_triangle(soup, Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(0, 0, 0)); // equal, but it begins at another corner
  add_triangle(soup, Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0));
  soup.polygons.push_back({ 6, 6, 7 }); // no triangle
  soup.points.insert(soup.points.end(), { Point_3(2, 0, 0), Point_3(2, 1, 0) });
  soup.polygons.push_back({ 6, 9, 10, 7 });
  const BS::Soup_triangles triangles = BS::different_triangles(soup);
  CHECK(triangles.points.size() == 6);
  CHECK(triangles.polygon_of == std::vector<std::size_t>{ 0, 2, 4, 4 });
  CHECK(triangles.duplicates == std::vector<std::pair<std::size_t, std::size_t> >{ { 1, 0 } });
  CHECK(triangles.point_of == std::vector<std::size_t>{ 0, 1, 2, 7, 9, 10 });
  const BS::Excised_soup_3 result = checked(soup);
  CHECK(result.report().excised == 0);
  CHECK(result.report().duplicates == 1);
}

TEST_CASE("Choice of an excision: a fin at an inner edge is excised, and the edge is pinned")
{
  const BS::Excised_soup_3 soup = checked(cube_with_fin());
  CHECK(soup.excised_triangles() == std::vector<std::size_t>{ 12 });
  CHECK(soup.reasons()[12] == Reason::NON_MANIFOLD);
  CHECK(CGAL::is_closed(soup.mesh()));
  CHECK(soup.pinned_edges().size() == 1);
}

TEST_CASE("Choice of an excision: of three facets at an edge, the flattest two of the largest component remain")
{
  const auto page = [](double angle, double width) {
    return Point_3(width * std::cos(angle), width * std::sin(angle), 0.5);
  };
  const Point_3 p(0, 0, 0), q(0, 0, 1);
  BS::Polygon_soup soup;
  add_triangle(soup, p, q, page(0, 2)); // the largest
  add_triangle(soup, q, p, page(2, 1));
  add_triangle(soup, q, p, page(3, 1));
  CHECK(checked(soup).excised_triangles() == std::vector<std::size_t>{ 1 });
}

TEST_CASE(
  "Choice of an excision: a large triangle at an edge or a vertex of small facets is excised, rather than these")
{
  const Mesh fine = sphere(3);
  const std::size_t size = fine.number_of_faces();
  const auto h = fine.halfedge(Mesh::Face_index(0));
  const Point_3 p = fine.point(fine.source(h)), q = fine.point(fine.target(h));
  const Point_3 far = CGAL::ORIGIN + 2 * (p - CGAL::ORIGIN);
  BS::Polygon_soup at_edge = soup_of(fine), at_vertex = at_edge;
  add_triangle(at_edge, p, q, far);
  add_triangle(at_vertex, p, far, CGAL::ORIGIN + 2 * (q - CGAL::ORIGIN));
  for(const BS::Polygon_soup& soup : { at_edge, at_vertex })
    CHECK(checked(soup).excised_triangles() == std::vector<std::size_t>{ size });
  BS::Polygon_soup at_border = soup_of(sheet(steps(0, 1, 20), steps(0, 1, 20)));
  add_triangle(at_border, Point_3(0.5, 0, 0), Point_3(0.4, -1, 0), Point_3(0.6, -1, 0));
  CHECK(checked(at_border).excised_triangles() == std::vector<std::size_t>{ 800 });
}

TEST_CASE("Choice of an excision: of two cubes with a common edge or vertex, one remains whole")
{
  const Mesh cube = box(Point_3(0, 0, 0), Point_3(1, 1, 1));
  for(double z : { 0., 1. }) {
    const BS::Excised_soup_3 soup = checked(joined_soup(cube, box(Point_3(1, 1, z), Point_3(2, 2, z + 1))));
    CHECK(soup.report().excised
          == soup.report().number_of(Reason::NON_MANIFOLD) + soup.report().number_of(Reason::STEEP_BORDER));
    std::size_t of_first = 0, of_second = 0;
    for(std::size_t t : soup.excised_triangles()) (t < 12 ? of_first : of_second) += 1;
    CHECK((of_first == 0) != (of_second == 0));
    CHECK(soup.report().excised >= 3);
  }
}

TEST_CASE("Choice of an excision: two holes that touch at a vertex lose the smaller fan there")
{
  Mesh mesh = sheet(steps(0, 6, 6), steps(0, 6, 6));
  remove_facets(mesh, [](const Point_3& p) {
    return (p.x() > 2 && p.x() < 3 && p.y() > 2 && p.y() < 3) || (p.x() > 3 && p.x() < 4 && p.y() > 3 && p.y() < 4);
  });
  const BS::Excised_soup_3 soup = checked(soup_of(mesh));
  CHECK(soup.report().excised == soup.report().number_of(Reason::NON_MANIFOLD));
  CHECK(soup.report().excised <= 2);
  CHECK(soup.report().excised > 0);
}

TEST_CASE("Choice of an excision: one facet of each intersecting pair is excised, with the least total area")
{
  // A dent that is pushed through the opposite side.
  const Mesh dented = mapped(sphere(3),
                             [](const Point_3& p) { return p.z() > 0.9 ? Point_3(p.x(), p.y(), p.z() - 2.5) : p; });
  const BS::Excised_soup_3 soup = checked(soup_of(dented));
  std::size_t intersecting = 0;
  std::vector<char> offends(soup.soup().triangles.size(), 0);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index> > pairs;
  CGAL::Polygon_mesh_processing::self_intersections(dented, std::back_inserter(pairs));
  for(const auto& pair : pairs) offends[pair.first] = offends[pair.second] = 1;
  for(char o : offends) intersecting += std::size_t(o);
  CHECK(soup.report().number_of(Reason::INTERSECTING) > 0);
  CHECK(soup.report().number_of(Reason::INTERSECTING) <= intersecting / 2);
  CHECK(soup.report().excised_area < 0.25);

  // One triangle through many: it is excised alone if it is smaller than all of them together.
  BS::Polygon_soup stabbed = soup_of(sheet(steps(0, 1, 20), steps(0, 1, 20)));
  add_triangle(stabbed, Point_3(0.2, 0.41, -0.01), Point_3(0.8, 0.41, -0.01), Point_3(0.5, 0.41, 0.01));
  CHECK(checked(stabbed).excised_triangles() == std::vector<std::size_t>{ 800 });

  // A stray triangle through one facet that has half its area and three neighbors.
  BS::Polygon_soup pierced = soup_of(sheet(steps(0, 3, 3), steps(0, 3, 3)));
  add_triangle(pierced, Point_3(1.6, 1.3, -1), Point_3(1.8, 1.3, -1), Point_3(1.7, 1.3, 9));
  CHECK(checked(pierced).excised_triangles() == std::vector<std::size_t>{ 18 });
}

TEST_CASE("Choice of an excision: triangles that lie upon each other, or touch, intersect")
{
  BS::Polygon_soup soup;
  add_triangle(soup, Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(0, 4, 0));
  add_triangle(soup, Point_3(1, 1, 0), Point_3(2, 1, 0), Point_3(1, 2, 0));       // within the first one
  add_triangle(soup, Point_3(4, 0, 0), Point_3(0, 0, 0), Point_3(0.1, 3, 0));     // over a common edge
  add_triangle(soup, Point_3(1, 0.5, 0), Point_3(1, 1, 1), Point_3(2, 1, 1));     // touches the first one
  CHECK(chosen(soup).excised_triangles() == std::vector<std::size_t>{ 1, 2, 3 }); // less area than 0 and 2
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(chosen(soup).mesh()));
}

TEST_CASE("Choice of an excision: a triangle without area is excised, and its contact remains")
{
  BS::Polygon_soup soup = square();
  add_triangle(soup, Point_3(-1, -1, 0), Point_3(0, 0, 0), Point_3(1, 1, 0));
  const BS::Excised_soup_3 result = checked(soup);
  CHECK(result.excised_triangles() == std::vector<std::size_t>{ 4 });
  CHECK(result.reasons()[4] == Reason::NO_AREA);
  CHECK(result.report().excised_area == 0);
  CHECK(result.pinned_vertices().size() == 1);
  CHECK(result.pinned_edges().size() == 2);
}

TEST_CASE("Choice of an excision: triangles are oriented like most of their component")
{
  BS::Polygon_soup soup = soup_of(sphere(1));
  for(std::size_t n : { 3, 10, 11 }) std::swap(soup.polygons[n][0], soup.polygons[n][1]);
  const BS::Excised_soup_3 result = checked(soup);
  CHECK(result.report().excised == 0);
  CHECK(result.report().reversed == 3);
  CHECK(result.is_reversed(10));
  CHECK(CGAL::is_closed(result.mesh()));
}

TEST_CASE("Choice of an excision: a non-orientable strip is cut")
{
  BS::Polygon_soup soup;
  constexpr std::size_t around = 24;
  for(std::size_t i = 0; i < around; ++i)
    for(double w : { -0.3, 0.3 }) {
      const double t = 2 * CGAL_PI * double(i) / around;
      soup.points.emplace_back((1 + w * std::cos(t / 2)) * std::cos(t), (1 + w * std::cos(t / 2)) * std::sin(t),
                               w * std::sin(t / 2));
    }
  for(std::size_t i = 0; i < around; ++i) {
    const std::size_t p = 2 * i, q = p + 1, r = i + 1 < around ? p + 2 : 1, s = i + 1 < around ? p + 3 : 0;
    soup.polygons.push_back({ p, r, s });
    soup.polygons.push_back({ p, s, q });
  }
  const BS::Excised_soup_3 result = checked(soup);
  CHECK(result.report().number_of(Reason::NOT_ORIENTABLE) == 1);
  CHECK(result.report().excised == 2); // the other half of its rectangle hangs at a vertex then
}

TEST_CASE("Choice of an excision: a border vertex whose fan cannot be completed is excised, an open one is not")
{
  // A ramp that winds once and a half around its axis.
  const auto ramp = [](double turns) {
    BS::Polygon_soup soup;
    soup.points.push_back(Point_3(0, 0, 0));
    constexpr std::size_t steps = 18;
    for(std::size_t n = 0; n <= steps; ++n) {
      const double t = 2 * CGAL_PI * turns * double(n) / steps;
      soup.points.emplace_back(std::cos(t), std::sin(t), 0.1 * t);
      if(n > 0) soup.polygons.push_back({ 0, n, n + 1 });
    }
    return soup;
  };
  CHECK(chosen(ramp(0.75)).report().excised == 0);
  const BS::Excised_soup_3 spiral = chosen(ramp(1.5));
  CHECK(spiral.report().number_of(Reason::STEEP_BORDER) > 0);
}

TEST_CASE("Choice of an excision: a pin at which facets face no common direction is excised")
{
  const Mesh cubes = screw();
  BS::Polygon_soup soup = soup_of(cubes);
  CHECK(checked(soup).report().excised == 0); // such a vertex without contact is truncated later
  add_triangle(soup, Point_3(1, 1, 1), Point_3(1.1, 1.2, 1.4), Point_3(1.2, 1.1, 1.4));
  const BS::Excised_soup_3 result = checked(soup);
  CHECK(result.report().number_of(Reason::SINGULAR_PIN) + result.report().number_of(Reason::INTERSECTING) > 0);
}

TEST_CASE("Choice of an excision: small pieces that excision separated are excised, and small components are kept")
{
  // A thin strip at the side of a sheet.
  BS::Polygon_soup soup = soup_of(sheet(steps(0, 10, 10), steps(0, 10, 10)));
  const std::size_t first = soup.polygons.size();
  for(int n = 0; n < 2; ++n) {
    const double x = 10 + 0.5 * n;
    add_triangle(soup, Point_3(x, 5, 0), Point_3(x + 0.5, 5, 0), Point_3(x, 6, 0));
    add_triangle(soup, Point_3(x + 0.5, 5, 0), Point_3(x + 0.5, 6, 0), Point_3(x, 6, 0));
  }
  const BS::Excised_soup_3 whole = checked(soup);
  CHECK(whole.report().excised == 0);
  const BS::Excised_soup_3 cut = BS::excise_also(whole, { first, first + 1 }, Reason::NOT_CLOSABLE);
  CHECK(cut.reasons()[first] == Reason::NOT_CLOSABLE);
  CHECK(cut.reasons()[first + 2] == Reason::FRAGMENT);
  CHECK(cut.reasons()[first + 3] == Reason::FRAGMENT);
  CHECK(cut.report().excised == 4);
  BS::Excision_parameters all;
  all.largest_fragment = 1e-9;
  CHECK(BS::excise_also(whole, { first, first + 1 }, Reason::NOT_CLOSABLE, all).report().excised == 2);

  const BS::Excised_soup_3 both = checked(soup_of(joined(sphere(2), sphere(0, 0.01, Point_3(3, 0, 0)))));
  CHECK(both.report().excised == 0);
}

TEST_CASE("Choice of an excision: reversed facets are those of the mesh with the opposite orientation")
{
  const BS::Excised_soup_3 soup = checked(soup_of(sphere(1)));
  const BS::Excised_soup_3 turned = BS::reverse_facets(soup,
                                                       { soup.mesh().faces().begin(), soup.mesh().faces().end() });
  CHECK(BS::check_excision(turned));
  CHECK(turned.report().reversed == 80);
  CHECK(turned.is_reversed(0));
}
} // namespace test_choose_excision
