// Triangles overlap if they meet outside of their common vertices and edges.
#include <CGAL/Bspline_shell_3/Mesh/triangles_overlap.h>
#include "test_meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace test_triangles_overlap {
namespace {

typedef std::array<std::size_t, 3> Triangle;

// Returns the result for all orders of corners and triangles, which must agree.
bool overlap(Triangle s, Triangle t, const std::vector<Point_3>& points)
{
  const bool result = CGAL::Bspline_shells::triangles_overlap(s, t, points);
  std::sort(s.begin(), s.end());
  std::sort(t.begin(), t.end());
  do {
    do {
      CHECK(CGAL::Bspline_shells::triangles_overlap(s, t, points) == result);
      CHECK(CGAL::Bspline_shells::triangles_overlap(t, s, points) == result);
    } while(std::next_permutation(t.begin(), t.end()));
  } while(std::next_permutation(s.begin(), s.end()));
  return result;
}

// The first three points are a triangle.
std::vector<Point_3> with(const std::vector<Point_3>& others)
{
  std::vector<Point_3> points{ Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(0, 4, 0) };
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

} // namespace

TEST_CASE("Overlapping triangles: without common vertices, touching is enough")
{
  CHECK(overlap({ 0, 1, 2 }, { 3, 4, 5 }, with({ Point_3(1, 1, -1), Point_3(1, 1, 1), Point_3(2, 5, 1) })));
  CHECK(overlap({ 0, 1, 2 }, { 3, 4, 5 }, with({ Point_3(1, 1, 0), Point_3(1, 1, 1), Point_3(2, 5, 1) })));
  CHECK_FALSE(overlap({ 0, 1, 2 }, { 3, 4, 5 }, with({ Point_3(1, 1, 1), Point_3(1, 1, 2), Point_3(2, 5, 1) })));
}

TEST_CASE("Overlapping triangles: triangles with a common vertex overlap if they also meet elsewhere")
{
  CHECK_FALSE(overlap({ 0, 1, 2 }, { 0, 3, 4 }, with({ Point_3(1, 1, 1), Point_3(1, 1, 2) })));
  CHECK(overlap({ 0, 1, 2 }, { 0, 3, 4 }, with({ Point_3(1, 1, -1), Point_3(1, 1, 2) })));
  CHECK(overlap({ 0, 1, 2 }, { 0, 3, 4 }, with({ Point_3(9, 9, -1), Point_3(9, 9, 2) })));
  CHECK(overlap({ 0, 1, 2 }, { 0, 3, 4 }, with({ Point_3(1, 1, 0), Point_3(1, 1, 2) })));
}

TEST_CASE("Overlapping triangles: triangles with a common edge overlap if one is folded onto the other")
{
  CHECK_FALSE(overlap({ 0, 1, 2 }, { 1, 0, 3 }, with({ Point_3(1, 1, 1) })));
  CHECK_FALSE(overlap({ 0, 1, 2 }, { 1, 0, 3 }, with({ Point_3(1, -1, 0) })));
  CHECK(overlap({ 0, 1, 2 }, { 1, 0, 3 }, with({ Point_3(1, 1, 0) })));
  CHECK(overlap({ 0, 1, 2 }, { 0, 2, 1 }, with({})));
}
} // namespace test_triangles_overlap
