// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_FIELD_CELLS_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_FIELD_CELLS_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The leaf cells of a field, and the field minus a threshold.
template <typename Field, typename Threshold>
class Field_cells
{
public:
  typedef typename Field::Cell_index Index;
  typedef std::decay_t<decltype(std::declval<const Field&>().cells())> Hierarchy;
  static constexpr Index npos = Field::npos;

  Field_cells(const Field& field, const Threshold& threshold) : m_field(field), m_threshold(threshold) {}

  const Hierarchy& hierarchy() const { return m_field.cells(); }
  std::size_t number_of_cells() const { return m_field.number_of_cells(); }
  bool is_leaf(Index) const { return true; }
  Enclosed_tricubic function(Index c) const { return m_threshold.difference(enclosed_value(m_field.cell(c)), c); }
  std::array<double, 3> corner(Index c) const { return m_field.cell(c).corner(); }
  double width(Index c) const { return m_field.cell(c).width(); }

private:
  const Field& m_field;
  const Threshold& m_threshold;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_FIELD_CELLS_H
