// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CELL_SUBDIVISION_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CELL_SUBDIVISION_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Box_examination.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Cover_boxes.h>
#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Subdivides leaf cells into boxes, until the kind of each box is known or subdivision is of no use. It also bounds the
// gradient on boxes.
template <typename Field, typename Threshold>
class Cell_subdivision
{
  typedef Box_examination<Threshold> Examination;
  // A direction to a face, an edge or a vertex of a cell or a box; components are -1, 0 or 1.
  typedef std::array<int, 3> Direction;

public:
  // An examined box, with the field and the thresholds on it.
  struct Part
  {
    Cover_box box;
    typename Examination::Functions functions;
  };

  // pre: `field` outlives this object
  Cell_subdivision(const Field& field, const Threshold& inner, const Threshold& outer, int separating_depth)
    : m_field(&field), m_examination(inner, outer), m_separating_depth(separating_depth)
  {}

  // Appends the boxes of a cell, in the order of `Cover_boxes`. If `gives_up`, the cell may have fewer boxes, and
  // those whose critical points seem to be in the shell are not subdivided.
  void subdivide(std::uint32_t c, bool gives_up, std::vector<Cover_box>& boxes) const
  {
    const std::size_t begin = boxes.size(), most_boxes = gives_up ? max_boxes_after_giving_up : max_boxes;
    const std::vector<Direction> ends = ends_of_domain(m_field->cell(c).bbox());
    Cover_box whole = { c, { 0, 0, 0 }, 0, Box_kind::UNDECIDED };
    // Breadth first: if the number of boxes reaches its limit, they are of equal size.
    std::vector<Part> parts(1, part(whole));
    examine(parts[0]);
    for(std::size_t n = 0; n < parts.size(); ++n) {
      Cover_box& box = parts[n].box;
      box.is_at_end = box.kind != Box_kind::EXCLUDED && !ends_in_shell(parts[n], ends).empty();
      const bool splits = box.kind == Box_kind::UNDECIDED
                            ? box.depth < max_depth && !(gives_up && m_examination.seems_critical(parts[n].functions))
                            : (is_critical(box.kind) && box.depth < m_separating_depth)
                                // parts inside must be separated from parts outside
                                || (box.is_at_end && box.depth < max_depth_at_end);
      if(!splits || parts.size() >= most_boxes) boxes.push_back(box);
      else
        for(const Part& octant : octants(parts[n])) parts.push_back(octant);
    }
    std::sort(boxes.begin() + std::ptrdiff_t(begin), boxes.end(), Cover_boxes<Field>::precedes);
  }

  // Returns a box with the functions on it.
  Part part(const Cover_box& box) const
  {
    Part part = { box, m_examination.functions(m_field->cell(box.cell), box.cell) };
    for(int bit = int(box.depth) - 1; bit >= 0; --bit)
      for(Enclosed_tricubic& f : part.functions) f = restrict_to_octant(f, Cover_boxes<Field>::octant(box, bit));
    return part;
  }

  // Returns the octants of a part. Undecided ones keep the kind and the proof of the part.
  std::array<Part, 8> octants(const Part& part) const
  {
    std::array<Part, 8> octants;
    for(int o = 0; o < 8; ++o) {
      Part& child = octants[std::size_t(o)];
      child.box = part.box;
      ++child.box.depth;
      for(int a = 0; a < 3; ++a) child.box.position[a] = std::uint16_t(2 * part.box.position[a] + ((o >> a) & 1));
      if(is_critical(part.box.kind))
        for(int a = 0; a < 3; ++a) child.box.proof[a] = 2 * part.box.proof[a] - ((o >> a) & 1);
      for(std::size_t m = 0; m < part.functions.size(); ++m)
        child.functions[m] = restrict_to_octant(part.functions[m], o);
      examine(child);
    }
    return octants;
  }

  // Encloses the values of the field where a box may be in the shell at the boundary of the domain.
  Level_range range_at_end(const Cover_box& box) const
  {
    const Part part = this->part(box);
    Level_range range;
    for(const Direction& direction : ends_in_shell(part, ends_of_domain(m_field->cell(box.cell).bbox())))
      range.include(part.functions[0].range_towards(direction));
    return range;
  }

  // Returns true if all of a box is certainly in the shell.
  bool is_between_thresholds(const Cover_box& box) const
  {
    return m_examination.are_between_thresholds(part(box).functions);
  }

  // Returns a lower bound, per user unit, of the length of the gradient in the shell, on a part that is not undecided.
  double gradient_bound(const Part& part) const
  {
    const double bound = m_examination.gradient_bound(part.functions, part.box);
    // There are two quotients. The second one may overflow, and little is known about a quotient that is subnormal. The
    // length of the direction is an upper bound.
    const double slope = bound / width(part.box);
    if(!((std::min)(bound, slope) >= underflow)) return 0;
    return (std::min)(slope, std::numeric_limits<double>::max()) * (1 - 4 * rounding);
  }

  // Returns the length of the gradient in the middle of a part. If the middle is not in the shell, returns infinity.
  // Not rigorous.
  double gradient_in_the_middle(const Part& part) const
  {
    return m_examination.gradient_in_the_middle(part.functions) / width(part.box);
  }

private:
  static constexpr int max_depth = 7;        // halvings of a cell
  static constexpr int max_depth_at_end = 4; // halvings, if only the boundary of the domain is undecided
  // A cell with as many boxes is not subdivided further: if a critical point is in the shell, no depth decides its box.
  static constexpr std::size_t max_boxes = 512, max_boxes_after_giving_up = 64;

  static bool is_critical(Box_kind kind)
  {
    return kind == Box_kind::CRITICAL_BELOW || kind == Box_kind::CRITICAL_ABOVE;
  }

  // Finds the kind of a part, and its proof. An undecided one keeps them.
  void examine(Part& part) const
  {
    Cover_box box = part.box;
    m_examination.examine(part.functions, box);
    if(box.kind != Box_kind::UNDECIDED) part.box = box;
  }

  // Returns the directions from a cell in which the domain ends.
  std::vector<Direction> ends_of_domain(const Bbox_3& cell) const
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Bbox_3 around(std::nextafter(cell.xmin(), -infinity), std::nextafter(cell.ymin(), -infinity),
                        std::nextafter(cell.zmin(), -infinity), std::nextafter(cell.xmax(), infinity),
                        std::nextafter(cell.ymax(), infinity), std::nextafter(cell.zmax(), infinity));
    const auto ignore = [](typename Field::Cell_index) {};
    std::vector<Direction> ends;
    if(m_field->visit_cells(around, ignore)) return ends;
    for(int n = 0; n < 27; ++n) {
      const Direction direction = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
      std::array<double, 3> p; // next to the middle of a face, an edge or a vertex
      for(int a = 0; a < 3; ++a)
        p[a] = direction[a] < 0   ? (around.min)(a)
               : direction[a] > 0 ? (around.max)(a)
                                  : ((cell.min)(a) + (cell.max)(a)) / 2;
      if(!m_field->visit_cells(Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]), ignore)) ends.push_back(direction);
    }
    return ends;
  }

  // Returns the directions, of those in `ends`, in which a part of the cell may be in the shell where the domain ends.
  std::vector<Direction> ends_in_shell(const Part& part, const std::vector<Direction>& ends) const
  {
    const int last = (1 << part.box.depth) - 1;
    std::vector<Direction> in_shell;
    for(const Direction& direction : ends) {
      bool touches = true;
      for(int a = 0; a < 3; ++a)
        touches = touches && (direction[a] == 0 || part.box.position[a] == (direction[a] < 0 ? 0 : last));
      if(touches && !m_examination.is_excluded_towards(direction, part.functions)) in_shell.push_back(direction);
    }
    return in_shell;
  }

  double width(const Cover_box& box) const { return std::ldexp(m_field->cell(box.cell).width(), -int(box.depth)); }

  const Field* m_field;
  Examination m_examination;
  int m_separating_depth;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_CELL_SUBDIVISION_H
