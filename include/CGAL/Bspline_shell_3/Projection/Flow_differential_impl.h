// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_IMPL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_IMPL_H

#include <CGAL/Bspline_shell_3/Projection/Flow_differential.h>

#include <CGAL/assertions.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE
Eigen::Matrix3d Flow_differential::onto_plane(const Eigen::Vector3d& normal) const
{
  CGAL_precondition(normal.dot(velocity) != 0);
  return matrix - velocity * (normal.transpose() * matrix) / normal.dot(velocity);
}

CGAL_BSPLINE_SHELL_3_INLINE
void Flow_differential::prepend_to_end(const Eigen::Matrix3d& linear)
{
  const Eigen::Matrix3d inverse = linear.inverse();
  matrix = inverse * matrix;
  velocity = inverse * velocity;
}

CGAL_BSPLINE_SHELL_3_INLINE
void Flow_differential::append_to_start(const Eigen::Matrix3d& linear)
{
  matrix *= linear;
}

namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE
Flow_differential no_differential(Flow_status status)
{
  Flow_differential result;
  result.status = status;
  return result;
}

CGAL_BSPLINE_SHELL_3_INLINE
Flow_differential orthogonal_differential(const std::array<double, 3>& normal)
{
  Flow_differential result;
  result.status = Flow_status::SUCCESS;
  result.velocity = Eigen::Vector3d(normal[0], normal[1], normal[2]);
  return result;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_IMPL_H
