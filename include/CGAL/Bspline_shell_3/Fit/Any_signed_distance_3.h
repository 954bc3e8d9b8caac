// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_ANY_SIGNED_DISTANCE_3_H
#define CGAL_BSPLINE_SHELL_3_FIT_ANY_SIGNED_DISTANCE_3_H

#include <CGAL/Bspline_shell_3/Mesh/Mesh_signed_distance_3.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The type of the points with which a signed-distance oracle is called.
template <typename Oracle, typename = void>
struct Point_of_oracle
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 type; // the oracle may be a lambda
};
template <typename Oracle>
struct Point_of_oracle<Oracle, std::void_t<typename Oracle::Point_3> >
{
  typedef typename Oracle::Point_3 type;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief a type-erased reference to a model of `SignedDistanceOracle_3`, so that fits are compiled only once.
 *
 * \cgalModels `SignedDistanceOracle_3`
 */
class Any_signed_distance_3
{
public:
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef double FT;

  /// \tparam Oracle a model of `SignedDistanceOracle_3`
  /// \pre `oracle` outlives this object
  template <typename Oracle>
  Any_signed_distance_3(const Oracle& oracle)
  {
    typedef typename internal::Point_of_oracle<Oracle>::type Oracle_point;
    constexpr bool is_callable = std::is_invocable_r<double, const Oracle&, const Oracle_point&>::value;
    static_assert(is_callable, "A signed-distance oracle must have a const operator() that returns a number for a "
                               "Point_3 of the oracle or, if the oracle does not define this type, for a Point_3 of "
                               "CGAL::Exact_predicates_inexact_constructions_kernel.");
    if constexpr(is_callable)
      m_at = [&oracle](const Point_3& p) -> double { return oracle(Oracle_point(p.x(), p.y(), p.z())); };
    if constexpr(std::is_same<Oracle, Mesh_signed_distance_3>::value)
      m_along = [&oracle](const std::vector<Point_3>& points, double* distances) {
        Mesh_signed_distance_3::Hint hint;
        for(const Point_3& p : points) *distances++ = oracle.signed_distance(p, hint);
      };
    else if constexpr(is_callable)
      m_along = [&oracle](const std::vector<Point_3>& points, double* distances) {
        for(const Point_3& p : points) *distances++ = oracle(Oracle_point(p.x(), p.y(), p.z()));
      };
  }
  Any_signed_distance_3(const Any_signed_distance_3&) = default;

  FT operator()(const Point_3& p) const { return m_at(p); }

  /// computes the distances of points, each of which is close to the previous one. For a mesh, this is faster, because
  /// the search for each point starts at the closest facet of the previous one.
  /// \param[out] distances one distance for each point
  void operator()(const std::vector<Point_3>& points, double* distances) const { m_along(points, distances); }

private:
  std::function<double(const Point_3&)> m_at;
  std::function<void(const std::vector<Point_3>&, double*)> m_along;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_ANY_SIGNED_DISTANCE_3_H
