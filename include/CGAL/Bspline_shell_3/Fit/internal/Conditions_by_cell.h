// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDITIONS_BY_CELL_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDITIONS_BY_CELL_H

#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Fit/internal/basis_rows.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// the 64 coefficients that act on a cell, or their changes, in units of the width of root cells
typedef std::array<double, 64> Local_coefficients;

// A condition bounds three numbers from below: the slope, the value, and minus the value. Its slacks are these numbers
// minus their bounds.
typedef std::array<double, 3> Condition_numbers;

inline Condition_numbers bounds(const Slope_condition& condition)
{
  return { condition.least, -condition.largest, -condition.largest };
}

// Conditions on a field in its leaf cells, the field's coefficients, and the slacks. Concurrent calls must be for cells
// without common coefficients.
template <typename Field>
class Conditions_by_cell
{
  typedef typename Field::Cell_index Index;

public:
  // pre: `field` outlives this object; its coefficients are not used
  explicit Conditions_by_cell(const Field& field)
    : m_field(field), m_conditions(field.number_of_cells()), m_least_slack(field.number_of_cells(), unknown)
  {}

  // Adds conditions. The coefficients must then be set again.
  void insert(const std::vector<Slope_condition>& conditions)
  {
    for(const Slope_condition& c : conditions) {
      m_conditions[c.cell].push_back(c);
      m_least_slack[c.cell] = unknown;
    }
    m_points.resize(0);
  }

  // Sets the free coefficients if they must be set.
  template <typename ConcurrencyTag>
  void set_coefficients(const Eigen::VectorXd& x)
  {
    if(m_points.size() == 0) m_points = m_field.template extend<ConcurrencyTag>(x);
  }

  // Changes the coefficients that act on cells by `cell.change(step)`. Cells share coefficients: all are read before
  // any is written.
  template <typename Cells>
  void change_coefficients(const Cells& cells, const Eigen::VectorXd& step)
  {
    std::vector<std::pair<Index, double> > moved;
    for(const auto& cell : cells) {
      m_least_slack[cell.cell] = unknown;
      const std::array<Index, 16> rows = m_field.coefficient_rows(cell.cell);
      const Local_coefficients change = cell.change(step);
      for(int n = 0; n < 64; ++n) {
        const Index point = rows[n / 4] + n % 4;
        if(change[n] != 0) moved.emplace_back(point, m_points[point] + change[n]);
      }
    }
    for(const auto& [point, value] : moved) m_points[point] = value;
  }

  const std::vector<Slope_condition>& in_cell(Index c) const { return m_conditions[c]; }

  // Returns the slacks of the conditions in a cell.
  std::vector<Condition_numbers> slacks(Index c) const
  {
    std::vector<Condition_numbers> slacks;
    if(m_conditions[c].empty()) return slacks;
    const std::array<Index, 16> rows = m_field.coefficient_rows(c);
    Local_coefficients local;
    for(int n = 0; n < 64; ++n) local[n] = m_points[rows[n / 4] + n % 4];
    for(const Slope_condition& condition : m_conditions[c]) {
      const Condition_numbers least = bounds(condition);
      slacks.push_back(numbers(condition, local));
      for(std::size_t k = 0; k < least.size(); ++k) slacks.back()[k] -= least[k];
    }
    return slacks;
  }

  // Returns the least slack in a cell; infinite if there are no conditions. It is cached.
  double least_slack(Index c)
  {
    if(std::isnan(m_least_slack[c])) m_least_slack[c] = find_worst(c).first;
    return m_least_slack[c];
  }

  // Returns the first condition in a cell that has the least slack.
  const Slope_condition& worst(Index c) const { return m_conditions[c][find_worst(c).second]; }

  // Returns the numbers of a condition, which are linear in the coefficients.
  Condition_numbers numbers(const Slope_condition& condition, const Local_coefficients& local) const
  {
    const First_order_jet<double> jet = first_order_jet<double>(local.data(), first_order_basis(condition.position));
    return { scale(condition.cell) * dot(jet.gradient, condition.direction), jet.value, -jet.value };
  }

  // Returns the derivative of such a number by the coefficients.
  Local_vector row(const Slope_condition& condition, std::size_t number) const
  {
    const Basis_jet<double, 2> basis = first_order_basis(condition.position);
    if(number == 0) return scale(condition.cell) * directional_row(basis, condition.direction);
    return (number == 1 ? 1. : -1.) * outer(basis[0][0], basis[0][1], basis[0][2]);
  }

  // Bounds the absolute values of the numbers of any condition in a cell. Values lie in the convex hull of the
  // coefficients, and first derivatives in that of their differences.
  Condition_numbers largest_numbers(Index c, const Local_coefficients& local) const
  {
    const std::array<Level_range, 3> d = difference_ranges(local.data());
    const std::array<double, 3> steepest = { d[0].largest_size(), d[1].largest_size(), d[2].largest_size() };
    const double value = largest_size(local);
    return { scale(c) * norm(steepest), value, value };
  }

private:
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  // Returns root cells per cell width.
  double scale(Index c) const { return double(1 << m_field.cells().level(c)); }

  // Returns the least slack in a cell, and the first condition that has it.
  std::pair<double, std::size_t> find_worst(Index c) const
  {
    std::pair<double, std::size_t> worst(std::numeric_limits<double>::infinity(), 0);
    const std::vector<Condition_numbers> slacks = this->slacks(c);
    for(std::size_t n = 0; n < slacks.size(); ++n)
      for(double slack : slacks[n])
        if(slack < worst.first) worst = { slack, n };
    return worst;
  }

  const Field& m_field;
  std::vector<std::vector<Slope_condition> > m_conditions; // by cell
  std::vector<double> m_least_slack;                       // by cell
  Eigen::VectorXd m_points;                                // coefficients at all points; empty if they must be set
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDITIONS_BY_CELL_H
