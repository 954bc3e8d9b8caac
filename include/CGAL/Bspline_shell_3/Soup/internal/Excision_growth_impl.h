// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_IMPL_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_growth.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<std::size_t> Excision_growth::triangles_around(const Excised_soup_3& soup,
                                                           const std::vector<Face_index>& offenders)
{
  m_reach_at.resize(soup.soup().points.size(), 0);
  const std::vector<Reach> reach = reach_from(soup, offenders);
  std::vector<std::size_t> triangles;
  for(Face_index f : soup.mesh().faces()) {
    if(reach[f].initial == 0) continue;
    triangles.push_back(soup.triangle_of(f));
    for(std::size_t v : soup.soup().triangles[triangles.back()])
      m_reach_at[v] = (std::max)(m_reach_at[v], reach[f].initial);
  }
  return triangles;
}

CGAL_BSPLINE_SHELL_3_INLINE
std::size_t Excision_growth::reach_of(const Excised_soup_3& soup, Face_index f) const
{
  std::size_t before = 0;
  for(std::size_t v : soup.soup().triangles[soup.triangle_of(f)]) before = (std::max)(before, m_reach_at[v]);
  return before + 1;
}

CGAL_BSPLINE_SHELL_3_INLINE
std::vector<Excision_growth::Reach> Excision_growth::reach_from(const Excised_soup_3& soup,
                                                                const std::vector<Face_index>& offenders) const
{
  const Mesh& mesh = soup.mesh();
  std::vector<Reach> reach(mesh.number_of_faces());
  std::vector<std::vector<Face_index> > with(1); // by remaining reach
  for(Face_index f : offenders) {
    const std::size_t n = reach_of(soup, f);
    if(reach[f].initial >= n) continue; // listed twice
    reach[f] = { n, n };
    if(with.size() <= n) with.resize(n + 1);
    with[n].push_back(f);
  }
  for(std::size_t n = with.size() - 1; n > 1; --n)
    for(std::size_t k = 0; k < with[n].size(); ++k) {
      const Face_index f = with[n][k];
      if(reach[f].remaining != n) continue; // reached from closer meanwhile
      for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        for(auto g : mesh.faces_around_target(mesh.halfedge(v))) {
          if(g == Mesh::null_face() || reach[g].remaining >= n - 1) continue;
          reach[g] = { (std::max)(reach[g].initial, reach[f].initial), n - 1 };
          with[n - 1].push_back(g);
        }
    }
  return reach;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_IMPL_H
