// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <Eigen/Core>

#include <array>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the differential of the flow that moves points along integral curves by a fixed difference of the field's
 * value: a linear map between vectors.
 *
 * It maps vectors along the curve at the start to vectors along the curve at the end. The differential of a map between
 * surfaces is that of the flow, followed by a projection along the curve onto the surface.
 */
struct Flow_differential
{
  Flow_status status = Flow_status::CANCELED;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity(); ///< derivatives of the end with respect to the start
  /// velocity of the curve at its end, parametrized by the field's value
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();

  explicit operator bool() const { return status == Flow_status::SUCCESS; }

  /// returns the differential of the map along the curves onto a surface with this normal at the end. Vectors are
  /// mapped into the tangent plane, and vectors along the curve to zero.
  /// \pre the normal is not orthogonal to the velocity
  Eigen::Matrix3d onto_plane(const Eigen::Vector3d& normal) const;
  /// returns the differential of the map along the curves onto the level set through the end
  Eigen::Matrix3d onto_level_set() const { return onto_plane(velocity); }

  /// composes with the inverse of a linear map at the end. A plane at the end is then given before the linear map,
  /// instead of its image.
  /// \pre `linear` is invertible
  void prepend_to_end(const Eigen::Matrix3d& linear);
  /// composes with a linear map at the start
  void append_to_start(const Eigen::Matrix3d& linear);
};

namespace internal {

// Returns the result for a point without an image.
Flow_differential no_differential(Flow_status status);

// Returns the differential of the projection along a normal.
Flow_differential orthogonal_differential(const std::array<double, 3>& normal);

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Projection/Flow_differential_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_DIFFERENTIAL_H
