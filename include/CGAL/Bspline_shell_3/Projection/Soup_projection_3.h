// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_PROJECTION_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_PROJECTION_3_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Outermost_facet_on_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/project_all.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief maps points of a shell along integral curves to the visible parts of a mesh that may intersect itself,
 * overlap, and have any orientation.
 *
 * The image of a point is the first point of the mesh on its integral curve, from the outer surface of the shell
 * inward. Facets that the curve misses by less than 100 times the tolerance count as met. If the curve leaves the shell
 * through the inner surface without meeting the mesh, the image is the point of the mesh that is nearest to the exit.
 * Such images are marked (`Projected_point::is_continued`), and several points may have the same one. Images jump at
 * silhouettes, where one part of the mesh hides another. A curve that only touches the mesh may miss it there.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename Shell, typename TriangleMesh>
class Soup_projection_3
{
public:
  typedef typename Shell::Point_3 Point_3;
  typedef Projection_target_3<TriangleMesh> Target;
  typedef Projected_point<TriangleMesh, Point_3> Image;
  typedef typename Image::Location Location;
  typedef typename Target::Coordinates Coordinates;
  struct Hint
  {}; ///< unused

  /// constructs a projection like `Shell_projection_3`, except for the tolerance
  /// \param tolerance tolerance of the steps along a curve. The growth of their errors where curves diverge is not
  ///   estimated, so `Projected_point::error` and `Projected_point::error_of_inverse` are NaN.
  Soup_projection_3(const Shell& shell, std::shared_ptr<const Target> target, double tolerance = 0)
    : m_shell(&shell), m_target(std::move(target)),
      m_tolerance(tolerance > 0 ? tolerance : Gradient_flow_3<Shell>::default_tolerance(shell))
  {
    CGAL_precondition(m_target != nullptr);
  }
  Soup_projection_3(const Shell&&, std::shared_ptr<const Target>, double = 0) = delete; // would dangle

  const Shell& shell() const { return *m_shell; }
  const Target& target() const { return *m_target; }
  double tolerance() const { return m_tolerance; }

  /// returns the image of a point.
  /// \tparam Point a type with the coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Image operator()(const Point& p) const
  {
    Image image;
    if(!*m_shell || !m_target->is_valid() || m_target->number_of_facets() == 0) {
      image.status = !*m_shell ? Flow_status::NO_SHELL : Flow_status::INVALID_MESH;
      return image;
    }
    internal::Curve_hit hit;
    Coordinates innermost;
    image.status = internal::Outermost_facet_on_curve<Shell>(*m_shell, *m_target, m_tolerance)(
      internal::rounded_coordinates(p), hit, innermost);
    if(image.status == Flow_status::LEAVES_SHELL) {
      std::tie(hit.facet, hit.barycentric) = m_target->closest(innermost);
      image.is_continued = true;
      image.status = Flow_status::SUCCESS;
    }
    if(image.status != Flow_status::SUCCESS) return image;
    const Coordinates x = m_target->point(hit.facet, hit.barycentric);
    image.location = { m_target->face_of(hit.facet), hit.barycentric };
    image.point = Point_3(x[0], x[1], x[2]);
    image.value = hit.value;
    image.error = image.error_of_inverse = std::numeric_limits<double>::quiet_NaN();
    return image;
  }

  template <typename Point>
  Image operator()(const Point& p, Hint&) const
  {
    return (*this)(p);
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
    if(!image.is_continued) return Gradient_flow_3<Shell>(*m_shell, m_tolerance).differential(p, image.value);
    return internal::orthogonal_differential(m_target->normal(m_target->facet_of(image.location.first)));
  }

private:
  const Shell* m_shell;
  std::shared_ptr<const Target> m_target;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SOUP_PROJECTION_3_H
