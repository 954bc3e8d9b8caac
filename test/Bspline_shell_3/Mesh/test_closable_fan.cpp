// The exact decision whether a border vertex can be closed is compared with known fans, and with trials of many
// directions.
#include <CGAL/Bspline_shell_3/Closing/close_virtually.h>
#include <CGAL/Bspline_shell_3/Mesh/closable_fan.h>
#include "test_meshes.h"

#include <CGAL/Random.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace test_closable_fan {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Vector_3 Vector_3;

// Returns points around the z-axis, at heights that rise from `low` to `high`.
std::vector<Point_3> spiral(double turns, double low, double high, int steps, const Point_3& p = CGAL::ORIGIN)
{
  std::vector<Point_3> link;
  for(int i = 0; i <= steps; ++i) {
    const double a = 2 * CGAL_PI * turns * i / steps;
    link.push_back(p + Vector_3(std::cos(a), std::sin(a), low + (high - low) * i / steps));
  }
  return link;
}

double determinant(const Vector_3& a, const Vector_3& b, const Vector_3& c)
{
  return CGAL::determinant(a, b, c);
}

// Returns the turn of a fan about g, or a negative number if a facet faces away from g, or nearly so.
double turn(const std::vector<Point_3>& link, const Vector_3& g)
{
  double sum = 0;
  const double length = std::sqrt(g.squared_length());
  for(std::size_t n = 0; n + 1 < link.size(); ++n) {
    const Vector_3 a = link[n] - CGAL::ORIGIN, b = link[n + 1] - CGAL::ORIGIN;
    const double sine = determinant(g, a, b) / length;
    if(!(sine > 1e-6)) return -1;
    sum += std::atan2(sine, a * b - (a * g) * (b * g) / g.squared_length());
  }
  return sum;
}

} // namespace

TEST_CASE("Fans: flat fans of less than a full turn are closable")
{
  for(double turns : { 0.1, 0.49, 0.5, 0.51, 0.75, 0.99 })
    CHECK(BS::is_fan_closable(CGAL::ORIGIN, spiral(turns, 0, 0, 12)));
  CHECK(BS::is_fan_closable(Point_3(3, -2, 7), spiral(0.9, 0.2, 0.4, 12, Point_3(3, -2, 7))));
  // The last edge coincides with the first one.
  CHECK_FALSE(
    BS::is_fan_closable(CGAL::ORIGIN, { Point_3(1, 0, 0), Point_3(-1, 1, 0), Point_3(-1, -1, 0), Point_3(2, 0, 0) }));
  // exactly half a turn
  CHECK(BS::is_fan_closable(CGAL::ORIGIN, { Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(-2, 0, 0) }));
}

TEST_CASE("Fans: a ramp that spirals by far more than a full turn is not closable")
{
  CHECK_FALSE(BS::is_fan_closable(CGAL::ORIGIN, spiral(1.75, 0, 0.3, 24)));
  CHECK_FALSE(BS::is_fan_closable(CGAL::ORIGIN, spiral(2.6, 0, 0.3, 36)));
  CHECK(BS::is_fan_closable(CGAL::ORIGIN, spiral(0.95, 0, 0.3, 24)));
  // About an axis that is tilted far enough, this fan makes 0.997 of a full turn.
  CHECK(BS::is_fan_closable(CGAL::ORIGIN, spiral(1.25, 0, 0.3, 24)));
}

TEST_CASE("Fans: the exact decision agrees with trials of many directions")
{
  CGAL::Random random(5);
  std::size_t closable = 0, others = 0;
  for(int trial = 0; trial < 300; ++trial) {
    std::vector<Point_3> link = spiral(random.get_double(0.2, 1.6), 0, random.get_double(0, 0.5),
                                       random.get_int(4, 12));
    const double noise = random.get_double(0, 0.8);
    for(Point_3& q : link) {
      const double x = random.get_double(-noise, noise), y = random.get_double(-noise, noise),
                   z = random.get_double(-noise, noise);
      q = q + Vector_3(x, y, z);
    }
    bool is_found = false, is_faced = false;
    for(int k = 0; k < 20000 && !is_found; ++k) {
      const double x = random.get_double(-1, 1), y = random.get_double(-1, 1), z = random.get_double(-1, 1);
      const double t = turn(link, Vector_3(x, y, z));
      is_faced = is_faced || t > 0;
      is_found = t > 0 && t < 2 * CGAL_PI - 1e-6;
    }
    const bool is_closable = BS::is_fan_closable(CGAL::ORIGIN, link);
    if(is_found) {
      CHECK(is_closable);
      ++closable;
    }
    // If a sampled direction is faced by all facets, a direction that closes the fan would have been found, unless such
    // directions are rare.
    else if(is_faced && !is_closable)
      ++others;
    else if(is_faced) WARN("a fan is closable about few directions only");
  }
  CHECK(closable > 50);
  CHECK(others > 10);
}

TEST_CASE("Fans: a mesh with a spiral at its border is not closable, and the facets around it are reported")
{
  Mesh mesh;
  const auto center = mesh.add_vertex(Point_3(0, 0, 0));
  std::vector<Mesh::Vertex_index> rim;
  for(const Point_3& q : spiral(1.75, 0, 0.6, 24)) rim.push_back(mesh.add_vertex(q));
  for(std::size_t n = 0; n + 1 < rim.size(); ++n) mesh.add_face(center, rim[n], rim[n + 1]);
  BS::Closing_report report;
  const auto closed = BS::close_virtually<CGAL::Sequential_tag>(mesh, 0.02, report);
  CHECK(closed.status == BS::Shell_status::NOT_CLOSABLE);
  CHECK(closed.offending_facets.size() == 24);
  CHECK_FALSE(closed.closing);
}
} // namespace test_closable_fan
