// Polygons are triangulated without new vertices. The number of triangles is minimal; they have the orientation and the
// area of the polygon.
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace test_triangulate_polygon {
namespace BS = CGAL::Bspline_shells;

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Exact_predicates_exact_constructions_kernel Exact_kernel;
typedef Kernel::Point_2 Point_2;
typedef Kernel::Point_3 Point_3;
typedef std::vector<std::array<std::size_t, 3> > Triangles;

// Returns the polygon in a plane orthogonal to an axis, as seen against the axis.
std::vector<Point_3> across(int axis, const std::vector<Point_2>& polygon)
{
  std::vector<Point_3> points;
  for(const Point_2& p : polygon) {
    std::array<double, 3> x = {};
    x[(axis + 1) % 3] = p.x();
    x[(axis + 2) % 3] = p.y();
    points.emplace_back(x[0], x[1], x[2]);
  }
  return points;
}

Exact_kernel::FT doubled_area(const Point_2& p, const Point_2& q, const Point_2& r)
{
  const auto exact = [](const Point_2& x) { return Exact_kernel::Point_2(x.x(), x.y()); };
  return CGAL::determinant(exact(q) - exact(p), exact(r) - exact(p));
}

Exact_kernel::FT doubled_area(const std::vector<Point_2>& polygon)
{
  Exact_kernel::FT sum = 0;
  for(std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += doubled_area(polygon[0], polygon[i], polygon[i + 1]);
  return sum;
}

// Checks a triangulation: triangles are positive and sum to the area, and each inner edge is in two triangles.
void check_triangulation(const std::vector<Point_2>& polygon)
{
  const CGAL::Sign sign = CGAL::sign(doubled_area(polygon));
  REQUIRE(sign != CGAL::ZERO);
  for(int axis = 0; axis < 3; ++axis) {
    const Triangles triangles = BS::triangulate_polygon(across(axis, polygon));
    REQUIRE(triangles.size() == polygon.size() - 2);
    Exact_kernel::FT sum = 0;
    std::multiset<std::pair<std::size_t, std::size_t> > edges;
    for(const auto& t : triangles) {
      const auto area = doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
      CHECK(CGAL::sign(area) == sign);
      sum += area;
      for(int e = 0; e < 3; ++e) edges.emplace(t[e], t[(e + 1) % 3]);
    }
    CHECK(sum == doubled_area(polygon));
    for(const auto& e : edges) {
      CHECK(edges.count(e) == 1);
      CHECK(edges.count({ e.second, e.first }) + (e.second == (e.first + 1) % polygon.size()) == 1);
    }
    // Vertices that were cut off do not occur again.
    std::set<std::size_t> cut;
    for(const auto& t : triangles) {
      for(std::size_t i : t) CHECK(cut.count(i) == 0);
      cut.insert(t[1]);
    }
  }
}

} // namespace

TEST_CASE("Polygons: convex and non-convex polygons of either orientation are triangulated")
{
  const std::vector<double> x = { 0, 8, 8, 0, 0, 6, 6, 2, 2, 4, 4, 5, 5, 1, 1, 7, 7, 0 },
                            y = { 0, 0, 8, 8, 2, 2, 6, 6, 4, 4, 5, 5, 3, 3, 7, 7, 1, 1 };
  std::vector<Point_2> spiral;
  for(std::size_t n = 0; n < x.size(); ++n) spiral.emplace_back(x[n], y[n]);
  const std::vector<std::vector<Point_2> > polygons = {
    { { 0, 0 }, { 1, 0 }, { 0, 1 } },
    { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } },
    { { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 } },                                         // an arrow
    { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } }, // a U
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 1 }, { 0, 1 } },                     // straight corners
    { { 0, 0 }, { 2, 0 }, { 1, 1 }, { 0, 2 } },                                         // one straight corner
    spiral
  };
  for(std::vector<Point_2> polygon : polygons)
    for(int turned = 0; turned < 2; ++turned) {
      for(std::size_t shift = 0; shift < polygon.size(); ++shift) {
        check_triangulation(polygon);
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      }
      std::reverse(polygon.begin(), polygon.end());
    }
}

TEST_CASE("Polygons: star-shaped polygons with many spikes, and with straight corners, are triangulated")
{
  CGAL::Random random(3);
  for(int n : { 5, 12, 60, 300 })
    for(int repeat = 0; repeat < 8; ++repeat) {
      std::vector<Point_2> polygon;
      for(int i = 0; i < n; ++i) {
        const double angle = 2 * CGAL_PI * i / n, radius = random.get_double(0.1, 1);
        const Point_2 p(radius * std::cos(angle), radius * std::sin(angle));
        // on a grid, so that midpoints of edges are exact
        const auto rounded = [](double x) { return std::round(std::ldexp(x, 20)) / std::ldexp(1., 20); };
        polygon.emplace_back(rounded(p.x()), rounded(p.y()));
      }
      if(repeat % 2 == 1)
        for(std::size_t i = 0; i < polygon.size(); i += 2)
          polygon.insert(polygon.begin() + i + 1, CGAL::midpoint(polygon[i], polygon[(i + 1) % polygon.size()]));
      check_triangulation(polygon);
    }
}

TEST_CASE("Polygons: the better diagonal of a quadrangle is chosen")
{
  // Along the axis of this kite, the triangles would be needles.
  const Triangles triangles = BS::triangulate_polygon({ { 0, 0, 0 }, { 1, -0.1, 0 }, { 2, 0, 0 }, { 1, 0.1, 0 } });
  REQUIRE(triangles.size() == 2);
  for(const auto& t : triangles) {
    CHECK(std::count(t.begin(), t.end(), std::size_t(1)) == 1);
    CHECK(std::count(t.begin(), t.end(), std::size_t(3)) == 1);
  }
}

TEST_CASE("Polygons: a polygon that cannot be triangulated still yields triangles")
{
  const std::vector<std::vector<Point_3> > polygons = {
    { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } }, // no area
    { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } }, // a point
    { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, // intersects itself
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { -1, -1, 0 } }
  };
  for(const auto& polygon : polygons) CHECK(BS::triangulate_polygon(polygon).size() == polygon.size() - 2);
}
} // namespace test_triangulate_polygon
