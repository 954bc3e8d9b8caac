// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_STOP_PREDICATES_H
#define CGAL_BSPLINE_SHELL_3_EDITING_STOP_PREDICATES_H

#include <cstddef>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief stops a simplification when the triangle mesh has no more than the requested number of facets; outside of
 * `simplify_in_shell()`, the mesh must be closed.
 *
 * \cgalModels `StopPredicate`
 */
class Facet_count_stop_predicate
{
public:
  explicit Facet_count_stop_predicate(std::size_t facets) : m_facets(facets) {}

  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t edges) const
  {
    return 2 * edges <= 3 * m_facets;
  }

private:
  std::size_t m_facets;
};

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief never stops a simplification: the mesh becomes as coarse as the filter allows.
 *
 * \cgalModels `StopPredicate`
 */
struct Never_stop_predicate
{
  template <typename FT, typename Profile>
  bool operator()(const FT&, const Profile&, std::size_t, std::size_t) const
  {
    return false;
  }
};

/*!
 * \ingroup PkgBsplineShell3Editing
 *
 * \brief is true if `simplify_in_shell()` may restore the mesh and simplify it again with the same stop predicate. This
 * requires that the predicate stores nothing about edges. Facets need not be proved immediately then, which saves time.
 *
 * Specialize this template for your own predicates.
 */
template <typename StopPredicate>
struct Is_repeatable_stop_predicate : std::false_type
{};
template <>
struct Is_repeatable_stop_predicate<Facet_count_stop_predicate> : std::true_type
{};
template <>
struct Is_repeatable_stop_predicate<Never_stop_predicate> : std::true_type
{};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_STOP_PREDICATES_H
