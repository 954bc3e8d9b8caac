// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_FILTER_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISION_FILTER_H

#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excised_simplices.h>

#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Soup
/// whether an edit of the mesh of an excised soup may add *contacts*: pairs of a facet and an excised triangle that
/// meet outside of common vertices and edges
enum class New_contacts
{
  ALLOWED,
  REJECTED ///< no edge collapse increases the number of contacts, and remeshing creates no facet with a contact
};

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief a filter of edits of the mesh of an excised soup. It rejects collapses, and facets that remeshing would
 * create, if the mesh would then share a further vertex, edge, or facet with the excised triangles.
 *
 * With `constrain_pins()` and, for remeshing, `protect_constraints`, the edited mesh passes `check_replacement()`.
 *
 * \cgalModels `PlacementFilter`
 * \cgalModels `FacetFilter`
 */
class Excision_filter
{
  typedef internal::Excised_simplices::Triangle Triangle;

public:
  typedef internal::Excised_simplices::Point_3 Point_3;

  explicit Excision_filter(const Excised_soup_3& soup, New_contacts contacts = New_contacts::ALLOWED)
    : m_excised(std::make_shared<const internal::Excised_simplices>(soup)), m_contacts(contacts)
  {}

  /// returns the placement, or none if it is rejected.
  /// \tparam Profile a model of `EdgeCollapseProfile`
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile& profile, const OptionalPoint& placement) const
  {
    return placement && keeps_complex(profile, *placement) && keeps_contacts(profile, *placement) ? placement
                                                                                                  : OptionalPoint();
  }

  /// returns whether remeshing may create the facet; may be called concurrently.
  /// \pre all pins are vertices of the mesh
  bool operator()(const Point_3& p, const Point_3& q, const Point_3& r) const
  {
    const Triangle t = { p, q, r };
    for(std::size_t i = 0; i < 3; ++i)
      if(m_excised->has_own_point(t[i]) || m_excised->has_edge(t[i], t[(i + 1) % 3])) return false;
    return !m_excised->has_triangle(t)
           && (m_contacts == New_contacts::ALLOWED || m_excised->number_of_contacts(t) == 0);
  }

private:
  // Calls `visit` for the corners of each facet at the edge. With `p`, these are the corners after the collapse, with
  // `p` in the place of both ends of the edge.
  template <typename Profile, typename Visit>
  static void visit_facets(const Profile& profile, const Point_3* p, const Visit& visit)
  {
    const auto& vpm = profile.vertex_point_map();
    for(const auto& t : profile.triangles()) {
      const std::array<typename Profile::vertex_descriptor, 3> v = { t.v0, t.v1, t.v2 };
      Triangle corners;
      for(std::size_t i = 0; i < 3; ++i) {
        const bool is_end = v[i] == profile.v0() || v[i] == profile.v1();
        corners[i] = is_end && p ? *p : Point_3(get(vpm, v[i]));
      }
      visit(v, corners);
    }
  }

  template <typename Profile>
  bool keeps_complex(const Profile& profile, const Point_3& p) const
  {
    if(!m_excised->has_point(p)) return true; // new facets have a vertex that no excised triangle has
    const bool keeps_first = p == profile.p0(), keeps_second = p == profile.p1();
    if(keeps_first == keeps_second) return false; // a new vertex in the place of another one
    // The facets at the vertex that is kept do not change.
    const auto kept = keeps_first ? profile.v0() : profile.v1();
    bool keeps = true;
    visit_facets(profile, &p, [&](const auto& vertices, const Triangle& t) {
      if(std::find(vertices.begin(), vertices.end(), kept) != vertices.end()) return;
      for(std::size_t i = 0; i < 3; ++i) keeps = keeps && (t[i] == p || !m_excised->has_edge(p, t[i]));
      keeps = keeps && !m_excised->has_triangle(t);
    });
    return keeps;
  }

  template <typename Profile>
  bool keeps_contacts(const Profile& profile, const Point_3& p) const
  {
    if(m_contacts == New_contacts::ALLOWED) return true;
    std::size_t before = 0, after = 0;
    const auto counts = [this](std::size_t& n) {
      return [&n, this](const auto&, const Triangle& t) { n += m_excised->number_of_contacts(t); };
    };
    visit_facets(profile, &p, counts(after));
    if(after > 0) visit_facets(profile, nullptr, counts(before));
    return after <= before;
  }

  std::shared_ptr<const internal::Excised_simplices> m_excised; // shared by copies, which CGAL makes
  New_contacts m_contacts;
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
