// The last digit in which coordinates were stored is found from their values.
#include <CGAL/Bspline_shell_3/Soup/coordinate_unit.h>
#include "test_meshes.h"

#include <cmath>

namespace test_coordinate_unit {
namespace {

using CGAL::Bspline_shells::coordinate_unit;

} // namespace

TEST_CASE("Coordinate unit: that of floats is the distance to the next float at the largest coordinate")
{
  CHECK(coordinate_unit({ Point_3(1, 2, 3) }) == std::ldexp(1, -22));
  CHECK(coordinate_unit({ Point_3(1, 2, -5e6) }) == 0.5);
  CHECK(coordinate_unit({ Point_3(0.1f, -0.7f, 0.3f) }) == std::ldexp(1, -24));
}

TEST_CASE("Coordinate unit: that of decimal numbers is the last place of the longest, at the largest coordinate")
{
  CHECK(coordinate_unit({ Point_3(0.1, 0, 2) }) == Approx(1));
  CHECK(coordinate_unit({ Point_3(0.123456, 5.5, 0) }) == Approx(1e-5));
  CHECK(coordinate_unit({ Point_3(123.456, 99.99999, 0) }) == Approx(1e-4));
  CHECK(coordinate_unit({ Point_3(1.23456e-12, 1.2, -7.5) }) == Approx(1e-5));
}

TEST_CASE("Coordinate unit: that of numbers with all digits of a double is the distance to the next one")
{
  CHECK(coordinate_unit({ Point_3(1. / 3, 1, 2) }) == std::ldexp(1, -51));
  CHECK(coordinate_unit({ Point_3(1. / 3, 0, -1e300 / 3) }) == std::ldexp(1, 942));
  CHECK(coordinate_unit({ Point_3(0, 0, 0) }) == 0);
  CHECK(coordinate_unit({}) == 0);
}
} // namespace test_coordinate_unit
