// Named_parameters.h: the package's parameters and CGAL's can be combined in any order.
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>

#include <catch2/catch.hpp>

namespace test_Named_parameters {
namespace {

namespace BS = CGAL::Bspline_shells;
namespace P = CGAL::Bspline_shells::parameters;
using CGAL::parameters::choose_parameter;
using CGAL::parameters::get_parameter;

template <typename T, typename Tag, typename Base>
void check(const CGAL::Named_function_parameters<T, Tag, Base>& np)
{
  CHECK(choose_parameter(get_parameter(np, BS::parameter_tags::resolution), 0) == 60);
  CHECK(choose_parameter(get_parameter(np, CGAL::internal_np::number_of_iterations), 0u) == 4);
  CHECK(choose_parameter(get_parameter(np, CGAL::internal_np::verbosity_level), 0) == 3);
  CHECK(choose_parameter(get_parameter(np, BS::parameter_tags::thickness), 7.) == 7.);
}

} // namespace

TEST_CASE("Named parameters: parameters of CGAL may come first, in between, or last")
{
  check(P::resolution(60).number_of_iterations(4u).verbosity_level(3));
  check(P::number_of_iterations(4u).resolution(60).verbosity_level(3));
  check(P::with(CGAL::parameters::number_of_iterations(4u).verbosity_level(3)).resolution(60));
  check(P::with(CGAL::parameters::verbosity_level(3)).resolution(60).number_of_iterations(4u));
}

TEST_CASE("Named parameters: default values can be extended")
{
  const auto np = P::with(CGAL::parameters::default_values()).resolution(60);
  CHECK(choose_parameter(get_parameter(np, BS::parameter_tags::resolution), 0) == 60);
}

TEST_CASE("Named parameters: a parameter with the same name in CGAL is the same parameter")
{
  const auto np = CGAL::parameters::allow_self_intersections(true);
  const auto own = P::allow_self_intersections(true);
  CHECK(choose_parameter(get_parameter(np, CGAL::internal_np::allow_self_intersections), false));
  CHECK(choose_parameter(get_parameter(own, CGAL::internal_np::allow_self_intersections), false));
  // In CGAL 6, this parameter is also called time_limit().
  const auto limited = CGAL::parameters::maximum_running_time(5.);
  CHECK(choose_parameter(get_parameter(limited, CGAL::internal_np::maximum_running_time), 0.) == 5.);
  CHECK(choose_parameter(get_parameter(P::time_limit(5.), CGAL::internal_np::maximum_running_time), 0.) == 5.);
}
} // namespace test_Named_parameters
