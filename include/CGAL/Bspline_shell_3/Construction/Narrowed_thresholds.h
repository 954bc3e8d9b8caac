// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_thresholds_3.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_obstacle.h>
#include <CGAL/Bspline_shell_3/Construction/Threshold_tuning.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/critical_values.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief limits of the search for thresholds, which end it even if some thresholds could be narrowed further.
 */
struct Narrowing_limits
{
  int max_passes = 8;
  /// number of cells with obstacles above which the search ends after `Threshold_tuning::max_passes_of_many` passes
  std::size_t many_obstacles = std::numeric_limits<std::size_t>::max();
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief chooses the thresholds of a shell. They are narrowed, that is, moved toward zero, where the shell may have a
 * critical point, and where it reaches the boundary of the domain. The values of the field on the mesh limit this.
 *
 * Critical values in undecided boxes determine how far to narrow (`critical_values()`). Thin walls
 * contain many critical points, and covering a cell there may take more boxes than the cover allows. If the threshold
 * is already close enough to zero, only a finer cover can decide.
 *
 * Each pass covers the shell anew (`Shell_cover_3`), except in cells where field and thresholds have not changed.
 * Results are also kept for later fields, on the same cells (`field_has_changed()`) and on finer cells
 * (`cells_were_refined()`). `forget_field()` keeps only the caps, which are upper bounds on the absolute values of
 * thresholds.
 */
template <typename Field>
class Narrowed_thresholds
{
public:
  typedef typename Field::Cell_index Cell_index;
  typedef typename Field::Point_3 Point_3;
  typedef Spline_threshold<Field> Threshold;

  /// \param seeds a point on each component of the mesh
  explicit Narrowed_thresholds(std::vector<Point_3> seeds) : m_seeds(std::move(seeds)) {}

  /// starts with thresholds for the requested thickness, except where earlier thresholds had to be narrower
  /// \param field as for `choose()`
  /// \param thickness the requested thickness as a function of points, in the units of the coordinates
  /// \pre `field` outlives the calls of `choose()` that follow
  template <typename Thickness>
  void begin(const Field& field, const Thickness& thickness)
  {
    m_field = &field;
    m_is_constant = false;
    m_thresholds.emplace(field, thickness);
    for(const Cap& cap : m_caps) m_thresholds->cap(cap); // otherwise, they would be found again
  }

  /// replaces the requested thresholds by two constant thresholds, which are not narrowed
  void set_constant(const Level_range& levels)
  {
    m_thresholds->set_constant(levels);
    m_is_constant = true;
  }

  /// chooses thresholds for the current field
  /// \tparam Ranges a function of `Mesh_ranges::Precision`
  /// \param ranges returns enclosures of the field on the part of the mesh in each cell
  /// \return the places where |f| on the mesh is too large for thresholds that exclude the obstacles; if there are
  ///   none, the places where only a finer cover can decide
  /// \pre `begin()` was called
  template <typename ConcurrencyTag, typename Ranges>
  std::vector<Threshold_obstacle> choose(const Ranges& ranges, const Narrowing_limits& limits)
  {
    CGAL_precondition(m_thresholds.has_value());
    // The ranges on the mesh limit the caps, and must therefore be sharp.
    bool is_sharp = !m_thresholds->caps().empty();
    m_tight.clear();
    if(!m_is_constant) m_thresholds->set_mesh_ranges(ranges(is_sharp ? Mesh_ranges::SHARP : Mesh_ranges::SUFFICIENT));
    std::size_t unresolved_before = std::numeric_limits<std::size_t>::max();
    for(int pass = 0;; ++pass) {
      const bool are_similar = m_examined && m_examined->inner.field().has_cells_of(*m_field);
      const Field &inner = are_similar ? m_examined->inner.field() : *m_field,
                  &outer = are_similar ? m_examined->outer.field() : *m_field;
      m_inner = std::make_unique<Threshold>(m_thresholds->template threshold<ConcurrencyTag>(NEGATIVE, inner));
      m_outer = std::make_unique<Threshold>(m_thresholds->template threshold<ConcurrencyTag>(POSITIVE, outer));
      Cover cover = covered<ConcurrencyTag>();
      std::vector<Threshold_obstacle> obstacles;
      const std::map<Cell_and_side, Nearest> nearest = nearest_in_the_way(cover, obstacles);
      if(!is_sharp && !nearest.empty() && !m_is_constant) {
        m_thresholds->set_mesh_ranges(ranges(Mesh_ranges::SHARP));
        is_sharp = true;
      }
      std::vector<Threshold_obstacle> unresolved;
      const std::vector<Threshold_obstacle> narrowed = narrow(nearest, obstacles, unresolved);
      std::vector<Cell_index> now(m_field->number_of_cells());
      std::iota(now.begin(), now.end(), Cell_index(0));
      // Cover these cells again, possibly with more boxes.
      for(const Threshold_obstacle& u : unresolved) now[u.cell] = Field::npos;
      m_examined.emplace(Examined{ *m_inner, *m_outer, std::move(cover), std::move(now) });
      const bool is_enough = pass + 1 >= threshold_tuning.max_passes_of_many && !obstacles.empty()
                             && (std::max)(cells_of(obstacles).size(), unresolved.size()) > limits.many_obstacles;
      const bool helps = !narrowed.empty()
                         || (obstacles.empty() && !unresolved.empty() && unresolved.size() < unresolved_before);
      unresolved_before = unresolved.size();
      if(!helps || is_enough || pass + 1 == limits.max_passes) {
        m_caps = m_thresholds->caps();
        if(!obstacles.empty()) return obstacles;
        return unresolved.empty() && pass + 1 == limits.max_passes ? narrowed : unresolved;
      }
    }
  }

  /// returns the places where a pass of the last call of `choose()` found little or no room
  std::vector<Threshold_obstacle> narrow_places() const
  {
    std::vector<Threshold_obstacle> places;
    for(const auto& tight : m_tight) places.push_back(tight.second);
    return places;
  }

  /// returns whether thresholds were chosen for the current field
  bool are_chosen() const { return bool(m_inner); }

  /// \pre `are_chosen()`
  const Threshold& inner() const
  {
    CGAL_precondition(are_chosen());
    return *m_inner;
  }
  /// \pre `are_chosen()`
  const Threshold& outer() const
  {
    CGAL_precondition(are_chosen());
    return *m_outer;
  }

  /// returns the total volume of the boxes in which the last call of `choose()` left critical points undecided, and of
  /// the boxes at the boundary of the domain; infinite before the first call
  double undecided_volume() const { return m_undecided_volume; }

  /// discards the chosen thresholds
  void reset()
  {
    m_inner.reset();
    m_outer.reset();
  }

  /// discards all data that is kept for later fields
  void forget()
  {
    m_examined.reset();
    m_caps.clear();
  }

  /// discards the cover, and keeps the caps for another field on finer cells. Caps are scaled by the ratio of the old
  /// to the new cell width, because |f| within a thin wall is larger on narrower cells.
  void forget_field(const Cell_hierarchy_3& before, const Cell_hierarchy_3& cells)
  {
    reset();
    m_examined.reset();
    std::map<Cell_and_side, Cap> least;
    for(Cap cap : m_caps) {
      const std::array<double, 3> corner = before.corner(cap.cell);
      const double width = before.width(cap.cell), half = width / 2;
      cap.cell = cells.locate(Point_3(corner[0] + half, corner[1] + half, corner[2] + half));
      cap.size *= width / cells.width(cap.cell);
      const auto it = least.insert({ { cap.cell, cap.side }, cap }).first;
      if(cap.size < it->second.size) it->second = cap;
    }
    m_caps.clear();
    for(const auto& cap : least) m_caps.push_back(cap.second);
  }

  /// discards the cover, which frees memory
  void forget_cover() { m_examined.reset(); }

  /// discards outdated parts of the cover after a change of the field on the same cells; `changed` marks the cells
  /// where it differs
  void field_has_changed(const std::vector<char>& changed)
  {
    reset();
    if(!m_examined) return;
    for(Cell_index& c : m_examined->now)
      if(c != Field::npos && changed[c]) c = Field::npos;
  }

  /// discards outdated data after a change to finer cells; `now` is the new index of each cell, or `Field::npos` if the
  /// cell was split or the field has changed in it
  void cells_were_refined(const std::vector<Cell_index>& now)
  {
    reset();
    if(m_examined)
      for(Cell_index& c : m_examined->now)
        if(c != Field::npos) c = now[c];
    std::vector<Cap> caps;
    for(Cap cap : m_caps) {
      cap.cell = now[cap.cell];
      if(cap.cell != Field::npos) caps.push_back(cap);
    }
    m_caps.swap(caps);
  }

private:
  typedef Shell_cover_3<Field, Threshold> Cover;
  typedef typename Shell_thresholds_3<Field>::Cap Cap;
  typedef std::pair<Cell_index, int> Cell_and_side;

  // The last cover and its thresholds. `now` is the current index of each of its cells, or npos where the field has
  // changed since then.
  struct Examined
  {
    Threshold inner, outer;
    Cover cover;
    std::vector<Cell_index> now;
  };

  // The obstructing box with the values closest to zero, and whether the cover is too coarse there.
  struct Nearest
  {
    double size;
    std::array<double, 3> point;
    bool is_coarse;
  };

  template <typename ConcurrencyTag>
  Cover covered() const
  {
    constexpr int separating_depth = 0; // only critical points matter here
    Cover cover(*m_field, *m_inner, *m_outer, separating_depth);
    if(m_examined) {
      constexpr std::size_t chunk = 256;
      std::vector<Cell_index> same = m_examined->now;
      internal::for_each_chunk<ConcurrencyTag>(same.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for(std::size_t n = begin; n < end; ++n) {
          const Cell_index c = Cell_index(n), now = same[c];
          if(now != Field::npos
             && !(is_same_in_cell(m_examined->inner.field(), c, m_inner->field(), now)
                  && is_same_in_cell(m_examined->outer.field(), c, m_outer->field(), now)))
            same[c] = Field::npos;
        }
      });
      cover.reuse(m_examined->cover, [&](Cell_index c) { return same[c]; });
    }
    for(std::size_t c = 0; c < m_seeds.size(); ++c) cover.template flood<ConcurrencyTag>(m_seeds[c], std::uint32_t(c));
    return cover;
  }

  // Returns the obstruction closest to zero in each cell, on each side of zero. Boxes in which the field may be zero
  // are added to the obstacles.
  std::map<Cell_and_side, Nearest> nearest_in_the_way(const Cover& cover, std::vector<Threshold_obstacle>& obstacles)
  {
    std::map<Cell_and_side, Nearest> nearest;
    m_undecided_volume = 0;
    const auto note = [&](const Cover_box& box, const Level_range& f) {
      m_undecided_volume += std::pow(std::ldexp(m_field->cells().width(box.cell), -int(box.depth)), 3);
      const Bbox_3 b = cover.bbox(box);
      const std::array<double, 3> middle = { (b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2,
                                             (b.zmin() + b.zmax()) / 2 };
      const double level = f.min > 0 ? f.min : f.max < 0 ? f.max : 0;
      if(level == 0) {
        obstacles.push_back({ box.cell, middle });
        return;
      }
      const Nearest place = { std::abs(level), middle, int(box.depth) <= threshold_tuning.coarse_depth };
      const auto it = nearest.insert({ { box.cell, level > 0 ? 1 : -1 }, place }).first;
      if(place.size < it->second.size) it->second = place;
    };
    if(cover.number_of_undecided_boxes() > 0)
      for(const Cover_box& box : cover.boxes())
        if(box.component != Cover_box::no_component && box.kind == Box_kind::UNDECIDED) {
          internal::Run::poll();
          // If only the threshold is too steep, a critical point need not exist, and the critical values may lie on the
          // other side of zero. In this case, the range of the field is used.
          const Enclosed_tricubic f = cover.function(box);
          const Level_range values = critical_values(f), field = f.range();
          const bool is_beyond_zero = (field.min > 0 && values.max < 0) || (field.max < 0 && values.min > 0);
          note(box, is_beyond_zero ? field : values);
        }
    for(std::size_t b : cover.at_end()) note(cover.boxes()[b], cover.range_at_end(cover.boxes()[b]));
    return nearest;
  }

  // Caps each threshold halfway between the obstruction and the value that the mesh requires, if there is room, and
  // returns these places. If a cap would not narrow the threshold and the cover is coarse, the place is unresolved.
  std::vector<Threshold_obstacle> narrow(const std::map<Cell_and_side, Nearest>& nearest,
                                         std::vector<Threshold_obstacle>& obstacles,
                                         std::vector<Threshold_obstacle>& unresolved)
  {
    const double margin = threshold_tuning.useful_cap;
    std::vector<Threshold_obstacle> narrowed;
    for(const auto& n : nearest) {
      const Cell_index c = n.first.first;
      const Sign side = Sign(n.first.second);
      const double size = n.second.size, needed = (std::max)(side * m_thresholds->needed(c, side), 0.);
      const Threshold_obstacle place = { c, n.second.point, side, size };
      if(needed > threshold_tuning.tight * size) m_tight[n.first] = place;
      const Threshold& threshold = side == POSITIVE ? *m_outer : *m_inner;
      const double now = side * threshold.value(Point_3(place.point[0], place.point[1], place.point[2]), c);
      const double room = n.second.is_coarse ? size : (std::min)(size, now);
      if(m_is_constant || !(needed < margin * room)) {
        obstacles.push_back(place);
      } else if(n.second.is_coarse && margin * now < (needed + room) / 2) {
        unresolved.push_back(place);
      } else {
        m_thresholds->cap(c, side, side * (needed + room) / 2);
        narrowed.push_back(place);
      }
    }
    return narrowed;
  }

  std::vector<Point_3> m_seeds;
  const Field* m_field = nullptr;
  std::optional<Shell_thresholds_3<Field> > m_thresholds;
  bool m_is_constant = false;
  std::vector<Cap> m_caps;                     // caps of the last thresholds
  std::unique_ptr<Threshold> m_inner, m_outer; // certificates refer to them
  std::optional<Examined> m_examined;
  std::map<Cell_and_side, Threshold_obstacle> m_tight;
  double m_undecided_volume = std::numeric_limits<double>::infinity();
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H
