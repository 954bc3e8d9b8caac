// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SHELL_CELLS_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SHELL_CELLS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/monotone_direction.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Surface/internal/Field_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The leaf cells of a shell's field, some of which are split: no leaf that the level set may intersect has both boxes
// of the shell's cover and boxes outside of the cover that are not excluded. Leaves with boxes of the cover are
// selected. Boxes of the cover touch only each other and excluded boxes, which a level between the thresholds does not
// intersect. Hence no part of the level set leaves the selected leaves.
//
// Leaves are also split if they have boxes of the cover that are monotone in nearly opposite directions, or boxes with
// critical points. Two parts of the level set may then be close to each other, and each of them needs its own leaves.
//
// Leaves that touch differ by at most one level. Leaves of the field that are not split keep their indices; the others
// follow.
template <typename Field, typename Threshold>
class Shell_cells
{
  typedef Field_cells<Field, Threshold> Whole_cells;
public:
  typedef Shell_cells Hierarchy;
  typedef typename Field::Cell_index Index;
  static constexpr Index npos = Field::npos;

  // `boxes` are the boxes of the cover.
  Shell_cells(const Field& field, const Threshold& threshold, const std::vector<Cover_box>& boxes)
    : m_cells(field, threshold), m_levels(cells().number_of_levels()), m_first_part(field.number_of_cells(), npos)
  {
    for(std::size_t begin = 0, end = 0; begin < boxes.size(); begin = end) {
      const Index c = boxes[begin].cell;
      while(end < boxes.size() && boxes[end].cell == c) ++end;
      separate({ cells().level(c), cells().lattice_point(c) }, 0, &boxes[begin], &boxes[begin] + (end - begin));
    }
    m_is_selected.assign(number_of_cells(), 0);
    for(const Cover_box& box : boxes)
      if(is_in_shell(box)) select(place(box));
  }

  const Hierarchy& hierarchy() const { return *this; }
  std::size_t number_of_cells() const { return m_first_part.size(); }
  bool is_leaf(Index c) const { return m_first_part[c] == npos; }
  bool is_selected(Index c) const { return m_is_selected[c] != 0; }
  Enclosed_tricubic function(Index c) const
  {
    if(!is_part(c)) return m_cells.function(c);
    const Part& part = this->part(c);
    Enclosed_tricubic f = m_cells.function(part.cell);
    for(int bit = part.depth() - 1; bit >= 0; --bit) f = restrict_to_octant(f, octant(part.position, bit));
    return f;
  }
  std::array<double, 3> corner(Index c) const
  {
    if(!is_part(c)) return m_cells.corner(c);
    std::array<double, 3> p = m_cells.corner(part(c).cell);
    for(int a = 0; a < 3; ++a) p[a] += part(c).position[a] * width(c);
    return p;
  }
  double width(Index c) const
  {
    return is_part(c) ? std::ldexp(m_cells.width(part(c).cell), -part(c).depth()) : m_cells.width(c);
  }

  // The interface of a hierarchy.
  int number_of_levels() const { return m_levels; }
  int level(Index c) const { return is_part(c) ? part(c).place.level : cells().level(c); }
  Lattice_point lattice_point(Index c) const { return is_part(c) ? part(c).place.point : cells().lattice_point(c); }
  Index leaf_around(int level, const Lattice_point& p) const { return leaf_around(Place{ level, p }); }
  bool is_split(int level, const Lattice_point& p) const { return is_split(Place{ level, p }); }

private:
  // A cell of a level, split or not.
  struct Place
  {
    int level;
    Lattice_point point;

    Place parent() const
    {
      Place p = { level - 1, point };
      for(int& i : p.point) i = (i - (i & 1)) / 2; // rounds down
      return p;
    }
    Place child(int octant) const
    {
      return { level + 1,
               { 2 * point[0] + (octant & 1), 2 * point[1] + (octant >> 1 & 1), 2 * point[2] + (octant >> 2) } };
    }
  };
  struct Part
  {
    Place place;
    Index cell; // cell of the field
    int level_of_cell;
    Lattice_point position; // position in that cell, in units of the width of the part

    int depth() const { return place.level - level_of_cell; }
  };

  const auto& cells() const { return m_cells.hierarchy(); }
  std::size_t number_of_whole_cells() const { return m_cells.number_of_cells(); }
  bool is_part(Index c) const { return c >= number_of_whole_cells(); }
  const Part& part(Index c) const { return m_parts[c - number_of_whole_cells()]; }

  template <typename Position>
  static int octant(const Position& p, int bit)
  {
    return ((p[0] >> bit) & 1) | ((p[1] >> bit) & 1) << 1 | ((p[2] >> bit) & 1) << 2;
  }

  Place place(const Cover_box& box) const
  {
    Place place = { cells().level(box.cell) + box.depth, cells().lattice_point(box.cell) };
    for(int a = 0; a < 3; ++a) place.point[a] = place.point[a] * (1 << box.depth) + box.position[a];
    return place;
  }

  // Returns the leaf of the field around a cell, or npos if the cell is split in the field.
  Index whole_leaf_around(Place p) const
  {
    while(p.level >= cells().number_of_levels()) p = p.parent();
    return cells().leaf_around(p.level, p.point);
  }
  // Returns the cell if it exists, otherwise the leaf around it, or npos if the cell is split in the field.
  Index cell_or_leaf_around(const Place& p) const
  {
    Index c = whole_leaf_around(p);
    while(c != npos && !is_leaf(c) && level(c) < p.level)
      c = m_first_part[c] + Index(octant(p.point, p.level - level(c) - 1));
    return c;
  }

  Index leaf_around(const Place& p) const
  {
    const Index c = cell_or_leaf_around(p);
    return c != npos && is_leaf(c) ? c : npos;
  }
  bool is_split(const Place& p) const
  {
    if(p.level < cells().number_of_levels() && cells().is_split(p.level, p.point)) return true;
    if(m_parts.empty()) return false;
    const Index c = cell_or_leaf_around(p);
    return c != npos && !is_leaf(c);
  }

  // Splits a cell if it is in the domain, and the cells that must be split before it and around it.
  void split(const Place& p)
  {
    if(is_split(p)) return;
    Index c = leaf_around(p);
    if(c == npos) return;
    if(level(c) < p.level) {
      split(p.parent());
      c = leaf_around(p);
    }
    m_first_part[c] = Index(number_of_cells());
    m_levels = (std::max)(m_levels, p.level + 2);
    const Index cell = is_part(c) ? part(c).cell : c;
    for(int o = 0; o < 8; ++o) {
      Part child = { p.child(o), cell, cells().level(cell), {} };
      for(int a = 0; a < 3; ++a)
        child.position[a] = child.place.point[a] - cells().lattice_point(cell)[a] * (1 << child.depth());
      m_parts.push_back(child);
      m_first_part.push_back(npos);
    }
    for(int n = 0; n < 27; ++n) {
      const Place neighbor = { p.level,
                               { p.point[0] + n % 3 - 1, p.point[1] + n / 3 % 3 - 1, p.point[2] + n / 9 - 1 } };
      const Index leaf = leaf_around(neighbor);
      if(leaf != npos && level(leaf) < p.level) split(neighbor.parent());
    }
  }

  static bool is_in_shell(const Cover_box& b) { return b.component != Cover_box::no_component; }

  // Returns whether two boxes of the cover are monotone in directions with an angle of more than 120 degrees.
  static bool are_opposite(const Cover_box* begin, const Cover_box* end)
  {
    constexpr double cosine = -0.5;
    std::vector<std::array<double, 3> > directions;
    for(const Cover_box* b = begin; b != end; ++b)
      if(is_in_shell(*b) && b->kind == Box_kind::MONOTONE) {
        const double length = norm(b->proof);
        directions.push_back({ b->proof[0] / length, b->proof[1] / length, b->proof[2] / length });
      }
    for(std::size_t m = 0; m < directions.size(); ++m)
      for(std::size_t n = 0; n < m; ++n)
        if(dot(directions[m], directions[n]) < cosine) return true;
    return false;
  }

  // Splits a cell until its boxes are separated. A range of one box may be the box around the cell.
  void separate(const Place& p, int depth, const Cover_box* begin, const Cover_box* end)
  {
    constexpr int depth_at_walls = 3; // halvings; boxes of covers that separate the sides of walls are as small
    const auto is_elsewhere = [](const Cover_box& b) { return !is_in_shell(b) && b.kind != Box_kind::EXCLUDED; };
    const auto is_at_wall = [](const Cover_box& b) { return is_in_shell(b) && b.kind != Box_kind::MONOTONE; };
    if(std::none_of(begin, end, is_in_shell)) return;
    const bool has_parts = std::any_of(begin, end, is_elsewhere) || are_opposite(begin, end);
    if(!has_parts && (depth >= depth_at_walls || std::none_of(begin, end, is_at_wall))) return;
    const Enclosed_tricubic f = function(cell_or_leaf_around(p));
    const Level_range range = f.range();
    if(range.min > 0 || range.max < 0) return;
    std::array<double, 3> direction;
    if(!has_parts && is_monotone(f, 0, direction)) return; // the level set is a graph
    split(p);
    if(begin->depth <= depth) { // one box around the cell
      for(int o = 0; o < 8; ++o) separate(p.child(o), depth + 1, begin, end);
      return;
    }
    for(int o = 0; o < 8; ++o) {
      // Boxes in an octant are consecutive.
      const Cover_box* last = std::find_if(
        begin, end, [&](const Cover_box& b) { return octant(b.position, b.depth - depth - 1) != o; });
      separate(p.child(o), depth + 1, begin, last);
      begin = last;
    }
  }

  // Selects the leaf that contains a box, or otherwise the leaves in the box.
  void select(const Place& p)
  {
    if(is_split(p))
      for(int o = 0; o < 8; ++o) select(p.child(o));
    else m_is_selected[leaf_around(p)] = 1;
  }

  const Whole_cells m_cells;
  int m_levels;
  // `m_first_part` and `m_is_selected` are by leaf of the field, and then by part.
  std::vector<Index> m_first_part; // first of eight consecutive parts, in the order of octants; npos for leaves
  std::vector<char> m_is_selected;
  std::vector<Part> m_parts;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_SHELL_CELLS_H
