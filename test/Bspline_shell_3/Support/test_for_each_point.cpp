// for_each_point.h: each point is visited once.
#include <CGAL/Bspline_shell_3/Support/for_each_point.h>

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace test_for_each_point {
namespace BSI = CGAL::Bspline_shells::internal;
typedef std::array<double, 3> Point;

namespace {

struct Counting_visitor
{
  std::size_t stops_at = std::size_t(-1), done = 0;
  bool advance(std::size_t so_far, std::size_t)
  {
    done = so_far;
    return so_far < stops_at;
  }
};

std::vector<Point> random_points(std::size_t size, double scale)
{
  CGAL::Random random(5);
  std::vector<Point> points(size);
  for(Point& p : points)
    for(double& x : p) x = scale * random.get_double(-1, 1);
  return points;
}

} // namespace

TEST_CASE("Points in order: each point is visited once, whatever its coordinates")
{
  const double infinity = std::numeric_limits<double>::infinity(), largest = (std::numeric_limits<double>::max)();
  for(std::size_t size : { 0, 1, 2, 63, 64, 65, 20000 })
    for(double scale : { 0., 1e-310, 1., largest }) {
      std::vector<Point> points = random_points(size, scale);
      for(std::size_t n = 7; n < size; n += 13) points[n][n % 3] = n % 2 == 0 ? infinity : std::nan("");
      std::vector<std::atomic<int> > met(size);
      std::atomic<std::size_t> wrong(0);
      Counting_visitor visitor;
      const bool all = BSI::for_each_point<CGAL::Parallel_if_available_tag>(
        size, [&](std::size_t n) { return points[n]; }, visitor,
        [&](std::size_t n, const Point& p) {
          ++met[n];
          for(int a = 0; a < 3; ++a)
            if(!(p[a] == points[n][a] || (std::isnan(p[a]) && std::isnan(points[n][a])))) ++wrong;
        });
      CHECK(all);
      CHECK(visitor.done == size);
      CHECK(wrong == 0);
      CHECK(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
    }
}

TEST_CASE("Points in order: a visitor can stop the iteration")
{
  const std::vector<Point> points = random_points(100000, 1);
  Counting_visitor visitor;
  visitor.stops_at = 30000;
  std::size_t met = 0;
  CHECK_FALSE(BSI::for_each_point<CGAL::Sequential_tag>(
    points.size(), [&](std::size_t n) { return points[n]; }, visitor, [&](std::size_t, const Point&) { ++met; }));
  CHECK(met == visitor.done);
  CHECK(met >= 30000);
  CHECK(met < points.size());
}
} // namespace test_for_each_point
