// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ENERGY_WEIGHTS_H
#define CGAL_BSPLINE_SHELL_3_FIT_ENERGY_WEIGHTS_H

#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the terms of the energy: the four terms of \cgalCite{CubicBsplineShell2025}, called *the paper* here, and two
 * additional terms.
 */
enum class Energy_term
{
  DISTANCE,         ///< \f$E_{SDF}\f$ (Eq. 4.2): squared difference to the signed distance, summed over the samples
  SURFACE,          ///< squared value on the facets; not in the paper
  ANGLE,            ///< \f$E_{angle}\f$ (Eq. 4.3): squared difference of gradient and normal, on the facets
  SINGULAR_HESSIAN, ///< \f$E_{singularH}\f$ (Eq. 4.4): absolute determinant of the Hessian, in the shell
  NORMAL,           ///< \f$E_{normal}\f$ (Eq. 4.5): squared difference of the gradient's normal component and one
  /// squared difference of the coefficients and the signed distance, extrapolated linearly from each cell; not in the
  /// paper
  COEFFICIENTS
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the weights of the terms, \f$E = E_{SDF} + \beta E_{surface} + \nu E_{normal} + \delta E_{coefficients} + \mu
 * (E_{angle} + \sigma E_{singularH} + \zeta E_{normal})\f$ (Eq. 4.6, where \f$\beta = \nu = \delta = 0\f$).
 */
struct Energy_weights
{
  double mu = 0.1;   ///< the paper's \f$\mu\f$
  double zeta = 1e5; ///< the paper's \f$\zeta\f$
  /// \f$\sigma\f$: 1 in the paper. The term is omitted by default, because it does not exclude critical points, takes
  /// most of the time, and thickens the shell at corners.
  double singular_hessian = 0;
  /// \f$\beta\f$: the weight of the squared value of the field on the mesh, integrated in cell units; 0 in the paper.
  /// The term makes the shell thinner.
  double surface = 0;
  /// \f$\nu\f$: the weight of \f$E_{normal}\f$ without \f$E_{angle}\f$; 0 in the paper. Where the surface term prevents
  /// variation of the field along facets, \f$E_{angle}\f$ contributes little, but takes half of the work.
  double normal = 0;
  /// \f$\delta\f$: 0 in the paper. Functions whose support meets the domain only at a corner are poorly determined by
  /// the other terms. A small weight continues the field smoothly there, and solvers converge faster.
  double coefficients = 0;

  /// records the first weight that is negative or not finite
  void check(Invalid_parameter& invalid) const
  {
    const Parameter_bounds allowed = Parameter_bounds::not_negative();
    invalid.check("energy_weights.mu", mu, allowed);
    invalid.check("energy_weights.zeta", zeta, allowed);
    invalid.check("energy_weights.singular_hessian", singular_hessian, allowed);
    invalid.check("energy_weights.surface", surface, allowed);
    invalid.check("energy_weights.normal", normal, allowed);
    invalid.check("energy_weights.coefficients", coefficients, allowed);
  }

  /// returns the weights of the paper, with all four terms
  static Energy_weights paper()
  {
    Energy_weights weights;
    weights.singular_hessian = 1;
    return weights;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ENERGY_WEIGHTS_H
