// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H
#define CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H

#include <CGAL/Bspline_shell_3/Fit/Slope_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/internal/basis_rows.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>
#include <CGAL/Bspline_shell_3/Spline/tensor_contraction.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <atomic>
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
 * \brief a condition on a field at a point: it increases along a direction, \f$d \cdot \nabla f \ge \delta\f$, and is
 * near zero.
 */
struct Slope_condition
{
  std::uint32_t cell;              ///< leaf cell of the field
  std::uint32_t facet;             ///< facet that has the direction as its normal, for reports
  std::array<double, 3> position;  ///< position in the cell, in [0, 1]^3
  std::array<double, 3> direction; ///< unit vector
  double least;                    ///< \f$\delta\f$, per user unit
  /// largest \f$|f|\f$ at the point, in units of the width of root cells
  double largest = std::numeric_limits<double>::infinity();
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief statistics of `Slope_enforcement`.
 */
struct Slope_report
{
  std::size_t violated_before = 0; ///< number of cells with a violated condition
  std::size_t patches = 0;         ///< number of systems that were solved
  bool enforced = true;            ///< `false` if too many cells were violated
  /// cells with a condition that is still violated at the end, ascending
  std::vector<std::uint32_t> violated_cells;
  std::vector<std::uint32_t> violated_facets; ///< facet of the worst condition in each of these cells
  /// cells with conditions in which the field has changed, ascending
  std::vector<std::uint32_t> changed_cells;
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief changes the minimizer of a quadratic energy, where conditions on its slope or size are violated, to the best
 * field that meets them.
 *
 * Violations are local, and so are the changes. Around the worst violated cell, the coefficients that act on the cell
 * and its neighbors are freed, and all others are kept. The energy plus \f$\Lambda \sum_i \max(0, \delta_i - g_i \cdot
 * x)\f$ is minimized over these coefficients. This is done through its dual, a quadratic program with one multiplier
 * \f$0 \le \lambda_i \le \Lambda\f$ for each condition. The bound makes the program elastic: conditions that contradict
 * each other get the multiplier \f$\Lambda\f$ and stay violated, and nothing diverges. The program starts with the
 * violated conditions. Conditions that its solution violates are added until there are none.
 *
 * Patches are solved one after the other, worst first, in a few sweeps. Patches with disjoint supports are solved in
 * parallel. As most patches wait for another one, each patch is also solved by several threads. A cell whose patch did
 * not help is not tried again, unless conditions are added.
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
  /// \param field the cells and functions; its coefficients are not used
  /// \param A lower triangle of the matrix of the energy \f$x^T A x - 2 b^T x\f$; coefficients whose columns are empty
  ///   keep their values
  /// \param b right-hand side
  /// \pre the arguments outlive this object; functions with a common entry have intersecting supports
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
    if(!std::is_sorted(conditions.begin(), conditions.end(), by_cell))
      std::stable_sort(conditions.begin(), conditions.end(), by_cell);
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
    for(std::size_t c = 0; c + 1 < m_first.size(); ++c) m_first[c + 1] += m_first[c];
  }

  /// changes the field where conditions are violated
  /// \param[in,out] x coefficients in units of the width of root cells (`Fit_energy`); after the first call, the result
  ///   of the last one
  /// \param most_violated if more cells are violated, the field is left unchanged: the problem is not local. If a sweep
  ///   leaves most of many violated cells, it is the last one.
  template <typename ConcurrencyTag = Sequential_tag>
  Slope_report operator()(Vector& x, std::size_t most_violated = std::numeric_limits<std::size_t>::max())
  {
    Slope_report report;
    if(m_points.size() == 0) m_points = m_field.template extend<ConcurrencyTag>(x);
    m_changed.assign(m_field.number_of_cells(), 0);
    std::size_t violated_before = 0; // violated cells before the last sweep
    for(int sweep = 0; sweep < slope_tuning.max_sweeps; ++sweep) {
      find_slacks<ConcurrencyTag>();
      std::vector<std::pair<double, Index> > violated; // worst first
      for(Index c = 0; c < m_field.number_of_cells(); ++c) {
        if(m_least_slack[c] < 0) violated.emplace_back(m_least_slack[c], c);
      }
      if(sweep == 0) report.violated_before = violated.size();
      if(violated.empty()) break;
      const bool too_many = sweep == 0 ? violated.size() > most_violated
                                       : violated.size() > slope_tuning.few_violated_cells
                                           && double(violated.size())
                                                > slope_tuning.violated_cells_left * double(violated_before);
      violated_before = violated.size();
      if(too_many) {
        report.enforced = false;
        break;
      }
      std::sort(violated.begin(), violated.end());
      report.patches += solve_patches<ConcurrencyTag>(violated, x);
    }
    find_slacks<ConcurrencyTag>();
    for(Index c = 0; c < m_field.number_of_cells(); ++c) {
      if(m_least_slack[c] < 0) {
        report.violated_cells.push_back(c);
        report.violated_facets.push_back(m_conditions[least_slack(c).second].facet);
      }
      if(m_changed[c]) report.changed_cells.push_back(c);
    }
    return report;
  }

private:
  static constexpr std::size_t cells_at_once = 8, columns_at_once = 16; // per thread

  double scale(Index c) const { return double(1 << m_field.cells().level(c)); }

  bool has_equation(Index u) const { return m_A.outerIndexPtr()[u] != m_A.outerIndexPtr()[u + 1]; }

  // A condition bounds three numbers from below: the slope, the value, and minus the value.
  static constexpr int numbers = 3;
  typedef std::array<double, numbers> Slacks;

  // Returns the derivative of such a number by the 64 coefficients of the cell, which are in root units.
  internal::Local_vector local_row(const Slope_condition& condition, int number) const
  {
    const internal::Basis_jet<double, 2> basis = internal::first_order_basis(condition.position);
    if(number == 0) return scale(condition.cell) * internal::directional_row(basis, condition.direction);
    return (number == 1 ? 1. : -1.) * internal::outer(basis[0][0], basis[0][1], basis[0][2]);
  }

  // Returns these numbers for 64 coefficients of the condition's cell.
  Slacks evaluate(const Slope_condition& condition, const double* local) const
  {
    const internal::First_order_jet<double> jet = internal::first_order_jet<double>(
      local, internal::first_order_basis(condition.position));
    const std::array<double, 3>&g = jet.gradient, &d = condition.direction;
    return { scale(condition.cell) * internal::dot(g, d), jet.value, -jet.value };
  }

  // Returns bounds on the changes of these numbers in a cell if its 64 coefficients change by `local`. Values lie in
  // the convex hull of the coefficients, and first derivatives in that of their differences.
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

  static double bound(const Slope_condition& condition, int number)
  {
    return number == 0 ? condition.least : -condition.largest;
  }

  // Calls visit(condition, slacks) for the conditions in a cell. Slacks are the numbers minus their bounds.
  template <typename Visitor>
  void visit_slacks(Index c, const Visitor& visit) const
  {
    if(m_first[c] == m_first[c + 1]) return;
    const std::array<Index, 16> rows = m_field.coefficient_rows(c);
    std::array<double, 64> local;
    for(int n = 0; n < 64; ++n) local[n] = m_points[rows[n / 4] + n % 4];
    for(std::size_t n = m_first[c]; n < m_first[c + 1]; ++n) {
      Slacks slacks = evaluate(m_conditions[n], local.data());
      for(int k = 0; k < numbers; ++k) slacks[k] -= bound(m_conditions[n], k);
      visit(n, slacks);
    }
  }

  // Returns the least slack in a cell, and the first condition with it.
  std::pair<double, std::size_t> least_slack(Index c) const
  {
    std::pair<double, std::size_t> least(std::numeric_limits<double>::infinity(), m_first[c]);
    visit_slacks(c, [&](std::size_t n, const Slacks& slacks) {
      for(double s : slacks)
        if(s < least.first) least = { s, n };
    });
    return least;
  }

  template <typename ConcurrencyTag>
  void find_slacks()
  {
    internal::for_each_chunk<ConcurrencyTag>(m_field.number_of_cells(), 1024, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c)
        if(!m_is_known[c]) {
          m_least_slack[c] = least_slack(Index(c)).first;
          m_is_known[c] = 1;
        }
    });
  }

  // A cell on which unknowns of a patch act, with their weights.
  struct Patch_cell
  {
    struct Entry
    {
      int n, place;
      double weight;
    };

    Index cell;
    std::vector<Entry> entries;
    std::vector<Slacks> before;                   // by condition, computed on demand
    std::vector<std::array<char, numbers> > used; // by condition: which numbers are in the program

    // Returns the changes of the cell's 64 coefficients.
    std::array<double, 64> change(const Vector& step) const
    {
      std::array<double, 64> local = {};
      for(const Entry& e : entries) local[e.n] += e.weight * step[e.place];
      return local;
    }
  };

  // For each coefficient, its place among the unknowns of the last patch that contained it.
  typedef std::vector<std::atomic<int> > Places;

  // The unknowns that are free around a cell.
  struct Patch
  {
    Index center;
    std::vector<int> unknowns; // ascending
    Bbox_3 reach;              // bounding box of the supports of their functions
    Vector step;               // step of the unknowns; empty if the patch was not solved

    // Returns the place of a coefficient among the unknowns, or -1. In the latter case, another patch may be writing
    // the place.
    int place(Index u, const Places& places) const
    {
      const int p = places[u].load(std::memory_order_relaxed);
      return std::size_t(p) < unknowns.size() && unknowns[std::size_t(p)] == int(u) ? p : -1;
    }
  };

  // Solves the patches of cells one after the other, and patches with disjoint supports in parallel. Returns the number
  // of solved patches.
  template <typename ConcurrencyTag>
  std::size_t solve_patches(const std::vector<std::pair<double, Index> >& cells, Vector& x)
  {
    constexpr std::size_t window = 64; // number of patches that are considered
    std::size_t solved = 0;
    Places places(std::size_t(x.size()));
    std::list<Patch> waiting;
    std::vector<Patch*> batch;
    std::vector<Bbox_3> reaches;
    for(std::size_t next = 0; next < cells.size() || !waiting.empty();) {
      batch.clear();
      for(; next < cells.size() && waiting.size() < window; ++next)
        if(!m_hopeless[cells[next].second]) {
          waiting.push_back({ cells[next].second, {}, {}, {} });
          batch.push_back(&waiting.back());
        }
      internal::for_each_chunk<ConcurrencyTag>(batch.size(), 1,
                                               [&](std::size_t n, std::size_t) { find_unknowns(*batch[n]); });
      // Select the patches that no earlier patch reaches, solved or not: the order is kept where it matters.
      batch.clear();
      reaches.clear();
      for(Patch& p : waiting) {
        const bool is_free = std::none_of(reaches.begin(), reaches.end(),
                                          [&](const Bbox_3& r) { return do_overlap(r, p.reach); });
        reaches.push_back(p.reach);
        if(is_free) batch.push_back(&p);
      }
      internal::for_each_chunk<ConcurrencyTag>(
        batch.size(), 1, [&](std::size_t n, std::size_t) { solve_patch<ConcurrencyTag>(*batch[n], x, places); });
      for(const Patch* p : batch) {
        if(p->step.size() > 0) ++solved;
        for(Eigen::Index n = 0; n < p->step.size(); ++n) x[p->unknowns[std::size_t(n)]] += p->step[n];
      }
      waiting.remove_if([&](const Patch& p) { return std::find(batch.begin(), batch.end(), &p) != batch.end(); });
    }
    return solved;
  }

  // Finds the unknowns that act on a cell and its neighbors, or, if these are too many, on the cell alone.
  void find_unknowns(Patch& patch) const
  {
    const Bbox_3 b = m_field.cell(patch.center).bbox();
    const double margin = 0.5 * m_field.cells().width(patch.center);
    const Bbox_3 core(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin, b.ymax() + margin,
                      b.zmax() + margin);
    std::vector<int>& unknowns = patch.unknowns;
    const auto free_coefficients = [&](Index c) {
      m_field.visit_coefficients(c, [&](int, Index u, double) {
        if(has_equation(u)) unknowns.push_back(int(u));
      });
    };
    const auto make_unique = [&] { sort_unique(unknowns); };
    m_field.visit_cells(core, free_coefficients);
    make_unique();
    if(unknowns.size() > slope_tuning.max_unknowns) {
      unknowns.clear();
      free_coefficients(patch.center);
      make_unique();
    }
    patch.reach = core;
    for(int u : unknowns) patch.reach += m_field.support(Index(u));
  }

  // Computes the step, if the cell still needs one, and updates the cells with conditions. If patches have disjoint
  // reaches, they read and write disjoint data: a cell lies in the support of each function that acts on it.
  template <typename ConcurrencyTag>
  void solve_patch(Patch& patch, const Vector& x, Places& places)
  {
    const double slack_before = least_slack(patch.center).first;
    if(!(slack_before < 0) || patch.unknowns.empty()) return;
    const std::vector<int>& unknowns = patch.unknowns;
    for(std::size_t n = 0; n < unknowns.size(); ++n)
      places[std::size_t(unknowns[n])].store(int(n), std::memory_order_relaxed);
    std::vector<Patch_cell> cells = cells_with_conditions<ConcurrencyTag>(patch, places);
    Eigen::MatrixXd H;
    Vector r;
    assemble(patch, x, places, H, r);
    const Eigen::LLT<Eigen::MatrixXd> factor(H);
    if(factor.info() == Eigen::Success) {
      patch.step = minimize<ConcurrencyTag>(cells, factor, r);
      // Cells share points: read all before any is written.
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
    m_hopeless[patch.center] = least_slack(patch.center).first < slope_tuning.violation_left * slack_before;
  }

  // Returns the cells with conditions on which the unknowns of a patch act.
  template <typename ConcurrencyTag>
  std::vector<Patch_cell> cells_with_conditions(const Patch& patch, const Places& places)
  {
    std::vector<Index> near;
    m_field.visit_cells(patch.reach, [&](Index c) {
      if(m_first[c] < m_first[c + 1]) near.push_back(c);
    });
    return internal::collect_from_chunks<ConcurrencyTag, Patch_cell>(
      near.size(), cells_at_once, [&](std::size_t begin, std::size_t end, std::vector<Patch_cell>& found) {
        for(std::size_t m = begin; m < end; ++m) {
          const Index c = near[m];
          Patch_cell cell;
          cell.cell = c;
          m_field.visit_coefficients(c, [&](int n, Index u, double weight) {
            const int p = patch.place(u, places);
            if(p >= 0) cell.entries.push_back({ n, p, weight });
          });
          if(cell.entries.empty()) continue;
          if(!m_is_known[c]) m_least_slack[c] = least_slack(c).first;
          m_is_known[c] = 1;
          found.push_back(std::move(cell));
        }
      });
  }

  // Assembles the unknowns' part of the matrix (its lower triangle) and of the residual.
  void assemble(const Patch& patch, const Vector& x, const Places& places, Eigen::MatrixXd& H, Vector& r) const
  {
    const Eigen::Index size = Eigen::Index(patch.unknowns.size());
    H.setZero(size, size);
    r.resize(size);
    for(Eigen::Index n = 0; n < size; ++n) r[n] = m_b[patch.unknowns[std::size_t(n)]];
    for(Eigen::Index n = 0; n < size; ++n) {
      const int u = patch.unknowns[std::size_t(n)];
      double sum = 0;
      for(Matrix::InnerIterator it(m_A, u); it; ++it) {
        sum += it.value() * x[it.row()];
        const int p = patch.place(Index(it.row()), places);
        if(p < 0) continue;
        H(p, n) = it.value();
        if(p != n) r[p] -= it.value() * x[u];
      }
      r[n] -= sum;
    }
    m_field.visit_coefficients_near(patch.reach, [&](Index v, const Bbox_3&) {
      if(int(v) > patch.unknowns.back() || patch.place(v, places) >= 0) return;
      for(Matrix::InnerIterator it(m_A, v); it; ++it) {
        const int p = patch.place(Index(it.row()), places);
        if(p >= 0) r[p] -= it.value() * x[v];
      }
    });
  }

  struct Violation
  {
    double slack;
    std::size_t cell, condition; // index of the cell in the patch, and of the condition
    int number;
    bool operator<(const Violation& o) const
    {
      return std::tie(slack, condition, number) < std::tie(o.slack, o.condition, o.number);
    }
  };

  // Finds the conditions in cells that a step of the unknowns violates and that are not in the program.
  void find_violations(std::vector<Patch_cell>& cells, std::size_t begin, std::size_t end, const Vector& step,
                       std::vector<Violation>& violated) const
  {
    for(std::size_t c = begin; c < end; ++c) {
      Patch_cell& cell = cells[c];
      const std::array<double, 64> change = cell.change(step);
      // Most conditions are far from being violated.
      const Slacks largest = largest_changes(change.data(), scale(cell.cell));
      if(m_least_slack[cell.cell] >= (std::max)(largest[0], largest[1])) continue;
      const std::size_t first = m_first[cell.cell];
      if(cell.before.empty()) {
        visit_slacks(cell.cell, [&](std::size_t, const Slacks& slacks) { cell.before.push_back(slacks); });
        cell.used.assign(cell.before.size(), std::array<char, numbers>{});
      }
      for(std::size_t n = 0; n < cell.before.size(); ++n) {
        const Slacks& before = cell.before[n];
        if(before[0] >= largest[0] && before[1] >= largest[1] && before[2] >= largest[2]) continue;
        const Slacks changes = evaluate(m_conditions[first + n], change.data());
        for(int k = 0; k < numbers; ++k)
          if(!cell.used[n][k] && before[k] + changes[k] < 0)
            violated.push_back({ before[k] + changes[k], c, first + n, k });
      }
    }
  }

  // Returns the step of the unknowns.
  template <typename ConcurrencyTag>
  Vector minimize(std::vector<Patch_cell>& cells, const Eigen::LLT<Eigen::MatrixXd>& factor, const Vector& r) const
  {
    const Eigen::Index size = r.size();
    const Vector free = factor.matrixL().solve(r);
    Vector step = factor.matrixU().solve(free);
    Eigen::MatrixXd W(size, 0);       // L^-1 G^T, for the conditions G in the program
    Eigen::MatrixXd K(0, 0);          // W^T W
    Vector wanted(0), multipliers(0); // required changes of G x, and their multipliers
    for(int exchange = 0; exchange < slope_tuning.max_exchanges; ++exchange) {
      std::vector<Violation> violated = internal::collect_from_chunks<ConcurrencyTag, Violation>(
        cells.size(), cells_at_once, [&](std::size_t begin, std::size_t end, std::vector<Violation>& found) {
          find_violations(cells, begin, end, step, found);
        });
      const std::size_t more = (std::min)(
        { violated.size(), slope_tuning.max_rows - (std::min)(slope_tuning.max_rows, std::size_t(W.cols())),
          slope_tuning.max_new_rows });
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
        const internal::Local_vector local = local_row(m_conditions[v.condition], v.number);
        for(const typename Patch_cell::Entry& e : cell.entries) W(e.place, column) += e.weight * local[e.n];
        wanted[column] = slope_tuning.excess * std::abs(bound(m_conditions[v.condition], v.number))
                         - cell.before[n][v.number];
        multipliers[column] = 0;
      }
      internal::for_each_chunk<ConcurrencyTag>(more, columns_at_once, [&](std::size_t begin, std::size_t end) {
        auto added = W.middleCols(old + Eigen::Index(begin), Eigen::Index(end - begin));
        factor.matrixL().solveInPlace(added);
      });
      // The dual: minimize |W l|^2 / 2 - l . (wanted - W^T L^-1 r) over 0 <= l <= bound, one multiplier after the
      // other.
      K.conservativeResize(W.cols(), W.cols());
      internal::for_each_chunk<ConcurrencyTag>(more, columns_at_once, [&](std::size_t begin, std::size_t end) {
        const Eigen::Index first = old + Eigen::Index(begin), columns = Eigen::Index(end - begin);
        K.middleCols(first, columns).noalias() = W.transpose() * W.middleCols(first, columns);
      });
      K.bottomLeftCorner(Eigen::Index(more), old) = K.topRightCorner(old, Eigen::Index(more)).transpose();
      Vector gap = wanted - W.transpose() * free - K * multipliers;
      for(int sweep = 0; sweep < slope_tuning.max_dual_sweeps; ++sweep) {
        double largest = 0;
        for(Eigen::Index m = 0; m < K.cols(); ++m) {
          if(!(K(m, m) > 0)) continue;
          const double next = (std::min)(slope_tuning.largest_multiplier,
                                         (std::max)(0., multipliers[m] + gap[m] / K(m, m)));
          const double delta = next - multipliers[m];
          if(delta == 0) continue;
          gap -= delta * K.col(m);
          multipliers[m] = next;
          largest = (std::max)(largest, std::abs(delta) * K(m, m));
        }
        if(largest < slope_tuning.dual_tolerance) break;
      }
      step = factor.matrixU().solve(free + W * multipliers);
    }
    return step;
  }

  const Field& m_field;
  const Matrix& m_A;
  const Vector& m_b;
  std::vector<Slope_condition> m_conditions; // sorted by cell
  std::vector<std::size_t> m_first;          // first condition of each cell, and the end
  Vector m_points;
  std::vector<char> m_hopeless, m_changed, m_is_known; // by cell; the last one: whether the least slack is valid
  std::vector<double> m_least_slack;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ENFORCE_SLOPES_H
