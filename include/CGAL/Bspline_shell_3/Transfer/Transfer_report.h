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
 * \brief reports the outcome of the transfer of an attribute.
 */
struct Transfer_report
{
  std::size_t transferred = 0; ///< number of simplices of the target with a value from the source
  /// all other simplices, each with the reason: by their positions in `vertices(mesh)` or, for facets and their
  /// corners, in `faces(mesh)`, in that order. They have the `default_value()` of the call, or keep their values if
  /// there is none.
  std::vector<std::pair<std::size_t, Flow_status> > failures;
  /// open meshes: number of these simplices with values from the border of the source, because some of their curves
  /// miss the source by less than the tolerance
  std::size_t snapped = 0;
  /// soups and proxies: positions of simplices of the target whose values depend on continued images
  /// (`Projected_point::is_continued`)
  std::vector<std::size_t> continued;
  /// texture coordinates: positions of facets that lie across a seam. Corners beyond the seam, as seen from the facet's
  /// centroid, are extrapolated from the centroid's side.
  std::vector<std::size_t> facets_across_seams;
  /// averages: positions of vertices of the source that contribute to no average, because they have no image; each with
  /// the reason
  std::vector<std::pair<std::size_t, Flow_status> > left_out;

  /// returns whether all simplices of the target have a value from the source
  explicit operator bool() const { return failures.empty(); }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_REPORT_H
