// common_direction.h: directions at less than 90 degrees to the normals of facets nearby.
#include <CGAL/Bspline_shell_3/Construction/common_direction.h>
#include "mesh_in_cells.h"

#include <array>
#include <cmath>
#include <optional>

namespace test_common_direction {
namespace {

namespace BS = CGAL::Bspline_shells;

std::optional<BS::Slope_condition> slope_near(const Mesh_in_cells& in, const std::array<double, 3>& p, double distance)
{
  return BS::common_slope(in.field, in.clipped, in.field.locate(Point_3(p[0], p[1], p[2])), p, distance, 0.2);
}

} // namespace

TEST_CASE("Common direction: it is normal to a side, bisects an edge, and does not exist in a plate")
{
  const Mesh_in_cells in(box(Point_3(-3, -3, -3), Point_3(3, 3, 3)));
  const auto side = slope_near(in, { 0.1, 0.2, 3.3 }, 0.3);
  REQUIRE(side);
  CHECK(side->direction[2] == Approx(1));
  CHECK(side->least == Approx(0.2));
  CHECK(in.point(*side).z() == Approx(3.3));
  CHECK(side->cell == in.field.locate(Point_3(0.1, 0.2, 3.3)));
  const auto edge = slope_near(in, { 0.1, 3.1, 3.1 }, 0.1414);
  REQUIRE(edge);
  CHECK(edge->direction[1] == Approx(std::sqrt(0.5)));
  CHECK(edge->direction[2] == Approx(std::sqrt(0.5)));
  CHECK(edge->least == Approx(0.2 * std::sqrt(0.5)));
  // The mesh is farther away than the search distance.
  CHECK_FALSE(slope_near(in, { 0, 0, 0 }, 0.1));
  const Mesh_in_cells plate(box(Point_3(-3, -3, -0.1), Point_3(3, 3, 0.1)));
  CHECK_FALSE(slope_near(plate, { 0.3, 0.2, 0 }, 0.1));
  // Near one side of the plate, within less than its thickness, there is a common direction.
  const auto near_side = slope_near(plate, { 0.3, 0.2, 0.15 }, 0.05);
  REQUIRE(near_side);
  CHECK(near_side->direction[2] == Approx(1));
}

TEST_CASE("Common direction: the margin is the smallest product with the normals in the box, if that is not too small")
{
  const double pi = std::acos(-1.);
  for(double angle : { 10., 40. }) {
    const Mesh_in_cells in(grooved_block(angle, 0.05));
    const CGAL::Bbox_3 in_groove(0.49, 0.2, 0.36, 0.51, 0.3, 0.39);
    const auto common = BS::common_direction(in.field, in.clipped, in_groove);
    REQUIRE(common);
    CHECK(common->direction[2] == Approx(1));
    CHECK(common->margin == Approx(std::sin(angle / 2 * pi / 180)));
    const auto normal = in.clipped.normal(common->facet);
    CHECK(normal[2] == Approx(common->margin));
  }
  const Mesh_in_cells narrow(grooved_block(1, 0.05));
  CHECK_FALSE(BS::common_direction(narrow.field, narrow.clipped, CGAL::Bbox_3(0.49, 0.2, 0.36, 0.51, 0.3, 0.39)));
  CHECK_FALSE(BS::common_direction(narrow.field, narrow.clipped, CGAL::Bbox_3(2, 2, 2, 3, 3, 3)));
}
} // namespace test_common_direction
