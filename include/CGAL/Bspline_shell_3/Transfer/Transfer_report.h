// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_REPORT_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_REPORT_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief how the transfer of an attribute went.
 */
struct Transfer_report
{
  std::size_t transferred = 0; ///< simplices of the target that got a value from the source
  /// All others, each with a reason, by their positions in `vertices(mesh)` or, for facets and their corners, in
  /// `faces(mesh)`, in that order. They have the `default_value()` of the call, or, without one, what they had before.
  std::vector<std::pair<std::size_t, Flow_status> > failures;
  /// open meshes: simplices among those whose curves, or some of them, miss the source by less than the tolerance, and
  /// got values from its border
  std::size_t snapped = 0;
  /// soups and proxies: simplices of the target, by position, whose values come, in part at least, from images that are
  /// continued
  /// (`Projected_point::is_continued`)
  std::vector<std::size_t> continued;
  /// texture coordinates: facets that lie across a seam, by position. Those of their corners that are beyond it, as
  /// seen from the facet's center, are extrapolated from this side.
  std::vector<std::size_t> facets_across_seams;
  /// averages: vertices of the source, by position, whose values are in none of them as they have no image; each with a
  /// reason
  std::vector<std::pair<std::size_t, Flow_status> > left_out;

  /// whether all simplices of the target got a value
  explicit operator bool() const { return failures.empty(); }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_REPORT_H
