// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_IMPL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncated_facets.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncation_map.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE
Truncated_facets::Truncated_facets(const std::shared_ptr<const Shell_truncation_3>& truncation,
                                   const std::vector<Facet>& facets, std::vector<Cut_facet> cut)
  : m_map(truncation), m_cut(std::move(cut)), m_cut_of(facets.size(), npos), m_traced_of(facets.size(), npos),
    m_traced_of_new(truncation->new_facets().size(), npos)
{
  for(std::size_t n = 0; n < m_cut.size(); ++n)
    if(m_cut[n].facet != npos) m_cut_of[m_cut[n].facet] = Index(n);
  std::vector<Facet> traced;
  for(std::size_t f = 0; f < facets.size(); ++f) {
    if(m_cut_of[f] != npos) continue;
    m_traced_of[f] = Index(traced.size());
    m_origins.push_back({ Index(f), npos });
    traced.push_back(facets[f]);
  }
  for(std::size_t n = 0; n < m_traced_of_new.size(); ++n) {
    const Shell_truncation_3::New_facet& of_truncation = truncation->new_facets()[n];
    if(m_cut[of_truncation.cut_facet].facet == npos) continue;
    m_traced_of_new[n] = Index(traced.size());
    m_origins.push_back({ npos, Index(n) });
    Facet facet;
    facet.neighbor.fill(npos);
    for(int i = 0; i < 3; ++i) facet.vertex[i] = truncation->points()[of_truncation.triangle[i]];
    traced.push_back(facet);
  }
  // First the edges of uncut facets; then the edges of new facets with each other and with uncut facets.
  for(std::size_t f = 0; f < facets.size(); ++f)
    if(m_traced_of[f] != npos)
      for(Index& g : traced[m_traced_of[f]].neighbor) g = g == npos ? npos : m_traced_of[g];
  std::map<std::pair<Index, Index>, std::pair<Index, int> > edges;
  for(std::size_t n = 0; n < m_traced_of_new.size(); ++n)
    if(m_traced_of_new[n] != npos)
      for(int i = 0; i < 3; ++i) {
        const auto& t = truncation->new_facets()[n].triangle;
        edges[{ t[i], t[(i + 1) % 3] }] = { m_traced_of_new[n], i };
      }
  for(const auto& e : edges) {
    const auto opposite = edges.find({ e.first.second, e.first.first });
    if(opposite != edges.end()) traced[e.second.first].neighbor[e.second.second] = opposite->second.first;
  }
  for(std::size_t n = 0; n < m_cut.size(); ++n)
    for(int i = 0; i < 3 && m_cut[n].facet != npos; ++i) {
      const auto& t = truncation->cut_facets()[n];
      const auto side = edges.find({ t[i], t[(i + 1) % 3] });
      const Index beyond = facets[m_cut[n].facet].neighbor[(m_cut[n].corner + i) % 3];
      if(side == edges.end() || beyond == npos || m_traced_of[beyond] == npos) continue;
      traced[side->second.first].neighbor[side->second.second] = m_traced_of[beyond];
      for(int j = 0; j < 3; ++j)
        // There is only one such edge: two common edges would meet at a center, where all facets are cut.
        if(facets[beyond].neighbor[j] == m_cut[n].facet) traced[m_traced_of[beyond]].neighbor[j] = side->second.first;
    }
  m_facets = Projection_facets_3(std::move(traced));
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncated_facets::Place Truncated_facets::traced(const Place& place) const
{
  if(!is_cut(place.first)) return { m_traced_of[place.first], place.second };
  const auto image = m_map.image(in_cut_facet(place));
  return { m_traced_of_new[image.facet], image.barycentric };
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncated_facets::Place Truncated_facets::untraced(const Place& place) const
{
  const Origin& origin = m_origins[place.first];
  if(origin.facet != npos) return { origin.facet, place.second };
  const auto preimage = m_map.preimage({ origin.new_facet, place.second });
  const Cut_facet& cut = m_cut[preimage.facet];
  Place result = { cut.facet, {} };
  for(int i = 0; i < 3; ++i) result.second[(cut.corner + i) % 3] = preimage.barycentric[i];
  return result;
}

CGAL_BSPLINE_SHELL_3_INLINE
Eigen::Matrix3d Truncated_facets::derivative(const Place& place, const std::array<Coordinates, 3>& vertices) const
{
  if(!is_cut(place.first)) return Eigen::Matrix3d::Identity();
  const auto columns = m_map.derivative(in_cut_facet(place));
  const Index traced_facet = traced(place).first;
  const auto eigen = [](const Coordinates& p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  // images of the vectors from the first corner of the cut facet to the other corners
  const int corner = m_cut[m_cut_of[place.first]].corner;
  Eigen::Matrix3d before, after;
  for(int k = 0; k < 2; ++k) {
    before.col(k) = eigen(vertices[(corner + k + 1) % 3]) - eigen(vertices[corner]);
    after.col(k).setZero();
    for(int i = 0; i < 3; ++i)
      after.col(k) += (columns[k + 1][i] - columns[0][i]) * eigen(m_facets.vertex(traced_facet, i));
  }
  before.col(2) = before.col(0).cross(before.col(1)).normalized();
  after.col(2) = eigen(m_facets.normal(traced_facet)).normalized();
  return after * before.inverse();
}

CGAL_BSPLINE_SHELL_3_INLINE
Truncation_map::Place Truncated_facets::in_cut_facet(const Place& place) const
{
  const Index n = m_cut_of[place.first];
  Truncation_map::Place result = { n, {} };
  for(int i = 0; i < 3; ++i) result.barycentric[i] = place.second[(m_cut[n].corner + i) % 3];
  return result;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_INTERNAL_TRUNCATED_FACETS_IMPL_H
