// facet_normal.h: the exact normal, times a positive factor, is within the radius around the direction.
#include "exact_spline.h"
#include "test_random.h"

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace test_facet_normal {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
typedef CGAL::Exact_predicates_inexact_constructions_kernel::Vector_3 Vector_3;

Exact_point exact_normal(const Point_3& p, const Point_3& q, const Point_3& r)
{
  Exact_point u, v;
  for(int a = 0; a < 3; ++a) {
    u[a] = Rational(q[a]) - Rational(p[a]);
    v[a] = Rational(r[a]) - Rational(p[a]);
  }
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

// Returns whether there is a factor for which all components are within the radius.
bool encloses(const BS::Facet_normal& found, const Exact_point& n)
{
  Rational least(0), most(-1);
  for(int a = 0; a < 3; ++a) {
    const Rational low = Rational(found.direction[a]) - Rational(found.radius),
                   high = Rational(found.direction[a]) + Rational(found.radius);
    if(n[a] == 0) {
      if(low > 0 || high < 0) return false;
      continue;
    }
    const Rational from = n[a] > 0 ? Rational(low / n[a]) : Rational(high / n[a]),
                   to = n[a] > 0 ? Rational(high / n[a]) : Rational(low / n[a]);
    least = (std::max)(least, from);
    most = most < 0 ? to : (std::min)(most, to);
  }
  return most > 0 && least <= most;
}

void check(const Point_3& p, const Point_3& q, const Point_3& r)
{
  if(CGAL::collinear(p, q, r)) return;
  const BS::Facet_normal found = BS::facet_normal(p, q, r);
  CHECK(encloses(found, exact_normal(p, q, r)));
  CHECK((std::max)({ std::abs(found.direction[0]), std::abs(found.direction[1]), std::abs(found.direction[2]) })
        == Approx(1));
  CHECK(found.radius < 1e-7);
}

Vector_3 random_vector(CGAL::Random& random)
{
  return Vector_3(random_number(random, -1, 1), random_number(random, -1, 1), random_number(random, -1, 1));
}

} // namespace

TEST_CASE(
  "Facet normals: the exact normal is enclosed for facets of all shapes and sizes, near the origin and far away")
{
  CGAL::Random random(1);
  for(int n = 0; n < 4000; ++n) {
    const double far = n % 4 == 0 ? std::ldexp(1., n / 4 % 30) : 0;
    const Point_3 p = CGAL::ORIGIN + far * random_vector(random), q = p + random_vector(random);
    // The shapes range from equilateral triangles to needles that are almost degenerate after rounding.
    const Point_3 r = p + random.get_double(-1, 1) * (q - p) + std::ldexp(1., -(n % 60)) * random_vector(random);
    check(p, q, r);
  }
}

TEST_CASE("Facet normals: the exact normal is enclosed, even if products underflow")
{
  CGAL::Random random(2);
  for(int exponent : { -100, -400, -480, -500, -512, -520, -530, -537 })
    for(int n = 0; n < 50; ++n) {
      const double size = std::ldexp(1., exponent);
      check(CGAL::ORIGIN + size * random_vector(random), CGAL::ORIGIN + size * random_vector(random),
            CGAL::ORIGIN + size * random_vector(random));
    }
}

TEST_CASE("Facet normals: reversing the corners reverses the normal, even if the normal is computed exactly")
{
  const Point_3 p(0, 0, 0), q(1, 1, 1);
  for(double width : { 1., 1e-3, 1e-9, 1e-14 }) {
    const Point_3 r(1, 1 + width, 1);
    CHECK(BS::facet_normal(p, q, r).direction[0] < -0.9);
    CHECK(BS::facet_normal(q, p, r).direction[0] > 0.9);
    check(p, q, r);
  }
}
} // namespace test_facet_normal
