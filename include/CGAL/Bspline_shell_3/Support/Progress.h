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
/// The steps of the construction of a shell.
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
 * \brief A visitor that is called in each step, and can stop the construction. This default never stops it.
 *
 * \cgalModels `ShellVisitor`
 */
struct Default_shell_visitor
{
  /// Called by the calling thread when a step begins. The value `false` stops with `Shell_status::CANCELED`.
  bool start_step(Shell_step) { return true; }
  /// Called by the calling thread many times within each step. The value `false` stops with `Shell_status::CANCELED`.
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief A visitor that is called as remeshing proceeds, and can end it. This default never ends it.
 *
 * \cgalModels `RemeshingVisitor`
 */
struct Default_remeshing_visitor
{
  /// Called when an iteration begins; the first iteration is 0. The value `false` ends the edit.
  bool start_iteration(unsigned int) { return true; }
  /// Called before each operation. The value `false` ends the edit.
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief A visitor that receives the number of points moved so far, and can stop the rest. This default never stops it.
 *
 * \cgalModels `FlowVisitor`
 */
struct Default_flow_visitor
{
  /// Called repeatedly by the calling thread. The value `false` stops: the remaining points get the status
  /// `Flow_status::CANCELED`.
  bool advance(std::size_t /* done */, std::size_t /* total */) { return true; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_PROGRESS_H
