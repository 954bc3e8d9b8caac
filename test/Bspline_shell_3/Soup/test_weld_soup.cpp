// Cracks of a polygon soup are closed where points differ by rounding. Anything that a check rejects stays as it is.
#include <CGAL/Bspline_shell_3/Soup/repair_and_weld.h>
#include <CGAL/Bspline_shell_3/Soup/weld_soup.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace test_weld_soup {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace PMP = CGAL::Polygon_mesh_processing;
typedef std::vector<std::size_t> Polygon;

BS::Weld_parameters within(double tolerance)
{
  BS::Weld_parameters parameters;
  parameters.tolerance = tolerance;
  return parameters;
}

BS::Weld_report report_of(const BS::Polygon_soup& soup, const BS::Weld_parameters& parameters)
{
  return BS::weld_soup(soup, parameters).report;
}

void add(BS::Polygon_soup& soup, const std::vector<Point_3>& points, const BS::Polygon_soup::Polygons& polygons)
{
  const std::size_t first = soup.points.size();
  soup.points.insert(soup.points.end(), points.begin(), points.end());
  for(Polygon polygon : polygons) {
    for(std::size_t& p : polygon) p += first;
    soup.polygons.push_back(polygon);
  }
}

// Returns a unit square (points 0 to 3) and a rectangle beside it (points 4 to 7). There is a gap between the points 1
// and 2 of the square and 4 and 7 of the rectangle.
BS::Polygon_soup cracked_sheet(double gap, double height = 0, double width = 1)
{
  BS::Polygon_soup soup;
  add(soup, { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0) }, { { 0, 1, 2 }, { 0, 2, 3 } });
  add(soup,
      { Point_3(1 + gap, 0, height), Point_3(1 + width, 0, 0), Point_3(1 + width, 1, 0), Point_3(1 + gap, 1, height) },
      { { 0, 1, 2 }, { 0, 2, 3 } });
  return soup;
}

// Returns the triangles of a mesh, each with its own corners, which are rounded to values near to them.
BS::Polygon_soup rounded_facets(const Mesh& mesh, const std::function<double(double)>& round)
{
  BS::Polygon_soup soup;
  for(auto f : mesh.faces()) {
    soup.polygons.emplace_back();
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      soup.polygons.back().push_back(soup.points.size());
      const Point_3& p = mesh.point(v);
      soup.points.emplace_back(round(p.x()), round(p.y()), round(p.z()));
    }
  }
  return soup;
}

// Returns a function that rounds to one of the `float`s next to a number, as different exporters do.
std::function<double(double)> to_near_float()
{
  return [random = std::mt19937(7)](double x) mutable {
    const float y = float(x);
    return double(random() % 4 == 0 ? std::nextafter(y, y + 1) : y);
  };
}

// Returns a function that sometimes changes the last digit of a number.
std::function<double(double)> to_near_double()
{
  return [random = std::mt19937(7)](double x) mutable { return random() % 4 == 0 ? std::nextafter(x, x + 1) : x; };
}

// Returns a function that rounds to decimal numbers, and sometimes changes their last digit.
std::function<double(double)> to_near_decimal(int significant_digits)
{
  return [=, random = std::mt19937(7)](double x) mutable {
    char text[32];
    std::snprintf(text, sizeof text, "%.*e", significant_digits - 1, x);
    const double y = std::strtod(text, nullptr);
    if(y == 0 || random() % 4 != 0) return y;
    std::snprintf(text, sizeof text, "%.*e", significant_digits - 1,
                  y + std::pow(10., std::floor(std::log10(std::abs(y))) + 1 - significant_digits));
    return std::strtod(text, nullptr);
  };
}

// Returns a cube with a side of 100, turned so that few coordinates are decimal numbers, with 12 * 4^levels facets.
Mesh turned_cube(int levels)
{
  Mesh mesh = box(Point_3(0, 0, 0), Point_3(100, 100, 100));
  for(int n = 0; n < levels; ++n) mesh = subdivided(mesh);
  const double c = std::cos(0.3), s = std::sin(0.3);
  return mapped(mesh, [&](const Point_3& p) { return Point_3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()); });
}

BS::Shell_of_soup_3 repaired_and_welded(const BS::Polygon_soup& soup, const BS::Weld_parameters& parameters = {})
{
  BS::Shell_of_soup_3 result;
  BS::internal::repair_and_weld(soup, parameters, result);
  return result;
}

} // namespace

TEST_CASE("Weld: close border vertices become the first of them, and the polygons remember where they come from")
{
  const BS::Polygon_soup soup = cracked_sheet(0.005);
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.soup.points == soup.points);
  CHECK(welded.soup.polygons == BS::Polygon_soup::Polygons{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 5, 6 }, { 1, 6, 2 } });
  CHECK(welded.provenance.polygon_of == Polygon{ 0, 1, 2, 3 });
  typedef BS::Weld_change C;
  CHECK(welded.provenance.change == std::vector<C>{ C::NONE, C::NONE, C::MOVED, C::MOVED });
  CHECK(welded.report.tolerance == 0.01);
  CHECK(welded.report.welded_points == 2);
  CHECK(welded.report.split_edges == 0);
  CHECK(welded.report.undone_clusters == 0);
  CHECK(welded.report.border_edges_before == 8);
  CHECK(welded.report.border_edges_after == 6);
  CHECK(message(welded.report) == "2 points were welded (within 0.01): 6 of 8 border edges remain.");

  const BS::Welded_soup other = BS::weld_soup(soup, within(0.004));
  CHECK(other.report.is_none());
  CHECK(other.report.undone_clusters == 0);
  CHECK(other.soup.polygons == soup.polygons);
  CHECK(other.provenance.polygon_of == Polygon{ 0, 1, 2, 3 });
  CHECK(message(other.report).empty());
}

TEST_CASE("Weld: polygons with more corners are triangulated if they change, and equal points are one point")
{
  BS::Polygon_soup soup = cracked_sheet(0.005);
  soup.polygons = { { 0, 0, 1 }, { 0, 1, 2, 3 }, { 4, 5, 6, 8 }, { 3, 2, 9, 10 } };
  soup.points.push_back(soup.points[7]);
  soup.points.emplace_back(1, 2, 0);
  soup.points.emplace_back(0, 2, 0);
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.report.welded_points == 2);
  CHECK(welded.provenance.polygon_of == Polygon{ 1, 2, 2, 3 });
  REQUIRE(welded.soup.polygons.size() == 4);
  CHECK(welded.soup.polygons[0] == Polygon{ 0, 1, 2, 3 });
  CHECK(welded.soup.polygons[1].size() == 3);
  CHECK(welded.soup.polygons[2].size() == 3);
  CHECK(welded.soup.polygons[3] == Polygon{ 3, 2, 9, 10 });
}

TEST_CASE("Weld: points of a chain that is longer than the tolerance remain")
{
  // Three triangles around a center, each with its own center.
  BS::Polygon_soup soup;
  for(int n = 0; n < 3; ++n) soup.points.emplace_back(0.008 * n, 0, 0);
  for(double angle : { 90, 210, 330 })
    soup.points.emplace_back(std::cos(angle * CGAL_PI / 180), std::sin(angle * CGAL_PI / 180), 0);
  soup.polygons = { { 0, 3, 4 }, { 1, 4, 5 }, { 2, 5, 3 } };
  const BS::Weld_report chain = report_of(soup, within(0.01));
  CHECK(chain.is_none());
  CHECK(chain.undone_clusters == 1);
  const BS::Weld_report cluster = report_of(soup, within(0.0161));
  CHECK(cluster.welded_points == 2);
  CHECK(cluster.border_edges_after == 3);
}

TEST_CASE("Weld: two points of one facet do not become one")
{
  BS::Polygon_soup soup = cracked_sheet(0.003);
  soup.points.emplace_back(1.003, 0.005, 0);
  soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 8 }, { 8, 5, 6 }, { 8, 6, 7 } };
  BS::Polygon_soup two = soup; // the other sheet can be welded
  for(Point_3& p : two.points) p = p + Vector_3(0, 0, 1);
  add(two, cracked_sheet(0.003).points, cracked_sheet(0.003).polygons);
  const BS::Weld_report report = report_of(two, within(0.01));
  CHECK(report.welded_points == 2);
  CHECK(report.undone_clusters == 2); // the points 2 and 7 alone do not close an edge
  // With a smaller tolerance, the third point splits an edge.
  const BS::Weld_report finer = report_of(soup, within(0.004));
  CHECK(finer.welded_points == 2);
  CHECK(finer.split_edges == 1);
  CHECK(finer.border_edges_after == 6);
}

TEST_CASE("Weld: a vertex that is not on the border remains")
{
  // A third sheet has an inner vertex near the crack.
  BS::Polygon_soup soup = cracked_sheet(0.005);
  add(soup,
      { Point_3(1.002, 0, 0.002), Point_3(0.5, -0.5, 0.3), Point_3(1.5, -0.5, 0.3), Point_3(1.5, 0.5, 0.3),
        Point_3(0.5, 0.5, 0.3) },
      { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } });
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.report.welded_points == 2);
  CHECK(welded.soup.polygons[4] == soup.polygons[4]);
}

TEST_CASE("Weld: points remain if no border edge is closed")
{
  BS::Polygon_soup soup;
  add(soup, { Point_3(0, 0, 0), Point_3(-1, -1, 0), Point_3(-1, 1, 0) }, { { 0, 2, 1 } });
  add(soup, { Point_3(0.005, 0, 0), Point_3(1, -1, 0), Point_3(1, 1, 0) }, { { 0, 1, 2 } });
  const BS::Weld_report report = report_of(soup, within(0.01));
  CHECK(report.is_none());
  CHECK(report.undone_clusters == 1);
}

TEST_CASE("Weld: an edge gets neither a third facet nor two of the same orientation")
{
  const auto book = [](int pages) {
    BS::Polygon_soup soup;
    for(int n = 0; n < pages; ++n) {
      const double a = 2 * n;
      add(soup, { Point_3(0.003 * n, 0, 0), Point_3(0.003 * n, 0, 1), Point_3(std::cos(a), std::sin(a), 0.5) },
          { n == 1 ? Polygon{ 0, 2, 1 } : Polygon{ 0, 1, 2 } });
    }
    return soup;
  };
  CHECK(report_of(book(2), within(0.01)).border_edges_after == 4);
  const BS::Weld_report three = report_of(book(3), within(0.01));
  CHECK(three.is_none());
  CHECK(three.undone_clusters == 2);
  BS::Polygon_soup same = book(2);
  std::reverse(same.polygons[0].begin(), same.polygons[0].end());
  CHECK(report_of(same, within(0.01)).is_none());
}

TEST_CASE("Weld: the facets at a vertex form one fan, or its points remain")
{
  BS::Polygon_soup soup = cracked_sheet(0.005);
  add(soup, { Point_3(1, -0.003, 0), Point_3(1, -1, 0.5), Point_3(0.8, -1, 0.5) }, { { 0, 1, 2 } });
  const BS::Weld_report report = report_of(soup, within(0.01));
  CHECK(report.is_none());
  CHECK(report.undone_clusters == 2);
}

TEST_CASE("Weld: two facets do not get the same corners")
{
  BS::Polygon_soup soup;
  add(soup, { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0) }, { { 0, 1, 2 } });
  add(soup, { Point_3(0, 0, -0.005), Point_3(1, 0, -0.005), Point_3(0, 1, 0.005) }, { { 0, 2, 1 } }); // they intersect
  const BS::Weld_report report = report_of(soup, within(0.01));
  CHECK(report.is_none());
  CHECK(report.undone_clusters == 3);
}

TEST_CASE("Weld: normals turn by less than ten degrees")
{
  // The points of the strip, which is 0.02 wide, move by its slope.
  CHECK(report_of(cracked_sheet(0, 0.02 * std::tan(9.5 * CGAL_PI / 180), 0.02), within(0.01)).welded_points == 2);
  const BS::Weld_report report = report_of(cracked_sheet(0, 0.02 * std::tan(10.5 * CGAL_PI / 180), 0.02), within(0.01));
  CHECK(report.is_none());
  CHECK(report.undone_clusters == 2);
}

TEST_CASE("Weld: a facet does not turn over, and keeps its area")
{
  // The third corner of a facet at the crack is `x` on its right.
  const auto weld = [](double x) {
    BS::Polygon_soup soup = cracked_sheet(-0.006);
    soup.points[5] = Point_3(x, 0.5, 0);
    soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 2 } };
    return report_of(soup, within(0.01));
  };
  CHECK(weld(1.3).welded_points == 1);
  CHECK(weld(1).is_none());
  CHECK(weld(0.9985).is_none());
}

TEST_CASE("Weld: polygons that did not intersect do not intersect afterwards")
{
  const auto with_blade = [](double x) {
    BS::Polygon_soup soup = cracked_sheet(0.005);
    add(soup, { Point_3(x, 0.4, 0.3), Point_3(x, 0.6, 0.3), Point_3(x, 0.5, -0.3) }, { { 0, 1, 2 } });
    return soup;
  };
  const BS::Weld_report in_gap = report_of(with_blade(1.0025), within(0.01));
  CHECK(in_gap.is_none());
  CHECK(in_gap.undone_clusters == 2);
  CHECK(report_of(with_blade(1.5), within(0.01)).welded_points == 2); // intersects a changed facet already
  CHECK(report_of(with_blade(2.5), within(0.01)).welded_points == 2);
}

TEST_CASE("Weld: only the cluster that causes an intersection is undone")
{
  // Two sheets, one above the other; a blade stands in the gap of the first.
  BS::Polygon_soup soup = cracked_sheet(0.005);
  add(soup, { Point_3(1.0025, 0.4, 0.3), Point_3(1.0025, 0.6, 0.3), Point_3(1.0025, 0.5, -0.3) }, { { 0, 1, 2 } });
  BS::Polygon_soup upper = cracked_sheet(0.005);
  for(Point_3& p : upper.points) p = p + Vector_3(0, 0, 1);
  add(soup, upper.points, upper.polygons);
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.report.welded_points == 2);
  CHECK(welded.report.undone_clusters == 2);
  CHECK(welded.soup.polygons[2] == soup.polygons[2]);
  CHECK(welded.soup.polygons[7] == Polygon{ 12, 16, 17 });
}

TEST_CASE("Weld: border vertices on a border edge split it")
{
  BS::Polygon_soup soup = cracked_sheet(0.005);
  soup.points.emplace_back(1.005, 0.3, 0);
  soup.points.emplace_back(0.995, 0.7, 0);
  soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 8 }, { 8, 5, 6 }, { 8, 6, 9 }, { 9, 6, 7 } };
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.report.welded_points == 2);
  CHECK(welded.report.split_edges == 1);
  CHECK(welded.report.border_edges_before == 10);
  CHECK(welded.report.border_edges_after == 6);
  CHECK(welded.provenance.polygon_of == Polygon{ 0, 0, 0, 1, 2, 3, 4, 5 });
  CHECK(std::count(welded.provenance.change.begin(), welded.provenance.change.end(), BS::Weld_change::SPLIT) == 3);
  CHECK(message(welded.report)
        == "2 points were welded and 1 edge was split (within 0.01): 6 of 10 border edges remain.");
  const BS::Shell_of_soup_3 result = repaired_and_welded(soup, within(0.01));
  REQUIRE(result.mesh_status == BS::Shell_status::SUCCESS);
  CHECK(result.repaired_mesh.number_of_faces() == 8);
  CHECK(PMP::area(result.repaired_mesh) == Approx(2).epsilon(0.01));
  CHECK(PMP::number_of_borders(result.repaired_mesh) == 1);
}

TEST_CASE("Weld: both sides of a crack may be split, and several sides of one triangle")
{
  // The vertices of the two sides alternate.
  BS::Polygon_soup soup;
  add(soup, { Point_3(0, 0.5, 0), Point_3(1, 0, 0), Point_3(1, 0.6, 0), Point_3(1, 1, 0) },
      { { 0, 1, 2 }, { 0, 2, 3 } });
  add(soup, { Point_3(2, 0.5, 0), Point_3(1, 0, 0), Point_3(1, 0.4, 0), Point_3(1, 1, 0) },
      { { 0, 2, 1 }, { 0, 3, 2 } });
  const BS::Weld_report report = report_of(soup, within(0));
  CHECK(report.welded_points == 0);
  CHECK(report.split_edges == 2);
  CHECK(report.border_edges_after == 4);

  // Each side of a triangle meets a chain of three edges.
  BS::Polygon_soup star;
  const std::vector<Point_3> corners{ Point_3(0, 0, 0), Point_3(3, 0, 0), Point_3(0, 3, 0) };
  add(star, corners, { { 0, 1, 2 } });
  for(std::size_t i = 0; i < 3; ++i) {
    const Point_3 &p = corners[i], &q = corners[(i + 1) % 3];
    const Point_3 outside = p + (q - corners[(i + 2) % 3]);
    add(star, { outside, p, p + (q - p) / 3, p + 2 * (q - p) / 3, q }, { { 0, 2, 1 }, { 0, 3, 2 }, { 0, 4, 3 } });
  }
  const BS::Welded_soup welded = BS::weld_soup(star, within(1e-3));
  CHECK(welded.report.split_edges == 3);
  CHECK(welded.report.border_edges_after == 6);
  CHECK(std::count(welded.provenance.polygon_of.begin(), welded.provenance.polygon_of.end(), 0) == 7);
}

TEST_CASE("Weld: an edge is split only where this closes an edge")
{
  // The tip of a triangle touches the middle of an edge.
  BS::Polygon_soup tip{ { Point_3(0, 0, 0), Point_3(0, -1, 0), Point_3(0, 1, 0), Point_3(-1, 0, 0), Point_3(1, -1, 0),
                          Point_3(1, 1, 0) },
                        { { 1, 2, 3 }, { 0, 4, 5 } } };
  CHECK(report_of(tip, within(0.01)).is_none());
  // Of three vertices near an edge, one belongs to another sheet.
  BS::Polygon_soup soup = cracked_sheet(0.005);
  soup.points.emplace_back(1.005, 0.3, 0);
  soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 8 }, { 8, 5, 6 }, { 8, 6, 7 } };
  add(soup, { Point_3(1.001, 0.7, 0.005), Point_3(1.5, 0.8, 1), Point_3(1.5, 0.6, 1) }, { { 0, 1, 2 } });
  const BS::Welded_soup welded = BS::weld_soup(soup, within(0.01));
  CHECK(welded.report.border_edges_after == 9);
  CHECK(std::count(welded.provenance.polygon_of.begin(), welded.provenance.polygon_of.end(), 0) == 2);
}

TEST_CASE("Weld: an edge is split only by vertices that are close, and if normals turn by less than ten degrees")
{
  // One side of the edge has a vertex at a distance, the other side a facet of a certain width.
  const auto with_vertex = [](double x, double z, double width) {
    BS::Polygon_soup soup = cracked_sheet(0);
    soup.points[0] = Point_3(1 - width, 0, 0);
    soup.points[3] = Point_3(1 - width, 1, 0);
    soup.points.emplace_back(1 + x, 0.5, z);
    soup.polygons = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 5, 8 }, { 8, 5, 6 }, { 8, 6, 2 } };
    return soup;
  };
  CHECK(report_of(with_vertex(0.007, 0.007, 1), within(0.01)).split_edges == 1);
  CHECK(report_of(with_vertex(0.0075, 0.0075, 1), within(0.01)).is_none());
  CHECK(report_of(with_vertex(0, 0.009, 0.12), within(0.01)).split_edges == 1);
  CHECK(report_of(with_vertex(0, 0.009, 0.08), within(0.01)).is_none());
  BS::Polygon_soup two = with_vertex(0, 0.009, 0.08); // another sheet is still welded
  BS::Polygon_soup other = cracked_sheet(0.005);
  for(Point_3& p : other.points) p = p + Vector_3(0, 0, 1);
  add(two, other.points, other.polygons);
  CHECK(report_of(two, within(0.01)).split_edges == 0);
  CHECK(report_of(two, within(0.01)).welded_points == 2);
}

TEST_CASE("Weld: neighbors of different orientation and edges of three facets elsewhere do not matter")
{
  BS::Polygon_soup soup = cracked_sheet(0.005);
  std::reverse(soup.polygons[1].begin(), soup.polygons[1].end());
  CHECK(report_of(soup, within(0.01)).welded_points == 2);
}

TEST_CASE("Weld: the default distance is four units, reduced near short edges and for thin shells")
{
  // The coordinates are `float`s of up to 1024, at which the unit is 2^-13.
  const double unit = std::ldexp(1, -13);
  const auto strip = [&](double gap, double width) {
    BS::Polygon_soup soup = cracked_sheet(gap, 0, float(width));
    soup.points.emplace_back(1024, 0, 0);
    return soup;
  };
  BS::Weld_parameters parameters;
  CHECK(report_of(strip(4 * unit, 1), parameters).unit == unit);
  CHECK(report_of(strip(4 * unit, 1), parameters).tolerance == 4 * unit);
  CHECK(report_of(strip(4 * unit, 1), parameters).welded_points == 2);
  CHECK(report_of(strip(5 * unit, 1), parameters).is_none());
  CHECK(report_of(strip(4 * unit, 37 * unit), parameters).welded_points == 2); // shortest edge: 33 units
  CHECK(report_of(strip(4 * unit, 35 * unit), parameters).is_none());
  CHECK(report_of(strip(4 * unit, 35 * unit), within(4 * unit)).welded_points == 2);
  BS::Polygon_soup narrow = strip(4 * unit, 1);
  narrow.points[0] = Point_3(1 - 31 * unit, 0, 0);
  narrow.points[3] = Point_3(1 - 31 * unit, 1, 0);
  CHECK(report_of(narrow, parameters).is_none());
  parameters.thickness = 401 * unit;
  CHECK(report_of(strip(4 * unit, 1), parameters).welded_points == 2);
  CHECK_FALSE(report_of(strip(4 * unit, 1), parameters).is_too_coarse);
  parameters.thickness = 399 * unit;
  CHECK(report_of(strip(4 * unit, 1), parameters).is_none());
  CHECK_FALSE(report_of(strip(4 * unit, 1), parameters).is_too_coarse);
  parameters.thickness = 101 * unit;
  CHECK(report_of(strip(unit, 1), parameters).welded_points == 2);
  parameters.thickness = 99 * unit;
  const BS::Weld_report coarse = report_of(strip(unit, 1), parameters);
  CHECK(coarse.is_none());
  CHECK(coarse.is_too_coarse);
  CHECK(message(coarse).find("subtract an offset") != std::string::npos);
}

TEST_CASE("Weld: a tolerance that connects too many points welds nothing")
{
  const BS::Polygon_soup soup = rounded_facets(sphere(3), to_near_float());
  const BS::Weld_report report = report_of(soup, within(10));
  CHECK(report.is_none());
  CHECK(report.border_edges_after == report.border_edges_before);
}

TEST_CASE("Weld: a cube whose facets were rounded one by one is closed again")
{
  for(const auto& round : { to_near_float(), to_near_decimal(7), to_near_double() }) {
    const BS::Polygon_soup soup = rounded_facets(turned_cube(2), round);
    const BS::Shell_of_soup_3 result = repaired_and_welded(soup);
    REQUIRE(result.mesh_status == BS::Shell_status::SUCCESS);
    CHECK(CGAL::is_closed(result.repaired_mesh));
    CHECK(result.repaired_mesh.number_of_faces() == 12 * 16);
    CHECK(PMP::volume(result.repaired_mesh) == Approx(1e6).epsilon(1e-5));
    CHECK(result.weld.welded_points > 50);
    CHECK(result.weld.border_edges_after == 0);
    CHECK(result.weld.undone_clusters == 0);
    CHECK(result.weld_provenance.polygon_of.size() == soup.polygons.size());
    CHECK(result.repairs.merged_points > 0);
    CHECK(result.offending_simplices.facets.empty());
    CHECK(result.offending_simplices.vertices.empty());
  }
}

TEST_CASE("Weld: edges inside of the soup are not counted as border edges")
{
  BS::Polygon_soup soup;
  for(int x = -4; x <= 4; ++x)
    for(int y = -4; y <= 4; ++y) soup.points.emplace_back(x, y, 0);
  for(std::size_t i = 0; i < 8; ++i)
    for(std::size_t j = 0; j < 8; ++j) {
      const std::size_t p = 9 * i + j;
      soup.polygons.push_back({ p, p + 9, p + 10 });
      soup.polygons.push_back({ p, p + 10, p + 1 });
    }
  const std::size_t center = 40, copy = soup.points.size();
  soup.points.push_back(soup.points[center] + Vector_3(0.005, 0, 0));
  const auto at_center = std::find_if(soup.polygons.begin(), soup.polygons.end(), [&](const Polygon& t) {
    return std::find(t.begin(), t.end(), center) != t.end();
  });
  std::replace(at_center->begin(), at_center->end(), center, copy);
  const BS::Weld_report report = report_of(soup, within(0.01));
  CHECK(report.welded_points == 1);
  CHECK(report.border_edges_before == 32 + 4);
  CHECK(report.border_edges_after == 32);
}

TEST_CASE("Weld: a cube whose sides are triangulated differently is closed again")
{
  // Half of the sides are finer, so that their vertices lie on edges of the others.
  const Mesh coarse = turned_cube(1), fine = turned_cube(2);
  BS::Polygon_soup soup;
  const auto round = to_near_float();
  for(const auto& [mesh, is_fine] : { std::make_pair(&coarse, false), std::make_pair(&fine, true) }) {
    Mesh part = *mesh;
    const bool keep = is_fine;
    remove_facets(part, [&](const Point_3& c) { return (c.z() < 1e-6 || c.z() > 100 - 1e-6) != keep; });
    const BS::Polygon_soup facets = rounded_facets(part, round);
    add(soup, facets.points, facets.polygons);
  }
  const BS::Shell_of_soup_3 result = repaired_and_welded(soup);
  REQUIRE(result.mesh_status == BS::Shell_status::SUCCESS);
  CHECK(CGAL::is_closed(result.repaired_mesh));
  CHECK(result.weld.split_edges == 16);
  CHECK(PMP::volume(result.repaired_mesh) == Approx(1e6).epsilon(1e-5));
}

TEST_CASE("Weld: coordinates that are too coarse close nothing")
{
  // A ball of 200 m, with geocentric coordinates in `float`s.
  const BS::Polygon_soup soup = rounded_facets(sphere(3, 100, Point_3(4e6, 5e6, 3e6)), to_near_float());
  const BS::Weld_report report = report_of(soup, BS::Weld_parameters());
  CHECK(report.unit == 0.5);
  CHECK(report.is_too_coarse);
  CHECK(report.is_none());
}

TEST_CASE("Weld: closed meshes are not examined, and holes remain")
{
  BS::Polygon_soup soup = rounded_facets(sphere(2), [](double x) { return x; });
  const BS::Shell_of_soup_3 closed = repaired_and_welded(soup);
  CHECK(closed.weld.unit == 0);
  Mesh mesh;
  BS::Soup_repairs repairs;
  BS::Offending_simplices offenders;
  BS::repair_soup(soup, mesh, repairs, offenders);
  CHECK(is_equal(closed.repaired_mesh, mesh));
  soup.polygons.pop_back();
  const BS::Shell_of_soup_3 open = repaired_and_welded(soup);
  CHECK(open.mesh_status == BS::Shell_status::SUCCESS);
  CHECK(open.weld.is_none());
  CHECK(open.weld.border_edges_before == 3);
  CHECK(open.weld_provenance.polygon_of.empty());
}

TEST_CASE("Weld: if the welded soup is not a mesh, the soup is not welded")
{
  BS::Polygon_soup soup = cracked_sheet(0.005);
  add(soup, { Point_3(5, 0, 0), Point_3(6, 0, 0), Point_3(5, 1, 0), Point_3(5, 0, 1), Point_3(5, -1, -1) },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } });
  const BS::Shell_of_soup_3 result = repaired_and_welded(soup, within(0.01));
  CHECK(result.mesh_status == BS::Shell_status::NON_MANIFOLD);
  CHECK(result.weld.is_none());
  CHECK(result.offending_simplices.facets == Polygon{ 4, 5, 6 });
}
} // namespace test_weld_soup
