// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_INVALID_PARAMETER_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_INVALID_PARAMETER_H

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief The values that a parameter may have: an interval.
 */
struct Parameter_bounds
{
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  bool is_lower_allowed = false, is_upper_allowed = false;

  /// finite numbers greater than zero, as lengths
  static Parameter_bounds positive() { return {}; }
  /// numbers greater than zero and infinity, as limits
  static Parameter_bounds positive_or_infinite() { return { 0, std::numeric_limits<double>::infinity(), false, true }; }
  /// finite numbers that are zero or more, as weights
  static Parameter_bounds not_negative() { return { 0, std::numeric_limits<double>::infinity(), true, false }; }

  /// Returns `false` for values that are not numbers.
  bool contains(double x) const
  {
    return (x > lower || (is_lower_allowed && x == lower)) && (x < upper || (is_upper_allowed && x == upper));
  }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief The parameter to which a status `INVALID_PARAMETER` refers: its name, its value and its bounds.
 */
struct Invalid_parameter
{
  const char* name = nullptr; ///< of the named parameter or the argument; null if no parameter is invalid
  double value = 0;           ///< that was given; if it is a function, a value that it returned
  Parameter_bounds bounds;    ///< of the values that are allowed

  /// whether a parameter is invalid
  explicit operator bool() const { return name != nullptr; }

  /// Records a parameter, unless its value is allowed or another parameter is recorded.
  void check(const char* parameter, double given, const Parameter_bounds& allowed)
  {
    if(!*this && !allowed.contains(given)) *this = { parameter, given, allowed };
  }
};

/// \ingroup PkgBsplineShell3Support
/// Returns a sentence with the name, the value and the bounds; an empty string if no parameter is invalid.
inline std::string message(const Invalid_parameter& parameter)
{
  if(!parameter) return "";
  const Parameter_bounds& bounds = parameter.bounds;
  std::ostringstream out;
  out.precision(10);
  out << "The parameter " << parameter.name << " is " << parameter.value << ". It must be "
      << (bounds.is_lower_allowed ? "at least " : "greater than ") << bounds.lower;
  if(std::isinf(bounds.upper)) out << (bounds.is_upper_allowed ? "" : " and finite");
  else out << (bounds.is_upper_allowed ? " and at most " : " and less than ") << bounds.upper;
  out << ".";
  return out.str();
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_INVALID_PARAMETER_H
