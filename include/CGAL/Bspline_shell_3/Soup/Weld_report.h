// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_WELD_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SOUP_WELD_REPORT_H

#include <cstddef>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Soup
 *
 * \brief the changes that `weld_soup()` made to close cracks.
 */
struct Weld_report
{
  double unit = 0;                     ///< `coordinate_unit()` of the points
  double tolerance = 0;                ///< largest distance between points that are welded
  std::size_t welded_points = 0;       ///< points that were replaced by another one
  std::size_t split_edges = 0;         ///< border edges that were split at border vertices
  std::size_t undone_clusters = 0;     ///< groups of close border vertices that a check rejected
  std::size_t border_edges_before = 0; ///< edges with one facet, in the soup
  std::size_t border_edges_after = 0;  ///< edges with one facet, after welding
  /// whether nothing was welded because `unit` is larger than 1/100 of the thickness
  bool is_too_coarse = false;

  /// returns whether nothing was changed
  bool is_none() const { return welded_points + split_edges == 0; }
};

/// \ingroup PkgBsplineShell3Soup
/// returns a sentence about the changes, or about coordinates that are too coarse to close cracks; otherwise an empty
/// string
inline std::string message(const Weld_report& report)
{
  std::ostringstream out;
  out.precision(2);
  const auto number = [](std::size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? " was" : "s were");
  };
  if(!report.is_none()) {
    if(report.welded_points > 0) out << number(report.welded_points, "point") << " welded";
    if(report.welded_points > 0 && report.split_edges > 0) out << " and ";
    if(report.split_edges > 0) out << number(report.split_edges, "edge") << " split";
    out << " (within " << report.tolerance << "): " << report.border_edges_after << " of " << report.border_edges_before
        << " border edges remain.";
  } else if(report.is_too_coarse && report.border_edges_before > 0) {
    out << "Coordinates that are rounded to " << report.unit
        << " are too coarse to close cracks: subtract an offset before they are rounded, or choose a tolerance "
           "(weld_tolerance).";
  }
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_WELD_REPORT_H
