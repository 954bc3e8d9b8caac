// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROXY_PROJECTION_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROXY_PROJECTION_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/project_all.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/tags.h>

#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief maps points of a polygon soup along integral curves onto its proxy, a mesh in the shell, like
 * `Shell_projection_3`.
 *
 * Points that are not in the shell, or whose curves leave it without meeting the proxy, are mapped to the nearest point
 * of the proxy. These images are marked (`Projected_point::is_continued`), and several points may have the same one.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename Shell, typename TriangleMesh>
class Proxy_projection_3 : public Shell_projection_3<Shell, TriangleMesh>
{
  typedef Shell_projection_3<Shell, TriangleMesh> Base;

public:
  typedef typename Base::Point_3 Point_3;
  typedef typename Base::Image Image;
  typedef typename Base::Coordinates Coordinates;
  typedef typename Base::Hint Hint;

  using Base::Base;

  /// returns the image of a point.
  /// \tparam Point a type with the coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Image operator()(const Point& p) const
  {
    Hint hint;
    return (*this)(p, hint);
  }
  /// returns the image of a point, with a hint as for `Shell_projection_3`
  template <typename Point>
  Image operator()(const Point& p, Hint& hint) const
  {
    Image image = Base::operator()(p, hint);
    const bool is_beyond = image.status == Flow_status::STARTS_OUTSIDE || image.status == Flow_status::LEAVES_SHELL;
    if(!is_beyond || this->target().number_of_facets() == 0) return image;
    const auto closest = this->target().closest(internal::rounded_coordinates(p));
    const Coordinates x = this->target().point(closest.first, closest.second);
    image.status = Flow_status::SUCCESS;
    image.is_continued = true;
    image.location = { this->target().face_of(closest.first), closest.second };
    image.point = Point_3(x[0], x[1], x[2]);
    return image;
  }

  /// returns the images of many points, like `Shell_projection_3::project()`
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange,
            typename Visitor = Default_flow_visitor>
  std::vector<Image> project(const PointRange& points, Visitor&& visitor = Visitor()) const
  {
    return internal::project_all<ConcurrencyTag>(*this, points, visitor);
  }

  /// returns the differential of the flow from a point to its image. For continued images, it is the differential of
  /// the orthogonal projection onto the plane of their facet. If the point has no image, the status is that of the
  /// image.
  /// \pre `image` is the image of `p`
  template <typename Point>
  Flow_differential differential(const Point& p, const Image& image) const
  {
    if(!image) return internal::no_differential(image.status);
    return image.is_continued
             ? internal::orthogonal_differential(this->target().normal(this->target().facet_of(image.location.first)))
             : Base::differential(p, image);
  }
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROXY_PROJECTION_3_H
