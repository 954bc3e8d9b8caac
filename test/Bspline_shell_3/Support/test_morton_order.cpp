// morton_order.h: the order of interleaved bits, for any number of threads.
#include <CGAL/Bspline_shell_3/Support/morton_order.h>

#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace test_morton_order {
namespace BSI = CGAL::Bspline_shells::internal;
typedef std::array<double, 3> Point;

namespace {

template <typename Tag>
std::vector<std::size_t> order(const std::vector<Point>& points)
{
  const BSI::Morton_order order = BSI::morton_order<Tag>(points);
  std::vector<std::size_t> numbers;
  for(std::size_t i = 0; i < points.size(); ++i) numbers.push_back(order[i]);
  return numbers;
}

// Returns the interleaved bits of three numbers.
std::uint64_t interleaved(const std::array<unsigned int, 3>& x)
{
  std::uint64_t code = 0;
  for(int bit = 0; bit < 21; ++bit)
    for(int a = 0; a < 3; ++a) code |= std::uint64_t(x[a] >> bit & 1) << (3 * bit + a);
  return code;
}

} // namespace

TEST_CASE(
  "Morton order: codes interleave bits, equal points keep their order, and points that are not finite come last")
{
  CGAL::Random random(6);
  constexpr unsigned int side = 32;
  std::vector<Point> points = { { 0, 0, 0 }, { side - 1, side - 1, side - 1 } };
  std::vector<std::pair<std::uint64_t, std::size_t> > expected = {
    { 0, 0 }, { interleaved({ side - 1, side - 1, side - 1 }), 1 }
  };
  for(std::size_t n = 2; n < 3000; ++n) {
    const std::array<unsigned int, 3> x = { unsigned(random.get_int(0, side)), unsigned(random.get_int(0, side)),
                                            unsigned(random.get_int(0, side)) };
    points.push_back({ double(x[0]), double(x[1]), double(x[2]) });
    expected.push_back({ interleaved(x), n });
    if(n % 100 == 50) {
      points[n][1] = std::numeric_limits<double>::infinity();
      expected[n].first = std::uint64_t(-1);
    }
  }
  std::sort(expected.begin(), expected.end());
  // The first five bits of the relative position in the box are those of the number.
  for(Point& p : points)
    for(double& x : p) x = 1e6 + x / 8;
  const std::vector<std::size_t> found = order<CGAL::Sequential_tag>(points);
  for(std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == expected[i].second);
}

TEST_CASE("Morton order: the result does not depend on the number of threads")
{
  CGAL::Random random(7);
  std::vector<Point> points;
  for(int n = 0; n < 50000; ++n) points.push_back({ random.get_double(), random.get_double(), random.get_double() });
  for(int n = 0; n < 50000; ++n) points.push_back(Point(points[std::size_t(n)]));
  CHECK(order<CGAL::Sequential_tag>(points) == order<CGAL::Parallel_if_available_tag>(points));
}
} // namespace test_morton_order
