// count_removed_border_points.h: a simplified border has original points in their order, and is within a distance.
#include <CGAL/Bspline_shell_3/Mesh/count_removed_border_points.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace test_count_removed_border_points {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::Shell_closing_3 Closing;
typedef std::vector<Closing::Point> Points;

// Returns cones over closed polygons, each with its own apex.
Closing cones(const std::vector<Points>& polygons)
{
  Points points;
  for(const Points& polygon : polygons) points.insert(points.end(), polygon.begin(), polygon.end());
  const std::size_t border = points.size();
  std::vector<Closing::Triangle> triangles;
  Closing::Index first = 0;
  for(const Points& polygon : polygons) {
    const auto size = Closing::Index(polygon.size()), apex = Closing::Index(points.size());
    for(Closing::Index i = 0; i < size; ++i) triangles.push_back({ first + i, first + (i + 1) % size, apex });
    points.push_back({ polygon[0][0], polygon[0][1], 100 });
    first += size;
  }
  return Closing(points, border, triangles, std::vector<Closing::Kind>(triangles.size(), Closing::Kind::CAP));
}

// a square of side 4; points of the lower side are 0.25 and 0.75 off it
const Points square = { { 0, 0, 0 }, { 1, -0.25, 0 }, { 2, 0.75, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } };
const Points other = { { 10, 0, 0 }, { 11, 0, 0 }, { 12, 0, 0 }, { 11, 1, 0 } };

Points without(Points points, const std::vector<std::size_t>& removed)
{
  for(auto n = removed.rbegin(); n != removed.rend(); ++n) points.erase(points.begin() + std::ptrdiff_t(*n));
  return points;
}

std::optional<std::size_t> count(const std::vector<Points>& before, const std::vector<Points>& after, double distance)
{
  const Closing original = cones(before), simplified = cones(after);
  REQUIRE(original.is_valid());
  REQUIRE(simplified.is_valid());
  return BS::count_removed_border_points(original, simplified, distance);
}

} // namespace

TEST_CASE("Removed border points: a border is within any distance of itself")
{
  CHECK(count({ square }, { square }, 0) == 0);
  CHECK(count({ square, other }, { other, square }, 0) == 0);
  Points turned(square.begin() + 2, square.end());
  turned.insert(turned.end(), square.begin(), square.begin() + 2);
  CHECK(count({ square }, { turned }, 0) == 0);
}

TEST_CASE("Removed border points: every removed point must be within the distance of the new edge")
{
  const double more = 1 + 1e-15;
  CHECK(count({ square }, { without(square, { 1, 2 }) }, 0.75 * more) == 2);
  CHECK_FALSE(count({ square }, { without(square, { 1, 2 }) }, 0.75 / more));
  CHECK_FALSE(count({ square }, { without(square, { 1, 2 }) }, 0.5));
  // The point (1, -0.25) is 5 / sqrt(73) from the line through (0, 0) and (2, 0.75).
  const double off = 5 / std::sqrt(73.);
  CHECK(count({ square }, { without(square, { 1 }) }, off * more) == 1);
  CHECK_FALSE(count({ square }, { without(square, { 1 }) }, off / more));
  CHECK_FALSE(count({ square }, { without(square, { 1 }) }, 0));
  // The first point of a list may be removed: it is 16 / sqrt(305) from the line through (0, 4) and (1, -0.25).
  const double corner = 16 / std::sqrt(305.);
  CHECK(count({ square }, { without(square, { 0 }) }, corner * more) == 1);
  CHECK_FALSE(count({ square }, { without(square, { 0 }) }, corner / more));
}

TEST_CASE("Removed border points: the square of the distance is not rounded up")
{
  // 0.1 * 0.1 is rounded up by 8e-19, which is more than the square of 5e-10.
  const Points bent = { { 0, 0, 0 }, { 1, 0.1, 5e-10 }, { 2, 0, 0 }, { 1, 3, 0 } };
  CHECK_FALSE(count({ bent }, { without(bent, { 1 }) }, 0.1));
  CHECK(count({ bent }, { without(bent, { 1 }) }, std::nextafter(0.1, 1.)) == 1);
}

TEST_CASE("Removed border points: distances are measured from segments, not from lines")
{
  CHECK(count({ square, other }, { square, without(other, { 1 }) }, 1e-100) == 1);
  CHECK(count({ square, other }, { square, without(other, { 1 }) }, 1e-300) == 1);
  // (2, 0) lies on the line through (0, 0) and (1, 0), but 1 from the segment.
  const Points spike = { { 0, 0, 0 }, { 2, 0, 0 }, { 1, 0, 0 }, { 1, 3, 0 } };
  CHECK_FALSE(count({ spike }, { without(spike, { 1 }) }, 0.999));
  CHECK(count({ spike }, { without(spike, { 1 }) }, 1.001) == 1);
}

TEST_CASE("Removed border points: points must be original, in their order, on all closed curves")
{
  const double large = 1000;
  Points moved = square;
  moved[1][0] = std::nextafter(moved[1][0], 2.);
  CHECK_FALSE(count({ square }, { moved }, large));
  CHECK_FALSE(count({ square }, { Points(square.rbegin(), square.rend()) }, large));
  Points swapped = square;
  std::swap(swapped[1], swapped[2]);
  CHECK_FALSE(count({ square }, { swapped }, large));
  CHECK_FALSE(count({ square, other }, { square }, large));
  CHECK_FALSE(count({ square }, { square, other }, large));
  Points joined = square;
  joined.insert(joined.end(), other.begin(), other.end());
  CHECK_FALSE(count({ square, other }, { joined }, large));
  CHECK_FALSE(count({ joined }, { square, other }, large));
}

TEST_CASE("Removed border points: closings that are not valid have no border")
{
  const Closing open({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, 2, { { 0, 1, 2 } }, { Closing::Kind::CAP });
  REQUIRE_FALSE(open.is_valid());
  CHECK_FALSE(BS::count_removed_border_points(open, cones({ square }), 1000));
  CHECK_FALSE(BS::count_removed_border_points(cones({ square }), open, 1000));
  CHECK_FALSE(BS::count_removed_border_points(Closing(), Closing(), 1000));
}
} // namespace test_count_removed_border_points
