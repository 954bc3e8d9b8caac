// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H

#include <CGAL/Bspline_shell_3/Certificate/internal/Box_examination.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Shell/Cover_box.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/critical_values.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
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
 * Leaf cells are subdivided until the kind of each box is known, or subdivision is of no use. From each point, all
 * boxes are flooded that touch each other and are not excluded. Flooding stops at excluded boxes, so the component of
 * the point cannot leave its boxes. If none of them is undecided, the component has no critical point. If the component
 * is excluded wherever the boxes touch the end of the domain, it lies in the interior.
 *
 * \tparam Field_ a model of `BsplineField_3` whose cells' corners are exact, also after `max_depth` halvings. Its
 *   domain consists of equal cells of a lattice, and its cells are dyadic parts of them.
 * \tparam Threshold a model of `ShellThreshold`
 */
template <typename Field_, typename Threshold = Constant_threshold>
class Shell_cover_3
{
public:
  typedef Field_ Field;
  typedef typename Field::Point_3 Point_3;
  typedef typename Field::Cell Cell;
  typedef std::size_t Box_index;      ///< a shell may have more boxes than 32 bits can count
  static constexpr int max_depth = 7; ///< halvings of a leaf cell
  /// A cell with more boxes is not subdivided further. The smaller limit applies once `many_undecided_boxes` boxes are
  /// undecided. From then on, boxes are not subdivided, either, if critical points in them seem to be in the shell.
  static constexpr std::size_t max_boxes_of_a_cell = 512, max_boxes_of_a_hopeless_cell = 64,
                               many_undecided_boxes = 1000;

  /// \param separating_depth halvings of a cell up to which boxes with critical points beyond a threshold are
  ///   subdivided, too. Both sides of a wall or a gap are one component of the cover, unless boxes between them are
  ///   excluded. Zero if components do not matter.
  /// \pre `field` outlives this object
  Shell_cover_3(const Field& field, const Threshold& inner, const Threshold& outer, int separating_depth = 3)
    : m_field(&field), m_examination(inner, outer), m_separating_depth(separating_depth),
      m_first(field.number_of_cells(), unseen)
  {}
  Shell_cover_3(const Field&&, const Threshold&, const Threshold&, int = 3) = delete; // it would dangle

  const Field& field() const { return *m_field; }

  /// Reuses the boxes of another cover for cells that are the same.
  /// \param now a function that maps cells of the other cover. Its value is the cell of this cover at the same place,
  ///   if the field and the thresholds are the same there, and `npos` otherwise.
  /// \pre the other cover's field has the same domain, and no cell of this cover has been subdivided
  template <typename Now>
  void reuse(const Shell_cover_3& other, const Now& now)
  {
    CGAL_precondition(m_boxes.empty());
    for(const Cell_boxes& known : other.m_cells) {
      const std::uint32_t cell = now(known.cell);
      if(cell == Field::npos) continue;
      m_first[cell] = m_cells.size();
      m_cells.push_back({ cell, m_boxes.size(), m_boxes.size() + (known.end - known.begin) });
      for(std::size_t b = known.begin; b < known.end; ++b) {
        m_boxes.push_back(other.m_boxes[b]);
        m_boxes.back().cell = cell;
        m_boxes.back().component = Cover_box::no_component;
      }
    }
  }

  /// Adopts the boxes and the components of another cover of the same shell.
  /// \pre no cell of this cover has been subdivided
  void adopt(std::vector<Cover_box> boxes)
  {
    CGAL_precondition(m_boxes.empty());
    m_boxes = std::move(boxes);
    for(std::size_t b = 0; b < m_boxes.size(); ++b) {
      if(m_first[m_boxes[b].cell] == unseen) {
        m_first[m_boxes[b].cell] = m_cells.size();
        m_cells.push_back({ m_boxes[b].cell, b, b });
      }
      m_cells.back().end = b + 1;
    }
  }

  /// two points of one component of the cover, the earlier one first
  typedef std::array<std::size_t, 2> Shared;

  /// Adopts the boxes of another cover, but only the components that contain given points. The number of each component
  /// becomes the number of the first of its points.
  /// \return the points that share a component with an earlier one. If a point lies in no component, nothing is
  ///   returned, and this cover is of no use.
  /// \pre no box of the other cover's components is undecided, and none is at the end of the field's domain
  std::optional<std::vector<Shared> > adopt(std::vector<Cover_box> boxes, const std::vector<Point_3>& points)
  {
    adopt(std::move(boxes));
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<Shared> shared;
    for(std::size_t n = 0; n < points.size(); ++n) {
      const std::uint32_t component = this->component(points[n]);
      if(component == Cover_box::no_component) return std::nullopt;
      const auto [known, is_new] = numbers.emplace(component, std::uint32_t(n));
      if(!is_new) shared.push_back({ known->second, n });
    }
    for(Cover_box& box : m_boxes) {
      const auto number = numbers.find(box.component);
      box.component = number == numbers.end() ? Cover_box::no_component : number->second;
    }
    return shared;
  }

  /// Subdivides cells that are known to be needed, several at a time.
  template <typename ConcurrencyTag>
  void prepare(std::vector<std::uint32_t> cells)
  {
    sort_unique(cells);
    cells.erase(std::remove_if(cells.begin(), cells.end(), [&](std::uint32_t c) { return m_first[c] != unseen; }),
                cells.end());
    constexpr std::size_t chunk = 64;
    const bool is_hopeless = m_undecided >= many_undecided_boxes;
    std::vector<std::vector<Cover_box> > boxes((cells.size() + chunk - 1) / chunk);
    internal::for_each_chunk<ConcurrencyTag>(cells.size(), chunk, [&](std::size_t begin, std::size_t end) {
      std::vector<Part> queue;
      for(std::size_t n = begin; n < end; ++n) subdivide(cells[n], is_hopeless, queue, boxes[begin / chunk]);
    });
    for(const std::vector<Cover_box>& part : boxes)
      for(const Cover_box& box : part) {
        if(m_first[box.cell] == unseen) {
          m_first[box.cell] = m_cells.size();
          m_cells.push_back({ box.cell, m_boxes.size(), m_boxes.size() });
        }
        m_boxes.push_back(box);
        m_cells.back().end = m_boxes.size();
      }
  }

  /// Floods from a point. Returns the number of the component of the cover that contains it: the given one, or that of
  /// an earlier point if the boxes are the same.
  template <typename ConcurrencyTag>
  std::uint32_t flood(const Point_3& p, std::uint32_t component)
  {
    const Bbox_3 at(p[0], p[1], p[2], p[0], p[1], p[2]);
    std::vector<Box_index> front, next, waiting;
    std::vector<std::uint32_t> wanted;
    const auto include = [&](Box_index b) {
      Cover_box& box = m_boxes[b];
      m_undecided += box.kind == Box_kind::UNDECIDED;
      box.component = component;
      next.push_back(b);
    };
    m_field->visit_cells(at, [&](typename Field::Cell_index c) { wanted.push_back(c); });
    prepare<ConcurrencyTag>(wanted);
    std::uint32_t known = Cover_box::no_component;
    for(std::uint32_t c : wanted)
      for_each_touching(c, at, [&](Box_index b) {
        if(m_boxes[b].kind == Box_kind::EXCLUDED) return;
        if(m_boxes[b].component != Cover_box::no_component) known = m_boxes[b].component;
        else include(b);
      });
    // All boxes at a point touch each other: if one was flooded before, all were.
    if(known != Cover_box::no_component) return known;
    // Advance the front within subdivided cells. Then subdivide all cells that it touches.
    while(!next.empty()) {
      wanted.clear();
      while(!next.empty()) {
        constexpr std::size_t chunk = 64;
        front.swap(next);
        next.clear();
        const std::vector<Flood_step> steps = internal::collect_from_chunks<ConcurrencyTag, Flood_step>(
          front.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Flood_step>& found) {
            for(std::size_t n = begin; n < end; ++n) find_steps(front[n], found);
          });
        for(const Flood_step& step : steps) switch(step.kind) {
            case Flood_step::BOX:
              if(m_boxes[step.number].component == Cover_box::no_component) include(step.number);
              break;
            case Flood_step::UNSEEN_CELL: wanted.push_back(std::uint32_t(step.number)); break;
            case Flood_step::WAITING_BOX: waiting.push_back(step.number); break;
            case Flood_step::BOX_AT_END: m_at_end.push_back(step.number); break;
          }
      }
      prepare<ConcurrencyTag>(wanted);
      next.swap(waiting);
    }
    return component;
  }

  /// Returns the component of the cover that contains a point, or `Cover_box::no_component`.
  std::uint32_t component(const Point_3& p) const
  {
    const Bbox_3 at(p[0], p[1], p[2], p[0], p[1], p[2]);
    std::uint32_t component = Cover_box::no_component;
    m_field->visit_cells(at, [&](typename Field::Cell_index c) {
      if(m_first[c] != unseen)
        for_each_touching(c, at, [&](Box_index b) {
          if(m_boxes[b].component != Cover_box::no_component) component = m_boxes[b].component;
        });
    });
    return component;
  }

  /// Returns all boxes; the boxes of one leaf cell are consecutive.
  const std::vector<Cover_box>& boxes() const { return m_boxes; }
  /// Returns the boxes of the cover that may be in the shell where they touch the end of the field's domain.
  const std::vector<Box_index>& at_end() const { return m_at_end; }
  /// Returns the number of undecided boxes of the cover.
  std::size_t number_of_undecided_boxes() const { return m_undecided; }
  /// Returns the number of leaf cells that were examined.
  std::size_t number_of_cells() const { return m_cells.size(); }

  /// Returns the closed box; its corners are exact.
  Bbox_3 bbox(const Cover_box& box) const
  {
    const Cell cell = m_field->cell(box.cell);
    const double width = cell.width() / double(1 << box.depth);
    std::array<double, 3> least;
    for(int a = 0; a < 3; ++a) least[a] = cell.corner()[a] + box.position[a] * width;
    return Bbox_3(least[0], least[1], least[2], least[0] + width, least[1] + width, least[2] + width);
  }

  /// Returns the field on a box, as an enclosed polynomial over the box.
  Enclosed_tricubic function(const Cover_box& box) const { return functions_on(box)[0]; }

  /// Encloses the values of the field where a box may be in the shell at the end of the domain.
  Level_range range_at_end(const Cover_box& box) const
  {
    const Part part = { box, functions_on(box) };
    Level_range range;
    for(const Direction& direction : ends_in_shell(part, ends_of_domain(m_field->cell(box.cell).bbox())))
      range.include(part.functions[0].range_towards(direction));
    return range;
  }

  /// Encloses the values of the field at critical points in a box.
  Level_range critical_values(const Cover_box& box) const { return Bspline_shells::critical_values(function(box)); }

  /// Returns `true` if all of a box is certainly in the shell.
  bool is_between_thresholds(const Cover_box& box) const
  {
    return m_examination.are_between_thresholds(functions_on(box));
  }

  /// Returns a lower bound, per user unit, of the length of the gradient in the shell, on the cover. The boxes with the
  /// least bounds are subdivided. This ends when their bounds are near the gradient in the middles of boxes, or at a
  /// limit.
  /// \pre no box of the cover is undecided
  template <typename ConcurrencyTag>
  double least_gradient() const
  {
    constexpr std::size_t chunk = 256, max_subdivisions = 2000, at_once = 16;
    constexpr double near = 0.7;
    std::vector<double> bounds(m_boxes.size(), std::numeric_limits<double>::infinity());
    internal::for_each_chunk<ConcurrencyTag>(m_boxes.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n)
        if(m_boxes[n].component != Cover_box::no_component)
          bounds[n] = gradient_bound({ m_boxes[n], functions_on(m_boxes[n]) });
    });
    struct Bounded_box
    {
      double bound;
      Cover_box box;
    };
    struct Bounded_part
    {
      Bounded_box bounded;
      double in_the_middle;
    };
    const auto is_above = [](const Bounded_box& a, const Bounded_box& b) { return a.bound > b.bound; };
    std::vector<Bounded_box> least; // a heap
    for(std::size_t n = 0; n < bounds.size(); ++n)
      if(bounds[n] < std::numeric_limits<double>::infinity()) least.push_back({ bounds[n], m_boxes[n] });
    if(least.empty()) return std::numeric_limits<double>::infinity();
    std::make_heap(least.begin(), least.end(), is_above);
    std::vector<Bounded_box> worst;
    double attained = gradient_in_the_middle({ least.front().box, functions_on(least.front().box) });
    for(std::size_t subdivisions = 0; subdivisions < max_subdivisions; subdivisions += worst.size()) {
      worst.clear();
      while(worst.size() < at_once && !least.empty() && least.front().bound < near * attained
            && least.front().box.depth < std::numeric_limits<std::uint16_t>::digits) {
        std::pop_heap(least.begin(), least.end(), is_above);
        worst.push_back(least.back());
        least.pop_back();
      }
      if(worst.empty()) break;
      const std::vector<Bounded_part> parts = internal::collect_from_chunks<ConcurrencyTag, Bounded_part>(
        worst.size(), 1, [&](std::size_t w, std::size_t, std::vector<Bounded_part>& found) {
          std::vector<Part> octants(1, Part{ worst[w].box, functions_on(worst[w].box) });
          push_octants(0, octants);
          for(std::size_t n = 1; n < octants.size(); ++n) {
            examine_part(octants[n]);
            if(octants[n].box.kind == Box_kind::EXCLUDED) continue;
            // The bound of a part may be weaker than the bound of its box.
            found.push_back({ { (std::max)(worst[w].bound, gradient_bound(octants[n])), octants[n].box },
                              gradient_in_the_middle(octants[n]) });
          }
        });
      for(const Bounded_part& part : parts) {
        attained = (std::min)(attained, part.in_the_middle);
        least.push_back(part.bounded);
        std::push_heap(least.begin(), least.end(), is_above);
      }
    }
    return least.empty() ? std::numeric_limits<double>::infinity() : least.front().bound;
  }

  /// Returns, for each leaf cell, a lower bound, per user unit, of the length of the gradient in the shell. It holds on
  /// the boxes of the cover in the cell, and is infinite if there are none. Bounds are coarser than `least_gradient()`.
  /// \pre no box of the cover is undecided
  template <typename ConcurrencyTag>
  std::vector<double> least_gradients() const
  {
    constexpr std::size_t chunk = 64;
    std::vector<double> bounds(m_first.size(), std::numeric_limits<double>::infinity());
    internal::for_each_chunk<ConcurrencyTag>(m_cells.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n)
        for(std::size_t b = m_cells[n].begin; b < m_cells[n].end; ++b)
          if(m_boxes[b].component != Cover_box::no_component) {
            double& bound = bounds[m_cells[n].cell];
            bound = (std::min)(bound, close_gradient_bound({ m_boxes[b], functions_on(m_boxes[b]) }, 0));
          }
    });
    return bounds;
  }

private:
  static constexpr std::size_t unseen = std::size_t(-1);
  static constexpr int max_depth_at_end = 4;

  typedef internal::Box_examination<Threshold> Examination;
  typedef typename Examination::Functions Functions;

  struct Part
  {
    Cover_box box;
    Functions functions;
  };
  // A direction to a face, an edge or a vertex of a cell or a box; components are -1, 0 or 1.
  typedef std::array<int, 3> Direction;
  struct Cell_boxes
  {
    std::uint32_t cell;
    std::size_t begin, end;
  };

  // A step of the flood from a box of the front, to a box that touches it and is not in the cover yet. If cells must be
  // subdivided first, the steps are these cells, and the box itself once more. Boxes at the end of the domain are
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

  void find_steps(Box_index b, std::vector<Flood_step>& steps) const
  {
    const Bbox_3 box = bbox(m_boxes[b]);
    const auto find_touching = [&](std::uint32_t c) {
      for_each_touching(c, box, [&](Box_index n) {
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
    m_field->visit_cells(box, [&](typename Field::Cell_index c) {
      if(m_first[c] == unseen) {
        if(complete) steps.resize(before);
        complete = false;
        steps.push_back({ Flood_step::UNSEEN_CELL, c });
      } else if(complete) find_touching(c);
    });
    if(!complete) steps.push_back({ Flood_step::WAITING_BOX, b });
    else if(m_boxes[b].is_at_end) steps.push_back({ Flood_step::BOX_AT_END, b });
  }

  static int octant(const Cover_box& box, int bit)
  {
    return ((box.position[0] >> bit) & 1) | ((box.position[1] >> bit) & 1) << 1 | ((box.position[2] >> bit) & 1) << 2;
  }

  // Returns true if the box has no point in common with the boundary of its cell.
  static bool is_inside_cell(const Cover_box& box)
  {
    const int last = (1 << box.depth) - 1;
    bool inside = true;
    for(int i : box.position) inside = inside && i > 0 && i < last;
    return inside;
  }

  static Bbox_3 grown(const Bbox_3& b)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return Bbox_3(std::nextafter(b.xmin(), -infinity), std::nextafter(b.ymin(), -infinity),
                  std::nextafter(b.zmin(), -infinity), std::nextafter(b.xmax(), infinity),
                  std::nextafter(b.ymax(), infinity), std::nextafter(b.zmax(), infinity));
  }

  // Appends the boxes of a cell in the order of a depth-first walk: boxes in an octant are consecutive. The queue is
  // scratch memory.
  void subdivide(std::uint32_t c, bool is_hopeless, std::vector<Part>& queue, std::vector<Cover_box>& boxes) const
  {
    const std::size_t most_boxes = is_hopeless ? max_boxes_of_a_hopeless_cell : max_boxes_of_a_cell;
    // Breadth first: if the number of boxes reaches its limit, they are of equal size.
    queue.resize(1);
    queue[0].box.cell = c;
    queue[0].box.depth = 0;
    queue[0].box.kind = Box_kind::UNDECIDED;
    queue[0].box.proof = {};
    for(int a = 0; a < 3; ++a) queue[0].box.position[a] = 0;
    queue[0].functions = m_examination.functions(m_field->cell(c), c);
    const std::size_t begin = boxes.size();
    const std::vector<Direction> ends = ends_of_domain(m_field->cell(c).bbox());
    for(std::size_t n = 0; n < queue.size(); ++n) {
      examine_part(queue[n]);
      Cover_box& box = queue[n].box;
      box.is_at_end = box.kind != Box_kind::EXCLUDED && !ends_in_shell(queue[n], ends).empty();
      const bool splits = box.kind == Box_kind::UNDECIDED
                            ? box.depth < max_depth
                                && !(is_hopeless && m_examination.seems_critical(queue[n].functions))
                            : (is_critical(box.kind) && box.depth < m_separating_depth)
                                // parts inside must be separated from parts outside
                                || (box.is_at_end && box.depth < max_depth_at_end);
      if(splits && queue.size() < most_boxes) push_octants(n, queue);
      else boxes.push_back(box);
    }
    std::sort(boxes.begin() + begin, boxes.end(),
              [](const Cover_box& a, const Cover_box& b) { return order(a) < order(b); });
  }

  // Returns the interleaved bits of the least corner.
  static std::uint32_t order(const Cover_box& box)
  {
    std::uint32_t key = 0;
    for(int bit = int(box.depth) - 1; bit >= 0; --bit) key = key << 3 | std::uint32_t(octant(box, bit));
    return key << (3 * (max_depth - int(box.depth)));
  }

  // Returns the directions from a cell in which the domain ends.
  std::vector<Direction> ends_of_domain(const Bbox_3& cell) const
  {
    std::vector<Direction> ends;
    const auto ignore = [](typename Field::Cell_index) {};
    const Bbox_3 around = grown(cell);
    if(m_field->visit_cells(around, ignore)) return ends;
    for(int k = -1; k <= 1; ++k)
      for(int j = -1; j <= 1; ++j)
        for(int i = -1; i <= 1; ++i) {
          const Direction direction = { i, j, k };
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

  Functions functions_on(const Cover_box& box) const
  {
    Functions on_box = m_examination.functions(m_field->cell(box.cell), box.cell);
    for(int bit = int(box.depth) - 1; bit >= 0; --bit)
      for(Enclosed_tricubic& f : on_box) f = restrict_to_octant(f, octant(box, bit));
    return on_box;
  }

  static bool is_critical(Box_kind kind)
  {
    return kind == Box_kind::CRITICAL_BELOW || kind == Box_kind::CRITICAL_ABOVE;
  }

  // Finds the kind of a part of a box. If it is undecided, the part keeps the kind and the proof of the box.
  void examine_part(Part& part) const
  {
    Cover_box box = part.box;
    m_examination.examine(part.functions, box);
    if(box.kind != Box_kind::UNDECIDED) part.box = box;
  }

  double width(const Cover_box& box) const { return std::ldexp(m_field->cell(box.cell).width(), -int(box.depth)); }

  // Returns a lower bound of the length of the gradient in the shell, on a box that is not undecided.
  double gradient_bound(const Part& part) const
  {
    const double bound = m_examination.gradient_bound(part.functions, part.box);
    // There are two quotients. The second one may overflow, and little is known about a quotient that is subnormal. The
    // length of the direction is an upper bound.
    const double slope = bound / width(part.box);
    if(!((std::min)(bound, slope) >= internal::underflow)) return 0;
    return (std::min)(slope, std::numeric_limits<double>::max()) * (1 - 4 * internal::rounding);
  }

  double gradient_in_the_middle(const Part& part) const
  {
    return m_examination.gradient_in_the_middle(part.functions) / width(part.box);
  }

  // Returns a closer lower bound: if the bound on a box is far from the gradient in its middle, the box is subdivided.
  double close_gradient_bound(const Part& part, int subdivisions) const
  {
    constexpr int max_subdivisions = 3;
    constexpr double near = 0.6;
    const double bound = gradient_bound(part);
    if(bound >= near * gradient_in_the_middle(part) || subdivisions == max_subdivisions
       || part.box.depth == std::numeric_limits<std::uint16_t>::digits)
      return bound;
    std::vector<Part> parts(1, part);
    push_octants(0, parts);
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t n = 1; n < parts.size(); ++n) {
      examine_part(parts[n]);
      if(parts[n].box.kind != Box_kind::EXCLUDED)
        least = (std::min)(least, close_gradient_bound(parts[n], subdivisions + 1));
    }
    return (std::max)(bound, least);
  }

  // Appends the octants of a part.
  static void push_octants(std::size_t n, std::vector<Part>& parts)
  {
    for(int o = 0; o < 8; ++o) {
      parts.emplace_back();
      const Part& part = parts[n];
      Part& child = parts.back();
      child.box = part.box;
      child.box.depth = std::uint8_t(part.box.depth + 1);
      for(int a = 0; a < 3; ++a) child.box.position[a] = std::uint16_t(2 * part.box.position[a] + ((o >> a) & 1));
      if(is_critical(part.box.kind))
        for(int a = 0; a < 3; ++a) child.box.proof[a] = 2 * part.box.proof[a] - ((o >> a) & 1);
      for(std::size_t m = 0; m < part.functions.size(); ++m)
        child.functions[m] = restrict_to_octant(part.functions[m], o);
    }
  }

  // Calls visit(box) for the boxes of a subdivided cell that have a point in common with the closed box.
  template <typename Visitor>
  void for_each_touching(std::uint32_t c, const Bbox_3& target, const Visitor& visit) const
  {
    const Cell_boxes& range = m_cells[m_first[c]];
    if(range.end - range.begin <= 8) {
      for(std::size_t b = range.begin; b < range.end; ++b)
        if(do_overlap(bbox(m_boxes[b]), target)) visit(b);
      return;
    }
    descend(range.begin, range.end, 0, target, visit);
  }

  // Visits the boxes [begin, end) that touch the target. They are the boxes of one part of a cell, of the given depth.
  template <typename Visitor>
  void descend(std::size_t begin, std::size_t end, int depth, const Bbox_3& target, const Visitor& visit) const
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
      descend(b, next, depth + 1, target, visit);
      b = next;
    }
  }

  const Field* m_field;
  Examination m_examination;
  int m_separating_depth;
  std::vector<std::size_t> m_first; // place of each leaf cell in m_cells, or unseen
  std::vector<Cell_boxes> m_cells;
  std::vector<Cover_box> m_boxes;
  std::vector<Box_index> m_at_end;
  std::size_t m_undecided = 0; // number of undecided boxes of the cover
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SHELL_COVER_3_H
