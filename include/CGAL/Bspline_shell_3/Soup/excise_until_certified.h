// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_EXCISE_UNTIL_CERTIFIED_H
#define CGAL_BSPLINE_SHELL_3_SOUP_EXCISE_UNTIL_CERTIFIED_H

#include <CGAL/Bspline_shell_3/Shell/Refinement_obstacle.h>
#include <CGAL/Bspline_shell_3/Shell/Shell_report.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/check_excision.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_growth.h>
#include <CGAL/Bspline_shell_3/Soup/internal/Excision_holes.h>
#include <CGAL/Bspline_shell_3/Soup/internal/facets_to_excise.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the limits of `excise_until_certified()`.
 */
struct Excision_limits
{
  /// largest fraction of the area that may be excised
  double share = 0.1;
  /// largest fraction of the mesh area in facets that share no edge with another one
  double isolated_share = 0.5;
  /// largest number of meshes that are tried. Growing rings around one place reach the limit of the area first.
  std::size_t attempts = 12;
  /// largest number of shells that are fitted
  std::size_t shells = 3;
  /// limit of effort for each of these shells, as a fraction of that of the shell of a sound mesh. Of the meshes of
  /// \cgal's data folder with a certified shell after excision, none needs more than 0.21 of the default limit.
  double effort = 1. / 4;
  /// largest number of facets closest to the listed obstacles that are excised at once, and the largest fraction of all
  /// facets; the larger limit counts. If there are more, the cause is the surface, not a few defects.
  std::size_t facets = 20;
  double share_of_facets = 0.01;

  bool permits(std::size_t excised, std::size_t all) const
  {
    return excised <= facets || double(excised) <= share_of_facets * double(all);
  }
};

namespace internal {

// Tries shells of the mesh of an excised soup, and excises more where they fail.
template <typename Shell>
class Excision_attempts
{
  typedef Excised_soup_3::Mesh Mesh;
  typedef std::vector<Mesh::Face_index> Facets;
public:
  Excision_attempts(Excised_soup_3 soup, const Excision_limits& limits) : m_soup(std::move(soup)), m_limits(limits) {}

  // Returns whether there is a certified shell.
  // \param build returns the shell of a mesh, in which holes with the given points have a cap
  template <typename Build>
  bool run(const Build& build)
  {
    // Scattered triangles are not a surface, and each attempt would close them one by one.
    if(share_of_isolated_facets(m_soup.mesh()) > m_limits.isolated_share) return false;
    for(; m_attempts < m_limits.attempts; ++m_attempts) {
      Run::poll();
      if(!m_soup || m_soup.report().excised_area > m_limits.share) return false;
      const Excision_holes holes(m_soup);
      const bool may_have_sheets = m_attempts + 1 == m_limits.attempts;
      m_shell = build(m_soup.mesh(),
                      [&](const std::array<double, 3>& p) { return !may_have_sheets && holes.contain(p); });
      if(ends_all_attempts(m_shell.status())) return false;
      if(m_shell.is_certified()) {
        const Excision_verdict verdict = check_excision(m_soup, truncated_vertices(m_shell.report().truncation));
        if(verdict) return true;
        // A truncated vertex moves, so excised triangles must not depend on it.
        if(verdict.status != Excision_status::MOVED_TIP
           || !excise(facets_at(verdict.vertices), Excision_reason::SINGULAR_PIN))
          return false;
      } else if(m_shell ? !excise_unproved() : !excise_refused()) return false;
    }
    return false;
  }

  Excised_soup_3& soup() { return m_soup; }
  Shell& shell() { return m_shell; }

private:
  bool excise(const Facets& facets, Excision_reason reason)
  {
    if(facets.empty()) return false;
    m_last = m_growth.triangles_around(m_soup, facets);
    m_soup = excise_also(m_soup, m_last, reason);
    return true;
  }

  // Excises facets at places of a shell that are not proved.
  bool excise_unproved()
  {
    if(++m_shells == m_limits.shells) return false;
    const Facets facets = facets_at_obstacles(m_soup.mesh(), m_shell.report().obstacles);
    return m_limits.permits(facets.size(), m_soup.mesh().number_of_faces())
           && excise(facets, Excision_reason::NOT_CERTIFIED);
  }

  // Changes the mesh where it was rejected.
  bool excise_refused()
  {
    const Offending_simplices& offenders = m_shell.report().offending_simplices;
    switch(m_shell.status()) {
      case Shell_status::INCONSISTENT_ORIENTATION: return turn_or_excise(offenders.facets);
      case Shell_status::NOT_CLOSABLE:
      case Shell_status::SELF_INTERSECTION:
      case Shell_status::NON_MANIFOLD:
      case Shell_status::DEGENERATE_FACET:
      case Shell_status::SINGULAR_VERTEX: break;
      default: return false;
    }
    if(m_shell.status() == Shell_status::NOT_CLOSABLE
       && excise(Excision_holes(m_soup).facets_without_cap(m_shell.report().closing), Excision_reason::NOT_CLOSABLE))
      return true;
    std::vector<Mesh::Vertex_index> vertices;
    for(std::size_t v : offenders.vertices) vertices.emplace_back(Mesh::size_type(v));
    Facets facets = facets_at(vertices);
    for(std::size_t f : offenders.facets) facets.emplace_back(Mesh::size_type(f));
    // If no facet is listed, a cap is at fault, probably that of the last hole.
    if(facets.empty()) facets = facets_beside(m_soup, m_last);
    return excise(facets, Excision_reason::NOT_CLOSABLE);
  }

  Facets facets_at(const std::vector<Mesh::Vertex_index>& vertices) const
  {
    Facets facets;
    for(auto v : vertices)
      for(auto f : m_soup.mesh().faces_around_target(m_soup.mesh().halfedge(v)))
        if(f != Mesh::null_face()) facets.push_back(f);
    return facets;
  }

  // Reverses components once. If this does not help, they are excised.
  bool turn_or_excise(const std::vector<std::size_t>& listed)
  {
    const Facets facets = facets_on_wrong_side(m_soup, listed);
    if(facets.empty()) return false;
    if(!std::exchange(m_has_reversed, true)) {
      m_soup = reverse_facets(m_soup, facets);
      return true;
    }
    std::vector<std::size_t> triangles;
    for(auto f : facets) triangles.push_back(m_soup.triangle_of(f));
    m_soup = excise_also(m_soup, triangles, Excision_reason::WRONG_SIDE);
    return true;
  }

  Excised_soup_3 m_soup;
  Shell m_shell;
  Excision_limits m_limits;
  Excision_growth m_growth;
  std::vector<std::size_t> m_last; // triangles excised in the last attempt
  std::size_t m_attempts = 0;      // number of failed attempts
  std::size_t m_shells = 0;        // number of shells without a certificate
  bool m_has_reversed = false;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief builds a certified shell of the mesh of an excised soup, and excises more triangles where this fails.
 *
 * If the mesh cannot be closed, the facets at which this fails are excised. If the same place fails again, rings of
 * facets around it are excised, too, one more each time. If no facet is known, because the cap of a hole is at fault,
 * those beside the last hole are excised. If the proof fails on a few facets, they are excised, too.
 * Components that face the wrong side are reversed. If this is impossible because they are open, they are excised.
 * Nothing is tried if most of the mesh is scattered facets without neighbors.
 *
 * \tparam Build a function that returns the `Shell` of an `Excised_soup_3::Mesh`. Its second argument is a function
 *   that returns whether the hole at a point has to be capped (`hole_requires_cap`).
 * \tparam Shell a `Bspline_shell_3`
 * \param[in,out] soup an excised soup; afterwards, the last one that was tried
 * \param[out] shell the last shell that was built
 * \return whether the shell is certified, and `check_excision()` accepts the soup with the truncation of the shell
 */
template <typename Shell, typename Build>
bool excise_until_certified(Excised_soup_3& soup, Shell& shell, const Excision_limits& limits, const Build& build)
{
  internal::Excision_attempts<Shell> attempts(std::move(soup), limits);
  const bool is_certified = attempts.run(build);
  soup = std::move(attempts.soup());
  shell = std::move(attempts.shell());
  return is_certified;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_EXCISE_UNTIL_CERTIFIED_H
