// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Cell_subdivision.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/Cover_boxes.h>
#include <CGAL/Bspline_shell_3/Certificate/internal/least_gradient.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief A cover, by closed boxes, of the components of \f$\{\epsilon_1 \le f \le \epsilon_2\}\f$ that contain given
 * points.
 *
 * Leaf cells are subdivided until the kind of each box is known, or further subdivision does not help. From each point,
 * a flood fill visits all connected boxes that are not excluded. Flooding stops at excluded boxes, so the component of
 * the point cannot leave its boxes. If none of them is undecided, the component has no critical point. If the component
 * is excluded wherever the boxes touch the boundary of the domain, it lies in the interior.
 *
 * \tparam Field_ a model of `BsplineField_3` whose cells' corners are exact, also after seven halvings. Its domain
 *   consists of equal cells of a lattice, and its cells are dyadic parts of them.
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field_, typename Threshold = Constant_threshold>
class Shell_cover_3
{
public:
  typedef Field_ Field;
  typedef typename Field::Point_3 Point_3;

  /// \param separating_depth halvings of a cell up to which boxes with critical points beyond a threshold are
  ///   subdivided, too. Both sides of a wall or a gap are one component of the cover, unless boxes between them are
  ///   excluded. Zero if components do not matter.
  /// \pre `field` outlives this object
  Shell_cover_3(const Field& field, const Threshold& inner, const Threshold& outer, int separating_depth = 3)
    : m_boxes(field), m_subdivision(field, inner, outer, separating_depth)
  {}
  Shell_cover_3(const Field&&, const Threshold&, const Threshold&, int = 3) = delete; // it would dangle

  const Field& field() const { return m_boxes.field(); }

  /// Reuses the boxes of another cover for cells that are the same.
  /// \param now a function that maps cells of the other cover. Its value is the cell of this cover at the same place,
  ///   if the field and the thresholds are the same there, and `npos` otherwise.
  /// \pre the other cover's field has the same domain, and no cell of this cover has been subdivided
  template <typename Now>
  void reuse(const Shell_cover_3& other, const Now& now)
  {
    CGAL_precondition(boxes().empty());
    for(Cover_box box : other.boxes()) {
      box.cell = now(box.cell);
      box.component = Cover_box::no_component;
      if(box.cell != Field::npos) m_boxes.push_back(box);
    }
  }

  /// Adopts the boxes and the components of another cover of the same shell.
  /// \pre no cell of this cover has been subdivided
  void adopt(const std::vector<Cover_box>& boxes)
  {
    CGAL_precondition(this->boxes().empty());
    for(const Cover_box& box : boxes) m_boxes.push_back(box);
  }

  /// two points of one component of the cover, the earlier one first
  typedef std::array<std::size_t, 2> Shared;

  /// Adopts the boxes of another cover, but only the components that contain given points. The number of each component
  /// becomes the number of the first of its points.
  /// \return the points that share a component with an earlier one. If a point lies in no component, nothing is
  ///   returned, and this cover is of no use.
  /// \pre no box of the other cover's components is undecided, and none is at the end of the field's domain
  std::optional<std::vector<Shared> > adopt(const std::vector<Cover_box>& boxes, const std::vector<Point_3>& points)
  {
    adopt(boxes);
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<Shared> shared;
    for(std::size_t n = 0; n < points.size(); ++n) {
      const std::uint32_t component = this->component(points[n]);
      if(component == Cover_box::no_component) return std::nullopt;
      const auto [known, is_new] = numbers.emplace(component, std::uint32_t(n));
      if(!is_new) shared.push_back({ known->second, n });
    }
    for(std::size_t b = 0; b < boxes.size(); ++b) {
      const auto number = numbers.find(boxes[b].component);
      m_boxes.set_component(b, number == numbers.end() ? Cover_box::no_component : number->second);
    }
    return shared;
  }

  /// Subdivides cells that are known to be needed, several at a time.
  template <typename ConcurrencyTag>
  void prepare(std::vector<std::uint32_t> cells)
  {
    constexpr std::size_t chunk = 64, many_undecided = 1000;
    sort_unique(cells);
    cells.erase(std::remove_if(cells.begin(), cells.end(), [&](std::uint32_t c) { return m_boxes.is_subdivided(c); }),
                cells.end());
    const bool gives_up = m_undecided >= many_undecided; // finer boxes are not worth their time
    for(const Cover_box& box : internal::collect_from_chunks<ConcurrencyTag, Cover_box>(
          cells.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Cover_box>&found) {
            for(std::size_t n = begin; n < end; ++n) m_subdivision.subdivide(cells[n], gives_up, found);
          }))
      m_boxes.push_back(box);
  }

  /// Floods from a point. Returns the number of the component of the cover that contains it: the given one, or that of
  /// an earlier point if the boxes are the same.
  template <typename ConcurrencyTag>
  std::uint32_t flood(const Point_3& p, std::uint32_t component)
  {
    constexpr std::size_t chunk = 64;
    std::vector<std::uint32_t> cells; // subdivided next
    std::vector<std::size_t> front, next, waiting;
    const auto include = [&](std::size_t b) {
      m_undecided += m_boxes[b].kind == Box_kind::UNDECIDED;
      m_boxes.set_component(b, component);
      next.push_back(b);
    };
    field().visit_cells(p.bbox(), [&](std::uint32_t c) { cells.push_back(c); });
    prepare<ConcurrencyTag>(cells);
    std::uint32_t known = Cover_box::no_component;
    visit_boxes_at(p, [&](std::size_t b) {
      if(m_boxes[b].kind == Box_kind::EXCLUDED) return;
      if(m_boxes[b].component != Cover_box::no_component) known = m_boxes[b].component;
      else include(b);
    });
    // All boxes at a point touch each other: if one was flooded before, all were.
    if(known != Cover_box::no_component) return known;
    // Advance the front within subdivided cells. Then subdivide all cells that it touches.
    while(!next.empty()) {
      cells.clear();
      while(!next.empty()) {
        front.swap(next);
        next.clear();
        for(const Flood_step& step : internal::collect_from_chunks<ConcurrencyTag, Flood_step>(
              front.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Flood_step>&found) {
                for(std::size_t n = begin; n < end; ++n) find_steps(front[n], found);
              }))
          switch(step.kind) {
            case Flood_step::BOX:
              if(m_boxes[step.number].component == Cover_box::no_component) include(step.number);
              break;
            case Flood_step::UNSEEN_CELL: cells.push_back(std::uint32_t(step.number)); break;
            case Flood_step::WAITING_BOX: waiting.push_back(step.number); break;
            case Flood_step::BOX_AT_END: m_at_end.push_back(step.number); break;
          }
      }
      prepare<ConcurrencyTag>(cells);
      next.swap(waiting);
    }
    return component;
  }

  /// Returns whether monotone boxes connect each monotone box of the cover to one that contains one of these points.
  /// Other monotone boxes may be in another component of the shell: only a box with critical points joins them to the
  /// cover, and its parts may be excluded.
  /// \param visit_points calls its argument for each of the points, until the argument returns `false`
  template <typename VisitPoints>
  bool are_monotone_boxes_connected_to(const VisitPoints& visit_points) const
  {
    const auto is_monotone = [](const Cover_box& box) {
      return box.kind == Box_kind::MONOTONE && box.component != Cover_box::no_component;
    };
    std::size_t left = std::size_t(std::count_if(boxes().begin(), boxes().end(), is_monotone));
    std::vector<char> is_reached(boxes().size(), 0);
    std::vector<std::size_t> front;
    const auto reach = [&](std::size_t b) {
      if(is_reached[b] || !is_monotone(m_boxes[b])) return;
      is_reached[b] = 1;
      front.push_back(b);
      --left;
    };
    visit_points([&](const Point_3& p) {
      internal::Run::poll();
      visit_boxes_at(p, reach);
      while(!front.empty()) {
        const Cover_box& box = m_boxes[front.back()];
        front.pop_back();
        const Bbox_3 b = bbox(box);
        if(is_inside_cell(box)) m_boxes.visit_touching(box.cell, b, reach);
        else visit_boxes_touching(b, reach);
      }
      return left > 0;
    });
    return left == 0;
  }

  /// Returns the component of the cover that contains a point, or `Cover_box::no_component`.
  std::uint32_t component(const Point_3& p) const
  {
    std::uint32_t component = Cover_box::no_component;
    visit_boxes_at(p, [&](std::size_t b) {
      if(m_boxes[b].component != Cover_box::no_component) component = m_boxes[b].component;
    });
    return component;
  }

  /// Returns all boxes; the boxes of one leaf cell are consecutive.
  const std::vector<Cover_box>& boxes() const { return m_boxes.boxes(); }
  /// Returns the boxes of the cover that may be in the shell where they touch the end of the field's domain.
  const std::vector<std::size_t>& at_end() const { return m_at_end; }
  /// Returns the number of undecided boxes of the cover.
  std::size_t number_of_undecided_boxes() const { return m_undecided; }
  /// Returns the number of leaf cells that were examined.
  std::size_t number_of_cells() const { return m_boxes.number_of_cells(); }

  /// Returns the closed box; its corners are exact.
  Bbox_3 bbox(const Cover_box& box) const { return m_boxes.bbox(box); }

  /// Returns the field on a box, as an enclosed polynomial over the box.
  Enclosed_tricubic function(const Cover_box& box) const { return m_subdivision.part(box).functions[0]; }

  /// Encloses the values of the field where a box may be in the shell at the boundary of the domain.
  Level_range range_at_end(const Cover_box& box) const { return m_subdivision.range_at_end(box); }

  /// Returns `true` if all of a box is certainly in the shell.
  bool is_between_thresholds(const Cover_box& box) const { return m_subdivision.is_between_thresholds(box); }

  /// Returns a lower bound, per user unit, of the length of the gradient in the shell, on the cover. The boxes with the
  /// least bounds are subdivided. This ends when their bounds are near the gradient in the middles of boxes, or at a
  /// limit.
  /// \pre no box of the cover is undecided
  template <typename ConcurrencyTag>
  double least_gradient() const
  {
    return internal::least_gradient<ConcurrencyTag>(m_subdivision, boxes());
  }

  /// Returns, for each leaf cell, a lower bound, per user unit, of the length of the gradient in the shell. It holds on
  /// the boxes of the cover in the cell, and is infinite if there are none. Bounds are coarser than `least_gradient()`.
  /// \pre no box of the cover is undecided
  template <typename ConcurrencyTag>
  std::vector<double> least_gradients() const
  {
    return internal::least_gradients<ConcurrencyTag>(m_subdivision, boxes(), field().number_of_cells());
  }

private:
  // A step of the flood from a box of the front, to a box that touches it and is not in the cover yet. If cells must be
  // subdivided first, the steps are these cells, and the box itself once more. Boxes at the boundary of the domain are
  // reported, too.
  struct Flood_step
  {
    enum Kind : std::uint8_t
    {
      BOX,
      UNSEEN_CELL,
      WAITING_BOX,
      BOX_AT_END
    };
    Kind kind;
    std::size_t number; // number of a box or cell
  };

  void find_steps(std::size_t b, std::vector<Flood_step>& steps) const
  {
    const Bbox_3 box = bbox(m_boxes[b]);
    const auto find_touching = [&](std::uint32_t c) {
      m_boxes.visit_touching(c, box, [&](std::size_t n) {
        if(m_boxes[n].kind != Box_kind::EXCLUDED && m_boxes[n].component == Cover_box::no_component)
          steps.push_back({ Flood_step::BOX, n });
      });
    };
    if(is_inside_cell(m_boxes[b])) {
      find_touching(m_boxes[b].cell);
      return;
    }
    const std::size_t before = steps.size();
    bool complete = true;
    field().visit_cells(box, [&](std::uint32_t c) {
      if(!m_boxes.is_subdivided(c)) {
        if(complete) steps.resize(before);
        complete = false;
        steps.push_back({ Flood_step::UNSEEN_CELL, c });
      } else if(complete) find_touching(c);
    });
    if(!complete) steps.push_back({ Flood_step::WAITING_BOX, b });
    else if(m_boxes[b].is_at_end) steps.push_back({ Flood_step::BOX_AT_END, b });
  }

  // Returns true if the box has no point in common with the boundary of its cell.
  static bool is_inside_cell(const Cover_box& box)
  {
    const int last = (1 << box.depth) - 1;
    bool inside = true;
    for(int i : box.position) inside = inside && i > 0 && i < last;
    return inside;
  }

  // Calls visit(b) for the boxes of subdivided cells that touch a closed box, or contain a point.
  template <typename Visitor>
  void visit_boxes_touching(const Bbox_3& box, const Visitor& visit) const
  {
    field().visit_cells(box, [&](std::uint32_t c) {
      if(m_boxes.is_subdivided(c)) m_boxes.visit_touching(c, box, visit);
    });
  }
  template <typename Visitor>
  void visit_boxes_at(const Point_3& p, const Visitor& visit) const
  {
    visit_boxes_touching(p.bbox(), visit);
  }

  internal::Cover_boxes<Field> m_boxes;
  internal::Cell_subdivision<Field, Threshold> m_subdivision;
  std::vector<std::size_t> m_at_end;
  std::size_t m_undecided = 0; // number of undecided boxes of the cover
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H
