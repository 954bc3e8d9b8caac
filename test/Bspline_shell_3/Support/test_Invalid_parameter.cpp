// Invalid_parameter.h: bounds, and messages with the name of a parameter and its permitted values.
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <catch2/catch.hpp>

#include <limits>
#include <string>

namespace test_Invalid_parameter {
namespace {

namespace BS = CGAL::Bspline_shells;
using BS::Parameter_bounds;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

std::string sentence(double value, const Parameter_bounds& bounds)
{
  BS::Invalid_parameter parameter;
  parameter.check("size", value, bounds);
  return message(parameter);
}

} // namespace

TEST_CASE("Invalid parameter: bounds contain exactly the permitted values")
{
  for(double x : { 1e-300, 1., 1e300 }) {
    CHECK(Parameter_bounds::positive().contains(x));
    CHECK(Parameter_bounds::positive_or_infinite().contains(x));
    CHECK(Parameter_bounds::not_negative().contains(x));
  }
  for(double x : { -1., -infinity, nan_value }) {
    CHECK_FALSE(Parameter_bounds::positive().contains(x));
    CHECK_FALSE(Parameter_bounds::positive_or_infinite().contains(x));
    CHECK_FALSE(Parameter_bounds::not_negative().contains(x));
  }
  CHECK_FALSE(Parameter_bounds::positive().contains(0));
  CHECK_FALSE(Parameter_bounds::positive_or_infinite().contains(0));
  CHECK(Parameter_bounds::not_negative().contains(0));
  CHECK_FALSE(Parameter_bounds::positive().contains(infinity));
  CHECK(Parameter_bounds::positive_or_infinite().contains(infinity));
  CHECK_FALSE(Parameter_bounds::not_negative().contains(infinity));
  const Parameter_bounds part = { 0, 1, true, false };
  CHECK(part.contains(0));
  CHECK_FALSE(part.contains(1));
}

TEST_CASE("Invalid parameter: the message has the name, the value and the bounds")
{
  CHECK(sentence(1, Parameter_bounds::positive()) == "");
  CHECK(sentence(-1, Parameter_bounds::positive())
        == "The parameter size is -1. It must be greater than 0 and finite.");
  CHECK(sentence(0, Parameter_bounds::positive_or_infinite()) == "The parameter size is 0. It must be greater than 0.");
  CHECK(sentence(infinity, Parameter_bounds::not_negative())
        == "The parameter size is inf. It must be at least 0 and finite.");
  CHECK(sentence(1.5, { 0, 1, true, false }) == "The parameter size is 1.5. It must be at least 0 and less than 1.");
  CHECK(sentence(nan_value, { 0, 1, true, true }) == "The parameter size is nan. It must be at least 0 and at most 1.");
}

TEST_CASE("Invalid parameter: the first invalid parameter is kept, and defines the message of the status")
{
  BS::Invalid_parameter parameter;
  CHECK_FALSE(parameter);
  CHECK(message(BS::Shell_status::INVALID_PARAMETER, parameter) == message(BS::Shell_status::INVALID_PARAMETER));
  parameter.check("first", 1, Parameter_bounds::positive());
  CHECK_FALSE(parameter);
  parameter.check("second", -1, Parameter_bounds::positive());
  parameter.check("third", -2, Parameter_bounds::positive());
  REQUIRE(parameter);
  CHECK(std::string(parameter.name) == "second");
  CHECK(parameter.value == -1);
  CHECK(message(BS::Shell_status::INVALID_PARAMETER, parameter) == message(parameter));
  CHECK(message(BS::Shell_status::EMPTY_MESH, parameter) == message(BS::Shell_status::EMPTY_MESH));
}
} // namespace test_Invalid_parameter
