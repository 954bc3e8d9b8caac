#include <Carry/Numbered_values.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace test_Numbered_values {

using namespace Tool;

TEST_CASE("Numbered_values: equal values have the same number, even if they are NaN")
{
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Numbered_values number;
  CHECK(number({ 1, 2 }) == 0);
  CHECK(number({ 1, missing }) == 1);
  CHECK(number({ missing, 2 }) == 2);
  CHECK(number({ 1, missing }) == 1);
  CHECK(number({ 1, -1 }) == 3);
  CHECK(number({ 1, 0 }) == 4);
  CHECK(number({ 1, 2 }) == 0);
  CHECK(number[3] == Numbered_values::Value{ 1, -1 });
  CHECK(std::isnan(number[1][1]));
}

} // namespace test_Numbered_values
