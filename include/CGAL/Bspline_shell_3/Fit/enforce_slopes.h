// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H
#define CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H

#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the condition that a field increases along a direction at a point, \f$d \cdot \nabla f \ge \delta\f$, and that it is
 * near zero there.
 */
struct Slope_condition
{
  std::uint32_t cell;                   ///< leaf cell of the field
  std::uint32_t facet;                  ///< whose normal the direction is, for reports
  std::array<double, 3> position;       ///< in the cell, in [0, 1]^3
  std::array<double, 3> direction;      ///< unit vector
  double least;                         ///< \f$\delta\f$, per user unit
  double largest = std::numeric_limits<double>::infinity();   ///< that \f$|f|\f$ may be there, in units of the width of root cells
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief how `enforce_slopes()` went.
 */
struct Slope_report
{
  std::size_t violated_before = 0;            ///< cells with a violated condition
  std::size_t patches = 0;                    ///< systems that were solved
  bool enforced = true;                       ///< `false` if there were too many
  std::vector<std::uint32_t> violated_cells;  ///< at the end: cells with a condition that no small change of the field meets
  std::vector<std::uint32_t> violated_facets; ///< of the worst condition in each of them
  std::vector<std::uint32_t> changed_cells;   ///< where the field is another one, among those with conditions; ascending
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief changes the minimizer of a quadratic energy, where conditions on its slope or its size are violated, to the best
 * one that meets them.
 *
 * Violations are local, and so is the work: around the worst violated cell, the coefficients that act on the cell and its
 * neighbors are freed and all others kept. The energy plus \f$\Lambda \sum_i \max(0, \delta_i - g_i \cdot x)\f$ is minimized over
 * them through its dual, a quadratic program in one multiplier \f$0 \le \lambda_i \le \Lambda\f$ for each condition. The bound
 * makes it elastic: conditions that contradict each other get the multiplier \f$\Lambda\f$ and stay violated, and nothing
 * diverges. The program starts with the violated conditions; those that its solution violates are added until there is none.
 * Patches are solved one after the other, worst first, in a few sweeps, and at once where their functions are apart; a cell whose patch did not help
 * is not tried again, unless conditions are added.
 *
 * \tparam Field `Hierarchical_bspline_field_3`
 */
template <typename Field>
class Slope_enforcement
{
  typedef typename Field::Cell_index Index;
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;
  static constexpr Index npos = Field::npos;

public:
  /// \param field gives cells and functions; its coefficients are not looked at
  /// \param A lower triangle of the energy's matrix, \f$x^T A x - 2 b^T x\f$; coefficients whose columns are empty keep their values
  /// \param b right-hand side
  /// \pre all of them outlive this object
  Slope_enforcement(const Field& field, const Matrix& A, const Vector& b) : m_field(field), m_A(A), m_b(b)
  {
    m_first.assign(field.number_of_cells() + 1, 0);
    m_hopeless.assign(field.number_of_cells(), 0);
    m_is_known.assign(field.number_of_cells(), 0);
    m_least_slack.resize(field.number_of_cells());
  }

  /// adds conditions
  void insert(std::vector<Slope_condition> conditions)
  {
    const auto by_cell = [](const Slope_condition& a, const Slope_condition& b) { return a.cell < b.cell; };
    if(!std::is_sorted(conditions.begin(), conditions.end(), by_cell)) std::stable_sort(conditions.begin(), conditions.end(), by_cell);
    for(const Slope_condition& c : conditions) {
      m_hopeless[c.cell] = 0;
      m_is_known[c.cell] = 0;
    }
    if(m_conditions.empty()) {
      m_conditions = std::move(conditions);
    } else {
      const auto middle = std::ptrdiff_t(m_conditions.size());
      m_conditions.insert(m_conditions.end(), conditions.begin(), conditions.end());
      std::inplace_merge(m_conditions.begin(), m_conditions.begin() + middle, m_conditions.end(), by_cell);
    }
    m_points.resize(0);
    m_first.assign(m_field.number_of_cells() + 1, 0);
    for(const Slope_condition& c : m_conditions) ++m_first[c.cell + 1];
    for(std::size_t c = 0; c + 1 < m_first.size(); ++c) m_first[c+1] += m_first[c];
  }

  /// \param[in,out] x coefficients in units of the width of root cells (`Fit_energy`); those that the last call left, if there
  /// was one
  /// \param most_violated nothing is changed if more cells have violated conditions: they are no local affair. Nor are they if
  /// a sweep leaves most of many.
  template <typename ConcurrencyTag = Sequential_tag>
  Slope_report operator()(Vector& x, std::size_t most_violated = std::numeric_limits<std::size_t>::max())
  {
    Slope_report report;
    if(m_points.size() == 0) m_points = m_field.template extend<ConcurrencyTag>(x);
    m_changed.assign(m_field.number_of_cells(), 0);
    std::size_t violated_before = 0;        // the sweep
    for(int sweep = 0; sweep < max_sweeps; ++sweep) {
      find_slacks<ConcurrencyTag>();
      std::vector<std::pair<double, Index> > violated;      // worst first
      for(Index c = 0; c < m_field.number_of_cells(); ++c) {
        if(m_least_slack[c] < 0) violated.emplace_back(m_least_slack[c], c);
      }
      if(sweep == 0) report.violated_before = violated.size();
      if(violated.empty()) break;
      const bool too_many = sweep == 0 ? violated.size() > most_violated
                                       : violated.size() > few && double(violated.size()) > progress * double(violated_before);
      violated_before = violated.size();
      if(too_many) {
        report.enforced = false;
        break;
      }
      std::sort(violated.begin(), violated.end());
      if(m_place.empty()) prepare(x);
      report.patches += solve_patches<ConcurrencyTag>(violated, x);
    }
    find_slacks<ConcurrencyTag>();
    for(Index c = 0; c < m_field.number_of_cells(); ++c) {
      if(m_least_slack[c] < 0) {
        report.violated_cells.push_back(c);
        report.violated_facets.push_back(worst_facet(c));
      }
      if(m_changed[c]) report.changed_cells.push_back(c);
    }
    return report;
  }

private:
  static constexpr int max_sweeps = 3;
  static constexpr std::size_t few = 64;                // violated cells that are left, whatever the progress of a sweep
  static constexpr double progress = 0.7;               // largest share of violations that a sweep may leave
  static constexpr std::size_t max_unknowns = 500;      // in a patch
  static constexpr int max_exchanges = 8;
  static constexpr std::size_t max_rows = 160, max_new_rows = 32;
  static constexpr double helps = 0.5;                  // largest share of a violation that a useful patch leaves
  static constexpr double largest_multiplier = 1e2;     // the weights make one near ten
  static constexpr double excess = 0.05;                // part by which a solution is to exceed what is wanted, as it is not exact
  static constexpr int max_dual_sweeps = 100;
  static constexpr double dual_tolerance = 1e-4;        // of slopes

  double scale(Index c) const { return double(1 << m_field.cells().level(c)); }

  bool has_equation(Index u) const { return m_A.outerIndexPtr()[u] != m_A.outerIndexPtr()[u+1]; }

  // A condition bounds three numbers from below: the slope, the value, and minus the value.
  static constexpr int numbers = 3;
  typedef std::array<double, numbers> Slacks;

  // the derivative of such a number by the 64 coefficients of the cell, which are in root units
  std::array<double, 64> local_row(const Slope_condition& condition, int number) const
  {
    std::array<std::array<double, 4>, 3> value, slope;
    for(int a = 0; a < 3; ++a) {
      value[a] = Cubic_bspline<>::values(condition.position[a]);
      slope[a] = Cubic_bspline<>::first_derivatives(condition.position[a]);
    }
    const std::array<double, 3>& d = condition.direction;
    const double s = scale(condition.cell);
    std::array<double, 64> row;
    for(int k = 0; k < 4; ++k)
      for(int j = 0; j < 4; ++j) {
        const double of_value = (number == 1 ? 1 : -1) * value[1][j] * value[2][k];
        const double with_slope = s * d[0] * value[1][j] * value[2][k];
        const double with_value = s * (d[1] * slope[1][j] * value[2][k] + d[2] * value[1][j] * slope[2][k]);
        for(int i = 0; i < 4; ++i)
          row[16*k + 4*j + i] = number == 0 ? with_slope * slope[0][i] + with_value * value[0][i] : of_value * value[0][i];
      }
    return row;
  }

  // these numbers, for 64 coefficients of the condition's cell
  Slacks evaluate(const Slope_condition& condition, const double* local) const
  {
    internal::Basis_jet<double, 2> basis;
    for(int a = 0; a < 3; ++a) {
      basis[0][a] = Cubic_bspline<>::values(condition.position[a]);
      basis[1][a] = Cubic_bspline<>::first_derivatives(condition.position[a]);
    }
    const internal::First_order_jet<double> jet = internal::first_order_jet<double>(local, basis);
    const std::array<double, 3>&g = jet.gradient, &d = condition.direction;
    return { scale(condition.cell) * internal::dot(g, d), jet.value, -jet.value };
  }

  // what 64 coefficients change of these numbers in a cell, at most: values lie in the hull of the coefficients, and first derivatives in that of their
  // differences
  static Slacks largest_changes(const double* local, double scale)
  {
    double value = 0, squared = 0;
    for(int n = 0; n < 64; ++n) value = (std::max)(value, std::abs(local[n]));
    std::array<double, 3> difference = {};
    internal::for_each_coefficient_line([&](int axis, int n, auto stride) {
      double& most = difference[std::size_t(axis)];
      for(int m = 0; m < 3; ++m) most = (std::max)(most, std::abs(local[n + (m + 1) * stride] - local[n + m * stride]));
    });
    for(double d : difference) squared += d * d;
    return { scale * std::sqrt(squared), value, value };
  }

  static double bound(const Slope_condition& condition, int number) { return number == 0 ? condition.least : -condition.largest; }

  // by how much they exceed their bounds
  Slacks slacks(const Slope_condition& condition) const
  {
    const std::array<Index, 16> rows = m_field.coefficient_rows(condition.cell);
    std::array<double, 64> local;
    for(int n = 0; n < 64; ++n) local[n] = m_points[rows[n / 4] + n % 4];
    Slacks slacks = evaluate(condition, local.data());
    for(int k = 0; k < numbers; ++k) slacks[k] -= bound(condition, k);
    return slacks;
  }

  double least_slack(Index c) const
  {
    double least = std::numeric_limits<double>::infinity();
    for(std::size_t n = m_first[c]; n < m_first[c+1]; ++n)
      for(double s : slacks(m_conditions[n])) least = (std::min)(least, s);
    return least;
  }

  // the condition with the least slack
  std::uint32_t worst_facet(Index c) const
  {
    const auto slack = [&](const Slope_condition& condition) {
      const Slacks s = slacks(condition);
      return *std::min_element(s.begin(), s.end());
    };
    std::size_t worst = m_first[c];
    for(std::size_t n = m_first[c] + 1; n < m_first[c+1]; ++n)
      if(slack(m_conditions[n]) < slack(m_conditions[worst])) worst = n;
    return m_conditions[worst].facet;
  }

  template <typename ConcurrencyTag>
  void find_slacks()
  {
    internal::for_each_chunk<ConcurrencyTag>(m_field.number_of_cells(), 1024, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c)
        if(!m_is_known[c]) {
          m_least_slack[c] = least_slack(Index(c));
          m_is_known[c] = 1;
        }
    });
  }

  // the residual, which is kept up to date from now on, and the strictly lower triangle by rows
  void prepare(const Vector& x)
  {
    m_residual = m_b - m_A.template selfadjointView<Eigen::Lower>() * x;
    const std::size_t size = std::size_t(x.size());
    m_row_begin.assign(size + 1, 0);
    for(std::size_t c = 0; c < size; ++c)
      for(int n = m_A.outerIndexPtr()[c] + 1; n < m_A.outerIndexPtr()[c+1]; ++n) ++m_row_begin[std::size_t(m_A.innerIndexPtr()[n]) + 1];
    for(std::size_t c = 0; c < size; ++c) m_row_begin[c+1] += m_row_begin[c];
    m_row_entries.resize(m_row_begin[size]);
    std::vector<std::size_t> next(m_row_begin.begin(), m_row_begin.end() - 1);
    for(std::size_t c = 0; c < size; ++c)
      for(int n = m_A.outerIndexPtr()[c] + 1; n < m_A.outerIndexPtr()[c+1]; ++n)
        m_row_entries[next[std::size_t(m_A.innerIndexPtr()[n])]++] = { int(c), n };
    m_place.assign(size, -1);
  }

  // a cell that unknowns of a patch act on, and how they do
  struct Patch_cell
  {
    struct Entry { int n, place; double weight; };

    Index cell;
    std::vector<Entry> entries;
    std::vector<Slacks> before;                         // by condition, made when they are needed
    std::vector<std::array<char, numbers> > used;       // in the program

    // of its 64 coefficients
    std::array<double, 64> change(const Vector& step) const
    {
      std::array<double, 64> local = {};
      for(const Entry& e : entries) local[e.n] += e.weight * step[e.place];
      return local;
    }
  };

  // what is freed around a cell
  struct Patch
  {
    Index center;
    std::vector<int> unknowns;      // ascending
    Bbox_3 reach;                   // of their functions
    Vector step;                    // of the unknowns; empty if the patch was not solved
  };

  // Solves the patches of cells one after the other, those at once that have nothing to do with each other. Returns how many were solved.
  template <typename ConcurrencyTag>
  std::size_t solve_patches(const std::vector<std::pair<double, Index> >& cells, Vector& x)
  {
    constexpr std::size_t window = 64;      // patches that are looked at
    std::size_t solved = 0;
    std::list<Patch> waiting;
    std::vector<Patch*> batch;
    std::vector<Bbox_3> reaches;
    for(std::size_t next = 0; next < cells.size() || !waiting.empty(); ) {
      for(; next < cells.size() && waiting.size() < window; ++next)
        if(!m_hopeless[cells[next].second]) waiting.push_back(patch(cells[next].second));
      // those that no earlier one reaches, done or not: the order is kept where it makes a difference
      batch.clear();
      reaches.clear();
      for(Patch& p : waiting) {
        const bool is_free = std::none_of(reaches.begin(), reaches.end(), [&](const Bbox_3& r) { return do_overlap(r, p.reach); });
        reaches.push_back(p.reach);
        if(is_free) batch.push_back(&p);
      }
      internal::for_each_chunk<ConcurrencyTag>(batch.size(), 1, [&](std::size_t n, std::size_t) { solve_patch(*batch[n]); });
      for(const Patch* p : batch) {
        if(p->step.size() > 0) ++solved;
        for(Eigen::Index n = 0; n < p->step.size(); ++n) add(p->unknowns[std::size_t(n)], p->step[n], x);
      }
      waiting.remove_if([&](const Patch& p) { return std::find(batch.begin(), batch.end(), &p) != batch.end(); });
    }
    return solved;
  }

  // all that acts on a cell and its neighbors, or, where these are many smaller ones, on the cell
  Patch patch(Index center)
  {
    const Bbox_3 b = m_field.cell(center).bbox();
    const double margin = 0.5 * m_field.cells().width(center);
    const Bbox_3 core(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin, b.ymax() + margin, b.zmax() + margin);
    Patch patch = { center, {}, core, {} };
    std::vector<int>& unknowns = patch.unknowns;
    const auto free_coefficients = [&](Index c) {
      m_field.visit_coefficients(c, [&](int, Index u, double) {
        if(m_place[u] >= 0 || !has_equation(u)) return;
        m_place[u] = 0;
        unknowns.push_back(int(u));
      });
    };
    m_field.visit_cells(core, free_coefficients);
    for(int u : unknowns) m_place[u] = -1;
    if(unknowns.size() > max_unknowns) {
      unknowns.clear();
      free_coefficients(center);
      for(int u : unknowns) m_place[u] = -1;
    }
    std::sort(unknowns.begin(), unknowns.end());
    for(int u : unknowns) patch.reach += m_field.support(Index(u));
    return patch;
  }

  // Finds the step, if the cell still needs one, and what it means for the cells with conditions. Where reaches are apart, so is all that this reads and
  // writes: a cell lies in the support of each function that acts on it.
  void solve_patch(Patch& patch)
  {
    const double slack_before = least_slack(patch.center);
    if(!(slack_before < 0) || patch.unknowns.empty()) return;
    const std::vector<int>& unknowns = patch.unknowns;
    const Eigen::Index size = Eigen::Index(unknowns.size());
    for(Eigen::Index n = 0; n < size; ++n) m_place[unknowns[n]] = int(n);
    // the cells with conditions that they may touch
    std::vector<Patch_cell> cells;
    m_field.visit_cells(patch.reach, [&](Index c) {
      if(m_first[c] == m_first[c+1]) return;
      Patch_cell cell;
      cell.cell = c;
      m_field.visit_coefficients(c, [&](int n, Index u, double weight) {
        const int place = m_place[u];
        if(place >= 0) cell.entries.push_back({ n, place, weight });
      });
      if(cell.entries.empty()) return;
      if(!m_is_known[c]) m_least_slack[c] = least_slack(c);
      m_is_known[c] = 1;
      cells.push_back(std::move(cell));
    });

    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
    Vector r(size);
    for(Eigen::Index n = 0; n < size; ++n) {
      r[n] = m_residual[unknowns[n]];
      // a zero may be stored for an unknown that acts on other cells, and is placed in another patch now
      for(Matrix::InnerIterator it(m_A, unknowns[n]); it; ++it)
        if(it.value() != 0 && m_place[it.row()] >= 0) H(m_place[it.row()], n) = it.value();
    }
    for(int u : unknowns) m_place[u] = -1;
    const Eigen::LLT<Eigen::MatrixXd> factor(H);
    if(factor.info() == Eigen::Success) {
      patch.step = minimize(cells, factor, r);
      // points are shared by cells: read all before any is written
      std::vector<std::pair<Index, double> > moved;
      for(const Patch_cell& cell : cells) {
        m_changed[cell.cell] = 1;
        m_is_known[cell.cell] = 0;
        const std::array<Index, 16> rows = m_field.coefficient_rows(cell.cell);
        const std::array<double, 64> change = cell.change(patch.step);
        for(int n = 0; n < 64; ++n) {
          const Index point = rows[n / 4] + n % 4;
          if(change[n] != 0) moved.emplace_back(point, m_points[point] + change[n]);
        }
      }
      for(const std::pair<Index, double>& m : moved) m_points[m.first] = m.second;
    }
    m_hopeless[patch.center] = least_slack(patch.center) < helps * slack_before;
  }

  // the step of the unknowns
  Vector minimize(std::vector<Patch_cell>& cells, const Eigen::LLT<Eigen::MatrixXd>& factor, const Vector& r) const
  {
    const Eigen::Index size = r.size();
    const Vector free = factor.matrixL().solve(r);
    Vector step = factor.matrixU().solve(free);
    struct Violation
    {
      double slack;
      std::size_t cell, condition;                // among the cells, and all conditions
      int number;
      bool operator<(const Violation& o) const { return std::tie(slack, condition, number) < std::tie(o.slack, o.condition, o.number); }
    };
    std::vector<Violation> violated;
    Eigen::MatrixXd W(size, 0);                   // L^-1 G^T, for the conditions G in the program
    Eigen::MatrixXd K(0, 0);                      // W^T W
    Vector wanted(0), multipliers(0);             // of G x, beyond what x has
    for(int exchange = 0; exchange < max_exchanges; ++exchange) {
      violated.clear();
      for(std::size_t c = 0; c < cells.size(); ++c) {
        Patch_cell& cell = cells[c];
        const std::array<double, 64> change = cell.change(step);
        // most conditions are far from being violated
        const Slacks largest = largest_changes(change.data(), scale(cell.cell));
        if(m_least_slack[cell.cell] >= (std::max)(largest[0], largest[1])) continue;
        const std::size_t first = m_first[cell.cell];
        if(cell.before.empty()) {
          for(std::size_t n = first; n < m_first[cell.cell + 1]; ++n) cell.before.push_back(slacks(m_conditions[n]));
          cell.used.assign(cell.before.size(), std::array<char, numbers>{});
        }
        for(std::size_t n = 0; n < cell.before.size(); ++n) {
          const Slacks& before = cell.before[n];
          if(before[0] >= largest[0] && before[1] >= largest[1] && before[2] >= largest[2]) continue;
          const Slacks changes = evaluate(m_conditions[first + n], change.data());
          for(int k = 0; k < numbers; ++k)
            if(!cell.used[n][k] && before[k] + changes[k] < 0) violated.push_back({ before[k] + changes[k], c, first + n, k });
        }
      }
      const std::size_t more = (std::min)({ violated.size(), max_rows - (std::min)(max_rows, std::size_t(W.cols())), max_new_rows });
      if(more == 0) break;
      std::partial_sort(violated.begin(), violated.begin() + std::ptrdiff_t(more), violated.end());
      const Eigen::Index old = W.cols();
      W.conservativeResize(Eigen::NoChange, old + Eigen::Index(more));
      wanted.conservativeResize(old + Eigen::Index(more));
      multipliers.conservativeResize(old + Eigen::Index(more));
      for(std::size_t m = 0; m < more; ++m) {
        const Violation& v = violated[m];
        Patch_cell& cell = cells[v.cell];
        const std::size_t n = v.condition - m_first[cell.cell];
        cell.used[n][v.number] = 1;
        const Eigen::Index column = old + Eigen::Index(m);
        W.col(column).setZero();
        const std::array<double, 64> local = local_row(m_conditions[v.condition], v.number);
        for(const typename Patch_cell::Entry& e : cell.entries) W(e.place, column) += e.weight * local[e.n];
        wanted[column] = excess * std::abs(bound(m_conditions[v.condition], v.number)) - cell.before[n][v.number];
        multipliers[column] = 0;
      }
      auto added = W.rightCols(Eigen::Index(more));
      factor.matrixL().solveInPlace(added);
      // the dual: minimize |W l|^2 / 2 - l . (wanted - W^T L^-1 r) over 0 <= l <= bound, one multiplier after the other
      K.conservativeResize(W.cols(), W.cols());
      K.rightCols(Eigen::Index(more)).noalias() = W.transpose() * added;
      K.bottomLeftCorner(Eigen::Index(more), old) = K.topRightCorner(old, Eigen::Index(more)).transpose();
      Vector gap = wanted - W.transpose() * free - K * multipliers;
      for(int sweep = 0; sweep < max_dual_sweeps; ++sweep) {
        double largest = 0;
        for(Eigen::Index m = 0; m < K.cols(); ++m) {
          if(!(K(m, m) > 0)) continue;
          const double next = (std::min)(largest_multiplier, (std::max)(0., multipliers[m] + gap[m] / K(m, m)));
          const double delta = next - multipliers[m];
          if(delta == 0) continue;
          gap -= delta * K.col(m);
          multipliers[m] = next;
          largest = (std::max)(largest, std::abs(delta) * K(m, m));
        }
        if(largest < dual_tolerance) break;
      }
      step = factor.matrixU().solve(free + W * multipliers);
    }
    return step;
  }

  // adds to a coefficient, and to the residual what it means
  void add(int u, double delta, Vector& x)
  {
    x[u] += delta;
    for(Matrix::InnerIterator it(m_A, u); it; ++it) m_residual[it.row()] -= it.value() * delta;
    for(std::size_t n = m_row_begin[u]; n < m_row_begin[u+1]; ++n)
      m_residual[m_row_entries[n].first] -= m_A.valuePtr()[m_row_entries[n].second] * delta;
  }

  const Field& m_field;
  const Matrix& m_A;
  const Vector& m_b;
  std::vector<Slope_condition> m_conditions;                // by cell
  std::vector<std::size_t> m_first;                         // condition of each cell
  Vector m_points, m_residual;
  std::vector<std::size_t> m_row_begin;
  std::vector<std::pair<int, int> > m_row_entries;          // column, and place among the values
  std::vector<char> m_hopeless, m_changed, m_is_known;      // of a cell: the last one, whether its least slack is
  std::vector<double> m_least_slack;
  std::vector<int> m_place;                                 // of a coefficient in the patch, or -1
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H
