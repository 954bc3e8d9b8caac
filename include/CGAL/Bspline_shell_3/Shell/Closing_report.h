// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SHELL_CLOSING_REPORT_H
#define CGAL_BSPLINE_SHELL_3_SHELL_CLOSING_REPORT_H

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Shell
 *
 * \brief a report on how an open mesh was closed.
 */
struct Closing_report
{
  /// a cycle of border edges
  struct Hole
  {
    std::array<double, 3> point = {}; ///< a point of the cycle
    std::size_t edges = 0;            ///< number of edges of the cycle
    bool is_capped = false;           ///< whether it is filled by a cap; otherwise, a back sheet would begin there
  };

  std::vector<Hole> holes;
  std::size_t sheets = 0;    ///< number of components of the mesh with a back sheet
  std::size_t triangles = 0; ///< number of triangles of caps and back sheets
  double least_offset = 0;   ///< smallest distance of a back sheet from the mesh at a vertex
  double largest_offset = 0; ///< largest distance of a back sheet from the mesh at a vertex

  std::size_t caps() const
  {
    std::size_t number = 0;
    for(const Hole& hole : holes) number += hole.is_capped ? 1 : 0;
    return number;
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SHELL_CLOSING_REPORT_H
