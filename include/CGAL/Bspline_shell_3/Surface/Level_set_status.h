// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_LEVEL_SET_STATUS_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_LEVEL_SET_STATUS_H

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Surface
 *
 * \brief the outcome of the extraction of a level set. Unless the value is `SUCCESS`, no facet was created.
 */
enum class Level_set_status
{
  SUCCESS,
  LEVEL_SET_EMPTY,        ///< the field does not have this value on the selected cells
  LEVEL_SET_LEAVES_CELLS, ///< the level set reaches a face of a selected cell without a selected cell behind it
  LEVEL_SET_UNRESOLVED    ///< the surfaces of several components of a shell cannot be separated
};

/// \ingroup PkgBsplineShell3Surface
/// returns a sentence that describes the problem and a remedy
inline const char* message(Level_set_status status)
{
  switch(status) {
    case Level_set_status::SUCCESS: return "The level set was extracted.";
    case Level_set_status::LEVEL_SET_EMPTY:
      return "The field does not reach the level on the selected cells: choose a level within the range of its values "
             "there.";
    case Level_set_status::LEVEL_SET_LEAVES_CELLS:
      return "The level set leaves the selected cells, so its mesh would be open: select all cells that it intersects, "
             "or build a shell with more rings of cells (number_of_rings).";
    case Level_set_status::LEVEL_SET_UNRESOLVED:
      return "Surfaces of several components of the shell are closer together, or smaller, than subcells: increase the "
             "subdivision ratio (subdivision_ratio).";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_LEVEL_SET_STATUS_H
