// coordinates.h: numbers of all kinds are rounded to the nearest double, however they were computed.
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace test_coordinates {
using CGAL::Bspline_shells::internal::rounded;
using CGAL::Bspline_shells::internal::rounded_coordinates;
typedef CGAL::Exact_predicates_exact_constructions_kernel Lazy_kernel;
typedef Lazy_kernel::FT Lazy;

TEST_CASE("Coordinates: numbers with a double value are converted exactly")
{
  for(double x : { 0., 1., -0.1, 1e300, 1e-300, std::numeric_limits<double>::denorm_min() }) {
    CHECK(rounded(x) == x);
    CHECK(rounded(CGAL::Exact_rational(x)) == x);
    CHECK(rounded(Lazy(x)) == x);
  }
  CHECK(rounded(0.5f) == 0.5);
  CHECK(rounded(3) == 3);
}

TEST_CASE("Coordinates: a lazy number is rounded by its exact value, before and after its evaluation")
{
  for(double x : { 0.1, -7.3, 1e-3 })
    for(double size : { 1., 1e6, 1e9, 1e12, 1e20 }) {
      CAPTURE(x, size);
      const Lazy large = Lazy(size) / Lazy(3), y = (Lazy(x) + large) - large;
      CHECK(rounded(y) == x);
      y.exact();
      CHECK(rounded(y) == x);
    }
  const Lazy third = Lazy(1) / Lazy(3);
  CHECK(rounded(third) == CGAL::to_double(CGAL::Exact_rational(1) / 3));
}

#ifdef NDEBUG // otherwise, CGAL asserts that they are finite
TEST_CASE("Coordinates: lazy numbers that are NaN or infinite are unchanged")
{
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(rounded(Lazy(infinity)) == infinity);
  CHECK(rounded(Lazy(-infinity)) == -infinity);
  CHECK(std::isnan(rounded(Lazy(std::numeric_limits<double>::quiet_NaN()))));
}
#endif

TEST_CASE("Coordinates: all three coordinates of a point are rounded")
{
  const Lazy large = Lazy(1e9) / Lazy(3);
  const Lazy_kernel::Point_3 p((Lazy(0.1) + large) - large, Lazy(0.2), Lazy(1) / Lazy(3));
  CHECK(rounded_coordinates(p) == std::array<double, 3>{ 0.1, 0.2, CGAL::to_double(CGAL::Exact_rational(1) / 3) });
}
} // namespace test_coordinates
