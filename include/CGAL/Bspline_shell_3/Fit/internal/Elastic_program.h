// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_ELASTIC_PROGRAM_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_ELASTIC_PROGRAM_H

#include <CGAL/Bspline_shell_3/Fit/Slope_tuning.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Minimizes s.H s / 2 - r.s + M sum_i max(0, least_i - g_i.s), where M is the largest multiplier.
//
// This is done through the dual, a quadratic program with one multiplier 0 <= l_i <= M for each row g_i. The bound
// makes the program elastic: rows that contradict each other get the multiplier M, and nothing diverges. Rows are added
// a few at a time, and multipliers are kept.
class Elastic_program
{
public:
  // pre: `factor` is that of H, and outlives this object
  Elastic_program(const Eigen::LLT<Eigen::MatrixXd>& factor, const Eigen::VectorXd& r)
    : m_factor(factor), m_free(factor.matrixL().solve(r)), m_step(factor.matrixU().solve(m_free)), m_W(r.size(), 0)
  {}

  std::size_t number_of_rows() const { return std::size_t(m_W.cols()); }
  // Returns the minimizer.
  const Eigen::VectorXd& step() const { return m_step; }

  // Adds rows, given as columns, and minimizes again.
  template <typename ConcurrencyTag>
  void add(const Eigen::MatrixXd& rows, const Eigen::VectorXd& least)
  {
    constexpr std::size_t chunk = 16;
    const Eigen::Index old = m_W.cols(), more = rows.cols();
    m_W.conservativeResize(Eigen::NoChange, old + more);
    m_K.conservativeResize(old + more, old + more);
    m_least.conservativeResize(old + more);
    m_multipliers.conservativeResize(old + more);
    m_least.tail(more) = least;
    m_multipliers.tail(more).setZero();
    const auto for_each_chunk_of_rows = [&](const auto& f) {
      for_each_chunk<ConcurrencyTag>(std::size_t(more), chunk, [&](std::size_t begin, std::size_t end) {
        f(Eigen::Index(begin), Eigen::Index(end - begin));
      });
    };
    for_each_chunk_of_rows([&](Eigen::Index first, Eigen::Index number) {
      auto added = m_W.middleCols(old + first, number);
      added = rows.middleCols(first, number);
      m_factor.matrixL().solveInPlace(added);
    });
    for_each_chunk_of_rows([&](Eigen::Index first, Eigen::Index number) {
      m_K.middleCols(old + first, number).noalias() = m_W.transpose() * m_W.middleCols(old + first, number);
    });
    m_K.bottomLeftCorner(more, old) = m_K.topRightCorner(old, more).transpose();
    solve_dual();
    m_step = m_factor.matrixU().solve(m_free + m_W * m_multipliers);
  }

private:
  // Minimizes |W l|^2 / 2 - l.(least - W^T L^-1 r) over 0 <= l <= M, one multiplier after the other.
  void solve_dual()
  {
    Eigen::VectorXd gap = m_least - m_W.transpose() * m_free - m_K * m_multipliers;
    for(int sweep = 0; sweep < slope_tuning.max_dual_sweeps; ++sweep) {
      double largest = 0;
      for(Eigen::Index m = 0; m < m_K.cols(); ++m) {
        if(!(m_K(m, m) > 0)) continue;
        const double next = (std::min)(slope_tuning.largest_multiplier,
                                       (std::max)(0., m_multipliers[m] + gap[m] / m_K(m, m)));
        const double delta = next - m_multipliers[m];
        if(delta == 0) continue;
        gap -= delta * m_K.col(m);
        m_multipliers[m] = next;
        largest = (std::max)(largest, std::abs(delta) * m_K(m, m));
      }
      if(largest < slope_tuning.dual_tolerance) break;
    }
  }

  const Eigen::LLT<Eigen::MatrixXd>& m_factor; // H = L L^T
  Eigen::VectorXd m_free, m_step;              // L^-1 r, and the minimizer
  Eigen::MatrixXd m_W, m_K;                    // L^-1 G^T, where G has the rows g_i, and W^T W
  Eigen::VectorXd m_least, m_multipliers;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_ELASTIC_PROGRAM_H
