// critical_point.h: proved critical points exist, and none is proved where the gradient only comes close to zero.
#include <CGAL/Bspline_shell_3/Certificate/critical_point.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace test_critical_point {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef std::array<double, 4> Cubic; // Bernstein coefficients

// (t - a)^3 / 3 + e t
Cubic cube(double a, double e)
{
  const double b = 1 - a;
  return { -a * a * a / 3, a * a * b / 3 + e / 3, -a * b * b / 3 + 2 * e / 3, b * b * b / 3 + e };
}

// (t - a)^2 / 2
Cubic square(double a)
{
  const double b = 1 - a;
  return { a * a / 2, (a * a - 2 * a * b) / 6, (b * b - 2 * a * b) / 6, b * b / 2 };
}

// p(x) + q(y) + r(z)
BS::Enclosed_tricubic sum(const Cubic& p, const Cubic& q, const Cubic& r)
{
  BS::Enclosed_tricubic f;
  for(int n = 0; n < 64; ++n) f.coefficients[n] = p[n % 4] + q[n / 4 % 4] + r[n / 16];
  return f;
}

} // namespace

TEST_CASE("Critical points: the critical point of a quadratic function is proved, and lies in the returned box")
{
  std::size_t wrong = 0;
  for(double x : { 0.1, 0.3, 0.5, 0.8 })
    for(double y : { 0.2, 0.5, 0.9 }) {
      const auto p = BS::prove_critical_point(sum(square(x), square(y), square(0.4)));
      REQUIRE(p);
      wrong += std::abs(p->center[0] - x) > p->radius || std::abs(p->center[1] - y) > p->radius
               || std::abs(p->center[2] - 0.4) > p->radius;
      for(double c : p->center) wrong += !(c - p->radius >= 0 && c + p->radius <= 1);
    }
  CHECK(wrong == 0);
}

TEST_CASE("Critical points: none is proved if the gradient is only close to zero and second derivatives vanish")
{
  // The derivative with respect to x is (x - a)^2 + e > 0.
  std::size_t proved = 0;
  for(double a : { 0.1, 0.25, 0.4, 0.6, 0.75, 0.9 })
    for(double e : { 1e-3, 1e-6, 1e-12 }) {
      proved += BS::prove_critical_point(sum(cube(a, e), square(0.5), square(0.5))).has_value();
      proved += BS::prove_critical_point(sum(square(0.5), cube(a, e), square(0.5))).has_value();
      proved += BS::prove_critical_point(sum(square(0.5), square(0.5), cube(a, e))).has_value();
    }
  CHECK(proved == 0);
}

TEST_CASE("Critical points: near a side the returned box stays in the cell, and beyond the side none is proved")
{
  for(double x : { 0.02, 0.98 }) {
    const auto p = BS::prove_critical_point(sum(square(x), square(0.5), square(0.5)));
    REQUIRE(p);
    CHECK(p->center[0] - p->radius >= 0);
    CHECK(p->center[0] + p->radius <= 1);
  }
  for(double x : { -0.02, 1.02 }) CHECK_FALSE(BS::prove_critical_point(sum(square(x), square(0.5), square(0.5))));
}

TEST_CASE("Critical points: none is proved while Newton's method has not converged")
{
  // The derivative c + m t + (1 - m) t^2 / 2 is positive. Its zero is beyond the side, and the steps towards it are
  // short.
  constexpr double m = 0.02, c = 0.01 * m;
  const Cubic slow = { 0, c / 3, 2 * c / 3 + m / 6, c + m / 2 + (1 - m) / 6 };
  CHECK_FALSE(BS::prove_critical_point(sum(slow, square(0.5), square(0.5))));
  CHECK_FALSE(BS::prove_critical_point(sum(square(0.5), slow, square(0.5))));
  CHECK_FALSE(BS::prove_critical_point(sum(square(0.5), square(0.5), slow)));
}

TEST_CASE("Critical points: none is proved if a function within the radius may have its critical point beyond the box")
{
  // Slopes of functions within the radius differ by up to six times the radius, 0.03. So do the zeros, which are only
  // 0.02 from the side.
  BS::Enclosed_tricubic f = sum(square(0.02), square(0.5), square(0.5));
  f.radius = 0.005;
  CHECK_FALSE(BS::prove_critical_point(f));
}

TEST_CASE("Critical points: none is proved if the error radius is too large")
{
  BS::Enclosed_tricubic f = sum(square(0.5), square(0.5), square(0.5));
  REQUIRE(BS::prove_critical_point(f));
  f.radius = 0.1;
  CHECK_FALSE(BS::prove_critical_point(f));
}
} // namespace test_critical_point
