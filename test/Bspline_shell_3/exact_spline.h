// The oracle for fields: Eq. 3.1 and 3.3 of the paper, summed over the coefficients of the spline in exact arithmetic,
// and Bernstein forms. It shares no code with the library's evaluation.
#ifndef EXACT_SPLINE_H
#define EXACT_SPLINE_H

#include "exact_vectors.h"

#include <array>
#include <cmath>

// Returns Eq. 3.1 of the paper as printed, or its pieces differentiated by hand.
inline Rational bspline(const Rational& t, int order)
{
  const Rational a = t < 0 ? Rational(-t) : t; // the function is even
  const int sign = t < 0 ? -1 : 1;
  if(a >= 2) return Rational(0);
  if(order == 0)
    return a >= 1 ? Rational(-a * a * a / 6 + a * a - 2 * a + Rational(4) / 3)
                  : Rational(a * a * a / 2 - a * a + Rational(2) / 3);
  if(order == 1) return a >= 1 ? Rational(sign * (-a * a / 2 + 2 * a - 2)) : Rational(sign * (3 * a * a / 2 - 2 * a));
  return a >= 1 ? Rational(2 - a) : Rational(3 * a - 2);
}

// Returns the position in units of the lattice; cell (i, j, k) begins at (i, j, k).
template <typename Field>
Exact_point lattice_coordinates(const Field& field, const Exact_point& p)
{
  const auto& lattice = field.cells().lattice();
  Exact_point u;
  for(int a = 0; a < 3; ++a) u[a] = (p[a] - Rational(lattice.origin()[a])) / Rational(lattice.spacing());
  return u;
}

// Returns the spline, or its derivative of the given order along each axis, per user unit.
// \pre all cells have the same size
template <typename Field>
Rational exact_value(const Field& field, const Exact_point& p, const std::array<int, 3>& order = { 0, 0, 0 })
{
  const Exact_point u = lattice_coordinates(field, p);
  int first[3];
  std::array<Rational, 6> b[3];
  for(int a = 0; a < 3; ++a) {
    first[a] = int(std::floor(CGAL::to_double(u[a]))) - 2; // four do not vanish; one more on each side for rounding
    for(int n = 0; n < 6; ++n) b[a][n] = bspline(u[a] - (first[a] + n), order[a]);
  }
  Rational sum(0);
  for(int k = 0; k < 6; ++k)
    for(int j = 0; j < 6; ++j)
      for(int i = 0; i < 6; ++i) {
        const auto g = field.points(0).index(first[0] + i, first[1] + j, first[2] + k);
        if(g != field.npos && b[0][i] != 0 && b[1][j] != 0 && b[2][k] != 0)
          sum += Rational(field.coefficients()[g]) * b[0][i] * b[1][j] * b[2][k];
      }
  for(int a = 0; a < 3; ++a)
    for(int n = 0; n < order[a]; ++n) sum /= Rational(field.cells().lattice().spacing());
  return sum;
}

typedef std::array<Rational, 64> Exact_coefficients;

inline Exact_coefficients exact_coefficients(const std::array<double, 64>& b)
{
  Exact_coefficients exact;
  for(int n = 0; n < 64; ++n) exact[n] = Rational(b[n]);
  return exact;
}

// Returns the polynomial with the given Bernstein coefficients on a cell, or a derivative of order at most two along
// each axis, per unit of the cell.
inline Rational bernstein_value(const Exact_coefficients& b, const Exact_point& t,
                                const std::array<int, 3>& order = { 0, 0, 0 })
{
  std::array<Rational, 4> w[3];
  for(int a = 0; a < 3; ++a) {
    const Rational& x = t[a];
    const Rational s = 1 - x;
    if(order[a] == 0) w[a] = { s * s * s, 3 * s * s * x, 3 * s * x * x, x * x * x };
    if(order[a] == 1) w[a] = { -3 * s * s, 3 * s * (s - 2 * x), 3 * x * (2 * s - x), 3 * x * x };
    if(order[a] == 2) w[a] = { 6 * s, 6 * (x - 2 * s), 6 * (s - 2 * x), 6 * x };
  }
  Rational sum(0);
  for(int k = 0; k < 4; ++k)
    for(int j = 0; j < 4; ++j) {
      Rational row(0);
      for(int i = 0; i < 4; ++i) row += b[16 * k + 4 * j + i] * w[0][i];
      sum += row * w[1][j] * w[2][k];
    }
  return sum;
}

#endif // EXACT_SPLINE_H
