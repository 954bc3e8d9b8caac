// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_EDIT_TERMINATION_H
#define CGAL_BSPLINE_SHELL_3_EDITING_EDIT_TERMINATION_H

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Editing
/// the reason why an edit ended. With `SHELL` and the values after it, the target may not have been reached.
enum class Edit_termination
{
  NOT_EDITED,     ///< the mesh is unchanged: the status is the reason
  TARGET,         ///< remeshing: all edges have about the requested length
  STOP_PREDICATE, ///< simplification: the stop predicate ended the edit, at its target or to cancel
  VISITOR,        ///< remeshing: the visitor ended the edit
  SHELL,          ///< the shell rejects at least one of the operations that would make progress
  FILTER,         ///< the shell would allow more, but the caller's filter rejects it
  MESH,           ///< nothing is rejected, but connectivity, constraints, or frozen facets prevent further operations
  ITERATIONS      ///< remeshing: all iterations were done, and the shell rejected nothing in the last one
};

/// \ingroup PkgBsplineShell3Editing
/// returns a sentence that describes the reason
inline const char* message(Edit_termination end)
{
  switch(end) {
    case Edit_termination::NOT_EDITED: return "The mesh was not edited: see the status for the reason.";
    case Edit_termination::TARGET: return "All edges have about the target length.";
    case Edit_termination::STOP_PREDICATE: return "The stop predicate ended the edit.";
    case Edit_termination::VISITOR: return "The visitor ended the edit.";
    case Edit_termination::SHELL:
      return "The shell rejects operations that would make progress: request a thicker shell.";
    case Edit_termination::FILTER: return "The filter rejects operations that would make progress: relax the filter.";
    case Edit_termination::MESH:
      return "The connectivity of the mesh, its constraints or frozen facets prevent further operations.";
    case Edit_termination::ITERATIONS:
      return "All iterations were done: more iterations may make progress (number_of_iterations).";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_EDIT_TERMINATION_H
