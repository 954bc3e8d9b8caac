// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SLOPE_PATCH_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SLOPE_PATCH_H

#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Conditions_by_cell.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Elastic_program.h>
#include <CGAL/Bspline_shell_3/Fit/internal/basis_rows.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The unknowns around a cell: the coefficients that act on the cell and its neighbors or, if these are too many, on the
// cell alone. Their best step minimizes an energy x^T A x - 2 b^T x under the conditions in the cells that it changes.
template <typename Field>
class Slope_patch
{
  typedef typename Field::Cell_index Index;
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;
  typedef Conditions_by_cell<Field> Conditions;

public:
  // pre: `field` and `A`, the lower triangle, outlive this object
  Slope_patch(const Field& field, const Matrix& A, Index center) : m_field(&field), m_A(&A), m_center(center)
  {
    const Bbox_3 b = field.cell(center).bbox();
    const double margin = 0.5 * field.cells().width(center);
    m_reach = Bbox_3(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin, b.ymax() + margin,
                     b.zmax() + margin);
    const auto free_coefficients = [&](Index c) {
      field.visit_coefficients(c, [&](int, Index u, double) {
        const bool has_equation = A.outerIndexPtr()[u] != A.outerIndexPtr()[u + 1];
        if(has_equation) m_unknowns.push_back(u);
      });
    };
    field.visit_cells(m_reach, free_coefficients);
    sort_unique(m_unknowns);
    if(m_unknowns.size() > slope_tuning.max_unknowns) {
      m_unknowns.clear();
      free_coefficients(center);
      sort_unique(m_unknowns);
    }
    for(Index u : m_unknowns) m_reach += field.support(u);
  }

  Index center() const { return m_center; }
  // Returns the bounding box of the supports of the unknowns' functions. Patches with disjoint reaches can be solved
  // concurrently, as cells lie in the supports of the functions that act on them.
  const Bbox_3& reach() const { return m_reach; }

  // Finds the best step, and changes the coefficients of the conditions by it.
  template <typename ConcurrencyTag>
  void solve(const Vector& b, const Vector& x, Conditions& conditions)
  {
    if(m_unknowns.empty()) return;
    m_places.assign(m_unknowns.back() - m_unknowns.front() + 1, -1);
    for(std::size_t n = 0; n < m_unknowns.size(); ++n) m_places[m_unknowns[n] - m_unknowns.front()] = int(n);
    Eigen::MatrixXd H;
    Vector r;
    assemble(b, x, H, r);
    const Eigen::LLT<Eigen::MatrixXd> factor(H);
    if(factor.info() != Eigen::Success) return;
    find_cells(conditions);
    Elastic_program program(factor, r);
    constexpr std::size_t chunk = 8; // cells per task
    // The program begins without conditions. Those that its solution violates are added until there are none.
    for(int exchange = 0; exchange < slope_tuning.max_exchanges; ++exchange) {
      std::vector<Violation> violated = collect_from_chunks<ConcurrencyTag, Violation>(
        m_cells.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Violation>& found) {
          for(std::size_t c = begin; c < end; ++c) find_violations(m_cells[c], program.step(), conditions, found);
        });
      const std::size_t more = (std::min)(
        { violated.size(), slope_tuning.max_rows - program.number_of_rows(), slope_tuning.max_new_rows });
      if(more == 0) break;
      std::partial_sort(violated.begin(), violated.begin() + std::ptrdiff_t(more), violated.end());
      violated.resize(more);
      add_rows<ConcurrencyTag>(violated, conditions, program);
    }
    m_step = program.step();
    conditions.change_coefficients(m_cells, m_step);
  }

  // Adds the step to x, and appends the cells with conditions in which the field changes. Returns false if there is no
  // step.
  bool apply(Vector& x, std::vector<Index>& changed_cells) const
  {
    if(m_step.size() == 0) return false;
    x(m_unknowns) += m_step;
    for(const Cell& cell : m_cells) changed_cells.push_back(cell.cell);
    return true;
  }

private:
  // A cell with conditions on which unknowns act.
  struct Cell
  {
    struct Entry
    {
      int n, place; // among the 64 coefficients, and among the unknowns
      double weight;
    };

    Index cell;
    std::vector<Entry> entries;
    std::vector<Condition_numbers> slacks; // before the step, computed on demand; infinite if in the program

    Local_coefficients change(const Vector& step) const
    {
      Local_coefficients local = {};
      for(const Entry& e : entries) local[e.n] += e.weight * step[e.place];
      return local;
    }
  };

  struct Violation
  {
    double slack;
    Cell* cell;
    std::size_t condition, number;
    bool operator<(const Violation& o) const
    {
      return std::tie(slack, cell->cell, condition, number) < std::tie(o.slack, o.cell->cell, o.condition, o.number);
    }
  };

  // Returns the place of a coefficient among the unknowns, or -1.
  int place(Index u) const
  {
    return m_unknowns.front() <= u && u <= m_unknowns.back() ? m_places[u - m_unknowns.front()] : -1;
  }

  // Assembles the unknowns' part of the matrix (its lower triangle) and of the residual.
  void assemble(const Vector& b, const Vector& x, Eigen::MatrixXd& H, Vector& r) const
  {
    r = b(m_unknowns);
    H.setZero(r.size(), r.size());
    for(Eigen::Index n = 0; n < r.size(); ++n) {
      const Index u = m_unknowns[std::size_t(n)];
      double sum = 0;
      for(Matrix::InnerIterator it(*m_A, u); it; ++it) {
        sum += it.value() * x[it.row()];
        const int p = place(Index(it.row()));
        if(p < 0) continue;
        H(p, n) = it.value();
        if(p != n) r[p] -= it.value() * x[u];
      }
      r[n] -= sum;
    }
    m_field->visit_coefficients_near(m_reach, [&](Index v, const Bbox_3&) {
      if(v > m_unknowns.back() || place(v) >= 0) return;
      for(Matrix::InnerIterator it(*m_A, v); it; ++it) {
        const int p = place(Index(it.row()));
        if(p >= 0) r[p] -= it.value() * x[v];
      }
    });
  }

  void find_cells(const Conditions& conditions)
  {
    m_field->visit_cells(m_reach, [&](Index c) {
      if(conditions.in_cell(c).empty()) return;
      Cell cell = { c, {}, {} };
      m_field->visit_coefficients(c, [&](int n, Index u, double weight) {
        const int p = place(u);
        if(p >= 0) cell.entries.push_back({ n, p, weight });
      });
      if(!cell.entries.empty()) m_cells.push_back(std::move(cell));
    });
  }

  // Finds the conditions in a cell that a step violates and that are not in the program.
  static void find_violations(Cell& cell, const Vector& step, Conditions& conditions, std::vector<Violation>& violated)
  {
    const Local_coefficients change = cell.change(step);
    // Most conditions are far from being violated.
    const Condition_numbers largest = conditions.largest_numbers(cell.cell, change);
    if(conditions.least_slack(cell.cell) >= (std::max)(largest[0], largest[1])) return;
    if(cell.slacks.empty()) cell.slacks = conditions.slacks(cell.cell);
    for(std::size_t n = 0; n < cell.slacks.size(); ++n) {
      const Condition_numbers& before = cell.slacks[n];
      if(before[0] >= largest[0] && before[1] >= largest[1] && before[2] >= largest[2]) continue;
      const Condition_numbers changes = conditions.numbers(conditions.in_cell(cell.cell)[n], change);
      for(std::size_t k = 0; k < changes.size(); ++k)
        if(before[k] + changes[k] < 0) violated.push_back({ before[k] + changes[k], &cell, n, k });
    }
  }

  // Adds violated conditions to the program.
  template <typename ConcurrencyTag>
  static void add_rows(const std::vector<Violation>& violated, const Conditions& conditions, Elastic_program& program)
  {
    const Eigen::Index number = Eigen::Index(violated.size());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(program.step().size(), number);
    Vector least(number);
    for(Eigen::Index m = 0; m < number; ++m) {
      const Violation& v = violated[std::size_t(m)];
      const Slope_condition& condition = conditions.in_cell(v.cell->cell)[v.condition];
      const Local_vector local = conditions.row(condition, v.number);
      for(const typename Cell::Entry& e : v.cell->entries) rows(e.place, m) += e.weight * local[e.n];
      double& slack = v.cell->slacks[v.condition][v.number];
      least[m] = slope_tuning.excess * std::abs(bounds(condition)[v.number]) - slack;
      slack = std::numeric_limits<double>::infinity();
    }
    program.add<ConcurrencyTag>(rows, least);
  }

  const Field* m_field;
  const Matrix* m_A;
  Index m_center;
  std::vector<Index> m_unknowns; // ascending
  Bbox_3 m_reach;
  std::vector<int> m_places; // by coefficient, from the first unknown: place among the unknowns, or -1
  std::vector<Cell> m_cells;
  Vector m_step; // change of the unknowns; empty before
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SLOPE_PATCH_H
