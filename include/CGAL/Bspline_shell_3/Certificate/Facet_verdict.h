// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_FACET_VERDICT_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_FACET_VERDICT_H

#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Certificate
/// \brief the result of a certificate for a facet.
struct Facet_verdict
{
  Verdict containment = Verdict::UNDECIDED;
  Verdict transversality = Verdict::UNDECIDED;
  /// a lower bound on \f$n \cdot \nabla f\f$ with the unit normal \f$n\f$; 0 if transversality is not proved. The bound
  /// is close only if the slope is near the smallest slope of all facets.
  double slope = 0;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_FACET_VERDICT_H
