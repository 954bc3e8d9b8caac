// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SOLVE_PART_H
#define CGAL_BSPLINE_SHELL_3_FIT_SOLVE_PART_H

#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/Solver_status.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief solves equations for some unknowns, while the others keep their values (see `Fit_energy::assemble()` for a
 * part).
 *
 * \param solver any model of `SPDSolver`; it solves the system of the chosen unknowns
 * \param lower lower triangle of the matrix of all unknowns; rows and columns of unknowns that are not chosen are empty
 * \param b right-hand side
 * \param chosen for each unknown, whether it is solved for
 * \param blocks the blocks of all unknowns
 * \param[in,out] x the initial value of the iteration, then the solution
 */
inline Solver_status solve_part(const Any_spd_solver& solver, const Eigen::SparseMatrix<double>& lower,
                                const Eigen::VectorXd& b, const std::vector<char>& chosen, const Unknown_blocks& blocks,
                                Eigen::VectorXd& x)
{
  typedef Eigen::SparseMatrix<double> Matrix;
  std::vector<Eigen::Index> unknowns;
  std::vector<int> place(chosen.size(), -1);
  for(std::size_t u = 0; u < chosen.size(); ++u)
    if(chosen[u]) {
      place[u] = int(unknowns.size());
      unknowns.push_back(Eigen::Index(u));
    }
  const Eigen::Index size = Eigen::Index(unknowns.size());
  Matrix part(size, size);
  part.resizeNonZeros(lower.nonZeros());
  Eigen::Index entries = 0;
  for(Eigen::Index n = 0; n < size; ++n) {
    part.outerIndexPtr()[n] = int(entries);
    for(Matrix::InnerIterator it(lower, unknowns[std::size_t(n)]); it; ++it, ++entries) {
      part.innerIndexPtr()[entries] = place[std::size_t(it.row())];
      part.valuePtr()[entries] = it.value();
    }
  }
  part.outerIndexPtr()[size] = int(entries);
  Unknown_blocks part_blocks;
  for(std::size_t block = 0; block < blocks.size(); ++block) {
    for(std::size_t n = blocks.first[block]; n < blocks.first[block + 1]; ++n)
      if(chosen[blocks.unknowns[n]]) part_blocks.unknowns.push_back(std::uint32_t(place[blocks.unknowns[n]]));
    if(part_blocks.unknowns.size() > part_blocks.first.back()) part_blocks.first.push_back(part_blocks.unknowns.size());
  }
  // Solves for the change of the unknowns, so that the tolerance is relative to the change.
  const Eigen::VectorXd all_residuals = b - lower.selfadjointView<Eigen::Lower>() * x;
  Eigen::VectorXd residual(size), change = Eigen::VectorXd::Zero(size);
  for(Eigen::Index n = 0; n < size; ++n) residual[n] = all_residuals[unknowns[std::size_t(n)]];
  Solver_status solved = solver.compute(part, part_blocks);
  if(solved == Solver_status::SUCCESS) solved = solver.solve(residual, change);
  if(solved != Solver_status::SUCCESS) return solved;
  for(Eigen::Index n = 0; n < size; ++n) x[unknowns[std::size_t(n)]] += change[n];
  return solved;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SOLVE_PART_H
