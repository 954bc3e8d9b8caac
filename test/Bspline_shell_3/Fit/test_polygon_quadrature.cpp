// polygon_quadrature.h: exactness, compared with integrals over triangles by the three-point rule; positions of the
// points.
#include <CGAL/Bspline_shell_3/Fit/internal/polygon_quadrature.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace test_polygon_quadrature {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef std::array<double, 3> Point;
typedef std::vector<Point> Polygon;
typedef std::vector<std::pair<Point, double> > Rule;

Rule rule(const Polygon& polygon)
{
  Rule points;
  BS::internal::for_each_quadrature_point(polygon,
                                          [&](const Point& p, double weight) { points.emplace_back(p, weight); });
  return points;
}

template <typename Function>
double integral(const Rule& points, const Function& f)
{
  double sum = 0;
  for(const auto& p : points) sum += p.second * f(p.first);
  return sum;
}

Point middle(const Point& p, const Point& q)
{
  return { (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2 };
}

// Returns an integral that is exact to degree two: points are the midpoints of the sides of triangles at the first
// corner.
template <typename Function>
double exact_integral(const Polygon& polygon, const Function& f)
{
  double sum = 0;
  for(std::size_t n = 1; n + 1 < polygon.size(); ++n) {
    const Point &p = polygon[0], &q = polygon[n], &r = polygon[n + 1];
    const Point u = { q[0] - p[0], q[1] - p[1], q[2] - p[2] }, v = { r[0] - p[0], r[1] - p[1], r[2] - p[2] };
    sum += BS::internal::norm(BS::internal::cross(u, v)) / 6 * (f(middle(p, q)) + f(middle(q, r)) + f(middle(r, p)));
  }
  return sum;
}

// Returns a polygon in the plane z = 0.3 + x / 2 - y / 4.
Polygon in_tilted_plane(const std::vector<std::array<double, 2> >& corners, double scale = 1)
{
  Polygon polygon;
  for(const auto& c : corners) polygon.push_back({ scale * c[0], scale * c[1], 0.3 + scale * (c[0] / 2 - c[1] / 4) });
  return polygon;
}

const std::vector<Polygon>& polygons()
{
  static const std::vector<Polygon> all = {
    in_tilted_plane({ { 0.1, 0.2 }, { 0.9, 0.1 }, { 0.4, 0.8 } }),
    in_tilted_plane({ { 0.1, 0.1 }, { 0.7, 0.2 }, { 0.9, 0.8 }, { 0.3, 0.7 } }), // a parallelogram
    in_tilted_plane({ { 0.1, 0.1 }, { 0.9, 0.2 }, { 0.8, 0.5 }, { 0.2, 0.9 } }),
    in_tilted_plane({ { 0, 0.3 }, { 0.3, 0 }, { 1, 0.2 }, { 0.9, 0.9 }, { 0.1, 1 } }),
    in_tilted_plane({ { 0, 0.3 }, { 0.2, 0 }, { 0.8, 0 }, { 1, 0.4 }, { 0.7, 1 }, { 0.1, 0.9 } }),
    in_tilted_plane({ { 0, 0 }, { 0.5, 0 }, { 1, 0 }, { 0, 1 } }), // a triangle with an additional corner
  };
  return all;
}

} // namespace

TEST_CASE("Quadrature on polygons: linear functions are exact, and so is the second moment of larger polygons")
{
  for(const Polygon& polygon : polygons()) {
    const double area = exact_integral(polygon, [](const Point&) { return 1.; });
    Point centroid;
    for(std::size_t a = 0; a < 3; ++a)
      centroid[a] = exact_integral(polygon, [&](const Point& p) { return p[a]; }) / area;
    const auto squared_distance = [&](const Point& p) {
      double sum = 0;
      for(std::size_t a = 0; a < 3; ++a) sum += (p[a] - centroid[a]) * (p[a] - centroid[a]);
      return sum;
    };
    const Rule points = rule(polygon);
    CHECK(points.size() == polygon.size());
    CHECK(integral(points, [](const Point&) { return 1.; }) == Approx(area).epsilon(1e-13));
    for(std::size_t a = 0; a < 3; ++a)
      CHECK(integral(points, [&](const Point& p) { return p[a]; }) == Approx(area * centroid[a]).epsilon(1e-13));
    // In the last polygon, the points are already in the middle of its sides, and cannot be moved farther.
    if(&polygon != &polygons().back())
      CHECK(integral(points, squared_distance) == Approx(exact_integral(polygon, squared_distance)).epsilon(1e-12));
  }
}

TEST_CASE("Quadrature on polygons: the rule has degree two on triangles and parallelograms")
{
  for(const Polygon& polygon : { polygons()[0], polygons()[1] })
    for(std::size_t a = 0; a < 3; ++a)
      for(std::size_t b = 0; b < 3; ++b) {
        const auto product = [&](const Point& p) { return p[a] * p[b]; };
        CHECK(integral(rule(polygon), product) == Approx(exact_integral(polygon, product)).epsilon(1e-12));
      }
}

TEST_CASE("Quadrature on polygons: points lie in the polygon, and weights are positive")
{
  std::size_t outside = 0;
  for(const Polygon& polygon : polygons())
    for(const auto& point : rule(polygon)) {
      const Point& p = point.first;
      CHECK(point.second > 0);
      CHECK(p[2] == Approx(0.3 + p[0] / 2 - p[1] / 4).epsilon(1e-13));
      for(std::size_t n = 0; n < polygon.size(); ++n) {
        const Point &q = polygon[n], &r = polygon[(n + 1) % polygon.size()];
        outside += (r[0] - q[0]) * (p[1] - q[1]) - (r[1] - q[1]) * (p[0] - q[0]) < -1e-15;
      }
    }
  CHECK(outside == 0);
}

TEST_CASE("Quadrature on polygons: a small polygon gets its centroid, and a degenerate polygon no point")
{
  for(const Polygon& polygon : { in_tilted_plane({ { 0.1, 0.2 }, { 0.9, 0.1 }, { 0.4, 0.8 } }, 0.25),
                                 in_tilted_plane({ { 0, 0 }, { 1, 0 }, { 0.5, 1 }, { 0, 1 } }, 0.2) }) {
    const Rule points = rule(polygon);
    REQUIRE(points.size() == 1);
    for(std::size_t a = 0; a < 3; ++a)
      CHECK(points[0].first[a] * points[0].second
            == Approx(exact_integral(polygon, [&](const Point& p) { return p[a]; })).epsilon(1e-13));
  }
  CHECK(rule({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0, 0 } }).empty());
  CHECK(rule({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 } }).empty());
}

TEST_CASE("Quadrature on polygons: the rule does not depend on the first corner, and is invariant under mirroring")
{
  const auto sorted = [](Rule points) {
    std::sort(points.begin(), points.end());
    return points;
  };
  double most = 0;
  for(const Polygon& polygon : polygons()) {
    Polygon other(polygon);
    std::rotate(other.begin(), other.begin() + 1, other.end());
    std::reverse(other.begin(), other.end());
    for(Point& p : other) p[0] = 1 - p[0];
    const Rule points = sorted(rule(polygon));
    Rule mirrored = rule(other);
    for(auto& p : mirrored) p.first[0] = 1 - p.first[0];
    mirrored = sorted(mirrored);
    REQUIRE(mirrored.size() == points.size());
    for(std::size_t n = 0; n < points.size(); ++n) {
      most = (std::max)(most, std::abs(points[n].second - mirrored[n].second));
      for(std::size_t a = 0; a < 3; ++a) most = (std::max)(most, std::abs(points[n].first[a] - mirrored[n].first[a]));
    }
  }
  CHECK(most < 1e-14);
}
} // namespace test_polygon_quadrature
