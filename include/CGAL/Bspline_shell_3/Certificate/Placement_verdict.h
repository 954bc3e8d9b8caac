// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_PLACEMENT_VERDICT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_PLACEMENT_VERDICT_H

#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Certificate
/// the verdict on a facet, or on a placement of the vertex of a collapsed edge
enum class Placement_verdict
{
  ACCEPTED,
  BASE_FILTER,  ///< rejected by another filter
  LEAVES_SHELL, ///< a facet is not proved to lie in the shell
  FACES_AWAY,   ///< a facet is not proved to face along the gradient
  WINDS_TWICE   ///< all facets at the vertex face along the gradient, but do not wind around the vertex once
};

/// \ingroup PkgBsplineShell3Certificate
inline const char* name(Placement_verdict verdict)
{
  switch(verdict) {
    case Placement_verdict::ACCEPTED: return "accepted";
    case Placement_verdict::BASE_FILTER: return "base_filter";
    case Placement_verdict::LEAVES_SHELL: return "leaves_shell";
    case Placement_verdict::FACES_AWAY: return "faces_away";
    case Placement_verdict::WINDS_TWICE: return "winds_twice";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief the number of judged placements, by verdict.
 */
struct Placement_statistics
{
  std::array<std::size_t, 5> by_verdict = {}; ///< counts in the order of `Placement_verdict`

  std::size_t number(Placement_verdict verdict) const { return by_verdict[std::size_t(verdict)]; }
  std::size_t rejected() const
  {
    std::size_t sum = 0;
    for(std::size_t n = 1; n < by_verdict.size(); ++n) sum += by_verdict[n];
    return sum;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_PLACEMENT_VERDICT_H
