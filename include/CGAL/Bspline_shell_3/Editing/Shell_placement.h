// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_SHELL_PLACEMENT_H
#define CGAL_BSPLINE_SHELL_3_EDITING_SHELL_PLACEMENT_H

#include <CGAL/Bspline_shell_3/Editing/internal/move_to_level.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief a placement for `CGAL::Surface_mesh_simplification::edge_collapse()` that moves the placements of another
 * policy into a shell. A point outside the shell is moved along the gradient to the mean value of the field at the ends
 * of the edge.
 *
 * `Shell_filter` then rejects fewer placements. This policy proves nothing, because it tests in floating-point
 * arithmetic whether a point is in the shell; the filter does.
 *
 * \cgalModels `GetPlacement`
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam BasePlacement a model of `GetPlacement`
 *
 * \sa `Shell_filter`
 */
template <typename Shell, typename BasePlacement>
class Shell_placement
{
public:
  /// \pre there is a shell, and `shell` outlives this object and its copies
  explicit Shell_placement(const Shell& shell, const BasePlacement& base_placement = BasePlacement())
    : m_shell(&shell), m_base_placement(base_placement)
  {}
  explicit Shell_placement(const Shell&&, const BasePlacement& = BasePlacement()) = delete; // would dangle

  /// returns the placement of the other policy, moved if necessary; none if that policy returns none.
  /// \tparam Profile a model of `EdgeCollapseProfile` whose points have coordinates of type `double`
  template <typename Profile>
  auto operator()(const Profile& profile) const
  {
    auto place = m_base_placement(profile);
    if(!place) return place;
    const Point_3 p = point(*place);
    if(m_shell->bounded_side(p) != ON_UNBOUNDED_SIDE) return place;
    const auto moved = internal::move_to_mean_level(m_shell->field(), p, point(profile.p0()), point(profile.p1()));
    if(moved) place = internal::converted<typename Profile::Point>(*moved);
    return place;
  }

private:
  typedef typename Shell::Point_3 Point_3;

  template <typename Point>
  static Point_3 point(const Point& p)
  {
    return internal::converted<Point_3>(p);
  }

  const Shell* m_shell;
  BasePlacement m_base_placement;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_SHELL_PLACEMENT_H
