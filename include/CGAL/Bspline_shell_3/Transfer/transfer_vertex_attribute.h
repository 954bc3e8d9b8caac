// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_VERTEX_ATTRIBUTE_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_VERTEX_ATTRIBUTE_H

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Transfer/Barycentric_interpolation.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/attribute_samples.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers values of vertices from the source to the target: scalars, colors, vectors, displacements, and other
 * values that can be interpolated.
 *
 * A vertex of the target gets the value at the point where the integral curve through the vertex meets the source. It
 * is interpolated from the three corners of the facet there. If `mapping()` is given, it converts this value by the
 * differential of the map; for example, it turns vectors as the map does. Values are sampled, which does not preserve
 * integrals. If the source has far more vertices than the target, `average_vertex_attribute()` loses less detail. The
 * property maps are read and written only by the calling thread.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceValueMap a model of `ReadablePropertyMap` from vertices of the source
 * \tparam TargetValueMap a model of `WritablePropertyMap` from vertices of the target. Here, the facets of the target
 *   need not be triangles, although `Shell_map_3::status()` is then `INVALID_MESH`.
 * \param map the map from the source to the target; its inverse transfers in the other direction
 * \param source_values the values of the source
 * \param target_values receives the values of the target
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{interpolation}
 *       \cgalParamDescription{a model of `AttributeInterpolation`}
 *       \cgalParamDefault{`Barycentric_interpolation`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{mapping}
 *       \cgalParamDescription{a function that is called as `mapping(value, differential)`, with the `Flow_differential`
 *         from the source to the target, and returns the value for the vertex; by default, values are not changed}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for vertices without a value from the source; by default, they keep their values}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the vertices without a value from the source, each with the reason; it converts to `true` if
 *   there are none
 * \cgalHeading{Cost} A few microseconds of processor time per vertex; with `mapping()`, about twice as much.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceValueMap,
          typename TargetValueMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_vertex_attribute(const Map& map, SourceValueMap source_values, TargetValueMap target_values,
                                          const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  typedef typename boost::property_traits<SourceValueMap>::value_type Value;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const auto interpolate = choose_parameter(get_parameter(np, parameter_tags::interpolation),
                                            Barycentric_interpolation());
  constexpr bool has_mapping = !CGAL::parameters::is_default_parameter<CGAL_NP_CLASS, parameter_tags::mapping_t>::value;

  const auto& points = map.to_target().target().traced_vertices();
  std::vector<Flow_differential> differentials(has_mapping ? points.size() : 0);
  std::vector<typename Map::Source_image> images(points.size());
  internal::for_each_point<ConcurrencyTag>(
    points.size(), [&](std::size_t n) { return points[n]; }, visitor,
    [&, hint = typename Map::Projection_to_source::Hint()](std::size_t n, const auto& p) mutable {
      if(map.status() == Flow_status::COMPONENTS_DIFFER) images[n].status = map.status();
      else images[n] = map.to_source()(p, hint); // the target's facets do not matter
      if constexpr(has_mapping)
        if(images[n]) {
          differentials[n] = internal::differential_from_image(map, images[n], p);
          images[n].status = differentials[n].status;
        }
    });

  Transfer_report report;
  std::size_t n = 0;
  for(auto v : vertices(map.target())) {
    if(internal::record(report, n, images[n].status, images[n].is_continued, images[n].is_snapped)) {
      const Value value = interpolate(internal::corner_values(map.source(), images[n].location.first, source_values),
                                      images[n].location.second);
      if constexpr(has_mapping)
        put(target_values, v, get_parameter_reference(np, parameter_tags::mapping)(value, differentials[n]));
      else put(target_values, v, value);
    } else internal::put_default_value(np, target_values, v);
    ++n;
  }
  return report;
}

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers values of vertices from the source to the target, as averages: each vertex of the target gets the
 * mean of the values of the source's vertices whose images lie on its facets.
 *
 * Each vertex of the source is mapped to a facet of the target, and contributes its value to the three corners of this
 * facet. Its weight at a corner is the barycentric coordinate of the image, multiplied by the area around the vertex on
 * the source. Averages of integers are rounded. Vertices of the target without contributions get the value of
 * `transfer_vertex_attribute()`.
 *
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceValueMap a model of `ReadablePropertyMap` from vertices of the source to values with `T + T` and
 *   `double * T`
 * \tparam TargetValueMap a model of `WritablePropertyMap` from vertices of the target
 * \param map the map from the source to the target
 * \param source_values the values of the source
 * \param target_values receives the values of the target
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for vertices without a value from the source; by default, they keep their values}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the vertices of the target without a value (all vertices if the visitor stopped), and the
 *   vertices of the source without an image, which do not contribute
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceValueMap,
          typename TargetValueMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report average_vertex_attribute(const Map& map, SourceValueMap source_values, TargetValueMap target_values,
                                         const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter_reference;
  typedef typename boost::property_traits<SourceValueMap>::value_type Value;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);

  const auto& source = map.to_source().target();
  const auto& target = map.to_target().target();
  Transfer_report report;
  if(!map.maps_points()) {
    std::size_t n = 0;
    for(auto v : vertices(map.target())) {
      internal::record(report, n++, map.status());
      internal::put_default_value(np, target_values, v);
    }
    return report;
  }
  const auto& points = source.traced_vertices();
  std::vector<typename Map::Target_image> images(points.size());
  const bool complete = internal::for_each_point<ConcurrencyTag>(
    points.size(), [&](std::size_t n) { return points[n]; }, visitor,
    [&, hint = typename Map::Projection_to_target::Hint()](std::size_t n, const auto& p) mutable {
      images[n] = map.to_target()(p, hint);
    });

  // The area around a vertex is a third of the area of its facets.
  const std::vector<std::size_t> position = internal::positions_of_corners(source);
  std::vector<double> area(points.size(), 0);
  for(std::size_t c = 0; c < position.size(); ++c) {
    const auto& n = source.normal(typename std::decay_t<decltype(source)>::Index(c / 3));
    area[position[c]] += internal::norm(n) / 6;
  }
  const std::vector<std::size_t> target_position = internal::positions_of_corners(target);
  // Numbers are summed as doubles, because integers would lose their fractions in each sum.
  typedef std::conditional_t<std::is_arithmetic<Value>::value, double, Value> Sum;
  std::vector<std::optional<Sum> > sum(target.traced_vertices().size());
  std::vector<double> weight(sum.size(), 0);
  std::vector<char> is_continued(sum.size(), 0), is_snapped(sum.size(), 0);
  std::size_t n = 0;
  for(auto v : vertices(map.source())) {
    const auto& image = images[n];
    if(image) {
      for(std::size_t i = 0; i < 3; ++i) {
        const double w = area[n] * image.location.second[i];
        if(!(w > 0)) continue;
        const std::size_t t = target_position[3 * std::size_t(target.facet_of(image.location.first)) + i];
        const Sum share = w * get(source_values, v);
        sum[t] = sum[t] ? Sum(*sum[t] + share) : share;
        weight[t] += w;
        if(image.is_continued) is_continued[t] = 1;
        if(image.is_snapped) is_snapped[t] = 1;
      }
    } else report.left_out.emplace_back(n, image.status);
    ++n;
  }
  std::vector<typename Map::Source_image> pulled(sum.size());
  std::vector<std::size_t> missed;
  for(std::size_t t = 0; t < sum.size(); ++t)
    if(!sum[t]) missed.push_back(t);
  if(complete)
    internal::for_each_point<ConcurrencyTag>(
      missed.size(), [&](std::size_t i) { return target.traced_vertices()[missed[i]]; }, visitor,
      [&, hint = typename Map::Projection_to_source::Hint()](std::size_t i, const auto& p) mutable {
        pulled[missed[i]] = map.to_source()(p, hint);
        is_continued[missed[i]] = pulled[missed[i]].is_continued;
        is_snapped[missed[i]] = pulled[missed[i]].is_snapped;
      });
  n = 0;
  for(auto v : vertices(map.target())) {
    if(internal::record(report, n,
                        !complete ? Flow_status::CANCELED
                        : sum[n]  ? Flow_status::SUCCESS
                                  : pulled[n].status,
                        is_continued[n] != 0, is_snapped[n] != 0)) {
      if(sum[n]) {
        if constexpr(std::is_integral<Value>::value) put(target_values, v, Value(std::lround(*sum[n] / weight[n])));
        else put(target_values, v, Value(1 / weight[n] * *sum[n]));
      } else
        put(target_values, v,
            Barycentric_interpolation()(internal::corner_values(map.source(), pulled[n].location.first, source_values),
                                        pulled[n].location.second));
    } else internal::put_default_value(np, target_values, v);
    ++n;
  }
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_VERTEX_ATTRIBUTE_H
