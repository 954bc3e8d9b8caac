// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RESOLUTION_TUNING_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RESOLUTION_TUNING_H

#include <cstddef>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// \brief tuned numbers of the cells with which the refinement begins (`choose_resolution()`). A *resolution* is a
/// number of cells per longest side of the mesh's box. They affect time and the number of cells only.
struct Resolution_tuning
{
  /// Resolutions that are tried, from the coarsest on; the finest is taken without asking.
  double coarsest = 20, middle = 24, finest = 30;
  /// Largest width of a cell, in thicknesses: wider cells do not follow the mesh closely enough anywhere.
  double widest_cell = 5.5;
  /// Length of the mean normal in a cell below which the mesh is bent, or folded, there.
  double bent = 0.9, folded = 0.7;
  /// Largest fraction of the surface cells that may be bent, or folded.
  double bent_cells = 1. / 8, folded_cells = 1. / 64;
};

inline constexpr Resolution_tuning resolution_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RESOLUTION_TUNING_H
