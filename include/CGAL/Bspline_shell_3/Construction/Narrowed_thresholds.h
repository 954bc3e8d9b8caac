// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Construction/Mesh_ranges.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_thresholds_3.h>
#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Field/is_same_in_cell.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Real_timer.h>
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
 * \brief a place where a shell may have a critical point, or reaches the end of the domain, and the mesh needs it to be in the shell.
 */
struct Threshold_obstacle
{
  std::uint32_t cell;
  std::array<double, 3> point;        ///< user units
};

/// \ingroup PkgBsplineShell3Construction
/// \return the cells of obstacles, ascending
inline std::vector<std::uint32_t> cells_of(const std::vector<Threshold_obstacle>& obstacles)
{
  std::vector<std::uint32_t> cells;
  for(const Threshold_obstacle& o : obstacles) cells.push_back(o.cell);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief when the search for thresholds ends although some could be narrowed further.
 */
struct Narrowing_limits
{
  int max_passes = 8;
  std::size_t many_obstacles = std::numeric_limits<std::size_t>::max();   ///< cells; with more of them, two passes are enough
  double max_seconds = std::numeric_limits<double>::infinity();           ///< ends before a pass would take longer
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief chooses the thresholds of a shell. Where it is undecided whether the shell has a critical point, or where it reaches the end of the domain,
 * the threshold next to that place is narrowed, as far as the mesh allows.
 *
 * Each pass covers the shell anew (`Shell_cover_3`), except in cells where field and thresholds have not changed. What is known is kept for further
 * fields, too: on the same cells (`field_has_changed()`), and on finer ones (`cells_were_refined()`).
 *
 * \tparam Field `Hierarchical_bspline_field_3`
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

  /// begins with thresholds as wide as asked for, but where earlier ones had to be narrower for the same field
  /// \param field as for `choose()`
  /// \param thickness asked for, a function of points, user units
  /// \pre `field` outlives the calls of `choose()` that follow
  template <typename Thickness>
  void begin(const Field& field, const Thickness& thickness)
  {
    m_field = &field;
    m_is_constant = false;
    m_wanted.emplace(field, thickness);
    for(const Cap& cap : m_caps) m_wanted->cap(cap);      // these would be found again
  }

  /// replaces what was asked for by the same two levels everywhere, which are not narrowed
  void set_constant(const Level_range& levels)
  {
    m_wanted->set_constant(levels);
    m_is_constant = true;
  }

  /// chooses thresholds for the present field
  /// \tparam ConcurrencyTag as for `bspline_shell_3()`; the result is the same
  /// \tparam Ranges a function of `Mesh_ranges::Precision`
  /// \param ranges encloses the field on the part of the mesh in each cell
  /// \return where the mesh needs them wider than they should be
  /// \pre `begin()` was called
  template <typename ConcurrencyTag, typename Ranges>
  std::vector<Threshold_obstacle> choose(const Ranges& ranges, const Narrowing_limits& limits)
  {
    constexpr int max_passes_of_many = 2; // where cells are to be refined in any case
    Real_timer timer;
    timer.start();
    // what the mesh needs counts where thresholds are capped
    bool is_sharp = !m_wanted->caps().empty();
    if(!m_is_constant) m_wanted->set_mesh_ranges(ranges(is_sharp ? Mesh_ranges::SHARP : Mesh_ranges::SUFFICIENT));
    for(int pass = 0; ; ++pass) {
      const double begin = timer.time();
      m_inner = std::make_unique<Threshold>(m_wanted->template threshold<ConcurrencyTag>(NEGATIVE));
      m_outer = std::make_unique<Threshold>(m_wanted->template threshold<ConcurrencyTag>(POSITIVE));
      Cover cover = covered<ConcurrencyTag>();
      std::vector<Threshold_obstacle> obstacles;
      const std::map<std::pair<Cell_index, int>, Nearest> nearest = nearest_in_the_way(cover, obstacles);
      if(!is_sharp && !nearest.empty() && !m_is_constant) {
        m_wanted->set_mesh_ranges(ranges(Mesh_ranges::SHARP));
        is_sharp = true;
      }
      const bool narrowed = narrow(nearest, obstacles);
      std::vector<Cell_index> now(m_field->number_of_cells());
      std::iota(now.begin(), now.end(), Cell_index(0));
      m_examined.emplace(Examined{ *m_inner, *m_outer, std::move(cover), std::move(now) });
      const bool is_enough = pass + 1 >= max_passes_of_many && cells_of(obstacles).size() > limits.many_obstacles;
      // another pass, and the certificate, take as long as this one
      const bool is_late = timer.time() + 2 * (timer.time() - begin) > limits.max_seconds;
      if(!narrowed || is_enough || pass + 1 == limits.max_passes || is_late) {
        m_caps = m_wanted->caps();
        return obstacles;
      }
    }
  }

  /// whether the last call of `choose()` was for the present field
  bool are_chosen() const { return bool(m_inner); }

  /// \pre `are_chosen()`
  const Threshold& inner() const { return *m_inner; }
  /// \pre `are_chosen()`
  const Threshold& outer() const { return *m_outer; }

  /// of the boxes where the last `choose()` left undecided whether the shell has a critical point, and of those at the end of the domain; infinite
  /// before the first one
  double undecided_volume() const { return m_undecided_volume; }

  /// leaves nothing chosen
  void reset() { m_inner.reset(); m_outer.reset(); }

  /// forgets what is kept from field to field
  void forget()
  {
    m_examined.reset();
    m_caps.clear();
  }

  /// forgets which parts of the shell were covered, and by that frees memory
  void forget_cover() { m_examined.reset(); }

  /// is to be called when the field is another one on the same cells, with those where it is
  void field_has_changed(const std::vector<char>& changed)
  {
    reset();
    if(!m_examined) return;
    for(Cell_index& c : m_examined->now)
      if(c != Field::npos && changed[c]) c = Field::npos;
  }

  /// is to be called when the field is another one on finer cells, with the number that each cell has there, or `Field::npos` where it is split,
  /// or the field is another one
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

  // The last cover and its thresholds; which of the present cells each of its cells is, or npos where the field has changed since then: most stay as
  // they are.
  struct Examined
  {
    Threshold inner, outer;
    Cover cover;
    std::vector<Cell_index> now;
  };

  // how near to the mesh's level a box comes that is in the way
  struct Nearest { double size; std::array<double, 3> point; };

  template <typename ConcurrencyTag>
  Cover covered() const
  {
    Cover cover(*m_field, *m_inner, *m_outer);
    if(m_examined)
      cover.reuse(m_examined->cover, [&](Cell_index c) {
        const Cell_index now = m_examined->now[c];
        return now != Field::npos && is_same_in_cell(m_examined->inner.field(), c, m_inner->field(), now)
            && is_same_in_cell(m_examined->outer.field(), c, m_outer->field(), now) ? now : Field::npos;
      });
    for(std::size_t c = 0; c < m_seeds.size(); ++c) cover.template flood<ConcurrencyTag>(m_seeds[c], std::uint32_t(c));
    return cover;
  }

  // in each cell and on either side; boxes that the field may be zero in are obstacles
  std::map<std::pair<Cell_index, int>, Nearest> nearest_in_the_way(const Cover& cover, std::vector<Threshold_obstacle>& obstacles)
  {
    std::map<std::pair<Cell_index, int>, Nearest> nearest;
    m_undecided_volume = 0;
    const auto note = [&](const Cover_box& box) {
      m_undecided_volume += std::pow(std::ldexp(m_field->cells().width(box.cell), -int(box.depth)), 3);
      const Level_range f = cover.function(box).range();
      const Bbox_3 b = cover.bbox(box);
      const std::array<double, 3> middle = { (b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2 };
      const int side = f.min > 0 ? 1 : f.max < 0 ? -1 : 0;
      if(side == 0) { obstacles.push_back({ box.cell, middle }); return; }
      const double size = side > 0 ? f.min : -f.max;
      const auto it = nearest.insert({ { box.cell, side }, { size, middle } }).first;
      if(size < it->second.size) it->second = { size, middle };
    };
    if(cover.number_of_undecided_boxes() > 0)
      for(const Cover_box& box : cover.boxes())
        if(box.component != Cover_box::no_component && box.kind == Box_kind::UNDECIDED) note(box);
    for(std::uint32_t b : cover.border()) note(cover.boxes()[b]);
    return nearest;
  }

  // caps thresholds halfway between what is in the way and what the mesh needs, if these are apart; returns whether there was such a place
  bool narrow(const std::map<std::pair<Cell_index, int>, Nearest>& nearest, std::vector<Threshold_obstacle>& obstacles)
  {
    constexpr double margin = 0.98;       // of a cap that makes a difference
    bool narrowed = false;
    for(const auto& n : nearest) {
      const Cell_index c = n.first.first;
      const int side = n.first.second;
      const double size = n.second.size, needed = side * m_wanted->needed(c, Sign(side));
      if(m_is_constant || !(needed < margin * size)) { obstacles.push_back({ c, n.second.point }); continue; }
      m_wanted->cap(c, Sign(side), side * ((std::max)(needed, 0.) + size) / 2);
      narrowed = true;
    }
    return narrowed;
  }

  std::vector<Point_3> m_seeds;
  const Field* m_field = nullptr;
  std::optional<Shell_thresholds_3<Field> > m_wanted;
  bool m_is_constant = false;
  std::vector<Cap> m_caps;                            // of the last thresholds
  std::unique_ptr<Threshold> m_inner, m_outer;        // at fixed places, as certificates refer to them
  std::optional<Examined> m_examined;
  double m_undecided_volume = std::numeric_limits<double>::infinity();
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_NARROWED_THRESHOLDS_H
