// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/prove_truncation.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

inline bool prove_truncation(const Shell_truncation_3& truncation); // if prove_truncation.h includes this file

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE
Shell_truncation_3::Shell_truncation_3(std::vector<Point> points, std::vector<Triangle> cut_facets,
                                       std::vector<Cut> cuts, std::vector<Core> cores, std::vector<Disc> discs,
                                       std::vector<Planar_point> planar)
  : m_points(std::move(points)), m_cut_facets(std::move(cut_facets)), m_cuts(std::move(cuts)),
    m_cores(std::move(cores)), m_discs(std::move(discs)), m_planar(std::move(planar)),
    m_is_valid(internal::prove_truncation(*this))
{
  if(!m_is_valid) return;
  for(const Core& c : m_cores) m_new_facets.push_back({ c.triangle, npos, c.facet });
  for(std::size_t n = 0; n < m_discs.size(); ++n)
    for(const Triangle& t : m_discs[n].triangles) m_new_facets.push_back({ t, Index(n), m_discs[n].facets.front() });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_IMPL_H
