// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_COVER_BOXES_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_COVER_BOXES_H

#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The boxes of subdivided leaf cells. A shell may have more of them than 32 bits can count.
//
// The boxes of a cell fill it. They are consecutive, in the order of a depth-first walk of the cell's octree, so that
// the boxes of each part of the cell are consecutive, too. Once appended, only the component of a box can change.
template <typename Field>
class Cover_boxes
{
  typedef typename Field::Cell_index Cell_index;

public:
  // pre: `field` outlives this object
  explicit Cover_boxes(const Field& field) : m_field(&field), m_range(field.number_of_cells(), { 0, 0 }) {}

  const Field& field() const { return *m_field; }

  // Appends a box.
  // pre: the other boxes of its cell are appended right before and after it, in the order of precedes()
  void push_back(const Cover_box& box)
  {
    CGAL_precondition(!is_subdivided(box.cell) || (m_boxes.back().cell == box.cell && precedes(m_boxes.back(), box)));
    if(!is_subdivided(box.cell)) {
      m_range[box.cell][0] = m_boxes.size();
      ++m_number_of_cells;
    }
    m_boxes.push_back(box);
    m_range[box.cell][1] = m_boxes.size();
  }

  void set_component(std::size_t b, std::uint32_t component) { m_boxes[b].component = component; }

  const std::vector<Cover_box>& boxes() const { return m_boxes; }
  const Cover_box& operator[](std::size_t b) const { return m_boxes[b]; }
  std::size_t number_of_cells() const { return m_number_of_cells; }
  bool is_subdivided(Cell_index c) const { return m_range[c][0] < m_range[c][1]; }

  // Returns true if a depth-first walk of their cell's octree visits box a before box b.
  static bool precedes(const Cover_box& a, const Cover_box& b)
  {
    // interleaved bits of the least corner
    const auto key = [](const Cover_box& box) {
      constexpr int bits = 16;
      std::uint64_t key = 0;
      for(int bit = int(box.depth) - 1; bit >= 0; --bit) key = key << 3 | std::uint64_t(octant(box, bit));
      return key << (3 * (bits - int(box.depth)));
    };
    return key(a) < key(b);
  }

  // Returns the octant, of the part of its cell that is bit + 1 halvings larger, that contains a box.
  static int octant(const Cover_box& box, int bit)
  {
    return ((box.position[0] >> bit) & 1) | ((box.position[1] >> bit) & 1) << 1 | ((box.position[2] >> bit) & 1) << 2;
  }

  // Returns the closed box; its corners are exact.
  Bbox_3 bbox(const Cover_box& box) const
  {
    const typename Field::Cell cell = m_field->cell(box.cell);
    const double width = cell.width() / double(1 << box.depth);
    std::array<double, 3> least;
    for(int a = 0; a < 3; ++a) least[a] = cell.corner()[a] + box.position[a] * width;
    return Bbox_3(least[0], least[1], least[2], least[0] + width, least[1] + width, least[2] + width);
  }

  // Calls visit(b) for the boxes of a subdivided cell that have a point in common with a closed box.
  template <typename Visitor>
  void visit_touching(Cell_index c, const Bbox_3& target, const Visitor& visit) const
  {
    visit_touching(m_range[c][0], m_range[c][1], 0, target, visit);
  }

private:
  // Visits the boxes [begin, end). They are the boxes of one part of a cell, of the given depth.
  template <typename Visitor>
  void visit_touching(std::size_t begin, std::size_t end, int depth, const Bbox_3& target, const Visitor& visit) const
  {
    Cover_box part = m_boxes[begin];
    const int below = int(part.depth) - depth;
    for(int a = 0; a < 3; ++a) part.position[a] = std::uint16_t(part.position[a] >> below);
    part.depth = std::uint8_t(depth);
    if(!do_overlap(bbox(part), target)) return;
    if(end - begin == 1) {
      visit(begin);
      return;
    }
    for(std::size_t b = begin; b < end;) {
      const int o = octant(m_boxes[b], int(m_boxes[b].depth) - depth - 1);
      const std::size_t next = std::size_t(
        std::partition_point(m_boxes.begin() + b, m_boxes.begin() + end,
                             [&](const Cover_box& x) { return octant(x, int(x.depth) - depth - 1) <= o; })
        - m_boxes.begin());
      visit_touching(b, next, depth + 1, target, visit);
      b = next;
    }
  }

  const Field* m_field;
  std::vector<std::array<std::size_t, 2> > m_range; // by cell; empty if the cell is not subdivided
  std::size_t m_number_of_cells = 0;                // number of subdivided cells
  std::vector<Cover_box> m_boxes;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_COVER_BOXES_H
