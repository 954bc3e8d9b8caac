// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_TRIANGLE_PREDICATE_ORACLE_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_TRIANGLE_PREDICATE_ORACLE_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief accepts facets that are contained in something else than a shell, as `CGAL::Polyhedral_envelope` tells. It
 * knows no direction that facets should face, and so says nothing about foldings.
 *
 * \cgalModels `ShellContainmentOracle`
 *
 * \tparam Contains a function of three points that returns whether their triangle is contained:
 *   `CGAL::Polyhedral_envelope`, `Shell_containment_3`, or a lambda
 */
template <typename Contains>
class Triangle_predicate_oracle
{
public:
  struct Memory
  {};

  /// \pre `contains` outlives this object
  explicit Triangle_predicate_oracle(const Contains& contains) : m_contains(&contains) {}
  explicit Triangle_predicate_oracle(const Contains&&) = delete; // it would dangle

  template <typename Point_3>
  Placement_verdict operator()(const Point_3& p, const std::vector<Point_3>& link, Memory&) const
  {
    for(std::size_t n = 0; n < link.size(); ++n)
      if(!(*m_contains)(p, link[n], link[(n + 1) % link.size()])) return Placement_verdict::LEAVES_SHELL;
    return Placement_verdict::ACCEPTED;
  }

private:
  const Contains* m_contains;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_TRIANGLE_PREDICATE_ORACLE_H
