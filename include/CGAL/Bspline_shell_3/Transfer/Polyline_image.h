// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_POLYLINE_IMAGE_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_POLYLINE_IMAGE_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>

#include <CGAL/boost/graph/properties.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Transfer
/// the reason why a part of a polyline has no image (`Polyline_gap`)
enum class Polyline_status
{
  NO_IMAGE,        ///< a point of the part has no image; `Polyline_gap::flow` is the reason
  NO_COMMON_FACET, ///< the ends of a segment of the polyline do not lie in a common facet of the source
  JUMPS            ///< the images of points next to each other are not next to each other on the target
};

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief a part of a polyline without an image.
 */
struct Polyline_gap
{
  double begin = 0; ///< parameter of the first point of the part (`Polyline_image::Vertex::parameter`)
  double end = 0;   ///< parameter of the last point of the part
  Polyline_status status = Polyline_status::NO_IMAGE;
  Flow_status flow = Flow_status::SUCCESS; ///< for `NO_IMAGE`, the status of the first image that was not found

  /// returns a sentence that describes the problem and a remedy
  const char* message() const
  {
    switch(status) {
      case Polyline_status::NO_IMAGE: return Bspline_shells::message(flow);
      case Polyline_status::NO_COMMON_FACET:
        return "The ends of a segment do not lie in a common facet of the source: insert a vertex at each edge that "
               "the segment crosses.";
      case Polyline_status::JUMPS:
        return "The image of the polyline jumps, or crosses facets that are narrower than the rounding of coordinates: "
               "verify both meshes (CGAL::Bspline_shells::Shell_certificate_3).";
    }
    return "";
  }
};

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief the image of a polyline on another mesh (`map_polyline()`): polylines whose consecutive vertices lie in a
 * common facet.
 *
 * A vertex on an edge or at a vertex of the mesh has barycentric coordinates that are exactly 0. Its point is the same
 * for each facet that contains it.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 * \tparam Point_3 the type of points
 */
template <typename TriangleMesh, typename Point_3>
struct Polyline_image
{
  /// facet and barycentric coordinates: a `CGAL::Polygon_mesh_processing::Face_location`
  typedef std::pair<typename boost::graph_traits<TriangleMesh>::face_descriptor, std::array<double, 3> > Location;

  struct Vertex
  {
    Location location;
    Point_3 point;
    /// place on the polyline of the source: `n + t` is the point that divides the segment from vertex `n` to vertex
    /// `n + 1` in the ratio `t : (1 - t)`
    double parameter = 0;
    bool is_continued = false; ///< as `Projected_point::is_continued`
  };

  /// the images of the parts between the gaps, in the order of the polyline; a part may have one vertex
  std::vector<std::vector<Vertex> > parts;
  std::vector<Polyline_gap> gaps; ///< by ascending parameters
  std::size_t traced_points = 0;  ///< number of points that were moved along integral curves

  /// returns whether the whole polyline has an image; it is then the only part
  explicit operator bool() const { return gaps.empty(); }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_POLYLINE_IMAGE_H
