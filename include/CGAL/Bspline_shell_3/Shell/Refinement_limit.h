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
    case Refinement_resource::ROUNDS: return "The maximum number of refinement rounds was reached.";
    default: out << "Another round of refinement would have " << limit.cells << " cells";
  }
  if(limit.resource == Refinement_resource::MEMORY)
    out << " and need about " << std::ceil(limit.bytes / megabyte)
        << " MB, which exceeds the memory limit: raise it (memory_limit).";
  else if(limit.resource == Refinement_resource::EFFORT)
    out << ", and all rounds together would exceed the effort limit: raise it (effort_limit).";
  else out << " and more unknowns than can be numbered: see the obstacles in the report.";
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_REFINEMENT_LIMIT_H
