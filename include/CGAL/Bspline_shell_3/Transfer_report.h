// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_REPORT_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_REPORT_H

#include <CGAL/Bspline_shell_3/Flow_status.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Flow
 *
 * \brief how the transfer of an attribute went.
 */
struct Transfer_report
{
  std::size_t transferred = 0;        ///< simplices that got a value; the others keep what they had
  /// the others: positions in `vertices(mesh)` or `faces(mesh)`, in that order, each with a reason
  std::vector<std::pair<std::size_t, Flow_status> > failures;
  /// texture coordinates: facets that lie across a seam, by position. Those of their corners that are beyond it, as seen from the
  /// facet's centre, are extrapolated from this side.
  std::vector<std::size_t> facets_across_seams;

  /// whether all simplices got a value
  explicit operator bool() const { return failures.empty(); }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_REPORT_H
