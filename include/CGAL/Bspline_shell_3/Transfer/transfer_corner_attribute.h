// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_CORNER_ATTRIBUTE_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_CORNER_ATTRIBUTE_H

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Transfer/Barycentric_interpolation.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/attribute_samples.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Determines the edges across which the values at the corners of facets are continuous, and those where they jump.
template <typename Target>
class Seams
{
public:
  typedef typename Target::Index Index;

  // `values` belong to halfedges: a halfedge represents the corner of its face at its target.
  template <typename CornerMap>
  Seams(const Target& surface, CornerMap values) : m_surface(&surface), m_is_seam(3 * surface.number_of_facets())
  {
    const auto& mesh = surface.mesh();
    for(Index f = 0; f < surface.number_of_facets(); ++f) {
      auto h = halfedge(surface.face_of(f), mesh);
      for(int i = 0; i < 3; ++i, h = next(h, mesh))
        m_is_seam[3 * f + i] = surface.neighbor(f, i) == Target::npos
                               || !(get(values, h) == get(values, prev(opposite(h, mesh), mesh)))
                               || !(get(values, prev(h, mesh)) == get(values, opposite(h, mesh)));
    }
  }

  // Returns whether the values are continuous from facet `f` to a facet with an area that contains a point of facet
  // `g`. This facet, which replaces `g`, may be another facet if the point is on an edge or at a vertex of `g`. Only
  // neighbors of `f` are considered. If the path to the point is so short that it may also lead around a vertex, facets
  // with a common vertex are considered as well.
  bool go_on(Index f, Index& g, const std::array<double, 3>& barycentric, bool around_vertices) const
  {
    for(Index n : facets_at(g, barycentric))
      if(m_surface->has_area(n) && (n == f || is_neighbor(f, n) || (around_vertices && is_around_vertex(f, n)))) {
        g = n;
        return true;
      }
    return false;
  }

private:
  bool is_neighbor(Index f, Index n) const
  {
    for(int i = 0; i < 3; ++i)
      if(m_surface->neighbor(f, i) == n && !m_is_seam[3 * f + i]) return true;
    return false;
  }

  // Returns whether `n` is reached from `f` around a vertex, without crossing seams.
  bool is_around_vertex(Index f, Index n) const
  {
    for(int side = 0; side < 2; ++side)
      for(int i = 0; i < 3; ++i) {
        Index facet = f;
        int edge = i; // leaves the vertex or leads to it
        while(!m_is_seam[3 * facet + edge]) {
          const Index g = m_surface->neighbor(facet, edge);
          if(g == n) return true;
          if(g == f) break;
          edge = (opposite_edge(facet, edge) + (side == 0 ? 1 : 2)) % 3;
          facet = g;
        }
      }
    return false;
  }

  // Returns the index of an edge in the facet on its other side.
  int opposite_edge(Index facet, int edge) const
  {
    const auto& mesh = m_surface->mesh();
    auto h = halfedge(m_surface->face_of(facet), mesh);
    for(int i = 0; i < edge; ++i) h = next(h, mesh);
    h = opposite(h, mesh);
    auto g = halfedge(face(h, mesh), mesh);
    for(int i = 0;; ++i, g = next(g, mesh))
      if(g == h) return i;
  }

  // Returns the facets that contain a point of `f`, beginning with `f`, across edges that are not on the border.
  std::vector<Index> facets_at(Index f, const std::array<double, 3>& barycentric) const
  {
    std::vector<Index> result{ f };
    int zeros = 0, corner = 0;
    for(int i = 0; i < 3; ++i) {
      if(barycentric[i] <= on_edge) ++zeros;
      else corner = i;
    }
    if(zeros == 1) {
      for(int i = 0; i < 3; ++i)
        if(barycentric[(i + 2) % 3] <= on_edge && m_surface->neighbor(f, i) != Target::npos)
          result.push_back(m_surface->neighbor(f, i));
    } else if(zeros == 2) {
      const auto& mesh = m_surface->mesh();
      auto h = halfedge(m_surface->face_of(f), mesh);
      for(int i = 0; i < (corner + 2) % 3; ++i) h = next(h, mesh); // halfedge to the corner
      for(auto g : halfedges_around_target(h, mesh))
        if(face(g, mesh) != boost::graph_traits<typename Target::Mesh>::null_face())
          result.push_back(m_surface->facet_of(face(g, mesh)));
    }
    return result;
  }

  static constexpr double on_edge = 1e-6; // barycentric coordinate

  const Target* m_surface;
  std::vector<char> m_is_seam;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers values at the corners of facets from the source to the target: texture coordinates, and other
 * attributes that jump at seams.
 *
 * A halfedge represents the corner of its face at its target vertex. Seams are the edges of the source where the values
 * of the two facets differ. Facets of the target are not stretched across a seam: the source is followed from facet to
 * facet along a path from the centroid of a facet of the target to each of its corners. If this path meets a seam, the
 * value at the corner is extrapolated from there, so that the whole facet has values of one side of the seam.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceCornerMap a model of `ReadablePropertyMap` from halfedges of the source, whose values can be compared
 *   for equality. It may be read concurrently.
 * \tparam TargetCornerMap a model of `WritablePropertyMap` from halfedges of the target
 * \param map the map from the source to the target
 * \param source_values the values of the source
 * \param target_values receives the values of the target
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{interpolation}
 *       \cgalParamDescription{a model of `AttributeInterpolation` that may extrapolate}
 *       \cgalParamDefault{`Barycentric_interpolation`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for all corners of facets without values from the source; by default, they keep
 *         their values}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the facets without values from the source, each with the reason, and the facets that lie across
 *   seams; it converts to `true` if all facets have values
 * \cgalHeading{Cost} Four points are moved for a facet that meets few facets of the source, and more near seams.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceCornerMap,
          typename TargetCornerMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_corner_attribute(const Map& map, SourceCornerMap source_values, TargetCornerMap target_values,
                                          const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename boost::property_traits<SourceCornerMap>::value_type Value;
  typedef typename Map::Projection_to_source::Target Source;
  typedef typename Map::Projection_to_target::Target Target;
  typedef typename Source::Index Index;
  typedef typename Map::Projection_to_source::Hint Hint;
  typedef std::array<double, 3> Coordinates;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const auto interpolate = choose_parameter(get_parameter(np, parameter_tags::interpolation),
                                            Barycentric_interpolation());

  const auto put_default_values = [&](auto f) {
    for(auto h : halfedges_around_face(halfedge(f, map.target()), map.target()))
      internal::put_default_value(np, target_values, h);
  };
  const Source& source = map.to_source().target();
  const Target& target = map.to_target().target();
  Transfer_report report;
  if(!map.maps_points()) {
    internal::fail_all_facets(report, map, put_default_values);
    return report;
  }
  const internal::Seams<Source> seams(source, source_values);

  // The origin of the value at a corner: a facet of the source, and the weights of its corners.
  struct Corner
  {
    Index facet;
    Coordinates weights;
  };
  struct Facet
  {
    Flow_status status = Flow_status::CANCELED;
    bool across = false, is_continued = false, is_snapped = false;
    std::array<Corner, 3> corners;
  };
  std::vector<Facet> facets(target.number_of_facets());

  // Follows a facet from its centroid to a corner.
  const auto follow = [&](Index n, int corner, Index from, Hint& hint, Facet& result) {
    const auto at = [&](double t) {
      Coordinates barycentric;
      for(int i = 0; i < 3; ++i) barycentric[i] = (1 - t) / 3 + (i == corner ? t : 0);
      return barycentric;
    };
    const auto traced = [&](double t) { return target.traced_point(typename Target::Index(n), at(t)); };
    constexpr double shortest = 1. / 1024;
    double t = 0, step = 1;
    auto image = map.to_source()(traced(t), hint);
    Index facet = from;
    while(t < 1) {
      const double next = (std::min)(t + step, 1.);
      const auto there = map.to_source()(traced(next), hint);
      if(!there) {
        result.status = there.status;
        return;
      }
      result.is_continued = result.is_continued || there.is_continued;
      result.is_snapped = result.is_snapped || there.is_snapped;
      Index g = source.facet_of(there.location.first);
      if(seams.go_on(facet, g, there.location.second, step <= shortest)) {
        facet = g;
        t = next;
        image = there;
        step *= 2;
      } else if(step > shortest) {
        step /= 2;
      } else {
        break;
      }
    }
    const Coordinates q = { image.point[0], image.point[1], image.point[2] };
    result.corners[corner] = { facet, source.position(facet, q).barycentric };
    if(t == 1) return;
    // Beyond the seam, values are continued linearly by the differential of the inverse map on this side.
    result.across = true;
    const auto& normal = source.normal(facet);
    Flow_differential d = image.is_continued ? internal::orthogonal_differential(normal)
                                             : map.to_source().differential(traced(t), image);
    d.append_to_start(target.traced_derivative(typename Target::Index(n), at(t)));
    if(!d) {
      result.status = d.status;
      return;
    }
    if(internal::is_along(normal, d)) {
      result.status = Flow_status::WRONG_ORIENTATION;
      return;
    }
    const Coordinates here = target.point(typename Target::Index(n), at(t)),
                      &end = target.vertex(typename Target::Index(n), corner);
    const Eigen::Vector3d step_on_source = d.onto_plane(Eigen::Vector3d(normal[0], normal[1], normal[2]))
                                           * Eigen::Vector3d(end[0] - here[0], end[1] - here[1], end[2] - here[2]);
    const Coordinates beyond = { q[0] + step_on_source[0], q[1] + step_on_source[1], q[2] + step_on_source[2] };
    result.corners[corner].weights = source.position(facet, beyond).barycentric;
  };

  internal::for_each_point<ConcurrencyTag>(
    facets.size(),
    [&](std::size_t n) {
      return target.traced_point(typename Target::Index(n), { 1 / 3., 1 / 3., 1 / 3. });
    },
    visitor,
    [&, hint = Hint()](std::size_t n, const auto& p) mutable {
      Facet& result = facets[n];
      const auto center = map.to_source()(p, hint);
      result.status = center.status;
      result.is_continued = center.is_continued;
      result.is_snapped = center.is_snapped;
      for(int corner = 0; corner < 3 && result.status == Flow_status::SUCCESS; ++corner)
        follow(Index(n), corner, source.facet_of(center.location.first), hint, result);
    });

  for(std::size_t n = 0; n < facets.size(); ++n) {
    if(!internal::record(report, n, facets[n].status, facets[n].is_continued, facets[n].is_snapped)) {
      put_default_values(target.face_of(typename Target::Index(n)));
      continue;
    }
    if(facets[n].across) report.facets_across_seams.push_back(n);
    // halfedge to the first corner
    auto h = prev(halfedge(target.face_of(typename Target::Index(n)), map.target()), map.target());
    for(const Corner& corner : facets[n].corners) {
      // halfedge from the first corner to the second
      const auto g = halfedge(source.face_of(corner.facet), map.source());
      const std::array<Value, 3> values = { { get(source_values, prev(g, map.source())), get(source_values, g),
                                              get(source_values, next(g, map.source())) } };
      put(target_values, h, interpolate(values, corner.weights));
      h = next(h, map.target());
    }
  }
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_CORNER_ATTRIBUTE_H
