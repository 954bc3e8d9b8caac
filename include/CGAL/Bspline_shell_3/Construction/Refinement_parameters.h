// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PARAMETERS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PARAMETERS_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/Energy_weights.h>

#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the goals and limits of a refinement.
 */
struct Refinement_parameters
{
  Energy_weights weights;
  Refinement_tuning tuning;
  /// slope required across a facet, as a fraction of the largest slope that is possible at its vertices
  /// (`vertex_cone_margin()`)
  double slope_fraction = 0.2;
  /// whether thresholds are constant and as tight as possible; the requested thickness bounds their difference
  bool constant_thresholds = false;
  std::size_t max_rounds = 24;
  /// limit of effort: the largest number of cells fitted in all rounds together. The default takes about a minute on
  /// two cores, including proofs.
  double max_cells = 1.5e6;
  double max_bytes = std::numeric_limits<double>::infinity(); ///< approximate limit

  Refinement_parameters()
  {
    weights.mu = 0;
    weights.normal = 10;
    weights.surface = 100;
    weights.coefficients = 0.012;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PARAMETERS_H
