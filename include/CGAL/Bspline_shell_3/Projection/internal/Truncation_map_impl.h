// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_IMPL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <typename Triangle>
Truncation_map::Found Truncation_map::find_triangle(std::size_t size, const Planar_point& p, const Triangle& triangle)
{
  const auto least = [](const Barycentric& b) { return (std::min)({ b[0], b[1], b[2] }); };
  Found found = { 0, barycentric_in(triangle(0), p) };
  for(std::size_t n = 1; n < size; ++n) {
    const Barycentric b = barycentric_in(triangle(n), p);
    if(least(b) > least(found.barycentric)) found = { n, b };
  }
  return found;
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Truncation_map(std::shared_ptr<const Shell_truncation_3> truncation)
  : m_truncation(std::move(truncation)), m_parts(m_truncation->cut_facets().size()),
    m_first_of_disc(1, m_truncation->cores().size())
{
  CGAL_precondition(m_truncation->is_valid());
  for(std::size_t n = 0; n < m_truncation->cores().size(); ++n) {
    const Shell_truncation_3::Core& c = m_truncation->cores()[n];
    m_parts[c.facet].push_back({ Index(n), npos, 0, corners(c.facet, c.triangle) });
  }
  for(std::size_t n = 0; n < m_truncation->discs().size(); ++n) {
    const Shell_truncation_3::Disc& d = m_truncation->discs()[n];
    for(std::size_t i = 0; i < d.rim.size(); ++i)
      m_parts[d.facets[i]].push_back({ npos, Index(n), i, corners(d.facets[i], tip_triangle(d, i)) });
    m_first_of_disc.push_back(m_first_of_disc.back() + d.triangles.size());
  }
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Place Truncation_map::image(const Place& place) const
{
  const Piece p = piece(place);
  return { p.new_facet, clamped(mapped(p, place.barycentric)) };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Place Truncation_map::preimage(const Place& place) const
{
  const Shell_truncation_3::New_facet& facet = m_truncation->new_facets()[place.facet];
  if(facet.disc == npos)
    return { facet.cut_facet, combined(place.barycentric, corners(facet.cut_facet, facet.triangle)) };
  const Shell_truncation_3::Disc& d = m_truncation->discs()[facet.disc];
  Planar_point x = {};
  for(int i = 0; i < 3; ++i)
    for(int a = 0; a < 2; ++a) x[a] += place.barycentric[i] * planar(facet.triangle[i])[a];
  const Found found = find_triangle(d.rim.size(), x, [&](std::size_t i) {
    return Planar_triangle{ { {}, planar(d.rim[i]), planar(d.rim[(i + 1) % d.rim.size()]) } };
  });
  const Index f = d.facets[found.number];
  return { f, combined(clamped(found.barycentric), corners(f, tip_triangle(d, found.number))) };
}

CGAL_BSPLINE_SHELL_3_INLINE
std::array<Truncation_map::Barycentric, 3> Truncation_map::derivative(const Place& place) const
{
  const Piece p = piece(place);
  return { { mapped(p, { 1, 0, 0 }), mapped(p, { 0, 1, 0 }), mapped(p, { 0, 0, 1 }) } };
}

CGAL_BSPLINE_SHELL_3_INLINE
Shell_truncation_3::Triangle Truncation_map::tip_triangle(const Shell_truncation_3::Disc& d, std::size_t edge)
{
  return { d.center, d.rim[edge], d.rim[(edge + 1) % d.rim.size()] };
}

CGAL_BSPLINE_SHELL_3_INLINE
std::array<Truncation_map::Barycentric, 3> Truncation_map::corners(Index facet,
                                                                   const Shell_truncation_3::Triangle& t) const
{
  const auto corner = [&](Index p) { return m_truncation->barycentric(m_truncation->cut_facets()[facet], p); };
  return { corner(t[0]), corner(t[1]), corner(t[2]) };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Planar_triangle Truncation_map::in_plane(const std::array<Barycentric, 3>& c)
{
  return { { { c[0][1], c[0][2] }, { c[1][1], c[1][2] }, { c[2][1], c[2][2] } } };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Planar_triangle Truncation_map::in_plane(const Shell_truncation_3::Triangle& t) const
{
  return { { planar(t[0]), planar(t[1]), planar(t[2]) } };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Barycentric Truncation_map::barycentric_in(const Planar_triangle& t, const Planar_point& p)
{
  const auto area = [](const Planar_point& a, const Planar_point& b, const Planar_point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  const double whole = area(t[0], t[1], t[2]);
  if(!(whole > 0)) return { 1, 0, 0 };
  const double u = area(t[0], p, t[2]) / whole, v = area(t[0], t[1], p) / whole;
  return { 1 - u - v, u, v };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Barycentric Truncation_map::clamped(Barycentric barycentric)
{
  double sum = 0;
  for(double& x : barycentric) sum += x = (std::max)(x, 0.);
  for(double& x : barycentric) x /= sum;
  return barycentric;
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Barycentric Truncation_map::combined(const Barycentric& weights,
                                                     const std::array<Barycentric, 3>& corners)
{
  Barycentric b = {};
  for(int i = 0; i < 3; ++i)
    for(int a = 0; a < 3; ++a) b[a] += weights[i] * corners[i][a];
  return clamped(b);
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Piece Truncation_map::piece(const Place& place) const
{
  const std::vector<Part>& parts = m_parts[place.facet];
  const Found in_facet = find_triangle(parts.size(), { place.barycentric[1], place.barycentric[2] },
                                       [&](std::size_t n) { return in_plane(parts[n].corners); });
  const Part& part = parts[in_facet.number];
  if(part.core != npos) return { &part, part.core };
  const std::vector<Shell_truncation_3::Triangle>& triangles = m_truncation->discs()[part.disc].triangles;
  const Found in_disc = find_triangle(triangles.size(), planar_point(part, clamped(in_facet.barycentric)),
                                      [&](std::size_t n) { return in_plane(triangles[n]); });
  return { &part, Index(m_first_of_disc[part.disc] + in_disc.number) };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Planar_point Truncation_map::planar_point(const Part& part, const Barycentric& b) const
{
  const std::vector<Index>& rim = m_truncation->discs()[part.disc].rim;
  const Planar_point &p = planar(rim[part.edge]), &q = planar(rim[(part.edge + 1) % rim.size()]);
  return { b[1] * p[0] + b[2] * q[0], b[1] * p[1] + b[2] * q[1] };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Barycentric Truncation_map::mapped(const Piece& piece, const Barycentric& b) const
{
  const Barycentric in_part = barycentric_in(in_plane(piece.part->corners), { b[1], b[2] });
  if(piece.part->core != npos) return in_part;
  return barycentric_in(in_plane(m_truncation->new_facets()[piece.new_facet].triangle),
                        planar_point(*piece.part, in_part));
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATION_MAP_IMPL_H
