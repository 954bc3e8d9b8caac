// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_SHELL_FILTER_H
#define CGAL_BSPLINE_SHELL_3_EDITING_SHELL_FILTER_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_facet_oracle_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Editing
/// \brief a filter that lets every placement pass.
///
/// \cgalModels `PlacementFilter`
struct Permissive_filter
{
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile&, const OptionalPoint& placement) const
  {
    return placement;
  }
};

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief a filter for `CGAL::Surface_mesh_simplification::edge_collapse()` that keeps a closed mesh in a shell: a
 * placement passes only if the oracle accepts the facets at the new vertex, which are all that change, and their fan.
 *
 * A mesh whose facets lie in the shell and face along the gradient, and whose fans all wind once, stays such a mesh:
 * - *Other fans* need no test. At a vertex of the link that is on one of the two old stars only, one neighbor moves:
 *   the two facets there turn by less than a turn together, before and after, from the same vertex to the same vertex,
 *   and so by the same angle. At the two vertices opposite to the edge, three facets become two: what the fan turns can
 *   only get less, by full turns, and a fan of facets that all face the axis turns once at least.
 * - *Components* need no test: every facet that changes has a vertex of the link, which stays where it is, and so lies
 *   in the component of the shell that the vertex lies in.
 *
 * The last two claims of the certificate, one sheet and degree one, then stay as they are, too. As \cgal collapses
 * edges of length zero without asking the filter, `Shell_certificate_3` should have the last word, as it has in
 * `simplify_in_shell()`.
 *
 * Copies, as \cgal makes them, share their statistics and what the oracle remembers, so that one filter and its copies
 * serve one thread at a time. The oracle may serve several.
 *
 * \cgalModels `PlacementFilter`
 *
 * \tparam Oracle a `Shell_facet_oracle_3`; deduced from a shell
 * \tparam BaseFilter a model of `PlacementFilter`, asked first
 *
 * \sa `Shell_placement`
 */
template <typename Oracle, typename BaseFilter = Permissive_filter>
class Shell_filter
{
public:
  typedef typename Oracle::Shell Shell;

  /// a filter with an oracle of its own, which proves all facets
  /// \pre `shell` outlives this object and its copies
  explicit Shell_filter(const Shell& shell, const BaseFilter& base_filter = BaseFilter())
    : Shell_filter(std::make_shared<const Oracle>(shell), base_filter)
  {}
  explicit Shell_filter(const Shell&&, const BaseFilter& = BaseFilter()) = delete; // it would dangle

  /// a filter that asks an oracle of the caller's
  /// \pre `oracle` outlives this object and its copies
  explicit Shell_filter(const Oracle& oracle, const BaseFilter& base_filter = BaseFilter())
    : Shell_filter(std::shared_ptr<const Oracle>(std::shared_ptr<void>(), &oracle), base_filter)
  {}
  explicit Shell_filter(const Oracle&&, const BaseFilter& = BaseFilter()) = delete; // it would dangle

  /// returns the placement, or none if it is rejected.
  /// \tparam Profile a model of `EdgeCollapseProfile` whose points have coordinates of type `double`
  template <typename Profile, typename OptionalPoint>
  OptionalPoint operator()(const Profile& profile, OptionalPoint placement) const
  {
    placement = m_base_filter(profile, placement);
    const Placement_verdict verdict = placement ? judge(profile, *placement) : Placement_verdict::BASE_FILTER;
    ++m_state->statistics.by_verdict[std::size_t(verdict)];
    return verdict == Placement_verdict::ACCEPTED ? placement : OptionalPoint();
  }

  /// counts of this filter and its copies
  const Placement_statistics& statistics() const { return m_state->statistics; }

private:
  struct State
  {
    Placement_statistics statistics;
    typename Oracle::Memory memory;
  };

  Shell_filter(std::shared_ptr<const Oracle> oracle, const BaseFilter& base_filter)
    : m_oracle(std::move(oracle)), m_base_filter(base_filter), m_state(std::make_shared<State>())
  {}

  template <typename Profile, typename Point>
  Placement_verdict judge(const Profile& profile, const Point& p) const
  {
    typedef typename Oracle::Point_3 Point_3;
    // the facets that stay, after the one or two at the edge, go around it: (v0, p, v2), from v2 to v0
    const auto& triangles = profile.triangles();
    const auto& vpm = profile.vertex_point_map();
    const std::size_t first = std::size_t(profile.left_face_exists()) + std::size_t(profile.right_face_exists());
    std::vector<Point_3> link;
    link.reserve(triangles.size() - first);
    for(std::size_t n = first; n < triangles.size(); ++n)
      link.push_back(internal::converted<Point_3>(get(vpm, triangles[n].v2)));
    return (*m_oracle)(internal::converted<Point_3>(p), link, m_state->memory);
  }

  std::shared_ptr<const Oracle> m_oracle;
  BaseFilter m_base_filter;
  std::shared_ptr<State> m_state;
};

template <typename Field, typename Threshold>
Shell_filter(const Bspline_shell_3<Field, Threshold>&) -> Shell_filter<Shell_facet_oracle_3<Field, Threshold> >;
template <typename Field, typename Threshold, typename BaseFilter>
Shell_filter(const Bspline_shell_3<Field, Threshold>&, const BaseFilter&)
  -> Shell_filter<Shell_facet_oracle_3<Field, Threshold>, BaseFilter>;

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_SHELL_FILTER_H
