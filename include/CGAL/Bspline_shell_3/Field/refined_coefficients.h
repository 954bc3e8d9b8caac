// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_REFINED_COEFFICIENTS_H
#define CGAL_BSPLINE_SHELL_3_FIELD_REFINED_COEFFICIENTS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Field/internal/visit_parent_points.h>

#include <Eigen/Core>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns the coefficient of a uniform spline of a level at a lattice point. This spline is the field on every leaf, of
// that level or coarser, on which the function of the point acts.
template <typename Field>
double coefficient_at(const Field& field, const Eigen::VectorXd& all, int level, const Lattice_point& p)
{
  if(level < field.number_of_levels()) {
    const auto n = field.points(level).index(p);
    if(n != Field::npos) return all[field.first_point(level) + n];
  }
  double sum = 0;
  visit_parent_points(
    p, [&](const Lattice_point& q, double weight) { sum += weight * coefficient_at(field, all, level - 1, q); });
  return sum;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief returns the free coefficients of the same function on finer cells; takes time linear in the size of the
 * fields.
 *
 * On a leaf of both fields whose coefficients depend on the same free coefficients in both, the function is represented
 * by the same `double`s.
 *
 * \tparam Field `Hierarchical_bspline_field_3`
 * \param coarse a field with the cells and functions; its coefficients are ignored
 * \param x free coefficients on the cells of `coarse`
 * \param fine a field on cells into which the cells of `coarse` were split
 */
template <typename Field>
Eigen::VectorXd refined_coefficients(const Field& coarse, const Eigen::VectorXd& x, const Field& fine)
{
  typedef typename Field::Cell_index Index;
  const Eigen::VectorXd all = coarse.extend(x);
  Eigen::VectorXd result(Eigen::Index(fine.number_of_coefficients()));
  for(int l = 0; l < fine.number_of_levels(); ++l)
    for(Index n = 0; n < fine.points(l).size(); ++n) {
      const Index u = fine.coefficient_of_point(fine.first_point(l) + n);
      if(u != Field::npos) result[u] = internal::coefficient_at(coarse, all, l, fine.points(l).point(n));
    }
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_REFINED_COEFFICIENTS_H
