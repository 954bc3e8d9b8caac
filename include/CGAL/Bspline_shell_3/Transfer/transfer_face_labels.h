// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_FACE_LABELS_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_FACE_LABELS_H

#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/attribute_samples.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers labels of facets from the source to the target, such as materials, parts, and boundary conditions.
 * Each facet of the target gets the most frequent label of its image on the source.
 *
 * A facet is sampled at the centroids of the equal triangles into which it is divided. Among labels that are equally
 * frequent, it gets that of the facet's centroid if possible, and otherwise the first one.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceLabelMap a model of `ReadablePropertyMap` from faces of the source to labels that can be compared for
 *   equality
 * \tparam TargetLabelMap a model of `WritablePropertyMap` from faces of the target
 * \param map the map from the source to the target
 * \param source_labels the labels of the source
 * \param target_labels receives the labels of the target
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{samples_per_facet}
 *       \cgalParamDescription{smallest number of samples, rounded up to the next square. With 1, the label is that at
 *         the centroid.}
 *       \cgalParamType{`std::size_t`}
 *       \cgalParamDefault{4}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for facets without a label from the source; by default, they keep their labels}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the facets without a label from the source, because none of their samples has an image, each
 *   with the reason for its centroid; it converts to `true` if there are none
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceLabelMap,
          typename TargetLabelMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_face_labels(const Map& map, SourceLabelMap source_labels, TargetLabelMap target_labels,
                                     const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename boost::property_traits<SourceLabelMap>::value_type Label;
  typedef typename Map::Projection_to_target::Target::Index Index;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const std::size_t requested_samples = choose_parameter(get_parameter(np, parameter_tags::samples_per_facet),
                                                         std::size_t(4));

  // The centroid comes first. If it is not the centroid of a part, it does not vote.
  const int parts = internal::parts_along_edge(requested_samples);
  std::vector<std::array<double, 3> > samples = internal::centroids_of_parts(parts);
  const bool has_centroid = parts % 3 != 0;
  if(!has_centroid) samples.insert(samples.begin(), { 1 / 3., 1 / 3., 1 / 3. });

  const auto& target = map.to_target().target();
  Transfer_report report;
  if(!map.maps_points()) {
    internal::fail_all_facets(report, map, [&](auto f) { internal::put_default_value(np, target_labels, f); });
    return report;
  }
  struct Sample
  {
    typename Map::Source_image::Location::first_type facet;
    Flow_status status = Flow_status::CANCELED;
    bool is_continued = false, is_snapped = false;
  };
  std::vector<Sample> found(target.number_of_facets() * samples.size());
  internal::for_each_point<ConcurrencyTag>(
    found.size(),
    [&](std::size_t n) { return target.traced_point(Index(n / samples.size()), samples[n % samples.size()]); }, visitor,
    [&, hint = typename Map::Projection_to_source::Hint()](std::size_t n, const auto& p) mutable {
      const auto image = map.to_source()(p, hint);
      found[n].facet = image.location.first;
      found[n].status = image.status;
      found[n].is_continued = image.is_continued;
      found[n].is_snapped = image.is_snapped;
    });

  std::vector<std::pair<Label, std::size_t> > votes;
  for(std::size_t n = 0; n < target.number_of_facets(); ++n) {
    votes.clear();
    bool is_continued = false, is_snapped = false;
    for(std::size_t i = 0; i < samples.size(); ++i) {
      const Sample& sample = found[n * samples.size() + i];
      if(sample.status != Flow_status::SUCCESS) continue;
      is_continued = is_continued || sample.is_continued;
      is_snapped = is_snapped || sample.is_snapped;
      const Label label = get(source_labels, sample.facet);
      auto vote = std::find_if(votes.begin(), votes.end(), [&](const auto& v) { return v.first == label; });
      if(vote == votes.end()) vote = votes.insert(vote, { label, 0 });
      if(i > 0 || has_centroid) ++vote->second;
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& v, const auto& w) { return v.second < w.second; });
    if(internal::record(report, n, most != votes.end() ? Flow_status::SUCCESS : found[n * samples.size()].status,
                        is_continued, is_snapped))
      put(target_labels, target.face_of(Index(n)), most->first);
    else internal::put_default_value(np, target_labels, target.face_of(Index(n)));
  }
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_FACE_LABELS_H
