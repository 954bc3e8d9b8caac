// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_MAP_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_MAP_3_H

#include <CGAL/Bspline_shell_3/Certificate/Shell_cover_3.h>
#include <CGAL/Bspline_shell_3/Certificate/match_components.h>
#include <CGAL/Bspline_shell_3/Mesh/closing_argument.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_target_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_projection_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/component_paths.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the map from one mesh in a shell to another mesh, along the integral curves of the shell's field.
 *
 * If the shell and both meshes are certified (`Shell_certificate_3`), the map is one-to-one; for simplified borders,
 * see \ref BsplineShell3OpenBorder. Certificates are not required, but the constructor compares the components of the
 * shell in which the two meshes lie:
 * - If the shell is certified, and each mesh is closed or has the border of its closing, each component of the shell is
 *   tested: a mesh is found in it if it has a vertex there, or crosses a path through it. If a mesh is not found, the
 *   status is `COMPONENTS_DIFFER`, and no points are mapped. If all paths through the component meet an edge or a
 *   vertex of the mesh, the status is `COMPONENTS_UNKNOWN`.
 * - Otherwise, segments through the shell are constructed at the largest facets of each component of both meshes. If
 *   each component of either mesh meets such a segment that also meets the other mesh, the status is `SUCCESS`;
 *   otherwise, it is `COMPONENTS_UNKNOWN`. Points are mapped in both cases.
 *
 * The map stores an AABB tree for each mesh, which it shares with its copies and with its inverse. Const member
 * functions may be called concurrently. The shell and the meshes must outlive the map and must not change.
 *
 * \tparam Shell_ a `CGAL::Bspline_shell_3`
 * \tparam SourceMesh_ a model of `FaceListGraph`
 * \tparam TargetMesh_ a model of `FaceListGraph`
 * \tparam ProjectionToSource_ projection of points of the shell onto the source, callable with and without a `Hint`;
 *   projections other than the default are for polygon soups (`Soup_map_3`), for which components are not compared
 * \tparam ProjectionToTarget_ projection of points of the shell onto the target
 */
template <typename Shell_, typename SourceMesh_, typename TargetMesh_ = SourceMesh_,
          typename ProjectionToSource_ = Shell_projection_3<Shell_, SourceMesh_>,
          typename ProjectionToTarget_ = Shell_projection_3<Shell_, TargetMesh_> >
class Shell_map_3
{
public:
  typedef Shell_ Shell;
  typedef SourceMesh_ Source_mesh;
  typedef TargetMesh_ Target_mesh;
  typedef ProjectionToSource_ Projection_to_source;
  typedef ProjectionToTarget_ Projection_to_target;
  typedef typename Projection_to_source::Image Source_image;
  typedef typename Projection_to_target::Image Target_image;
  typedef typename Projection_to_source::Location Source_location; ///< facet and barycentric coordinates
  typedef typename Projection_to_target::Location Target_location;
  typedef typename Projection_to_target::Coordinates Coordinates;
  typedef typename boost::graph_traits<Source_mesh>::vertex_descriptor Source_vertex;

  /// prepares the map. If a mesh has facets that are not triangles, or coordinates that are not finite, all images have
  /// the status `INVALID_MESH`.
  /// \param shell a shell; if it is not valid (`!shell`), all images have the status `NO_SHELL`
  /// \param source a mesh in the shell
  /// \param target another mesh in the shell
  /// \param np_source optional named parameters for the source; `tolerance` applies to both directions
  ///   \cgalNamedParamsBegin
  ///     \cgalParamNBegin{vertex_point_map}
  ///       \cgalParamDescription{a property map from the vertices of the source to their points}
  ///       \cgalParamType{a model of `ReadablePropertyMap`}
  ///       \cgalParamDefault{`get(CGAL::vertex_point, source)`}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{closing}
  ///       \cgalParamDescription{triangles that close the source, as for `Shell_projection_3`. If both meshes have the
  ///         border of `Bspline_shell_3::closing()`, no closings need to be passed.}
  ///       \cgalParamType{`Shell_closing_3`, or a shared pointer to one, which may be null}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{tolerance}
  ///       \cgalParamDescription{tolerance of the tracing in both directions, as for `Gradient_flow_3`, in the units of
  ///         the coordinates}
  ///       \cgalParamType{`double`}
  ///       \cgalParamDefault{`Gradient_flow_3::default_tolerance()`}
  ///     \cgalParamNEnd
  ///   \cgalNamedParamsEnd
  /// \param np_target optional named parameters for the target; `tolerance` is a compile-time error here
  ///   \cgalNamedParamsBegin
  ///     \cgalParamNBegin{vertex_point_map}
  ///       \cgalParamDescription{a property map from the vertices of the target to their points}
  ///       \cgalParamType{a model of `ReadablePropertyMap`}
  ///       \cgalParamDefault{`get(CGAL::vertex_point, target)`}
  ///     \cgalParamNEnd
  ///     \cgalParamNBegin{closing}
  ///       \cgalParamDescription{triangles that close the target}
  ///     \cgalParamNEnd
  ///   \cgalNamedParamsEnd
  template <typename T1 = bool, typename Tag1 = internal_np::all_default_t, typename Base1 = internal_np::No_property,
            typename T2 = bool, typename Tag2 = internal_np::all_default_t, typename Base2 = internal_np::No_property>
  Shell_map_3(const Shell& shell, const Source_mesh& source, const Target_mesh& target,
              const CGAL::Named_function_parameters<T1, Tag1, Base1>& np_source = CGAL::parameters::default_values(),
              const CGAL::Named_function_parameters<T2, Tag2, Base2>& np_target = CGAL::parameters::default_values())
    : Shell_map_3(prepare<Projection_to_source>(shell, source, np_source, tolerance(np_source)),
                  prepare<Projection_to_target>(shell, target, np_target, tolerance(np_source)))
  {
    static_assert(CGAL::parameters::is_default_parameter<CGAL::Named_function_parameters<T2, Tag2, Base2>,
                                                         parameter_tags::tolerance_t>::value,
                  "The tolerance of both directions is a parameter of np_source.");
  }

  // Temporaries would dangle.
  template <typename... NP>
  Shell_map_3(const Shell&&, const Source_mesh&, const Target_mesh&, const NP&...) = delete;
  template <typename... NP>
  Shell_map_3(const Shell&, const Source_mesh&&, const Target_mesh&, const NP&...) = delete;
  template <typename... NP>
  Shell_map_3(const Shell&, const Source_mesh&, const Target_mesh&&, const NP&...) = delete;

  /// constructs the map between the meshes of two projections
  /// \pre both refer to the same shell object
  Shell_map_3(Projection_to_source to_source, Projection_to_target to_target)
    : m_to_source(std::move(to_source)), m_to_target(std::move(to_target))
  {
    if(!shell()) m_status = Flow_status::NO_SHELL;
    else if(!m_to_source.target().is_valid() || !m_to_target.target().is_valid()) m_status = Flow_status::INVALID_MESH;
    else if constexpr(std::is_same<Projection_to_source, Shell_projection_3<Shell, Source_mesh> >::value
                      && std::is_same<Projection_to_target, Shell_projection_3<Shell, Target_mesh> >::value)
      m_status = compare_components();
  }

  /// returns `SUCCESS` or `COMPONENTS_UNKNOWN` if points are mapped, and otherwise the status of all images
  Flow_status status() const { return m_status; }
  /// returns whether points are mapped; each image then has its own status
  bool maps_points() const { return m_status == Flow_status::SUCCESS || m_status == Flow_status::COMPONENTS_UNKNOWN; }

  const Shell& shell() const { return m_to_target.shell(); }
  const Source_mesh& source() const { return m_to_source.target().mesh(); }
  const Target_mesh& target() const { return m_to_target.target().mesh(); }
  const Projection_to_source& to_source() const { return m_to_source; } ///< maps any point of the shell
  const Projection_to_target& to_target() const { return m_to_target; } ///< maps any point of the shell

  /// returns the inverse map, in constant time
  Shell_map_3<Shell, Target_mesh, Source_mesh, Projection_to_target, Projection_to_source> inverse() const
  {
    return { m_to_target, m_to_source, m_status };
  }

  /// returns the coordinates of a location on the source
  Coordinates point(const Source_location& location) const
  {
    return m_to_source.target().point(m_to_source.target().facet_of(location.first), location.second);
  }

  /// returns the point from which the curve through a location is traced; it lies on the truncated source if the shell
  /// truncates tips
  Coordinates traced_point(const Source_location& location) const
  {
    return m_to_source.target().traced_point(m_to_source.target().facet_of(location.first), location.second);
  }

  /// returns the image on the target of a location on the source
  Target_image operator()(const Source_location& location) const
  {
    if(!maps_points()) return refused();
    return m_to_target(traced_point(location));
  }

  /// returns the image on the target of a vertex of the source
  /// \pre the vertex is not isolated
  Target_image operator()(Source_vertex v) const
  {
    CGAL_precondition(halfedge(v, source()) != boost::graph_traits<Source_mesh>::null_halfedge());
    return (*this)(Polygon_mesh_processing::locate_vertex<double>(v, source()));
  }

  /// returns the differential of the flow from a location to its image. `Flow_differential::onto_plane()` with the
  /// normal of the facet of the image converts it to the differential of the map, and
  /// `Flow_differential::onto_level_set()` to that of the map into a level set. If the location has no image, the
  /// status is that of the image.
  /// \pre `image` is the image of `location`
  Flow_differential differential(const Source_location& location, const Target_image& image) const
  {
    if(!image) return internal::no_differential(image.status);
    Flow_differential d = m_to_target.differential(traced_point(location), image);
    d.append_to_start(
      m_to_source.target().traced_derivative(m_to_source.target().facet_of(location.first), location.second));
    return d;
  }

  /// returns the images of many locations, like `Shell_projection_3::project()`.
  /// \tparam LocationRange a random access range of `Source_location`
  template <typename ConcurrencyTag = Parallel_if_available_tag, typename LocationRange,
            typename Visitor = Default_flow_visitor>
  std::vector<Target_image> project(const LocationRange& locations, Visitor&& visitor = Visitor()) const
  {
    std::vector<Target_image> images(std::size_t(std::end(locations) - std::begin(locations)));
    if(!maps_points()) {
      std::fill(images.begin(), images.end(), refused());
      return images;
    }
    internal::for_each_point<ConcurrencyTag>(
      images.size(), [&](std::size_t n) { return traced_point(*(std::begin(locations) + std::ptrdiff_t(n))); }, visitor,
      [&, hint = typename Projection_to_target::Hint()](std::size_t n, const auto& p) mutable {
        images[n] = m_to_target(p, hint);
      });
    return images;
  }

private:
  template <typename, typename, typename, typename, typename>
  friend class Shell_map_3;

  Shell_map_3(Projection_to_source to_source, Projection_to_target to_target, Flow_status status)
    : m_to_source(std::move(to_source)), m_to_target(std::move(to_target)), m_status(status)
  {}

  Target_image refused() const
  {
    Target_image image;
    image.status = m_status;
    return image;
  }

  Flow_status compare_components() const
  {
    const auto& source = m_to_source.target();
    const auto& target = m_to_target.target();
    if(shell().is_certified() && is_closed(source) && is_closed(target))
      return (std::max)(find_missed_component(source), find_missed_component(target));
    const bool are_shared = internal::share_components(shell(), source.traced_facets(), target.traced_facets());
    return are_shared ? Flow_status::SUCCESS : Flow_status::COMPONENTS_UNKNOWN;
  }

  // Returns the closing of a mesh: its own, or that of the shell. It may be null.
  template <typename Target>
  const std::shared_ptr<const Shell_closing_3>& closing_of(const Target& target) const
  {
    return target.closing() ? target.closing() : shell().closing();
  }

  // Returns whether a mesh is closed, or is closed by its closing. For other open meshes, crossings depend on the path.
  template <typename Target>
  bool is_closed(const Target& target) const
  {
    return target.traced_facets().is_closed() || has_border_of_closing(target);
  }

  // Returns `COMPONENTS_DIFFER` if a component of the shell contains no part of a mesh. Returns `COMPONENTS_UNKNOWN` if
  // all paths through it are degenerate and no vertex is known to be in it, and otherwise `SUCCESS`.
  // \pre the shell is certified, and `is_closed()` holds
  template <typename Target>
  Flow_status find_missed_component(const Target& target) const
  {
    typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point;
    const std::vector<Crossing_path> paths = shell().component_paths();
    const auto& traced = target.traced_facets();
    std::size_t number;
    const std::vector<typename Target::Index> component = traced.components(number);
    const Shell_closing_3* closing = closing_of(target).get();
    const std::size_t facets = traced.number_of_facets(),
                      all = facets + (traced.is_closed() ? 0 : closing->triangles().size());
    const auto point = [](const Coordinates& p) { return Point(p[0], p[1], p[2]); };
    const Component_match match = match_components(
      paths, number + (all > facets ? 1 : 0), all,
      [&](std::size_t n) {
        std::array<Point, 3> t;
        for(int i = 0; i < 3; ++i)
          t[i] = n < facets ? point(traced.vertex(typename Target::Index(n), i))
                            : point(closing->points()[closing->triangles()[n - facets][i]]);
        return t;
      },
      [&](std::size_t n) { return n < facets ? std::size_t(component[n]) : number; });
    std::vector<char> is_missed(match.crossings.size(), 0);
    for(std::size_t k = 0; k < match.crossings.size(); ++k) is_missed[k] = match.crossings[k].value_or(0) == 0;
    for(std::size_t k : match.component_of_shell)
      if(k != Component_match::none) is_missed[k] = 0;
    const auto found = [&] {
      Flow_status worst = Flow_status::SUCCESS;
      for(std::size_t k = 0; k < is_missed.size(); ++k) {
        const Flow_status status = match.crossings[k] ? Flow_status::COMPONENTS_DIFFER
                                                      : Flow_status::COMPONENTS_UNKNOWN;
        if(is_missed[k]) worst = (std::max)(worst, status);
      }
      return worst;
    };
    if(found() == Flow_status::SUCCESS || !shell().proved_cover()) return found();
    // A path may miss an uncertified mesh in its component, so vertices are located as well. If components of the shell
    // share a component of the cover, the cover cannot assign a vertex to one of them.
    std::vector<char> has_boxes(is_missed.size(), 0);
    for(const Cover_box& box : *shell().proved_cover())
      if(box.component < has_boxes.size()) has_boxes[box.component] = 1;
    if(std::find(has_boxes.begin(), has_boxes.end(), 0) != has_boxes.end()) return found();
    Shell_cover_3<typename Shell::Field, typename Shell::Threshold> cover(shell().field(), shell().inner_threshold(),
                                                                          shell().outer_threshold());
    cover.adopt(*shell().proved_cover());
    for(const Coordinates& v : target.traced_vertices()) {
      const std::uint32_t k = cover.component(typename Shell::Point_3(v[0], v[1], v[2]));
      if(k < is_missed.size()) is_missed[k] = 0;
    }
    return found();
  }

  template <typename Target>
  bool has_border_of_closing(const Target& target) const
  {
    const Shell_closing_3* closing = closing_of(target).get();
    if(!closing) return false;
    for(std::size_t n = 0; n < closing->number_of_border_points(); ++n)
      if(!target.border_corner(closing->points()[n])) return false;
    return true;
  }

  template <typename NamedParameters>
  static double tolerance(const NamedParameters& np)
  {
    return CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, parameter_tags::tolerance), 0.);
  }

  template <typename Projection, typename TriangleMesh, typename NamedParameters>
  static Projection prepare(const Shell& shell, const TriangleMesh& mesh, const NamedParameters& np, double tolerance)
  {
    auto vpm = CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, internal_np::vertex_point),
                                                  get_const_property_map(CGAL::vertex_point, mesh));
    auto target = std::make_shared<const typename Projection::Target>(mesh, vpm, shell.truncation(),
                                                                      internal::closing_argument(np, nullptr));
    return Projection(shell, std::move(target), tolerance);
  }

  Projection_to_source m_to_source;
  Projection_to_target m_to_target;
  Flow_status m_status = Flow_status::SUCCESS;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_SHELL_MAP_3_H
