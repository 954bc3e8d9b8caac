// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_STATUS_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_STATUS_H

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the outcome of moving a point along its integral curve: if the value is not `SUCCESS`, the point has no image.
 * Also the status of a map (`Shell_map_3::status()`).
 */
enum class Flow_status
{
  SUCCESS,
  COMPONENTS_UNKNOWN, ///< maps: it is unknown whether the two meshes lie in the same components of the shell
  COMPONENTS_DIFFER,  ///< a component of the shell contains no part of the source, or no part of the target
  NO_SHELL,           ///< there is no shell
  INVALID_MESH,       ///< the mesh has facets that are not triangles, or coordinates that are not finite
  NOT_FINITE,         ///< a coordinate of the point is infinite or not a number
  STARTS_OUTSIDE,     ///< the point is not in the shell
  LEAVES_SHELL,       ///< the curve leaves the shell without meeting the target
  WRONG_ORIENTATION,  ///< the curve meets the target only at facets that face against the gradient
  GRADIENT_VANISHES,  ///< the curve runs into a critical point, up to rounding
  TOLERANCE_NOT_MET,  ///< the tolerance cannot be met
  CANCELED            ///< the visitor canceled before the point was processed
};

/// \ingroup PkgBsplineShell3Projection
/// returns a sentence that describes the problem and a remedy
inline const char* message(Flow_status status)
{
  switch(status) {
    case Flow_status::SUCCESS: return "The point was moved.";
    case Flow_status::NO_SHELL: return "There is no shell: see the status of the shell for the reason.";
    case Flow_status::COMPONENTS_UNKNOWN:
      return "It is unknown whether both meshes lie in the same components of the shell: certify the shell "
             "(CGAL::Bspline_shells::certify), and verify both meshes (CGAL::Bspline_shells::Shell_certificate_3).";
    case Flow_status::INVALID_MESH:
      return "A mesh has facets that are not triangles, or infinite or NaN coordinates: triangulate it "
             "(CGAL::Polygon_mesh_processing::triangulate_faces), or repair its coordinates.";
    case Flow_status::COMPONENTS_DIFFER:
      return "A component of the shell contains no part of one of the meshes, so the meshes are not mapped onto each "
             "other: compare their certificates, or project to one mesh (CGAL::Bspline_shells::Shell_projection_3).";
    case Flow_status::NOT_FINITE: return "The point has infinite or NaN coordinates: repair or remove it.";
    case Flow_status::STARTS_OUTSIDE:
      return "The point is not in the shell: verify the mesh that contains it "
             "(CGAL::Bspline_shells::Shell_certificate_3).";
    case Flow_status::LEAVES_SHELL:
      return "The curve through the point leaves the shell without meeting the target: verify the target "
             "(CGAL::Bspline_shells::Shell_certificate_3).";
    case Flow_status::WRONG_ORIENTATION:
      return "The target faces against the gradient where the curve meets it: reverse its orientation, or verify it "
             "(CGAL::Bspline_shells::Shell_certificate_3).";
    case Flow_status::GRADIENT_VANISHES:
      return "The curve runs into a critical point of the field, up to rounding: use a certified shell.";
    case Flow_status::TOLERANCE_NOT_MET: return "The tolerance cannot be met: increase it (tolerance).";
    case Flow_status::CANCELED: return "The visitor canceled the computation.";
  }
  return "";
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_FLOW_STATUS_H
