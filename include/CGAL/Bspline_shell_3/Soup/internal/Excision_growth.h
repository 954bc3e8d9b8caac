// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H
#define CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Chooses the triangles that are excised at places where no shell was built: one ring of facets around offending
// facets, and twice as many rings each time that a place fails again.
class Excision_growth
{
  typedef Excised_soup_3::Mesh Mesh;
  typedef Mesh::Face_index Face_index;
public:
  // Returns the triangles of the offending facets and of the rings around them, ascending.
  std::vector<std::size_t> triangles_around(const Excised_soup_3& soup, const std::vector<Face_index>& offenders)
  {
    m_rings_at.resize(soup.soup().points.size(), 0);
    const std::vector<Reach> reach = reach_from(soup, offenders);
    std::vector<std::size_t> triangles;
    for(Face_index f : soup.mesh().faces()) {
      if(reach[f].rings == 0) continue;
      triangles.push_back(soup.triangle_of(f));
      for(std::size_t v : soup.soup().triangles[triangles.back()])
        m_rings_at[v] = (std::max)(m_rings_at[v], reach[f].rings);
    }
    return triangles;
  }

private:
  struct Reach
  {
    std::size_t rings = 0;     // around the offending facet from which this one is reached; 0 if there is none
    std::size_t remaining = 0; // rings around this facet
  };

  // Returns twice the number of rings with which the place of a facet failed before, or one.
  std::size_t rings_around(const Excised_soup_3& soup, Face_index f) const
  {
    std::size_t before = 0;
    for(std::size_t v : soup.soup().triangles[soup.triangle_of(f)]) before = (std::max)(before, m_rings_at[v]);
    return before == 0 ? 1 : 2 * before;
  }

  std::vector<Reach> reach_from(const Excised_soup_3& soup, const std::vector<Face_index>& offenders) const
  {
    const Mesh& mesh = soup.mesh();
    std::vector<Reach> reach(mesh.number_of_faces());
    std::vector<std::vector<Face_index> > with(1); // by number of remaining rings
    for(Face_index f : offenders) {
      const std::size_t rings = rings_around(soup, f);
      if(reach[f].rings >= rings) continue; // listed twice
      reach[f] = { rings, rings };
      if(with.size() <= rings) with.resize(rings + 1);
      with[rings].push_back(f);
    }
    for(std::size_t remaining = with.size() - 1; remaining > 0; --remaining)
      for(std::size_t k = 0; k < with[remaining].size(); ++k) {
        const Face_index f = with[remaining][k];
        if(reach[f].remaining != remaining) continue; // reached with more meanwhile
        for(auto v : mesh.vertices_around_face(mesh.halfedge(f)))
          for(auto g : mesh.faces_around_target(mesh.halfedge(v))) {
            if(g == Mesh::null_face()) continue;
            Reach& of_neighbor = reach[g];
            if(of_neighbor.rings > 0 && of_neighbor.remaining >= remaining - 1) continue;
            of_neighbor = { (std::max)(of_neighbor.rings, reach[f].rings), remaining - 1 };
            with[remaining - 1].push_back(g);
          }
      }
    return reach;
  }

  std::vector<std::size_t> m_rings_at; // by point: the number of rings with which it was excised
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_INTERNAL_EXCISION_GROWTH_H
