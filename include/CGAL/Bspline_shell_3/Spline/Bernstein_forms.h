// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_FORMS_H
#define CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_FORMS_H

#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>

#include <array>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

constexpr int factorial(int n)
{
  return n < 2 ? 1 : n * factorial(n - 1);
}
constexpr int binomial(int n, int k)
{
  return factorial(n) / (factorial(k) * factorial(n - k));
}

// The exponents of the barycentric coordinates in the Bernstein polynomials of a triangle, by decreasing first
// exponent.
template <int degree>
struct Triangle_indices
{
  static constexpr int size = (degree + 1) * (degree + 2) / 2;
  int exponent[size][3] = {};

  constexpr Triangle_indices()
  {
    for(int i = degree, n = 0; i >= 0; --i)
      for(int j = degree - i; j >= 0; --j, ++n) {
        exponent[n][0] = i;
        exponent[n][1] = j;
        exponent[n][2] = degree - i - j;
      }
  }
  static constexpr int index(int i, int j) { return (degree - i) * (degree - i + 1) / 2 + (degree - i - j); }
  constexpr int multinomial(int n) const
  {
    return factorial(degree) / (factorial(exponent[n][0]) * factorial(exponent[n][1]) * factorial(exponent[n][2]));
  }
};

// Maps products of cubic Bernstein polynomials of a triangle to their positions among those of degree six and nine.
struct Triangle_product_table
{
  unsigned char pair[10][10] = {};   // cubic x cubic -> degree six
  unsigned char triple[28][10] = {}; // degree six x cubic -> degree nine

  constexpr Triangle_product_table()
  {
    constexpr Triangle_indices<3> cubic;
    constexpr Triangle_indices<6> sextic;
    for(int b = 0; b < 10; ++b) {
      for(int a = 0; a < 10; ++a)
        pair[a][b] = static_cast<unsigned char>(Triangle_indices<6>::index(
          cubic.exponent[a][0] + cubic.exponent[b][0], cubic.exponent[a][1] + cubic.exponent[b][1]));
      for(int a = 0; a < 28; ++a)
        triple[a][b] = static_cast<unsigned char>(Triangle_indices<9>::index(
          sextic.exponent[a][0] + cubic.exponent[b][0], sextic.exponent[a][1] + cubic.exponent[b][1]));
    }
  }
};

// Returns the weights of a cubic's four Bernstein coefficients in its polar form at (u, v, w), times `multiplicity`.
template <typename NT>
inline std::array<NT, 4> polar_weights(const NT& u, const NT& v, const NT& w, int multiplicity)
{
  const NT u1 = NT(1) - u, v1 = NT(1) - v, w1 = NT(1) - w;
  const NT m(multiplicity);
  return { m * (u1 * v1 * w1), m * (u * v1 * w1 + u1 * v * w1 + u1 * v1 * w),
           m * (u * v * w1 + u * v1 * w + u1 * v * w), m * (u * v * w) };
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns the Bernstein coefficients, of degree nine, of a tricubic on the segment from `p` to `q`.
 *
 * `p` and `q` are positions in the cell (\f$[0,1]^3\f$, `Tricubic_cell_3::local_coordinates()`). The first coefficient
 * is the value at `p`, and the last is the value at `q`. The coefficients are computed from the polar form of the
 * tricubic. For a segment in the cell, they are convex combinations of the cell's coefficients. Bounds by the hull
 * property are therefore never worse than those of the cell.
 *
 * \tparam NT a number type, `double` or an interval
 * \param c 64 Bernstein coefficients of a cell
 * \param p the first end of the segment
 * \param q its other end
 */
template <typename NT>
std::array<NT, 10> segment_bernstein_form(const double* c, const std::array<NT, 3>& p, const std::array<NT, 3>& q)
{
  std::array<internal::Weights<NT>, 4> weights[3];
  for(int a = 0; a < 3; ++a)
    for(int n = 0; n < 4; ++n) // n arguments at q
      weights[a][n] = internal::polar_weights(n > 2 ? q[a] : p[a], n > 1 ? q[a] : p[a], n > 0 ? q[a] : p[a],
                                              internal::binomial(3, n));
  std::array<NT, 10> r;
  r.fill(NT(0));
  for(int i = 0; i < 4; ++i) {
    const std::array<NT, 16> z = internal::contract_slowest<16>(c, weights[2][i]);
    for(int j = 0; j < 4; ++j) {
      const std::array<NT, 4> y = internal::contract_slowest<4>(z.data(), weights[1][j]);
      for(int k = 0; k < 4; ++k) r[i + j + k] += internal::dot4(y.data(), weights[0][k]);
    }
  }
  for(int m = 0; m < 10; ++m) r[m] = r[m] / NT(internal::binomial(9, m));
  return r;
}

/*!
 * \ingroup PkgBsplineShell3Spline
 *
 * \brief returns the Bernstein coefficients, of degree nine, of a tricubic on the triangle `p`, `q`, `r`.
 *
 * The 55 coefficients are ordered by decreasing exponent of `p`, then of `q`. Coefficients 0, 45, and 54 are the values
 * at `p`, `q`, and `r`. See `segment_bernstein_form()` for positions, number type, and the hull property.
 */
template <typename NT>
std::array<NT, 55> triangle_bernstein_form(const double* c, const std::array<NT, 3>& p, const std::array<NT, 3>& q,
                                           const std::array<NT, 3>& r)
{
  static constexpr internal::Triangle_indices<3> cubic;
  static constexpr internal::Triangle_indices<9> nonic;
  static constexpr internal::Triangle_product_table table;

  internal::Weights<NT> weights[3][10];
  for(int a = 0; a < 3; ++a) {
    const NT* corner[3] = { &p[a], &q[a], &r[a] };
    for(int n = 0; n < 10; ++n) {
      const NT* argument[3];
      for(int v = 0, m = 0; v < 3; ++v)
        for(int e = 0; e < cubic.exponent[n][v]; ++e) argument[m++] = corner[v];
      weights[a][n] = internal::polar_weights(*argument[0], *argument[1], *argument[2], cubic.multinomial(n));
    }
  }
  // Sums over the z and y exponents first; the remaining sum is linear in the x rows.
  std::array<std::array<NT, 4>, 28> yz;
  for(auto& row : yz) row.fill(NT(0));
  for(int i = 0; i < 10; ++i) {
    const std::array<NT, 16> z = internal::contract_slowest<16>(c, weights[2][i]);
    for(int j = 0; j < 10; ++j) {
      const std::array<NT, 4> y = internal::contract_slowest<4>(z.data(), weights[1][j]);
      std::array<NT, 4>& row = yz[table.pair[i][j]];
      for(int k = 0; k < 4; ++k) row[k] += y[k];
    }
  }
  std::array<NT, 55> f;
  f.fill(NT(0));
  for(int n = 0; n < 28; ++n)
    for(int k = 0; k < 10; ++k) f[table.triple[n][k]] += internal::dot4(yz[n].data(), weights[0][k]);
  for(int m = 0; m < 55; ++m) f[m] = f[m] / NT(nonic.multinomial(m));
  return f;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SPLINE_BERNSTEIN_FORMS_H
