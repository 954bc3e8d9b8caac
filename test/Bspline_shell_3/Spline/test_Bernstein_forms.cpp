// A tricubic on a segment or a triangle in its cell, as a Bernstein form of degree nine. Polynomials of degree nine are
// equal if they agree at ten points of a segment, or at the 55 points (i, j, k) / 9 of a triangle. With rational
// numbers, comparisons at these points are proofs.
#include <CGAL/Bspline_shell_3/Spline/Bernstein_forms.h>
#include "test_random.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Random.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace test_Bernstein_forms {
namespace {

namespace BS = CGAL::Bspline_shells;
typedef CGAL::Exact_rational Rational;
typedef std::array<Rational, 3> Exact_point;
typedef std::array<double, 3> Point;
typedef std::array<double, 64> Coefficients;

Rational power(const Rational& x, int n)
{
  Rational r(1);
  for(int m = 0; m < n; ++m) r *= x;
  return r;
}

// The definition: the sum of c(i, j, k) B_i(x) B_j(y) B_k(z).
Rational tricubic(const Coefficients& c, const Exact_point& p)
{
  const int binomial[4] = { 1, 3, 3, 1 };
  std::array<Rational, 4> b[3];
  for(int a = 0; a < 3; ++a)
    for(int i = 0; i < 4; ++i) b[a][i] = binomial[i] * power(p[a], i) * power(1 - p[a], 3 - i);
  Rational sum(0);
  for(int k = 0; k < 4; ++k)
    for(int j = 0; j < 4; ++j)
      for(int i = 0; i < 4; ++i) sum += Rational(c[i + 4 * j + 16 * k]) * b[0][i] * b[1][j] * b[2][k];
  return sum;
}

template <typename NT, std::size_t size>
NT de_casteljau(std::array<NT, size> b, const NT& t)
{
  for(std::size_t n = size - 1; n > 0; --n)
    for(std::size_t i = 0; i < n; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
  return b[0];
}

// Returns the position in the order of decreasing exponents of the first corner, then of the second.
std::size_t position(int degree, int i, int j)
{
  std::size_t n = 0;
  for(int ii = degree; ii >= 0; --ii)
    for(int jj = degree - ii; jj >= 0; --jj, ++n)
      if(ii == i && jj == j) return n;
  return n;
}

Rational de_casteljau(const std::array<Rational, 55>& coefficients, const std::array<Rational, 3>& barycentric)
{
  std::vector<Rational> b(coefficients.begin(), coefficients.end());
  for(int d = 8; d >= 0; --d) {
    std::vector<Rational> next;
    for(int i = d; i >= 0; --i)
      for(int j = d - i; j >= 0; --j)
        next.push_back(barycentric[0] * b[position(d + 1, i + 1, j)] + barycentric[1] * b[position(d + 1, i, j + 1)]
                       + barycentric[2] * b[position(d + 1, i, j)]);
    b = next;
  }
  return b[0];
}

template <typename NT>
std::array<NT, 3> as(const Point& p)
{
  return { NT(p[0]), NT(p[1]), NT(p[2]) };
}

Coefficients random_coefficients(CGAL::Random& random)
{
  Coefficients c;
  for(double& x : c) x = random.get_double(-1, 1);
  return c;
}

Coefficients unit_coefficients(int n)
{
  Coefficients c = {};
  c[n] = 1;
  return c;
}

// The allowance in level_bounds.h relies on this constant.
const double rounding = 26 * std::numeric_limits<double>::epsilon();

} // namespace

TEST_CASE("Bernstein forms: the form on a segment equals the tricubic")
{
  CGAL::Random random(1);
  for(int n = 0; n < 5; ++n) {
    const Coefficients c = random_coefficients(random);
    // The last segments leave the cell, where the form must still equal the tricubic.
    const Exact_point p = as<Rational>(random_point(random));
    Exact_point q = as<Rational>(random_point(random));
    if(n > 2) q[n - 3] += 2;
    const std::array<Rational, 10> b = BS::segment_bernstein_form<Rational>(c.data(), p, q);
    for(int m = 0; m <= 9; ++m) {
      const Rational t = Rational(m) / 9;
      Exact_point x;
      for(int a = 0; a < 3; ++a) x[a] = (1 - t) * p[a] + t * q[a];
      CHECK(de_casteljau(b, t) == tricubic(c, x));
    }
    CHECK(b[0] == tricubic(c, p));
    CHECK(b[9] == tricubic(c, q));
  }
}

TEST_CASE("Bernstein forms: the form on a triangle equals the tricubic")
{
  CGAL::Random random(2);
  for(int n = 0; n < 3; ++n) {
    const Coefficients c = random_coefficients(random);
    Exact_point corner[3];
    for(Exact_point& p : corner) p = as<Rational>(random_point(random));
    if(n == 2) corner[1][2] += 2;
    const std::array<Rational, 55> b = BS::triangle_bernstein_form<Rational>(c.data(), corner[0], corner[1], corner[2]);
    for(int i = 0; i <= 9; ++i)
      for(int j = 0; i + j <= 9; ++j) {
        const std::array<Rational, 3> barycentric = { Rational(i) / 9, Rational(j) / 9, Rational(9 - i - j) / 9 };
        Exact_point x;
        for(int a = 0; a < 3; ++a)
          x[a] = barycentric[0] * corner[0][a] + barycentric[1] * corner[1][a] + barycentric[2] * corner[2][a];
        CHECK(de_casteljau(b, barycentric) == tricubic(c, x));
      }
    CHECK(b[0] == tricubic(c, corner[0]));
    CHECK(b[45] == tricubic(c, corner[1]));
    CHECK(b[54] == tricubic(c, corner[2]));
  }
}

TEST_CASE("Bernstein forms: coefficients are sorted by decreasing exponent of the first corner, then of the second")
{
  // The function x has the coefficients i/3. On a triangle, its coefficients are weighted means of x at the corners.
  Coefficients c;
  for(int n = 0; n < 64; ++n) c[n] = n % 4 * 3; // 9 x has integer coefficients
  const Exact_point p = { Rational(1) / 2, Rational(0), Rational(1) },
                    q = { Rational(1) / 8, Rational(1), Rational(0) },
                    r = { Rational(1), Rational(1) / 3, Rational(1) };
  const std::array<Rational, 10> s = BS::segment_bernstein_form<Rational>(c.data(), p, q);
  for(int m = 0; m <= 9; ++m) CHECK(s[m] == (9 - m) * p[0] + m * q[0]);
  const std::array<Rational, 55> b = BS::triangle_bernstein_form<Rational>(c.data(), p, q, r);
  int n = 0;
  for(int i = 9; i >= 0; --i)
    for(int j = 9 - i; j >= 0; --j, ++n) CHECK(b[n] == i * p[0] + j * q[0] + (9 - i - j) * r[0]);
}

TEST_CASE("Bernstein forms: sides of a triangle's form are the forms of its sides")
{
  CGAL::Random random(3);
  const Coefficients c = random_coefficients(random);
  const Exact_point p = as<Rational>(random_point(random)), q = as<Rational>(random_point(random)),
                    r = as<Rational>(random_point(random));
  const std::array<Rational, 55> b = BS::triangle_bernstein_form<Rational>(c.data(), p, q, r);
  const std::array<Rational, 10> pq = BS::segment_bernstein_form<Rational>(c.data(), p, q);
  const std::array<Rational, 10> qr = BS::segment_bernstein_form<Rational>(c.data(), q, r);
  const std::array<Rational, 10> rp = BS::segment_bernstein_form<Rational>(c.data(), r, p);
  for(int m = 0; m <= 9; ++m) {
    CHECK(pq[m] == b[position(9, 9 - m, m)]);
    CHECK(qr[m] == b[position(9, 0, 9 - m)]);
    CHECK(rp[m] == b[position(9, m, 0)]);
  }
}

TEST_CASE("Bernstein forms: every coefficient is a convex combination of the cell's coefficients")
{
  // The form is linear in the coefficients of the cell; its weights are the forms of the 64 unit vectors.
  CGAL::Random random(4);
  Exact_point p = as<Rational>(random_point(random)), q = as<Rational>(random_point(random)),
              r = as<Rational>(random_point(random));
  p[0] = 0;
  q[1] = 1;
  r = { Rational(1), Rational(0), Rational(1) }; // also on the boundary of the cell
  std::array<Rational, 10> segment_sum;
  std::array<Rational, 55> triangle_sum;
  segment_sum.fill(Rational(0));
  triangle_sum.fill(Rational(0));
  for(int n = 0; n < 64; ++n) {
    const Coefficients c = unit_coefficients(n);
    const std::array<Rational, 10> s = BS::segment_bernstein_form<Rational>(c.data(), p, q);
    const std::array<Rational, 55> t = BS::triangle_bernstein_form<Rational>(c.data(), p, q, r);
    CHECK(*std::min_element(s.begin(), s.end()) >= 0);
    CHECK(*std::min_element(t.begin(), t.end()) >= 0);
    for(int m = 0; m < 10; ++m) segment_sum[m] += s[m];
    for(int m = 0; m < 55; ++m) triangle_sum[m] += t[m];
  }
  for(const Rational& sum : segment_sum) CHECK(sum == 1);
  for(const Rational& sum : triangle_sum) CHECK(sum == 1);
}

TEST_CASE("Bernstein forms: doubles are within 26 eps of the largest coefficient, and intervals contain the form")
{
  typedef CGAL::Interval_nt<false> Interval;
  CGAL::Random random(5);
  for(int n = 0; n < 10; ++n) {
    Coefficients c = random_coefficients(random);
    if(n % 2)
      for(double& x : c) x += 1000; // large values have large absolute errors
    double largest = 0;
    for(double x : c) largest = (std::max)(largest, std::abs(x));
    const Point p = random_point(random), q = random_point(random), r = random_point(random);
    const std::array<Rational, 10> s = BS::segment_bernstein_form(c.data(), as<Rational>(p), as<Rational>(q));
    const std::array<Rational, 55> t = BS::triangle_bernstein_form(c.data(), as<Rational>(p), as<Rational>(q),
                                                                   as<Rational>(r));
    const std::array<double, 10> sd = BS::segment_bernstein_form(c.data(), p, q);
    const std::array<double, 55> td = BS::triangle_bernstein_form(c.data(), p, q, r);
    std::array<Interval, 10> si;
    std::array<Interval, 55> ti;
    {
      Interval::Protector protector;
      si = BS::segment_bernstein_form(c.data(), as<Interval>(p), as<Interval>(q));
      ti = BS::triangle_bernstein_form(c.data(), as<Interval>(p), as<Interval>(q), as<Interval>(r));
    }
    const auto check = [&](const Rational& exact, double rounded, const Interval& enclosure) {
      CHECK(std::abs(CGAL::to_double(Rational(Rational(rounded) - exact))) <= rounding * largest);
      CHECK(Rational(enclosure.inf()) <= exact);
      CHECK(Rational(enclosure.sup()) >= exact);
      CHECK(enclosure.sup() - enclosure.inf() <= 4 * rounding * largest); // narrow enough to be useful
    };
    for(int m = 0; m < 10; ++m) check(s[m], sd[m], si[m]);
    for(int m = 0; m < 55; ++m) check(t[m], td[m], ti[m]);
  }
}
} // namespace test_Bernstein_forms
