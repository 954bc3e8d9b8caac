// check_certificate/interval.h: an interval contains what exact arithmetic gives for any two numbers of its operands, also where
// rounding to nearest leaves it out.
#include "interval.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace {

bool contains(const Interval& i, const Rational& r) { return Rational(i.lo) <= r && r <= Rational(i.hi); }

// of all signs, some of them single numbers, with sizes far apart
std::vector<Interval> intervals()
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60);
  std::vector<Interval> result;
  for(int n = 0; n < 60; ++n) {
    const double a = std::ldexp(number(random), exponent(random)), b = n % 3 == 0 ? a : std::ldexp(number(random), exponent(random));
    result.emplace_back((std::min)(a, b), (std::max)(a, b));
  }
  result.emplace_back(-0.1, 0.1);
  result.emplace_back(0.);
  return result;
}

} // namespace

TEST_CASE("intervals of the checker: sums, differences and products contain those of all ends")
{
  std::size_t wrong_sums = 0, wrong_differences = 0, wrong_products = 0, wrong_quotients = 0;
  for(const Interval& i : intervals())
    for(const Interval& j : intervals())
      for(double x : { i.lo, i.hi })
        for(double y : { j.lo, j.hi }) {
          wrong_sums += !contains(i + j, Rational(x) + Rational(y));
          wrong_differences += !contains(i - j, Rational(x) - Rational(y));
          wrong_products += !contains(i * j, Rational(x) * Rational(y));
          if(y > 0) wrong_quotients += !contains(i / y, Rational(x) / Rational(y));
        }
  CHECK(wrong_sums == 0);
  CHECK(wrong_differences == 0);
  CHECK(wrong_products == 0);
  CHECK(wrong_quotients == 0);
}

TEST_CASE("intervals of the checker: they are no wider than rounding makes them")
{
  const Interval i(1, 2), j(-3, 5);
  CHECK((i + j).lo == down(-2.));
  CHECK((i + j).hi == up(7.));
  CHECK((i - j).lo == down(-4.));
  CHECK((i - j).hi == up(5.));
  CHECK((i * j).lo == down(-6.));
  CHECK((i * j).hi == up(10.));
}

TEST_CASE("intervals of the checker: a hull contains all of them; a rational number lies in its interval")
{
  const Interval h = hull(std::vector<Interval>{ { 0, 1 }, { -2, -1 }, { 3, 4 } });
  CHECK(h.lo == -2);
  CHECK(h.hi == 4);
  std::size_t wrong = 0;
  for(int p = -20; p <= 20; ++p)
    for(int q = 1; q <= 20; ++q) {
      const Rational r = Rational(p) / q;
      const Interval i = enclose(r);
      wrong += !contains(i, r) || i.hi > up(up(up(i.lo)));
    }
  CHECK(wrong == 0);
}

TEST_CASE("intervals of the checker: the arithmetic of this machine is what they rely on") { CHECK(usable_arithmetic()); }
