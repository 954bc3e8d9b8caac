// Enclosures of tricubic polynomials on triangles and boxes.
#ifndef CHECK_CERTIFICATE_POLYNOMIALS_H
#define CHECK_CERTIFICATE_POLYNOMIALS_H

#include "interval.h"

#include <algorithm>
#include <array>
#include <cstddef>

// Bernstein coefficients of a tricubic polynomial over a cube, [i + 4 j + 16 k].
typedef std::array<Interval, 64> Coefficients;

// Homogeneous polynomials in three variables, as coefficients of monomials x^a y^b z^c in increasing order of (a, b).
constexpr int number_of_terms(int degree)
{
  return (degree + 1) * (degree + 2) / 2;
}

template <int DEGREE>
std::array<std::array<int, 3>, number_of_terms(DEGREE)> exponents()
{
  std::array<std::array<int, 3>, number_of_terms(DEGREE)> result;
  int n = 0;
  for(int a = 0; a <= DEGREE; ++a)
    for(int b = 0; b <= DEGREE - a; ++b) result[n++] = { a, b, DEGREE - a - b };
  return result;
}

template <int DEGREE>
struct Polynomial : std::array<Interval, number_of_terms(DEGREE)>
{};

template <int D, int E>
void add_product(const Polynomial<D>& p, const Polynomial<E>& q, Polynomial<D + E>& sum)
{
  static const auto index = [] {
    std::array<std::array<int, number_of_terms(E)>, number_of_terms(D)> table;
    const auto first = exponents<D>();
    const auto second = exponents<E>();
    const auto all = exponents<D + E>();
    for(std::size_t i = 0; i < first.size(); ++i)
      for(std::size_t j = 0; j < second.size(); ++j) {
        const std::array<int, 3> e = { first[i][0] + second[j][0], first[i][1] + second[j][1],
                                       first[i][2] + second[j][2] };
        table[i][j] = int(std::find(all.begin(), all.end(), e) - all.begin());
      }
    return table;
  }();
  for(std::size_t i = 0; i < p.size(); ++i)
    for(std::size_t j = 0; j < q.size(); ++j) {
      Interval& s = sum[index[i][j]];
      s = s + p[i] * q[j];
    }
}

template <int D, int E>
Polynomial<D + E> operator*(const Polynomial<D>& p, const Polynomial<E>& q)
{
  Polynomial<D + E> product;
  add_product(p, q, product);
  return product;
}

typedef std::array<std::array<Interval, 3>, 3> Triangle; // coordinates of its corners

// Returns the range of a tricubic polynomial on a triangle, in coordinates in which the leaf is the unit cube. The
// polynomial is expressed in barycentric coordinates. Its Bernstein coefficients are those of the monomials, divided by
// the multinomials.
inline Interval range_on_triangle(const Coefficients& b, const Triangle& corner)
{
  std::array<std::array<Polynomial<3>, 4>, 3> bernstein;
  for(int axis = 0; axis < 3; ++axis) {
    Polynomial<1> u, v;
    for(int i = 0; i < 3; ++i) {
      // exponents<1>() begins with the third variable
      u[i] = corner[2 - i][axis];
      v[i] = Interval(1) - u[i];
    }
    const Polynomial<2> uu = u * u, vv = v * v;
    bernstein[axis] = { vv * v, vv * u, uu * v, uu * u };
    for(int i = 1; i < 3; ++i)
      for(Interval& c : bernstein[axis][i]) c = c * 3;
  }
  Polynomial<9> f;
  for(int k = 0; k < 4; ++k) {
    Polynomial<6> plane;
    for(int j = 0; j < 4; ++j) {
      Polynomial<3> row;
      for(std::size_t n = 0; n < row.size(); ++n)
        for(int i = 0; i < 4; ++i) row[n] = row[n] + b[i + 4 * j + 16 * k] * bernstein[0][i][n];
      add_product(row, bernstein[1][j], plane);
    }
    add_product(plane, bernstein[2][k], f);
  }
  static const auto exponents_of_f = exponents<9>();
  const double factorial[] = { 1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880 };
  for(std::size_t n = 0; n < f.size(); ++n) {
    const auto& e = exponents_of_f[n];
    f[n] = f[n] / (factorial[9] / (factorial[e[0]] * factorial[e[1]] * factorial[e[2]]));
  }
  return hull(f);
}

// Extends the values at one end of the unit cube along an axis.
inline void make_constant(Coefficients& b, int axis, bool upper)
{
  const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  for(int n = 0; n < 64; ++n)
    if(n / stride % 4 == 0)
      for(int i = 0; i < 4; ++i) b[std::size_t(n + i * stride)] = b[std::size_t(n + (upper ? 3 : 0) * stride)];
}

// Restricts a polynomial on the unit cube to a half along an axis, by de Casteljau's algorithm.
inline void halve(Coefficients& b, int axis, bool upper)
{
  const int stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  const auto middle = [](const Interval& x, const Interval& y) { return (x + y) / 2; };
  for(int n = 0; n < 64; ++n)
    if(n / stride % 4 == 0) {
      Interval* const c[] = { &b[n], &b[n + stride], &b[n + 2 * stride], &b[n + 3 * stride] };
      const Interval m01 = middle(*c[0], *c[1]), m12 = middle(*c[1], *c[2]), m23 = middle(*c[2], *c[3]);
      const Interval m012 = middle(m01, m12), m123 = middle(m12, m23), m = middle(m012, m123);
      if(upper) {
        *c[0] = m;
        *c[1] = m123;
        *c[2] = m23;
      } else {
        *c[1] = m01;
        *c[2] = m012;
        *c[3] = m;
      }
    }
}

// Converts the B-spline coefficients that act on the cube, axis by axis.
inline Coefficients bernstein(Coefficients c)
{
  for(int stride = 1; stride < 64; stride *= 4)
    for(int n = 0; n < 64; ++n)
      if(n / stride % 4 == 0) {
        Interval &c0 = c[n], &c1 = c[n + stride], &c2 = c[n + 2 * stride], &c3 = c[n + 3 * stride];
        const Interval first = (c0 + c1 * 4 + c2) / 6, last = (c1 + c2 * 4 + c3) / 6;
        const Interval second = (c1 * 2 + c2) / 3, third = (c1 + c2 * 2) / 3;
        c0 = first;
        c1 = second;
        c2 = third;
        c3 = last;
      }
  return c;
}

inline Coefficients difference(const Coefficients& f, const Coefficients& g)
{
  Coefficients d;
  for(int n = 0; n < 64; ++n) d[n] = f[n] - g[n];
  return d;
}

// Returns d . grad f times the edge of the cube, which does not change the sign, elevated to degree three.
inline Coefficients derivative(const Coefficients& f, const std::array<Interval, 3>& d)
{
  Coefficients sum;
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4)
    for(int n = 0; n < 64; ++n)
      if(n / stride % 4 == 0) {
        const Interval d0 = f[n + stride] - f[n], d1 = f[n + 2 * stride] - f[n + stride],
                       d2 = f[n + 3 * stride] - f[n + 2 * stride];
        const Interval raised[] = { d0 * 3, d0 + d1 * 2, d1 * 2 + d2, d2 * 3 };
        for(int i = 0; i < 4; ++i) sum[n + i * stride] = sum[n + i * stride] + d[axis] * raised[i];
      }
  return sum;
}

// Returns (x - center) / 2 . grad f, in units of the cube: along each axis, a linear polynomial times one of degree
// two.
inline Coefficients along_half_offset(const Coefficients& f, const std::array<Interval, 3>& center)
{
  Coefficients sum;
  for(int axis = 0, stride = 1; axis < 3; ++axis, stride *= 4) {
    const Interval first = (Interval(0) - center[axis]) / 2, last = (Interval(1) - center[axis]) / 2;
    for(int n = 0; n < 64; ++n)
      if(n / stride % 4 == 0) {
        const Interval d0 = f[n + stride] - f[n], d1 = f[n + 2 * stride] - f[n + stride],
                       d2 = f[n + 3 * stride] - f[n + 2 * stride];
        const Interval product[] = { first * d0 * 3, last * d0 + first * d1 * 2, last * d1 * 2 + first * d2,
                                     last * d2 * 3 };
        for(int i = 0; i < 4; ++i) sum[n + i * stride] = sum[n + i * stride] + product[i];
      }
  }
  return sum;
}

#endif // CHECK_CERTIFICATE_POLYNOMIALS_H
