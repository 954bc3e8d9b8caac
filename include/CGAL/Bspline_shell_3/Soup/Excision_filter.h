// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_FILTER_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_FILTER_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>

#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a filter of edge collapses in the mesh of an excised soup: a collapse must not create a vertex, an edge, or a
 * facet that the mesh would then have in common with the excised triangles.
 *
 * With `constrain_pins()`, it ensures that the simplified mesh passes `check_replacement()`.
 *
 * \cgalModels `PlacementFilter`
 */
class Excision_filter
{
  typedef Excised_soup_3::Mesh::Point Point_3;

public:
  explicit Excision_filter(const Excised_soup_3& soup) : m_simplices(std::make_shared<const Simplices>(soup)) {}

  /// returns the placement, or none if it is rejected.
  /// \tparam Profile a model of `EdgeCollapseProfile`
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    return placement && is_allowed(profile, *placement) ? placement : OptionalPoint();
  }

private:
  typedef std::array<Point_3, 2> Edge;     // ascending
  typedef std::array<Point_3, 3> Triangle; // ascending

  // What the mesh must not get. Simplices of the contact are in the mesh already, and a collapse cannot double them.
  struct Simplices
  {
    explicit Simplices(const Excised_soup_3& soup)
    {
      const auto& mesh = soup.mesh();
      for(std::size_t t : soup.excised_triangles()) {
        const Soup_triangles::Triangle& corners = soup.soup().triangles[t];
        Triangle triangle;
        for(std::size_t i = 0; i < 3; ++i) {
          const std::size_t p = corners[i], q = corners[(i + 1) % 3];
          triangle[i] = soup.soup().points[p];
          points.insert(triangle[i]);
          const auto v = soup.vertex_at(p), w = soup.vertex_at(q);
          const bool are_vertices = v != mesh.null_vertex() && w != mesh.null_vertex();
          if(!are_vertices || mesh.halfedge(v, w) == mesh.null_halfedge())
            edges.insert(sorted(Edge{ soup.soup().points[p], soup.soup().points[q] }));
        }
        triangles.insert(sorted(triangle));
      }
    }

    std::set<Point_3> points;
    std::set<Edge> edges;
    std::set<Triangle> triangles;
  };

  template <typename Simplex>
  static Simplex sorted(Simplex simplex)
  {
    std::sort(simplex.begin(), simplex.end());
    return simplex;
  }

  template <typename Profile>
  bool is_allowed(const Profile& profile, const Point_3& p) const
  {
    if(m_simplices->points.count(p) == 0) return true; // new facets have a vertex that no excised triangle has
    const bool keeps_first = p == profile.p0(), keeps_second = p == profile.p1();
    if(keeps_first == keeps_second) return false; // a new vertex in the place of another one
    // The facets at the vertex that is removed get the other one, or vanish if they have both.
    const auto removed = keeps_first ? profile.v1() : profile.v0(), kept = keeps_first ? profile.v0() : profile.v1();
    const auto& vpm = profile.vertex_point_map();
    for(const auto& t : profile.triangles()) {
      const std::array<typename Profile::vertex_descriptor, 3> v = { t.v0, t.v1, t.v2 };
      const auto i = std::size_t(std::find(v.begin(), v.end(), removed) - v.begin());
      if(i == 3 || std::find(v.begin(), v.end(), kept) != v.end()) continue;
      const Point_3 q = get(vpm, v[(i + 1) % 3]), r = get(vpm, v[(i + 2) % 3]);
      if(m_simplices->edges.count(sorted(Edge{ p, q })) > 0 || m_simplices->edges.count(sorted(Edge{ p, r })) > 0
         || m_simplices->triangles.count(sorted(Triangle{ p, q, r })) > 0)
        return false;
    }
    return true;
  }

  std::shared_ptr<const Simplices> m_simplices; // shared by copies, which CGAL makes
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief constrains the edges that an edit must keep so that no pin moves: pinned edges, and one edge at each other
 * pinned vertex, because the vertices of constrained edges do not move.
 *
 * \tparam EdgeIsConstrainedMap a model of `WritablePropertyMap` from the edges of `soup.mesh()`, or of a copy of it
 */
template <typename EdgeIsConstrainedMap>
void constrain_pins(const Excised_soup_3& soup, EdgeIsConstrainedMap map)
{
  const auto& mesh = soup.mesh();
  std::set<Excised_soup_3::Mesh::Vertex_index> pinned(soup.pinned_vertices().begin(), soup.pinned_vertices().end());
  for(const auto e : soup.pinned_edges()) {
    put(map, e, true);
    pinned.erase(mesh.vertex(e, 0));
    pinned.erase(mesh.vertex(e, 1));
  }
  for(const auto v : pinned) put(map, mesh.edge(mesh.halfedge(v)), true);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_FILTER_H
