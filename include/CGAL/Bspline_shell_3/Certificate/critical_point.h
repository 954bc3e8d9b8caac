// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief a box, inside the box of a function, that is proved to contain a critical point of the function.
 */
struct Critical_point
{
  std::array<double, 3> center; ///< local coordinates
  double radius;                ///< half the width of the box, in local coordinates
};

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief returns a small box that is proved to contain a critical point of a function on its box; nothing if none is
 * found, or if it is degenerate.
 *
 * Newton's method finds a candidate. Krawczyk's test, with second derivatives enclosed on the whole box, proves that a
 * small box around it contains exactly one zero of the gradient.
 */
std::optional<Critical_point> prove_critical_point(const Enclosed_tricubic& f);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Certificate/critical_point_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_CRITICAL_POINT_H
