// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_LIMIT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_LIMIT_H

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the resource that the next round of refinement would exhaust.
 */
enum class Refinement_resource
{
  NONE,
  MEMORY,  ///< `memory_limit`
  NUMBERS, ///< indices of unknowns
  EFFORT,  ///< `effort_limit`
  ROUNDS   ///< the allowed number of rounds
};

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief the limit that ended refinement, and the estimated size of the next round.
 */
struct Refinement_limit
{
  Refinement_resource resource = Refinement_resource::NONE;
  std::size_t cells = 0; ///< number of cells of the next round
  double bytes = 0;
};

/// \ingroup PkgBsplineShell3Shell
/// \return a sentence that describes the limit; empty if there was none
inline std::string message(const Refinement_limit& limit)
{
  constexpr double megabyte = 1e6;
  std::ostringstream out;
  switch(limit.resource) {
    case Refinement_resource::NONE: return "";
    case Refinement_resource::ROUNDS: return "There were as many rounds of refinement as are allowed.";
    default: out << "Another round of refinement would have " << limit.cells << " cells, and ";
  }
  if(limit.resource == Refinement_resource::MEMORY)
    out << "take about " << std::ceil(limit.bytes / megabyte) << " MB: that is beyond the memory limit.";
  else if(limit.resource == Refinement_resource::EFFORT) out << "all rounds together more than the effort limit.";
  else out << "more unknowns than can be numbered.";
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_LIMIT_H
