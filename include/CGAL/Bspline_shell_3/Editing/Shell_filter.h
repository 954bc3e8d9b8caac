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
/// \brief a filter that accepts every placement.
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
 * \brief a filter for `CGAL::Surface_mesh_simplification::edge_collapse()` that keeps a mesh in a shell. A placement
 * passes only if the oracle accepts the facets at the new vertex, and these wind around the vertex once; no other
 * facets change.
 *
 * Assume that the facets of a mesh are proved to lie in the shell and to face along the gradient. Assume also that the
 * *fan* of facets at each vertex winds around the gradient there once. A collapse that passes the filter of an oracle
 * with `Facet_proofs::ALL` preserves these properties:
 * - *Other fans* need no test. At a vertex of the link that is on only one of the two old stars, one neighbor moves.
 *   Before and after, the two facets at this neighbor together wind from the same vertex to the same vertex. They wind
 *   by less than a full turn, and hence by the same angle. At the two vertices opposite to the edge, three facets
 *   become two. The angle of the fan can then only decrease, by full turns, and a fan of facets that all face along the
 *   gradient winds at least once.
 * - *Components* need no test. Every facet that changes has a vertex of the link, which does not move. The facet
 *   therefore lies in the same component of the shell as this vertex.
 *
 * Edges whose facets reach a border are not collapsed, so that an open mesh keeps the border of its shell's closing.
 * Shells with a truncation are not supported: the mesh would have to be truncated first, as in `simplify_in_shell()`.
 *
 * The last two claims of the certificate, `ONE_SHEET` and `DEGREE_ONE`, then remain true as well. Nevertheless, the
 * result should be verified by `Shell_certificate_3`, as in `simplify_in_shell()`, because \cgal collapses edges of
 * length zero without calling the filter.
 *
 * Copies, which \cgal makes, share their statistics and the memory of the oracle, so a filter and its copies must be
 * used by one thread at a time. The oracle may be used by several threads.
 *
 * \cgalModels `PlacementFilter`
 *
 * \tparam Oracle a `Shell_facet_oracle_3`; deduced from a shell
 * \tparam BaseFilter a model of `PlacementFilter`, which is called first
 *
 * \sa `Shell_placement`
 */
template <typename Oracle, typename BaseFilter = Permissive_filter>
class Shell_filter
{
public:
  typedef typename Oracle::Shell Shell;

  /// constructs a filter with its own oracle, which proves all accepted facets
  /// \pre `shell` outlives this object and its copies
  explicit Shell_filter(const Shell& shell, const BaseFilter& base_filter = BaseFilter())
    : Shell_filter(std::make_shared<const Oracle>(shell), base_filter)
  {}
  explicit Shell_filter(const Shell&&, const BaseFilter& = BaseFilter()) = delete; // would dangle

  /// constructs a filter with the caller's oracle
  /// \pre `oracle` outlives this object and its copies
  explicit Shell_filter(const Oracle& oracle, const BaseFilter& base_filter = BaseFilter())
    : Shell_filter(std::shared_ptr<const Oracle>(std::shared_ptr<void>(), &oracle), base_filter)
  {}
  explicit Shell_filter(const Oracle&&, const BaseFilter& = BaseFilter()) = delete; // would dangle

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

  /// returns the counts of this filter and its copies
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
    // The facets that remain, after the one or two at the edge, surround it: (v0, p, v2), from v2 to v0.
    const auto& triangles = profile.triangles();
    const auto& vpm = profile.vertex_point_map();
    const std::size_t first = std::size_t(profile.left_face_exists()) + std::size_t(profile.right_face_exists());
    std::vector<Point_3> link;
    link.reserve(triangles.size() - first);
    for(std::size_t n = first; n < triangles.size(); ++n) {
      const std::size_t next = n + 1 < triangles.size() ? n + 1 : first;
      if(triangles[n].v0 != triangles[next].v2) return Placement_verdict::LEAVES_SHELL; // border
      link.push_back(internal::converted<Point_3>(get(vpm, triangles[n].v2)));
    }
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
