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
/// \brief tuning parameters of `choose_resolution()`. They affect time and the number of cells only. A *resolution* is
/// the number of root cells along the longest side of the mesh's bounding box.
struct Resolution_tuning
{
  /// Resolutions to try, coarsest first. The finest is used if the others are rejected.
  double coarsest = 20, middle = 24, finest = 30;
  /// Largest width of a cell, in multiples of the thickness. A field on wider cells does not follow the mesh closely
  /// enough anywhere.
  double widest_cell = 5.5;
  /// The mesh is bent, or folded, in a cell if its mean normal there is shorter than this.
  double bent = 0.9, folded = 0.7;
  /// Largest fraction of the surface cells that may be bent, or folded.
  double bent_cells = 1. / 8, folded_cells = 1. / 64;
};

inline constexpr Resolution_tuning resolution_tuning = {};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_RESOLUTION_TUNING_H
