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
 * \brief the outcome of the transfer of an attribute. *Elements* are the vertices or facets of the target that receive
 * values.
 */
struct Transfer_report
{
  std::size_t transferred = 0; ///< number of elements of the target with a value from the source
  /// all other elements, each with the reason, by ascending positions in `vertices(mesh)` or, for facets and their
  /// corners, in `faces(mesh)`. They have the `default_value()` of the call, or keep their values if there is none.
  std::vector<std::pair<std::size_t, Flow_status> > failures;
  /// open meshes: number of the transferred elements with values from the border of the source, because some of their
  /// curves miss the source by less than the tolerance
  std::size_t snapped = 0;
  /// soups and proxies: positions of elements whose values depend on images that are only nearest points
  /// (`Projected_point::is_continued`)
  std::vector<std::size_t> continued;
  /// texture coordinates: positions of facets that lie across a seam. Corners that are separated from the facet's
  /// centroid by the seam get values extrapolated from the centroid's side.
  std::vector<std::size_t> facets_across_seams;
  /// averages: positions of vertices of the source that do not contribute to an average, because they have no image;
  /// each with the reason
  std::vector<std::pair<std::size_t, Flow_status> > left_out;

  /// returns whether all elements have a value from the source
  explicit operator bool() const { return failures.empty(); }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_REPORT_H
