// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H

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
 * \brief the image of a point on a mesh, or the reason why there is none.
 */
template <typename TriangleMesh, typename Point_3>
struct Projected_point
{
  typedef Polygon_mesh_processing::Face_location<TriangleMesh, double> Location;

  Flow_status status = Flow_status::CANCELED;
  /// facet and barycentric coordinates
  Location location = Location(boost::graph_traits<TriangleMesh>::null_face(), {});
  Point_3 point;    ///< in user coordinates
  double value = 0; ///< value of the field at the image: the parameter along the curve
  /// \name Estimated errors
  /// In user units, to first order; 0 if no curve was traced, NaN if unknown.
  /// @{
  double error = 0; ///< distance from the exact image; at most the tolerance
  /// Distance of the point from the exact curve through the image: the error of the way back, across the curve. It
  /// exceeds the tolerance only where curves approach each other so closely that `double`s do not distinguish them.
  double error_of_inverse = 0;
  /// @}
  /// Whether the image is the nearest point, because the shell does not define an image. Only projections between a
  /// polygon soup and its proxy yield such images (`Soup_projection_3`, `Proxy_projection_3`).
  bool is_continued = false;
  /// Whether the curve misses an open mesh by less than the tolerance, and the image was moved to the border.
  bool is_snapped = false;

  explicit operator bool() const { return status == Flow_status::SUCCESS; }
};

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief moves points of a shell along the integral curves of its field onto a mesh.
 *
 * If the mesh is certified (`Shell_certificate_3`), each curve meets it once, and every point of the shell has one
 * image. Curves are traced in `double`s. Steps are controlled such that the image is found up to a tolerance;
 * otherwise, the status is the reason. Curves of uncertified meshes are traced in the same way while they stay in the
 * shell. If such a curve meets the mesh several times, the image is one of the hits at facets that face along the
 * gradient.
 *
 * Const member functions may be called concurrently. Points that are projected together use each other's facets as
 * starting points. The result does not depend on the number of threads. If each curve meets the mesh once, the other
 * points affect an image by the tolerance at most; otherwise, they may determine which hit is the image.
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

  /// start of the search: the facet of the last image, as a number of `Projection_target_3::traced_facets()`. It saves
  /// time for sequences of points that are close to each other. Use one hint for each sequence of points and thread.
  struct Hint
  {
    typename Target::Index facet = Target::npos;
  };

  /// prepares the projection to a mesh of triangles; with other facets, all images have the status `INVALID_MESH`.
  /// Sorts the facets into a tree. The object may be used concurrently.
  /// \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
  /// \param mesh the mesh to project to
  /// \param np optional named parameters
  ///   \cgalNamedParamsBegin
  ///     \cgalParamNBegin{vertex_point_map}
  ///       \cgalParamDescription{vertex point map of the mesh}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{tolerance}
  ///       \cgalParamDescription{as for the constructor below}
  ///       \cgalParamType{`double`}
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
        shell.truncation()),
      CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, parameter_tags::tolerance), 0.))
  {}

  // Temporaries would dangle.
  template <typename... NP>
  Shell_projection_3(const Shell&&, const TriangleMesh&, const NP&...) = delete;
  template <typename... NP>
  Shell_projection_3(const Shell&, const TriangleMesh&&, const NP&...) = delete;

  /// prepares the projection to a mesh that is already prepared and may be shared.
  /// \pre `shell` outlives this object, and `target` is not null
  /// \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
  /// \param target the mesh to project to
  /// \param tolerance largest distance of an image from the exact one, as estimated by `Gradient_flow_3`, and from the
  ///   end of the traced curve; user units; 0 stands for the default of `Gradient_flow_3`
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
  /// returns the image of a point. If the curve meets the mesh once, the hint affects it by the tolerance at most.
  /// \param hint any hint; set to the facet of the image, if there is one
  template <typename Point>
  Image operator()(const Point& p, Hint& hint) const
  {
    Image image;
    if(!*m_shell || !m_target->is_valid()) {
      image.status = !*m_shell ? Flow_status::NO_SHELL : Flow_status::INVALID_MESH;
      return image;
    }
    const Coordinates start = internal::rounded_coordinates(p);
    // A border vertex of an open mesh is its own image: all meshes that the shell maps to each other share their
    // borders.
    if(m_shell->closing() && m_shell->closing()->border_point(start) != Shell_closing_3::npos)
      if(const auto* corner = m_target->border_corner(start)) {
        const Point_3 point(start[0], start[1], start[2]);
        if(m_shell->bounded_side(point) != ON_UNBOUNDED_SIDE) {
          image.status = Flow_status::SUCCESS;
          image.location.first = m_target->face_of(corner->facet);
          image.location.second[corner->vertex] = 1;
          image.point = point;
          image.value = m_shell->field().cell(m_shell->field().locate(point)).value(point);
          return image;
        }
      }
    typename internal::Facet_on_curve<Shell>::Hit hit;
    const typename Target::Index near = hint.facet < m_target->traced_facets().number_of_facets() ? hint.facet
                                                                                                  : Target::npos;
    image.status = internal::Facet_on_curve<Shell>(*m_shell, m_target->traced_facets(), m_tolerance)(start, near, hit);
    if(image.status != Flow_status::SUCCESS) return image;
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
  /// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
  /// \tparam PointRange a random access range of points
  /// \tparam Visitor a model of `FlowVisitor`
  /// \return the images in the same order; images that were not computed because the visitor stopped are `CANCELED`
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange,
            typename Visitor = Default_flow_visitor>
  std::vector<Image> project(const PointRange& points, Visitor&& visitor = Visitor()) const
  {
    return internal::project_all<ConcurrencyTag>(*this, points, visitor);
  }

  /// returns the differential of the flow from a point to its image, and of the map from the truncated mesh to the mesh
  /// if tips are replaced. Apply `Flow_differential::onto_plane()` with the facet's normal, or
  /// `Flow_differential::onto_level_set()`, which does not jump between facets. If the point has no image, the status
  /// is that of the image.
  /// \pre `image` is the image of `p`
  template <typename Point>
  Flow_differential differential(const Point& p, const Image& image) const
  {
    if(!image) return internal::no_differential(image.status);
    Flow_differential d = Gradient_flow_3<Shell>(*m_shell, m_tolerance).differential(p, image.value);
    d.prepend_to_end(m_target->traced_derivative(m_target->facet_of(image.location.first), image.location.second));
    return d;
  }

private:
  const Shell* m_shell;
  std::shared_ptr<const Target> m_target;
  double m_tolerance;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_PROJECTION_3_H
