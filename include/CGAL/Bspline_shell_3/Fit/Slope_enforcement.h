// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SLOPE_ENFORCEMENT_H
#define CGAL_BSPLINE_SHELL_3_FIT_SLOPE_ENFORCEMENT_H

#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Conditions_by_cell.h>
#include <CGAL/Bspline_shell_3/Fit/internal/Slope_patch.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/tags.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

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
 * and its neighbors are freed, and all others are kept. Half the energy plus \f$\Lambda \sum_i \max(0, \delta_i - g_i
 * \cdot x)\f$ is minimized over these coefficients. Conditions that contradict each other stay violated.
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
  typedef internal::Slope_patch<Field> Patch;

public:
  /// \param field the cells and functions; its coefficients are not used
  /// \param A lower triangle of the matrix of the energy \f$x^T A x - 2 b^T x\f$; coefficients whose columns are empty
  ///   keep their values
  /// \param b right-hand side
  /// \pre the arguments outlive this object; functions with a common entry have intersecting supports
  Slope_enforcement(const Field& field, const Matrix& A, const Vector& b)
    : m_field(field), m_A(A), m_b(b), m_conditions(field), m_abandoned(field.number_of_cells(), 0)
  {}

  /// adds conditions
  void insert(const std::vector<Slope_condition>& conditions)
  {
    for(const Slope_condition& c : conditions) m_abandoned[c.cell] = 0;
    m_conditions.insert(conditions);
  }

  /// changes the field where conditions are violated
  /// \param[in,out] x coefficients in units of the width of root cells (`Fit_energy`); after the first call, the result
  ///   of the last one
  /// \param most_violated if more cells are violated, the field is left unchanged: the problem is not local. If many
  ///   cells are violated and a sweep leaves most of them violated, no further sweep follows.
  template <typename ConcurrencyTag = Sequential_tag>
  Slope_report operator()(Vector& x, std::size_t most_violated = std::numeric_limits<std::size_t>::max())
  {
    Slope_report report;
    m_conditions.template set_coefficients<ConcurrencyTag>(x);
    std::vector<Index> violated = violated_cells<ConcurrencyTag>();
    report.violated_before = violated.size();
    for(int sweep = 0; sweep < slope_tuning.max_sweeps && !violated.empty(); ++sweep) {
      report.enforced = violated.size() <= most_violated;
      if(!report.enforced) break;
      most_violated = (std::max)(slope_tuning.few_violated_cells,
                                 std::size_t(slope_tuning.violated_cells_left * double(violated.size())));
      solve_patches<ConcurrencyTag>(violated, x, report);
      violated = violated_cells<ConcurrencyTag>();
    }
    std::sort(violated.begin(), violated.end());
    for(Index c : violated) report.violated_facets.push_back(m_conditions.worst(c).facet);
    report.violated_cells = std::move(violated);
    sort_unique(report.changed_cells);
    return report;
  }

private:
  // Returns the cells with a violated condition, worst first.
  template <typename ConcurrencyTag>
  std::vector<Index> violated_cells()
  {
    constexpr std::size_t chunk = 1024;
    std::vector<Index> violated = internal::collect_from_chunks<ConcurrencyTag, Index>(
      m_field.number_of_cells(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Index>& found) {
        for(Index c = Index(begin); c < end; ++c)
          if(m_conditions.least_slack(c) < 0) found.push_back(c);
      });
    std::stable_sort(violated.begin(), violated.end(),
                     [&](Index a, Index b) { return m_conditions.least_slack(a) < m_conditions.least_slack(b); });
    return violated;
  }

  // Solves the patches of cells. In each step, all patches are solved that do not overlap an earlier patch that is not
  // solved yet. Overlapping patches thus keep their order.
  template <typename ConcurrencyTag>
  void solve_patches(const std::vector<Index>& cells, Vector& x, Slope_report& report)
  {
    std::vector<Patch> waiting;
    for(auto next = cells.begin(); next != cells.end() || !waiting.empty();) {
      std::vector<Index> centers;
      for(; next != cells.end() && waiting.size() + centers.size() < slope_tuning.max_waiting_patches; ++next)
        if(!m_abandoned[*next]) centers.push_back(*next);
      for(Patch& patch : internal::collect_from_chunks<ConcurrencyTag, Patch>(
            centers.size(), 1, [&](std::size_t n, std::size_t, std::vector<Patch>&found) {
              found.emplace_back(m_field, m_A, centers[n]);
            }))
        waiting.push_back(std::move(patch));
      std::vector<Patch> batch = take_independent(waiting);
      internal::for_each_chunk<ConcurrencyTag>(batch.size(), 1, [&](std::size_t n, std::size_t) {
        Patch& patch = batch[n];
        const double before = m_conditions.least_slack(patch.center());
        if(!(before < 0)) return; // another patch has helped
        patch.template solve<ConcurrencyTag>(m_b, x, m_conditions);
        m_abandoned[patch.center()] = m_conditions.least_slack(patch.center()) < slope_tuning.violation_left * before;
      });
      for(const Patch& patch : batch) report.patches += patch.apply(x, report.changed_cells);
    }
  }

  // Removes and returns the patches that no earlier one reaches.
  static std::vector<Patch> take_independent(std::vector<Patch>& patches)
  {
    std::vector<Patch> independent, others;
    std::vector<Bbox_3> reaches;
    for(Patch& patch : patches) {
      const bool is_reached = std::any_of(reaches.begin(), reaches.end(),
                                          [&](const Bbox_3& r) { return do_overlap(r, patch.reach()); });
      reaches.push_back(patch.reach());
      (is_reached ? others : independent).push_back(std::move(patch));
    }
    patches.swap(others);
    return independent;
  }

  const Field& m_field;
  const Matrix& m_A;
  const Vector& m_b;
  internal::Conditions_by_cell<Field> m_conditions;
  std::vector<char> m_abandoned; // by cell: its patch did not help
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SLOPE_ENFORCEMENT_H
