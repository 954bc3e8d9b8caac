// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_THRESHOLDS_H
#define CGAL_BSPLINE_SHELL_3_FIELD_THRESHOLDS_H

#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief a constant threshold.
 *
 * \cgalModels `ShellThreshold`
 */
class Constant_threshold
{
public:
  static constexpr bool is_constant = true;

  explicit Constant_threshold(double level = 0) : m_level(level) {}
  double level() const { return m_level; } ///< value of the threshold
  bool operator==(const Constant_threshold& other) const { return m_level == other.m_level; }

  /// returns `true`, because the threshold is tricubic on the leaf cells of every field
  template <typename Field>
  bool has_cells_of(const Field&) const
  {
    return true;
  }

  template <typename Point_3>
  double value(const Point_3&) const
  {
    return m_level;
  }
  template <typename Point_3>
  double value(const Point_3&, std::uint32_t /* cell */) const
  {
    return m_level;
  }

  /// encloses the threshold on a leaf cell
  Level_range range(std::uint32_t /* cell */) const { return { m_level, m_level }; }

  /// returns a function minus the threshold, on a leaf cell
  Enclosed_tricubic difference(const Enclosed_tricubic& f, std::uint32_t /* cell */) const
  {
    Enclosed_tricubic constant;
    constant.coefficients.fill(m_level);
    return Bspline_shells::difference(f, constant);
  }

private:
  double m_level;
};

/*!
 * \ingroup PkgBsplineShell3Field
 *
 * \brief a threshold that varies in space: a field on the same leaf cells, shared by copies.
 *
 * \cgalModels `ShellThreshold`
 *
 * \tparam Field a model of `BsplineField_3`
 */
template <typename Field>
class Spline_threshold
{
public:
  static constexpr bool is_constant = false;

  Spline_threshold() = default; ///< no threshold
  /// \pre `field` has the same cells, with the same indices, as the field of the shell (`has_cells_of()`)
  explicit Spline_threshold(Field field) : m_data(std::make_shared<const Data>(std::move(field))) {}

  const Field& field() const { return m_data->field; }

  /// returns whether the two thresholds are the same function on the same cells
  bool operator==(const Spline_threshold& other) const
  {
    if(m_data == other.m_data || !m_data || !other.m_data) return m_data == other.m_data;
    const auto &a = field().coefficients(), &b = other.field().coefficients();
    return a.size() == b.size() && a == b && has_cells_of(other.field());
  }

  /// returns whether the threshold has the leaf cells of a field, with the same indices
  template <typename OtherField>
  bool has_cells_of(const OtherField& other) const
  {
    if(!m_data || field().number_of_cells() != other.number_of_cells()) return false;
    for(std::size_t c = 0; c < other.number_of_cells(); ++c) {
      const auto a = field().cell(typename Field::Cell_index(c)), b = other.cell(typename OtherField::Cell_index(c));
      if(a.corner() != b.corner() || a.width() != b.width()) return false;
    }
    return true;
  }

  double value(const typename Field::Point_3& p) const { return field().value(p).value(); }
  template <typename Point_3>
  double value(const Point_3& p, std::uint32_t cell) const
  {
    const double constant = this->constant(cell);
    return std::isnan(constant) ? field().cell(cell).value(p) : constant;
  }
  /// returns the common value of all coefficients on a leaf cell, or NaN if they differ. On most cells, they are equal.
  double constant(std::uint32_t cell) const { return m_data->constants[cell]; }

  /// encloses the threshold on a leaf cell
  Level_range range(std::uint32_t cell) const
  {
    const double constant = this->constant(cell);
    if(!std::isnan(constant)) {
      const double radius = internal::radius_of_difference(0, field().cell(cell).error_radius(), std::abs(constant));
      return { constant - radius, constant + radius };
    }
    Enclosed_tricubic zero;
    zero.coefficients.fill(0);
    const Level_range negative = difference(zero, cell).range();
    return { -negative.max, -negative.min };
  }

  Enclosed_tricubic difference(const Enclosed_tricubic& f, std::uint32_t cell) const
  {
    return Bspline_shells::difference(f, enclosed_value(field().cell(cell)));
  }

private:
  struct Data
  {
    explicit Data(Field field_) : field(std::move(field_)), constants(field.number_of_cells())
    {
      for(std::size_t c = 0; c < constants.size(); ++c) {
        const double* const b = field.cell(typename Field::Cell_index(c)).coefficients();
        const bool is_constant = std::all_of(b + 1, b + 64, [b](double x) { return x == b[0]; });
        constants[c] = is_constant ? b[0] : std::numeric_limits<double>::quiet_NaN();
      }
    }

    Field field;
    std::vector<double> constants;
  };

  std::shared_ptr<const Data> m_data;
};

/// \ingroup PkgBsplineShell3Field
/// encloses the two thresholds on a leaf cell
template <typename Threshold>
Level_range threshold_range(const Threshold& inner, const Threshold& outer, std::uint32_t cell)
{
  if constexpr(Threshold::is_constant) {
    return { inner.level(), outer.level() };
  } else {
    Level_range range = inner.range(cell);
    range.include(outer.range(cell));
    return range;
  }
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_THRESHOLDS_H
