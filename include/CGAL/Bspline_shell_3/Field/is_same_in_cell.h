// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_IS_SAME_IN_CELL_H
#define CGAL_BSPLINE_SHELL_3_FIELD_IS_SAME_IN_CELL_H

#include <algorithm>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief returns whether two fields are evaluated from the same numbers in a cell.
 *
 * \tparam Field `Hierarchical_bspline_field_3`
 * \param f,g the fields
 * \param c,d the index of the cell in `f` and in `g`
 */
template <typename Field>
bool is_same_in_cell(const Field& f, typename Field::Cell_index c, const Field& g, typename Field::Cell_index d)
{
  const double *x = f.cell(c).coefficients(), *y = g.cell(d).coefficients();
  return x == y || (f.cell(c).error_radius() == g.cell(d).error_radius() && std::equal(x, x + 64, y));
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_IS_SAME_IN_CELL_H
