// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MARKED_CELLS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MARKED_CELLS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// calls `visit(n)` for the cell `c` and for all cells within half of its width along all axes
template <typename Visitor>
void visit_around(const Cell_hierarchy_3& cells, Cell_hierarchy_3::Index c, const Visitor& visit)
{
  const std::array<double, 3> low = cells.corner(c);
  const double width = cells.width(c), near = width / 2;
  cells.visit_cells(Bbox_3(low[0] - near, low[1] - near, low[2] - near, low[0] + width + near, low[1] + width + near,
                           low[2] + width + near),
                    visit);
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief collects the cells to split, except for cells of the finest level allowed.
 */
class Marked_cells
{
public:
  typedef Cell_hierarchy_3::Index Index;

  /// \pre `cells` outlive this object
  explicit Marked_cells(const Cell_hierarchy_3& cells) : m_cells(cells) {}

  bool empty() const { return m_marked.empty(); }

  void mark(Index c)
  {
    if(m_cells.level(c) < m_cells.max_level()) m_marked.push_back(c);
  }

  /// marks a cell and its neighbors of the same size whose positions differ from it along at most `axes` axes. Where
  /// slopes fail, splitting a wider region gives the field more freedom.
  void mark_widely(Index c, int axes = 3)
  {
    const Lattice_point p = m_cells.lattice_point(c);
    visit_around(m_cells, c, [&](Index n) {
      if(m_cells.level(n) != m_cells.level(c)) return;
      const Lattice_point q = m_cells.lattice_point(n);
      if(int(p[0] != q[0]) + int(p[1] != q[1]) + int(p[2] != q[2]) <= axes) mark(n);
    });
  }

  /// returns the marked cells, ascending and without duplicates
  const std::vector<Index>& sorted()
  {
    sort_unique(m_marked);
    return m_marked;
  }

private:
  const Cell_hierarchy_3& m_cells;
  std::vector<Index> m_marked;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_MARKED_CELLS_H
