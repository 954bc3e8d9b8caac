// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_SEGMENT_THROUGH_SHELL_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_SEGMENT_THROUGH_SHELL_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>
#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/power_of_two.h>

#include <CGAL/enum.h>

#include <array>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Returns whether the field and its differences from the two thresholds are proved to increase along a segment.
template <typename Field, typename Threshold>
bool certainly_increase(const Field_predicates_3<Field>& predicates, const Threshold& inner, const Threshold& outer,
                        const std::array<typename Field::Point_3, 2>& segment)
{
  if(predicates.increases(segment) != Verdict::PROVED) return false;
  if constexpr(Threshold::is_constant) return true;
  else
    return predicates.increases_above(segment, inner) == Verdict::PROVED
           && predicates.increases_above(segment, outer) == Verdict::PROVED;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief returns whether a segment is proved to lead through a component of the shell once.
 *
 * The field is less than the inner threshold at the source, and greater than the outer threshold at the target; the
 * field and its differences from the thresholds increase along the segment. Hence the part between the thresholds is
 * connected, and lies in one component of the shell.
 */
template <typename Field, typename Threshold>
bool leads_through_shell(const Field_predicates_3<Field>& predicates, const Threshold& inner, const Threshold& outer,
                         const std::array<typename Field::Point_3, 2>& segment)
{
  return predicates.is_beyond(segment[0], inner, NEGATIVE) && predicates.is_beyond(segment[1], outer, POSITIVE)
         && internal::certainly_increase(predicates, inner, outer, segment);
}

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief returns a segment that is proved to lead through the shell once, near a point and along the gradient there;
 * nothing if the point is outside the domain, or if no such segment is found.
 *
 *
 * \param predicates the predicates of the field
 * \param inner the inner threshold
 * \param outer the outer threshold
 * \param middle a point in the shell
 */
template <typename Field, typename Threshold>
std::optional<std::array<typename Field::Point_3, 2> > segment_through_shell(
  const Field_predicates_3<Field>& predicates, const Threshold& inner, const Threshold& outer,
  const typename Field::Point_3& middle)
{
  typedef typename Field::Point_3 Point_3;
  const Field& field = predicates.field();
  const typename Field::Cell_index c = field.locate(middle);
  if(c == Field::npos) return std::nullopt;
  const auto jet = field.cell(c).first_order_jet(middle);
  // The gradient and the values are scaled, because squares of small or large numbers would underflow or overflow.
  const std::array<double, 3> gradient = internal::scaled_to_unit(jet.gradient);
  const double unit = internal::reciprocal_power_of_two(jet.gradient), squared = internal::dot(gradient, gradient);
  if(!(squared > 0)) return std::nullopt;
  // Returns the first point in a direction that is proved to be beyond a threshold. The field may be less steep there.
  const auto end = [&](double difference, const Threshold& threshold, Sign side) -> std::optional<Point_3> {
    for(double stretch : { 1.05, 1.2, 1.5, 2., 3. }) {
      const double s = stretch * (unit * difference) / squared;
      const Point_3 p(middle[0] + s * gradient[0], middle[1] + s * gradient[1], middle[2] + s * gradient[2]);
      if(predicates.is_beyond(p, threshold, side)) return p;
    }
    return std::nullopt;
  };
  const double down = jet.value - inner.value(middle), up = outer.value(middle) - jet.value, more = (up + down) / 64;
  const std::optional<Point_3> source = end(-down - more, inner, NEGATIVE), target = end(up + more, outer, POSITIVE);
  if(!source || !target) return std::nullopt;
  const std::array<Point_3, 2> segment = { *source, *target };
  if(!internal::certainly_increase(predicates, inner, outer, segment)) return std::nullopt;
  return segment;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_SEGMENT_THROUGH_SHELL_H
