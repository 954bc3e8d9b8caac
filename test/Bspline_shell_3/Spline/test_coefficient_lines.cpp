#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
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
} // namespace test_coefficient_lines
