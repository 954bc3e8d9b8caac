// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_FIELD_EVALUATION_H
#define CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_FIELD_EVALUATION_H

#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Spline/Tricubic_cell_3.h>
#include <CGAL/Bspline_shell_3/Spline/coefficient_lines.h>

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Converts the 64 B-spline coefficients that act on a cell to Bernstein coefficients, one axis after the other.
template <typename NT>
inline void to_bernstein(NT* b)
{
  for_each_coefficient_line([b](int, int n, auto stride) {
    const std::array<NT, 4> r = Cubic_bspline<NT>::bernstein_coefficients(
      { b[n], b[n + stride], b[n + 2 * stride], b[n + 3 * stride] });
    for(int m = 0; m < 4; ++m) b[n + m * stride] = r[std::size_t(m)];
  });
}

// Returns a bound on the errors of Bernstein coefficients, in every rounding mode. The error of an operation is at most
// eps times its result, or at most the smallest positive number. Each of the three passes takes averages, with weights
// that sum to one, in three operations; magnitudes never grow. Dependent coefficients are averages of up to 27 others:
// the errors of their products sum to eps, and there are 26 sums. Of the smallest numbers, 27 are for the products, 3
// for divisions, and one for the radius itself. If coefficients are so large that sums of their multiples may overflow,
// the bound is infinite.
inline double conversion_radius(double largest_coefficient, bool has_dependent)
{
  constexpr double too_large = (std::numeric_limits<double>::max)() / 1024;
  if(!(largest_coefficient < too_large)) return std::numeric_limits<double>::infinity();
  constexpr double eps = std::numeric_limits<double>::epsilon(), least = std::numeric_limits<double>::denorm_min();
  return (has_dependent ? 37 : 10) * eps * largest_coefficient + (has_dependent ? 32 : 4) * least;
}

// Base class of all fields: types, and evaluation on the leaf that contains a point.
template <typename Field, typename GeomTraits>
class Field_evaluation
{
  static_assert(std::is_same<typename GeomTraits::FT, double>::value,
                "GeomTraits must be a kernel with the number type double.");
public:
  typedef GeomTraits Geom_traits;
  typedef typename GeomTraits::FT FT;
  typedef typename GeomTraits::Point_3 Point_3;
  typedef typename GeomTraits::Vector_3 Vector_3;
  typedef Tricubic_cell_3 Cell;

  /// \name Evaluation
  /// Results are empty outside the domain.
  /// @{
  std::optional<FT> value(const Point_3& p) const
  {
    const auto c = field().locate(p);
    if(c == Field::npos) return std::nullopt;
    return field().cell(c).value(p);
  }
  std::optional<Vector_3> gradient(const Point_3& p) const
  {
    const auto c = field().locate(p);
    if(c == Field::npos) return std::nullopt;
    const Cell::First_order_jet jet = field().cell(c).first_order_jet(p);
    return Vector_3(jet.gradient[0], jet.gradient[1], jet.gradient[2]);
  }
  std::optional<Eigen::Matrix3d> hessian(const Point_3& p) const
  {
    const auto c = field().locate(p);
    if(c == Field::npos) return std::nullopt;
    const auto& h = field().cell(c).second_order_jet(p).hessian;
    Eigen::Matrix3d m;
    m << h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2];
    return m;
  }
  /// @}

private:
  const Field& field() const { return static_cast<const Field&>(*this); }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIELD_INTERNAL_FIELD_EVALUATION_H
