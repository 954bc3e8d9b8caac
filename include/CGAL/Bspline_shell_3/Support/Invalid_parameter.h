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
 * \brief the values that a parameter may have: an interval.
 */
struct Parameter_bounds
{
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  bool is_lower_allowed = false, is_upper_allowed = false;

  /// returns the bounds on lengths: finite numbers greater than zero
  static Parameter_bounds positive() { return {}; }
  /// returns the bounds on limits: numbers greater than zero, and infinity
  static Parameter_bounds positive_or_infinite() { return { 0, std::numeric_limits<double>::infinity(), false, true }; }
  /// returns the bounds on weights: finite numbers that are zero or more
  static Parameter_bounds not_negative() { return { 0, std::numeric_limits<double>::infinity(), true, false }; }

  /// returns `true` if a value is in the interval, and `false` if it is NaN
  bool contains(double x) const
  {
    return (x > lower || (is_lower_allowed && x == lower)) && (x < upper || (is_upper_allowed && x == upper));
  }
};

/*!
 * \ingroup PkgBsplineShell3Support
 *
 * \brief the parameter to which a status `INVALID_PARAMETER` refers: its name, its value, and its bounds.
 */
struct Invalid_parameter
{
  const char* name = nullptr; ///< name of the parameter or argument; null if none is invalid
  double value = 0;           ///< the given value; if the parameter is a function, a value that it returned
  Parameter_bounds bounds;    ///< bounds on the allowed values

  /// returns `true` if a parameter is invalid
  explicit operator bool() const { return name != nullptr; }

  /// records a parameter if its value is not allowed and no other parameter is recorded
  void check(const char* parameter, double given, const Parameter_bounds& allowed)
  {
    if(!*this && !allowed.contains(given)) *this = { parameter, given, allowed };
  }
};

/// \ingroup PkgBsplineShell3Support
/// returns a sentence with the name, the value, and the bounds; an empty string if no parameter is invalid
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
