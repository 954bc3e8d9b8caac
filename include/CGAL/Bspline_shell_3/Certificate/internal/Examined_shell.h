// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINED_SHELL_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINED_SHELL_H

#include <CGAL/Bspline_shell_3/Certificate/Field_predicates_3.h>

#include <array>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The set between two thresholds of a field, and the predicates that examine it.
template <typename Field, typename Threshold>
struct Examined_shell
{
  const Field& field;
  const Threshold &inner, &outer;
  const Field_predicates_3<Field>& predicates;

  // Returns whether the segment between two points is proved to lie between the thresholds.
  bool contains(const typename Field::Point_3& p, const typename Field::Point_3& q) const
  {
    return predicates.values_within(std::array<typename Field::Point_3, 2>{ p, q }, inner, outer) == Verdict::PROVED;
  }
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_INTERNAL_EXAMINED_SHELL_H
