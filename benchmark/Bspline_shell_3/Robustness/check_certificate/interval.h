// Intervals of doubles that enclose real numbers, rounded outwards after every operation; exact rationals.
#ifndef CHECK_CERTIFICATE_INTERVAL_H
#define CHECK_CERTIFICATE_INTERVAL_H

// Depending on the size of the program, GCC warns of members that Boost neither initializes nor uses.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

typedef boost::multiprecision::cpp_rational Rational;

// Returns std::nextafter to +infinity for finite numbers. A separate function, as it has to be inlined.
inline double up(double x)
{
  x += 0.; // -0 would have another successor
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof x);
  bits += bits >= 0 ? 1 : -1;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline double down(double x)
{
  return -up(-x);
}

struct Interval
{
  Interval(double x = 0) : lo(x), hi(x) {}
  Interval(double l, double h) : lo(l), hi(h) {}
  double lo, hi;
};

inline Interval operator+(const Interval& a, const Interval& b)
{
  return Interval(down(a.lo + b.lo), up(a.hi + b.hi));
}
inline Interval operator-(const Interval& a, const Interval& b)
{
  return Interval(down(a.lo - b.hi), up(a.hi - b.lo));
}
inline Interval operator*(const Interval& a, const Interval& b)
{
  const double c = a.lo * b.lo, d = a.lo * b.hi, e = a.hi * b.lo, f = a.hi * b.hi;
  return Interval(down((std::min)((std::min)(c, d), (std::min)(e, f))),
                  up((std::max)((std::max)(c, d), (std::max)(e, f))));
}
// The divisor is positive.
inline Interval operator/(const Interval& a, double b)
{
  return Interval(down(a.lo / b), up(a.hi / b));
}

template <class Range>
Interval hull(const Range& range)
{
  Interval h = range[0];
  for(const Interval& i : range) h = Interval((std::min)(h.lo, i.lo), (std::max)(h.hi, i.hi));
  return h;
}

inline Interval enclose(const Rational& r)
{
  const double d = r.convert_to<double>();
  Interval i(down(d), up(d));
  while(Rational(i.lo) > r) i.lo = down(i.lo);
  while(Rational(i.hi) < r) i.hi = up(i.hi);
  return i;
}

// Returns whether double arithmetic satisfies the assumptions of intervals.
inline bool usable_arithmetic()
{
#ifdef __FAST_MATH__
  return false;
#endif
  volatile double one = 1, least = (std::numeric_limits<double>::min)(), half = 0.5,
                  nan = std::numeric_limits<double>::quiet_NaN();
  volatile double u = std::ldexp(1., -53), more = std::ldexp(1., -53) + std::ldexp(1., -64), minus = -1;
  volatile double denormal = least * half, back = denormal * 2, to_even = one + u, above = one + more,
                  below = minus - u, toward = one - u * half;
  const volatile double copy = nan;
  bool usable = FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::is_iec559 && denormal != 0 && back == least
                && copy != nan && to_even == 1 && above == 1 + DBL_EPSILON && below == -1 && toward == 1;
  volatile double third = one / 3, product = third * 3;
  usable = usable && product == 1 && std::fma(double(third), 3., -1.) == -u / 2;
  for(double x :
      { 0., -0., 1., -1., 0.1, -0.1, 1e300, -1e-300, DBL_TRUE_MIN, -DBL_TRUE_MIN, DBL_MIN, -DBL_MIN, 2., -2. }) {
    volatile double v = x;
    usable = usable && up(v) == std::nextafter(x, HUGE_VAL) && down(v) == std::nextafter(x, -HUGE_VAL)
             && Rational(x).convert_to<double>() == x && (x == 0 || Rational(x) != Rational(up(v)));
  }
  return usable && Rational(0.1) == Rational(3602879701896397LL) / (1LL << 55);
}

#endif // CHECK_CERTIFICATE_INTERVAL_H
