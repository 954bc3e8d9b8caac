#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace test_coefficient_lines {
TEST_CASE(
  "Coefficient lines: along each axis, every coefficient is on one line, and neighbors differ only in that coordinate")
{
  std::array<std::array<int, 64>, 3> times = {};
  std::vector<int> axes;
  CGAL::Bspline_shells::internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
    axes.push_back(axis);
    const std::array<int, 3> first = { n % 4, n / 4 % 4, n / 16 };
    REQUIRE(first[std::size_t(axis)] == 0);
    for(int m = 0; m < 4; ++m) {
      std::array<int, 3> expected = first;
      expected[std::size_t(axis)] = m;
      const int c = n + m * stride;
      CHECK(c == 16 * expected[2] + 4 * expected[1] + expected[0]);
      ++times[std::size_t(axis)][std::size_t(c)];
    }
  });
  for(const auto& t : times)
    for(int k : t) CHECK(k == 1);
  CHECK(std::is_sorted(axes.begin(), axes.end())); // one axis after the other
  CHECK(axes.size() == 48);
}

TEST_CASE("Differences of neighboring coefficients: their ranges along each axis, without NaN")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for(int bad = -1; bad < 64; ++bad) {
    // Along axis a, the differences are among m (m + 1) / 2 - 4 for m = 0, 1, 2, times the a-th scale.
    const std::array<double, 3> scale = { 1, 10, 100 };
    std::array<double, 64> c;
    const auto value = [](int i) { return (i - 1) * i * (i + 1) / 6. - 4 * i; };
    for(int n = 0; n < 64; ++n)
      c[std::size_t(n)] = n == bad ? nan
                                   : scale[0] * value(n % 4) + scale[1] * value(n / 4 % 4) + scale[2] * value(n / 16);
    const auto ranges = CGAL::Bspline_shells::internal::difference_ranges(c.data());
    for(std::size_t a = 0; a < 3; ++a) {
      CHECK(ranges[a].min == -4 * scale[a]);
      CHECK(ranges[a].max == -scale[a]);
    }
  }
}
} // namespace test_coefficient_lines
