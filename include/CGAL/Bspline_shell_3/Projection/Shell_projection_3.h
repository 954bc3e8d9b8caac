// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H

#include <CGAL/Bspline_shell_3/Mesh/closing_argument.h>
#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Facet_on_curve.h>
#include <CGAL/Bspline_shell_3/Projection/internal/project_all.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the image of a point: the point of a mesh that corresponds to it, or the reason why none was found.
 */
template <typename TriangleMesh, typename Point_3>
struct Projected_point
{
  typedef Polygon_mesh_processing::Face_location<TriangleMesh, double> Location;

  Flow_status status = Flow_status::CANCELED;
  /// facet and barycentric coordinates
  Location location = Location(boost::graph_traits<TriangleMesh>::null_face(), {});
  Point_3 point;    ///< position of the image
  double value = 0; ///< value of the field at the image
  /// \name Estimated errors
  /// In the units of the coordinates, to first order; 0 if no curve was traced, NaN if unknown.
  /// @{
  double error = 0; ///< distance from the exact image; at most the tolerance
  /// distance of the point from the exact curve through the image: the error of the inverse map, measured across the
  /// curve. It exceeds the tolerance only where curves approach each other so closely that `double`s do not distinguish
  /// them.
  double error_of_inverse = 0;
  /// @}
  /// whether the image is the nearest point, because no curve leads to an image. Only projections between a polygon
  /// soup and its proxy yield such images (`Soup_projection_3`, `Proxy_projection_3`), and projections onto an open
  /// mesh with its closing (named parameter `closing`): if the curve meets the closing, the image is on the border.
  bool is_continued = false;
  /// whether the curve misses an open mesh by less than the tolerance, and the image was moved to the border
  bool is_snapped = false;

  explicit operator bool() const { return status == Flow_status::SUCCESS; }
};

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell along the integral curves of its field onto a mesh.
 *
 * If the mesh is certified (`Shell_certificate_3`), each curve meets it once, and every point in its components of the
 * shell has one image. Curves are traced in floating-point arithmetic, with steps that are small enough for a
 * tolerance; if the tolerance cannot be met, the status is `TOLERANCE_NOT_MET`. Curves to uncertified meshes are traced
 * in the same way while they stay in the shell. If such a curve meets the mesh several times, the image is one of these
 * points, on a facet that faces along the gradient: the normal and the gradient form an acute angle.
 *
 * Const member functions may be called concurrently. If many points are projected together, the search for an image
 * begins at the facet of the previous one. If each curve meets the mesh once, this changes an image by at most the
 * tolerance; otherwise, it may determine which of several points is the image. The result does not depend on the number
 * of threads.
 *
 * \tparam Shell a `CGAL::Bspline_shell_3`
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename Shell, typename TriangleMesh>
class Shell_projection_3
{
public:
  typedef typename Shell::Point_3 Point_3;
  typedef Projection_target_3<TriangleMesh> Target;
  typedef Projected_point<TriangleMesh, Point_3> Image;
  typedef typename Image::Location Location;
  typedef typename Target::Coordinates Coordinates;

  /// the facet at which the search begins: that of the previous image, as an index into
  /// `Projection_target_3::traced_facets()`. A hint saves time if each point is close to the previous one. Use a
  /// separate hint for each sequence of points and in each thread.
  struct Hint
  {
    typename Target::Index facet = Target::npos;
  };

  /// prepares the projection onto a triangle mesh, with a search tree for its facets. If the mesh has other facets, or
  /// coordinates that are not finite, all images have the status `INVALID_MESH`.
  /// \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
  /// \param mesh the mesh to project onto
  /// \param np optional named parameters
  ///   \cgalNamedParamsBegin
  ///     \cgalParamNBegin{vertex_point_map}
  ///       \cgalParamDescription{vertex point map of the mesh}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{tolerance}
  ///       \cgalParamDescription{as for the constructor below}
  ///       \cgalParamType{`double`}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{closing}
  ///       \cgalParamDescription{triangles that close the mesh (`Edit_report::closing`). A point whose curve meets them
  ///         instead of the mesh is mapped to the nearest point of the border, and the image is marked
  ///         (`Projected_point::is_continued`).}
  ///       \cgalParamType{`Shell_closing_3`, or a shared pointer to one, which may be null}
  ///       \cgalParamDefault{none: such a point has no image}
  ///     \cgalParamNEnd
  ///   \cgalNamedParamsEnd
  /// \pre `shell` and `mesh` outlive this object and do not change
  template <typename CGAL_NP_TEMPLATE_PARAMETERS>
  Shell_projection_3(const Shell& shell, const TriangleMesh& mesh,
                     const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
    : Shell_projection_3(
      shell,
      std::make_shared<const Target>(
        mesh,
        CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, internal_np::vertex_point),
                                           get_const_property_map(CGAL::vertex_point, mesh)),
        shell.truncation(), internal::closing_argument(np, nullptr)),
      CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, parameter_tags::tolerance), 0.))
  {}

  // Temporaries would dangle.
  template <typename... NP>
  Shell_projection_3(const Shell&&, const TriangleMesh&, const NP&...) = delete;
  template <typename... NP>
  Shell_projection_3(const Shell&, const TriangleMesh&&, const NP&...) = delete;

  /// constructs the projection onto a mesh that is already prepared, and may be shared by several projections.
  /// \pre `shell` outlives this object, and `target` is not null
  /// \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
  /// \param target the mesh to project onto
  /// \param tolerance largest distance of an image from the exact image, as estimated by `Gradient_flow_3`, and from
  ///   the end of the traced curve; in the units of the coordinates. 0 stands for
  ///   `Gradient_flow_3::default_tolerance()`.
  Shell_projection_3(const Shell& shell, std::shared_ptr<const Target> target, double tolerance = 0)
    : m_shell(&shell), m_target(std::move(target)),
      m_tolerance(tolerance > 0 ? tolerance : Gradient_flow_3<Shell>::default_tolerance(shell))
  {
    CGAL_precondition(m_target != nullptr);
  }
  Shell_projection_3(const Shell&&, std::shared_ptr<const Target>, double = 0) = delete; // would dangle

  const Shell& shell() const { return *m_shell; }
  const Target& target() const { return *m_target; }
  double tolerance() const { return m_tolerance; }

  /// returns the image of a point.
  /// \tparam Point a type with the coordinates `p[0]`, `p[1]`, `p[2]`
  template <typename Point>
  Image operator()(const Point& p) const
  {
    Hint hint;
    return (*this)(p, hint);
  }
  /// returns the image of a point, beginning the search at the hint. If the curve meets the mesh once, the hint changes
  /// the image by at most the tolerance.
  /// \param hint any hint; set to the facet of the image if there is one
  template <typename Point>
  Image operator()(const Point& p, Hint& hint) const
  {
    Image image;
    if(!*m_shell || !m_target->is_valid()) {
      image.status = !*m_shell ? Flow_status::NO_SHELL : Flow_status::INVALID_MESH;
      return image;
    }
    const Coordinates start = internal::rounded_coordinates(p);
    // A border vertex of an open mesh is its own image, because all meshes that the shell maps onto each other share
    // their borders.
    if(m_shell->closing() && m_shell->closing()->border_point(start) != Shell_closing_3::npos)
      if(const auto* corner = m_target->border_corner(start)) {
        const Point_3 point(start[0], start[1], start[2]);
        if(m_shell->bounded_side(point) != ON_UNBOUNDED_SIDE) {
          Coordinates weights = {};
          weights[corner->vertex] = 1;
          place(image, { corner->facet, weights });
          return image;
        }
      }
    typename internal::Facet_on_curve<Shell>::Hit hit;
    const typename Target::Index near = hint.facet < m_target->traced_facets().number_of_facets() ? hint.facet
                                                                                                  : Target::npos;
    image.status = internal::Facet_on_curve<Shell>(*m_shell, m_target->traced_facets(), m_tolerance)(start, near, hit);
    if(image.status == Flow_status::LEAVES_SHELL) continue_at_border(image, start);
    if(image.status != Flow_status::SUCCESS || image.is_continued) return image;
    hint.facet = hit.facet;

    Coordinates weights = hit.barycentric;
    double sum = 0;
    for(double& w : weights) sum += w = (std::max)(w, 0.);
    for(double& w : weights) w /= sum;
    const auto place = m_target->untraced({ hit.facet, weights });
    const Coordinates x = m_target->point(place.first, place.second);
    image.location = { m_target->face_of(place.first), place.second };
    image.point = Point_3(x[0], x[1], x[2]);
    image.value = hit.value;
    image.error = hit.error.at_image;
    image.error_of_inverse = hit.error.at_start;
    image.is_snapped = hit.is_beyond_border;
    return image;
  }

  /// returns the images of many points.
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
  /// \tparam PointRange a random access range of points
  /// \tparam Visitor a model of `FlowVisitor`
  /// \return the images in the same order; images that were not computed because the visitor stopped are `CANCELED`
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange,
            typename Visitor = Default_flow_visitor>
  std::vector<Image> project(const PointRange& points, Visitor&& visitor = Visitor()) const
  {
    return internal::project_all<ConcurrencyTag>(*this, points, visitor);
  }

  /// returns the differential of the flow from a point to its image, composed with that of the map from the truncated
  /// mesh to the mesh if tips are truncated. `Flow_differential::onto_plane()` with the facet's normal converts it to
  /// the differential of the projection, and `Flow_differential::onto_level_set()` to that onto a level set, which does
  /// not jump between facets. For a continued image, it is the differential of the orthogonal projection onto the plane
  /// of the facet. If the point has no image, the status is that of the image.
  /// \pre `image` is the image of `p`
  template <typename Point>
  Flow_differential differential(const Point& p, const Image& image) const
  {
    if(!image) return internal::no_differential(image.status);
    if(image.is_continued)
      return internal::orthogonal_differential(m_target->normal(m_target->facet_of(image.location.first)));
    Flow_differential d = Gradient_flow_3<Shell>(*m_shell, m_tolerance).differential(p, image.value);
    d.prepend_to_end(m_target->traced_derivative(m_target->facet_of(image.location.first), image.location.second));
    return d;
  }

private:
  // Sets an image to a place on the mesh.
  // pre: the place is in the shell
  void place(Image& image, const std::pair<typename Target::Index, Coordinates>& at) const
  {
    const Coordinates x = m_target->point(at.first, at.second);
    image.status = Flow_status::SUCCESS;
    image.location = { m_target->face_of(at.first), at.second };
    image.point = Point_3(x[0], x[1], x[2]);
    image.value = m_shell->field().cell(m_shell->field().locate(image.point)).value(image.point);
  }

  // If the curve through a point meets the closing of the mesh, sets the image to the nearest point of the border.
  void continue_at_border(Image& image, const Coordinates& start) const
  {
    const Projection_facets_3& closing = m_target->closing_facets();
    if(closing.number_of_facets() == 0) return;
    typename internal::Facet_on_curve<Shell>::Hit hit;
    if(internal::Facet_on_curve<Shell>(*m_shell, closing, m_tolerance)(start, Target::npos, hit)
       != Flow_status::SUCCESS)
      return;
    const auto nearest = m_target->closest_on_border(closing.point(hit.facet, hit.barycentric));
    const Coordinates x = m_target->point(nearest.first, nearest.second);
    if(m_shell->bounded_side(Point_3(x[0], x[1], x[2])) == ON_UNBOUNDED_SIDE) return;
    place(image, nearest);
    image.is_continued = true;
  }

  const Shell* m_shell;
  std::shared_ptr<const Target> m_target;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
