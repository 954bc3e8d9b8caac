// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_DYADIC_PART_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_DYADIC_PART_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A part of a segment (size two) or a triangle (size three). Its corners have dyadic barycentric coordinates, in units
// of 2^-depth.
template <std::size_t size>
struct Dyadic_part
{
  typedef std::array<std::int64_t, size> Corner;

  std::array<Corner, size> corner;
  int depth = 0;
  int refinements = 0; // subdivisions below the size of a cell
};

template <std::size_t size>
Dyadic_part<size> whole_simplex()
{
  Dyadic_part<size> whole;
  for(std::size_t v = 0; v < size; ++v) {
    whole.corner[v].fill(0);
    whole.corner[v][v] = 1;
  }
  return whole;
}

// Returns one coordinate of the point with the given barycentric coordinates. Terms are added in the order of the
// vertices, so the result is the same for every part that has the point as a corner.
template <typename Point_3, std::size_t size>
double coordinate(const std::array<Point_3, size>& simplex, const std::array<std::int64_t, size>& numerator, int depth,
                  int a)
{
  const double unit = 1 / double(std::int64_t(1) << depth);
  double sum = 0;
  for(std::size_t v = 0; v < size; ++v) sum += double(numerator[v]) * unit * simplex[v][a];
  return sum;
}

inline double edge_length(const std::array<double, 3>& p, const std::array<double, 3>& q)
{
  return (std::max)({ std::abs(p[0] - q[0]), std::abs(p[1] - q[1]), std::abs(p[2] - q[2]) });
}

template <std::size_t size>
std::array<std::size_t, 2> longest_edge(const std::array<std::array<double, 3>, size>& corner)
{
  std::array<std::size_t, 2> longest = { 0, 1 };
  for(std::size_t v = 1; v + 1 < size; ++v)
    for(std::size_t u = 0; u <= v; ++u)
      if(edge_length(corner[u], corner[v + 1]) > edge_length(corner[longest[0]], corner[longest[1]]))
        longest = { u, v + 1 };
  return longest;
}

// Bisects an edge; all numerators are doubled.
template <std::size_t size>
void bisect(const Dyadic_part<size>& part, const std::array<std::size_t, 2>& edge,
            std::vector<Dyadic_part<size> >& stack)
{
  Dyadic_part<size> half = part;
  ++half.depth;
  for(auto& corner : half.corner)
    for(std::int64_t& numerator : corner) numerator *= 2;
  std::array<std::int64_t, size> middle;
  for(std::size_t n = 0; n < size; ++n) middle[n] = part.corner[edge[0]][n] + part.corner[edge[1]][n];
  for(std::size_t end : { edge[1], edge[0] }) {
    stack.push_back(half);
    stack.back().corner[end] = middle;
  }
}

inline void subdivide(const Dyadic_part<2>& part, std::vector<Dyadic_part<2> >& stack)
{
  const std::size_t first = stack.size();
  bisect(part, { 0, 1 }, stack);
  for(std::size_t n = first; n < stack.size(); ++n) ++stack[n].refinements;
}

inline void subdivide(const Dyadic_part<3>& part, std::vector<Dyadic_part<3> >& stack)
{
  std::array<std::array<std::int64_t, 3>, 3> c, m; // corners, and midpoints of the sides opposite to them
  for(int v = 0; v < 3; ++v)
    for(int u = 0; u < 3; ++u) {
      c[v][u] = 2 * part.corner[v][u];
      m[v][u] = part.corner[(v + 1) % 3][u] + part.corner[(v + 2) % 3][u];
    }
  const int depth = part.depth + 1, refinements = part.refinements + 1;
  stack.push_back({ { m[0], m[1], m[2] }, depth, refinements });
  stack.push_back({ { c[2], m[1], m[0] }, depth, refinements });
  stack.push_back({ { c[1], m[0], m[2] }, depth, refinements });
  stack.push_back({ { c[0], m[2], m[1] }, depth, refinements });
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_DYADIC_PART_H
