// The univariate cubic B-spline: all properties are identities of polynomials with rational coefficients, and are
// tested in exact arithmetic. Two cubics that agree at the 17 points k/16 are equal.
#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include "exact_spline.h"

#include <CGAL/Interval_nt.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace test_Cubic_bspline {
namespace {

typedef CGAL::Bspline_shells::Cubic_bspline<Rational> Basis;
typedef Basis::Weights Weights;

Weights basis(int order, const Rational& t)
{
  return order == 0 ? Basis::values(t) : order == 1 ? Basis::first_derivatives(t) : Basis::second_derivatives(t);
}

Rational sixteenths(int k)
{
  return Rational(k) / 16;
}

// Coefficients of a spline that are not multiples of each other.
const Weights some_coefficients = { Rational(7) / 3, Rational(-11) / 5, Rational(13) / 2, Rational(1) / 17 };

} // namespace

TEST_CASE("B-splines: values and derivatives on a cell agree with Eq. 3.1, centered at the knots -1, 0, 1, 2")
{
  for(int order = 0; order < 3; ++order)
    for(int k = 0; k <= 16; ++k) {
      const Weights w = basis(order, sixteenths(k));
      for(int n = 0; n < 4; ++n) {
        CAPTURE(order, k, n);
        CHECK(w[n] == bspline(sixteenths(k) - (n - 1), order));
      }
    }
}

TEST_CASE("B-splines: the four functions sum to one and their derivatives to zero")
{
  for(int k = -16; k <= 32; ++k) // also where the pieces are continued beyond the cell
    for(int order = 0; order < 3; ++order) {
      const Weights w = basis(order, sixteenths(k));
      CHECK(w[0] + w[1] + w[2] + w[3] == (order == 0 ? 1 : 0));
    }
}

TEST_CASE("B-splines: no function is negative on the cell")
{
  for(int k = 0; k <= 16; ++k)
    for(const Rational& w : Basis::values(sixteenths(k))) CHECK(w >= 0);
}

TEST_CASE("B-splines: derivatives agree with difference quotients")
{
  // These five-point formulas are exact for polynomials of degree four and five, so no limit is needed.
  for(const Rational& h : { Rational(1), Rational(1, 7) })
    for(int k = 0; k <= 16; ++k) {
      const Rational t = sixteenths(k);
      const Weights ll = Basis::values(t - 2 * h), l = Basis::values(t - h), m = Basis::values(t),
                    r = Basis::values(t + h), rr = Basis::values(t + 2 * h);
      const Weights first = Basis::first_derivatives(t), second = Basis::second_derivatives(t);
      for(int n = 0; n < 4; ++n) {
        CHECK(first[n] == (ll[n] - 8 * l[n] + 8 * r[n] - rr[n]) / (12 * h));
        CHECK(second[n] == (-ll[n] + 16 * l[n] - 30 * m[n] + 16 * r[n] - rr[n]) / (12 * h * h));
      }
    }
}

TEST_CASE("B-splines: value, first and second derivative are continuous at a knot")
{
  for(int order = 0; order < 3; ++order) {
    const Weights left = basis(order, Rational(1)), right = basis(order, Rational(0));
    CHECK(left[0] == 0); // this function ends here
    for(int n = 0; n < 3; ++n) CHECK(left[n + 1] == right[n]);
    CHECK(right[3] == 0); // this one begins here
  }
}

TEST_CASE("B-splines: polynomials up to degree three are reproduced")
{
  // The coefficient at knot g is the polar form at (g-1, g, g+1).
  const auto coefficient = [](int degree, const Rational& g) {
    return degree == 0   ? Rational(1)
           : degree == 1 ? g
           : degree == 2 ? Rational(g * g - Rational(1) / 3)
                         : Rational(g * g * g - g);
  };
  const auto power = [](const Rational& x, int n) {
    Rational r(1);
    for(int m = 0; m < n; ++m) r *= x;
    return r;
  };
  for(int degree = 0; degree <= 3; ++degree)
    for(int cell : { -3, 0, 5 })
      for(int k = 0; k <= 16; ++k) {
        const Rational t = sixteenths(k), x = cell + t;
        Rational sum[3] = { Rational(0), Rational(0), Rational(0) };
        for(int order = 0; order < 3; ++order)
          for(int n = 0; n < 4; ++n) sum[order] += basis(order, t)[n] * coefficient(degree, Rational(cell + n - 1));
        CAPTURE(degree, cell, k);
        CHECK(sum[0] == power(x, degree));
        CHECK(sum[1] == (degree < 1 ? Rational(0) : Rational(degree * power(x, degree - 1))));
        CHECK(sum[2] == (degree < 2 ? Rational(0) : Rational(degree * (degree - 1) * power(x, degree - 2))));
      }
}

TEST_CASE("B-splines: each function is a sum of five functions of half the width")
{
  const auto mask = Basis::two_scale_mask();
  for(int k = -40; k <= 40; ++k) {
    const Rational t = sixteenths(k);
    Rational sum(0);
    for(int j = -2; j <= 2; ++j) sum += mask[j + 2] * bspline(2 * t - j, 0);
    CHECK(sum == bspline(t, 0));
  }
}

TEST_CASE("B-splines: the Bernstein form is the same cubic")
{
  const Weights b = Basis::bernstein_coefficients(some_coefficients);
  for(int k = 0; k <= 16; ++k) {
    const Rational t = sixteenths(k), s = 1 - t;
    const Weights w = Basis::values(t);
    Rational spline(0);
    for(int n = 0; n < 4; ++n) spline += w[n] * some_coefficients[n];
    CHECK(s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3] == spline);
  }
}

TEST_CASE("B-splines: doubles agree with rational numbers up to rounding, and intervals contain these")
{
  typedef CGAL::Interval_nt<false> Interval;
  // At most eight roundings of terms that are at most 4.
  const double tolerance = 8 * 4 * std::numeric_limits<double>::epsilon() / 2;
  for(int n = 0; n <= 100; ++n) {
    const double t = n / 100.;
    for(int order = 0; order < 3; ++order) {
      const Weights exact = basis(order, Rational(t));
      typedef CGAL::Bspline_shells::Cubic_bspline<double> Double_basis;
      const std::array<double, 4> w = order == 0   ? Double_basis::values(t)
                                      : order == 1 ? Double_basis::first_derivatives(t)
                                                   : Double_basis::second_derivatives(t);
      std::array<Interval, 4> enclosure;
      {
        Interval::Protector protector;
        typedef CGAL::Bspline_shells::Cubic_bspline<Interval> Interval_basis;
        enclosure = order == 0   ? Interval_basis::values(t)
                    : order == 1 ? Interval_basis::first_derivatives(t)
                                 : Interval_basis::second_derivatives(t);
      }
      for(int m = 0; m < 4; ++m) {
        CHECK(std::abs(CGAL::to_double(Rational(Rational(w[m]) - exact[m]))) <= tolerance);
        CHECK(Rational(enclosure[m].inf()) <= exact[m]);
        CHECK(Rational(enclosure[m].sup()) >= exact[m]);
        CHECK(enclosure[m].sup() - enclosure[m].inf() <= 2 * tolerance);
      }
    }
  }
}
} // namespace test_Cubic_bspline
