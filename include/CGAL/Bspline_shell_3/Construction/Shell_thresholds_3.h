// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_THRESHOLDS_3_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_THRESHOLDS_3_H

#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/enum.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief thresholds of a shell that vary in space: minus and plus half the requested thickness, closer to zero where
 * required, but never closer than the values of the field on the mesh.
 *
 * A threshold is a spline on the cells of the field. If all coefficients that act on a cell lie beyond the values of
 * the field on the mesh in that cell, so does the threshold; the mesh *requires* this bound on the coefficients. A
 * *cap* keeps the threshold below a value in a cell; from there, the threshold rises with a bounded slope.
 */
template <typename Field>
class Shell_thresholds_3
{
  typedef typename Field::Cell_index Index;
public:
  /// \param field the field; its values are not used
  /// \param thickness the requested thickness as a function of points, in the units of the coordinates
  /// \param slope slope of a threshold around a cap; less than the slope of the field, which is about one
  /// \pre `field` outlives this object
  template <typename Thickness>
  Shell_thresholds_3(const Field& field, const Thickness& thickness, double slope = 0.2)
    : m_field(&field), m_slope(slope)
  {
    const Eigen::Index size = Eigen::Index(field.number_of_coefficients());
    m_cap[0].resize(size);
    for(Eigen::Index u = 0; u < size; ++u) {
      const Bbox_3 b = field.support(Index(u));
      m_cap[0][u] = thickness(typename Field::Point_3((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2,
                                                      (b.zmin() + b.zmax()) / 2))
                    / 2;
    }
    m_cap[1] = m_cap[0];
    m_highest = size > 0 ? m_cap[0].maxCoeff() : 0;
    for(Eigen::VectorXd& needed : m_needed) needed.setConstant(size, -std::numeric_limits<double>::infinity());
  }

  /// sets the values that the mesh requires
  /// \param mesh_ranges enclosures of the field on the part of the mesh in each cell (`Facet_ranges::cell`)
  void set_mesh_ranges(const std::vector<Level_range>& mesh_ranges)
  {
    constexpr double none = -std::numeric_limits<double>::infinity();
    typedef std::array<double, 2> Pair;
    std::vector<Pair> at_points(m_field->number_of_points(), Pair{ none, none });
    const auto include = [](Pair& p, const Pair& q) {
      for(int side = 0; side < 2; ++side) p[side] = (std::max)(p[side], q[side]);
    };
    for(Index c = 0; c < m_field->number_of_cells(); ++c) {
      const Level_range& range = mesh_ranges[c];
      if(!(range.min <= range.max)) continue;
      for(Index row : m_field->coefficient_rows(c))
        for(Index n = row; n < row + 4; ++n) include(at_points[n], { -range.min, range.max });
    }
    // Points without a coefficient pass their requirements on to the coefficients on which they depend.
    std::vector<Pair> needed(m_field->number_of_coefficients(), Pair{ none, none });
    for(int level = 0; level < m_field->number_of_levels(); ++level)
      for(Index n = 0; n < m_field->points(level).size(); ++n) {
        const Index point = m_field->first_point(level) + n, u = m_field->coefficient_of_point(point);
        if(at_points[point][0] == none) continue;
        if(u != Field::npos) include(needed[u], at_points[point]);
        else
          m_field->visit_parents(level, m_field->points(level).point(n),
                                 [&](Index parent, double) { include(needed[parent], at_points[point]); });
      }
    for(std::size_t u = 0; u < needed.size(); ++u)
      for(int side = 0; side < 2; ++side) m_needed[side][Eigen::Index(u)] = needed[u][side];
  }

  /// sets the two thresholds to constants
  void set_constant(const Level_range& levels)
  {
    for(int side = 0; side < 2; ++side) {
      m_needed[side].setConstant(side == 0 ? -levels.min : levels.max);
      m_cap[side] = m_needed[side];
    }
  }

  /// returns the value that the mesh requires in a cell: a lower bound on the outer threshold, or an upper bound on the
  /// inner threshold
  double needed(Index cell, Sign side) const
  {
    double most = -std::numeric_limits<double>::infinity();
    m_field->visit_coefficients(cell,
                                [&](int, Index u, double) { most = (std::max)(most, m_needed[number(side)][u]); });
    return side == POSITIVE ? most : -most;
  }

  /// a bound on a threshold near a cell
  struct Cap
  {
    Index cell;
    Sign side;
    Bbox_3 core; ///< box of the centers of all functions that act on the cell
    double size; ///< bound on the absolute value of the threshold there
  };

  /// bounds the outer threshold in a cell from above by `level`, or the inner threshold from below, as far as the mesh
  /// permits
  void cap(Index cell, Sign side, double level)
  {
    // Distances are measured from the centers of functions of all sizes to the box of the centers of all functions that
    // act on the cell.
    Bbox_3 core = m_field->cell(cell).bbox();
    m_field->visit_coefficients(cell, [&](int, Index u, double) {
      const Bbox_3 s = m_field->support(u);
      const double x = (s.xmin() + s.xmax()) / 2, y = (s.ymin() + s.ymax()) / 2, z = (s.zmin() + s.zmax()) / 2;
      core += Bbox_3(x, y, z, x, y, z);
    });
    cap(Cap{ cell, side, core, side == POSITIVE ? level : -level });
  }

  /// adds a cap, for example of thresholds on other cells; takes time linear in the number of functions near it
  void cap(const Cap& cap)
  {
    const double reach = (m_highest - cap.size) / m_slope;
    if(!(reach > 0)) return;
    const Bbox_3& core = cap.core;
    Eigen::VectorXd& caps = m_cap[number(cap.side)];
    m_field->visit_coefficients_near(
      Bbox_3(core.xmin() - reach, core.ymin() - reach, core.zmin() - reach, core.xmax() + reach, core.ymax() + reach,
             core.zmax() + reach),
      [&](Index u, const Bbox_3& support) {
        double squared = 0;
        for(int a = 0; a < 3; ++a) {
          const double center = ((support.min)(a) + (support.max)(a)) / 2;
          const double gap = (std::max)({ 0., center - (core.max)(a), (core.min)(a)-center });
          squared += gap * gap;
        }
        caps[u] = (std::min)(caps[u], cap.size + m_slope * std::sqrt(squared));
      });
    m_caps.push_back(cap);
  }

  /// returns all caps so far
  const std::vector<Cap>& caps() const { return m_caps; }

  /// returns the inner (`NEGATIVE`) or the outer (`POSITIVE`) threshold
  /// \param similar a function on the cells of the field, of which the parts that are equal are copied
  template <typename ConcurrencyTag>
  Field threshold(Sign side, const Field& similar) const
  {
    Eigen::VectorXd x = m_needed[number(side)].cwiseMax(m_cap[number(side)]);
    if(side == NEGATIVE) x = -x;
    return similar.template with_coefficients<ConcurrencyTag>(std::move(x));
  }
  /// returns the same threshold, without copies
  template <typename ConcurrencyTag>
  Field threshold(Sign side) const
  {
    return threshold<ConcurrencyTag>(side, *m_field);
  }

private:
  static int number(Sign side) { return side == POSITIVE ? 1 : 0; }

  const Field* m_field;
  double m_slope, m_highest = 0;
  std::vector<Cap> m_caps;
  // by coefficient: first of the negated inner threshold, then of the outer threshold
  std::array<Eigen::VectorXd, 2> m_needed, m_cap;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SHELL_THRESHOLDS_3_H
