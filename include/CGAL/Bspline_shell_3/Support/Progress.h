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
/// the steps of the construction of a shell
enum class Shell_step
{
  CHECK,      ///< copy, triangulate, and check the mesh
  CELLS,      ///< choose the cells, clip the mesh to them
  DISTANCE,   ///< sample the signed distance
  FIT,        ///< assemble and solve
  BOUNDS,     ///< extrema of the field on the mesh
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
 * \brief a visitor that receives the steps of a construction and can cancel it. This default never cancels it.
 *
 * \cgalModels `ShellVisitor`
 */
struct Default_shell_visitor
{
  /// called by the calling thread when a step begins; `false` ends the construction with `Shell_status::CANCELED`
  bool start_step(Shell_step) { return true; }
  /// called by the calling thread many times within each step; `false` ends the construction with
  /// `Shell_status::CANCELED`
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief a visitor that receives the progress of remeshing and can end it. This default never ends it.
 *
 * \cgalModels `RemeshingVisitor`
 */
struct Default_remeshing_visitor
{
  /// called when an iteration begins; the first iteration is 0. `false` ends the edit.
  bool start_iteration(unsigned int) { return true; }
  /// called before each operation; `false` ends the edit
  bool go_on() { return true; }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief a visitor that receives the number of points moved so far and can cancel the rest. This default never cancels
 * it.
 *
 * \cgalModels `FlowVisitor`
 */
struct Default_flow_visitor
{
  /// called repeatedly by the calling thread; if it returns `false`, the remaining points get the status
  /// `Flow_status::CANCELED`
  bool advance(std::size_t /* done */, std::size_t /* total */) { return true; }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_PROGRESS_H
