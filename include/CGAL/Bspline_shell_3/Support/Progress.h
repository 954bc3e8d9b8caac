// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_PROGRESS_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_PROGRESS_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Support
/// the steps from a mesh to its shell
enum class Shell_step
{
  CHECK,      ///< copy, triangulate and check the mesh
  CELLS,      ///< cut the mesh, choose the cells
  DISTANCE,   ///< sample the signed distance
  FIT,        ///< assemble and solve
  BOUNDS,     ///< extrema on the mesh
  CERTIFICATE ///< thresholds and proofs
};

/// \ingroup PkgBsplineShell3Support
inline const char* name(Shell_step step)
{
  switch(step) {
    case Shell_step::CHECK: return "check";
    case Shell_step::CELLS: return "cells";
    case Shell_step::DISTANCE: return "distance";
    case Shell_step::FIT: return "fit";
    case Shell_step::BOUNDS: return "bounds";
    case Shell_step::CERTIFICATE: return "certificate";
  }
  return "";
}

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief is told of each step, and may stop the construction; the default lets it go on.
 *
 * \cgalModels `ShellVisitor`
 */
struct Default_shell_visitor
{
  /// called, from the calling thread, when a step begins; `false` stops with `Shell_status::CANCELED`
  bool start_step(Shell_step) { return true; }
  /// called many times within each step, from the calling thread; `false` stops with `Shell_status::CANCELED`
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief is told how far remeshing has come, and may end it; the default lets it go on.
 *
 * \cgalModels `RemeshingVisitor`
 */
struct Default_remeshing_visitor
{
  /// called when an iteration begins, the first being 0; `false` ends the edit
  bool start_iteration(unsigned int) { return true; }
  /// called before each operation; `false` ends the edit
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief is told how many of many points have been moved, and may stop the rest; the default lets it go on.
 *
 * \cgalModels `FlowVisitor`
 */
struct Default_flow_visitor
{
  /// called now and then, from the calling thread; `false` stops: what is left gets the status `Flow_status::CANCELED`
  bool advance(std::size_t /* done */, std::size_t /* total */) { return true; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_PROGRESS_H
