// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_FITTED_PART_H
#define CGAL_BSPLINE_SHELL_3_FIT_FITTED_PART_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the free coefficients that act on the chosen cells and are fitted, while all others keep their values.
 */
struct Fitted_part
{
  std::vector<char> coefficients;  ///< 1 for each fitted coefficient
  std::vector<char> points;        ///< 1 for each point whose coefficient is fitted, or depends on a fitted coefficient
  std::vector<char> cells;         ///< 1 for each cell on which a fitted coefficient acts
  std::size_t number_of_cells = 0; ///< number of cells on which a fitted coefficient acts

  Fitted_part() = default;

  /// selects the coefficients that act on the chosen cells; takes time linear in the size of the field
  /// \tparam Field `Hierarchical_bspline_field_3`
  /// \param field the cells and basis functions; its coefficients are ignored
  /// \param chosen the cells
  template <typename Field>
  Fitted_part(const Field& field, const std::vector<std::uint32_t>& chosen)
    : coefficients(field.number_of_coefficients(), 0), points(field.number_of_points(), 0),
      cells(field.number_of_cells(), 0)
  {
    typedef typename Field::Cell_index Index;
    for(Index c : chosen)
      for(Index row : field.coefficient_rows(c)) std::fill_n(points.begin() + row, 4, 1);
    for(int l = 0; l < field.number_of_levels(); ++l)
      for(Index n = 0; n < field.points(l).size(); ++n) {
        const Index point = field.first_point(l) + n, u = field.coefficient_of_point(point);
        if(!points[point]) continue;
        if(u != Field::npos) coefficients[u] = 1;
        else field.visit_parents(l, field.points(l).point(n), [&](Index parent, double) { coefficients[parent] = 1; });
      }
    for(int l = 0; l < field.number_of_levels(); ++l)
      for(Index n = 0; n < field.points(l).size(); ++n) {
        const Index point = field.first_point(l) + n, u = field.coefficient_of_point(point);
        points[point] = u != Field::npos ? coefficients[u] : 0;
        if(u == Field::npos)
          field.visit_parents(l, field.points(l).point(n),
                              [&](Index parent, double) { points[point] |= coefficients[parent]; });
      }
    for(Index c = 0; c < field.number_of_cells(); ++c) {
      const std::array<Index, 16> rows = field.coefficient_rows(c);
      cells[c] = std::any_of(rows.begin(), rows.end(),
                             [&](Index r) { return points[r] || points[r + 1] || points[r + 2] || points[r + 3]; });
      number_of_cells += std::size_t(cells[c]);
    }
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_FITTED_PART_H
