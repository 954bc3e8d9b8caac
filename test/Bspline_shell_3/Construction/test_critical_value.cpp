// critical_value.h: what a quadratic is where its slope vanishes, if that is near.
#include <CGAL/Bspline_shell_3/Construction/critical_value.h>

#include <catch2/catch.hpp>

#include <array>
#include <limits>

namespace {

namespace BS = CGAL::Bspline_shells;
typedef BS::internal::Second_order_jet<double> Jet;

constexpr double infinity = std::numeric_limits<double>::infinity();

// of c + k ((p - q) . d)^2 / 2 at p
Jet across_a_wall(double c, double k, const std::array<double, 3>& d, double distance)
{
  Jet jet;
  jet.value = c + k * distance * distance / 2;
  for(int a = 0; a < 3; ++a) jet.gradient[a] = k * distance * d[a];
  jet.hessian = { k*d[0]*d[0], k*d[1]*d[1], k*d[2]*d[2], k*d[0]*d[1], k*d[0]*d[2], k*d[1]*d[2] };
  return jet;
}

} // namespace

TEST_CASE("Critical value: of a quadratic across a wall, whatever its direction, from either side, and wherever one looks from")
{
  const double third = 1. / 3;
  for(const auto& d : { std::array<double, 3>{ 1, 0, 0 }, std::array<double, 3>{ 0, 0.6, 0.8 }, std::array<double, 3>{ 2*third, -2*third, third } })
    for(double k : { 3., -0.5 })
      for(double distance : { 0., 0.01, -0.2, 1. }) {
        const auto found = BS::critical_value(across_a_wall(-0.25, k, d, distance), 1.001);
        REQUIRE(found.has_value());
        CHECK(*found == Approx(-0.25));
      }
}

TEST_CASE("Critical value: none beyond the reach, and none of a linear function")
{
  const std::array<double, 3> d = { 0, 0.6, 0.8 };
  CHECK(BS::critical_value(across_a_wall(1, 2, d, 0.5), 0.51).has_value());
  CHECK_FALSE(BS::critical_value(across_a_wall(1, 2, d, 0.5), 0.49).has_value());
  Jet linear = {};
  linear.value = 1;
  linear.gradient = { 1, 2, 3 };
  CHECK_FALSE(BS::critical_value(linear, 1e9).has_value());
  linear.gradient[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(BS::critical_value(linear, infinity).has_value());
}
