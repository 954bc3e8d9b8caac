// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_TANGENT_VECTORS_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_TANGENT_VECTORS_H

#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/Tangent_field.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/attribute_samples.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief maps tangent vectors of one surface to tangent vectors of another, as the parameter `mapping()` of
 * `transfer_vertex_attribute()`. Images are tangent to the level sets of the field, so that they do not jump from facet
 * to facet. Components along the curve are lost.
 */
struct Tangent_vector_mapping
{
  /// \tparam Vector a type with three coordinates, and constructible from three coordinates
  template <typename Vector>
  Vector operator()(const Vector& v, const Flow_differential& differential) const
  {
    const Eigen::Vector3d image = differential.onto_level_set() * Eigen::Vector3d(v[0], v[1], v[2]);
    return Vector(image[0], image[1], image[2]);
  }
};

namespace internal {

// Returns the vector whose rotations by multiples of 2 pi / N about the normal best fit the images of the N vectors of
// a symmetric field. The fit is that of N-th powers. Of the rotations, the one closest to the image of the first vector
// is returned. Its length is the geometric mean of the lengths of the images.
inline Eigen::Vector3d map_symmetric_vector(const Eigen::Matrix3d& differential, const Eigen::Vector3d& source_normal,
                                            const Eigen::Vector3d& target_normal, const Eigen::Vector3d& vector,
                                            int symmetry)
{
  const Eigen::Vector3d first = differential * vector;
  if(symmetry == 1 || !(first.norm() > 0)) return first;
  constexpr double pi = 3.14159265358979323846;
  const Eigen::Vector3d x = first.normalized(), y = target_normal.normalized().cross(x);
  std::complex<double> power = 0;
  double log_length = 0;
  for(int k = 0; k < symmetry; ++k) {
    const Eigen::Vector3d image = differential
                                  * (Eigen::AngleAxisd(2 * pi * k / symmetry, source_normal.normalized()) * vector);
    power += std::polar(1., symmetry * std::atan2(y.dot(image), x.dot(image)));
    log_length += std::log(image.norm());
  }
  const double angle = std::arg(power) / symmetry;
  return std::exp(log_length / symmetry) * (std::cos(angle) * x + std::sin(angle) * y);
}

// The vector of a field on the source at a point of the target.
struct Tangent_sample
{
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  Flow_status status = Flow_status::CANCELED;
  bool is_continued = false, is_snapped = false;
};

// `prepare(differential)` converts the differential to that of the map onto the target, and returns the normal of the
// plane of the image.
template <typename Map, typename Point, typename Prepare>
Tangent_sample tangent_sample(const Map& map, const Tangent_field& field, int symmetry, const Point& p,
                              typename Map::Projection_to_source::Hint& hint, const Prepare& prepare)
{
  const auto& source = map.to_source().target();
  Tangent_sample sample;
  const typename Map::Source_image image = map.to_source()(p, hint);
  sample.status = image.status;
  sample.is_continued = image.is_continued;
  sample.is_snapped = image.is_snapped;
  if(!image) return sample;
  Flow_differential differential = differential_from_image(map, image, p);
  sample.status = differential.status;
  if(!differential) return sample;
  const Eigen::Vector3d normal = prepare(differential);
  const auto facet = source.facet_of(image.location.first);
  if(is_along(normal, differential)) sample.status = Flow_status::WRONG_ORIENTATION;
  else
    sample.vector = map_symmetric_vector(differential.onto_plane(normal), eigen_vector(source.normal(facet)), normal,
                                         field(facet, image.location.second), symmetry);
  return sample;
}

template <typename VectorMap, typename Range>
std::vector<Eigen::Vector3d> eigen_vectors(VectorMap vectors, const Range& range)
{
  std::vector<Eigen::Vector3d> result;
  for(auto simplex : range) {
    const auto& v = get(vectors, simplex);
    result.emplace_back(rounded(v[0]), rounded(v[1]), rounded(v[2]));
  }
  return result;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers tangent vectors of facets from the source to the target by the differential of the map: vector
 * fields, line fields, cross fields, and other fields that are symmetric under rotations.
 *
 * A facet of the target gets the image of the vector of the source at the point where the curve through the facet's
 * centroid meets the source. The image lies in the facet's plane. A symmetric field is given by one of its vectors for
 * each facet. All of its vectors are mapped; because their images need not be symmetric, the symmetric vectors that fit
 * them best are used.
 *
 * Two parameters preserve more detail between meshes of different resolution. For a *coarser* target,
 * `samples_per_facet` averages the vectors that a facet covers. For a *finer* target, `linear_reconstruction` computes
 * a linear field from the vectors of a facet and its neighbors; without it, all facets whose centroids lie on the same
 * facet of the source get the image of the same vector.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceVectorMap a model of `ReadablePropertyMap` from faces of the source to vectors with `v[0]`, `v[1]`,
 *   `v[2]`
 * \tparam TargetVectorMap a model of `WritablePropertyMap` from faces of the target to vectors that are constructible
 *   from three numbers
 * \param map the map from the source to the target
 * \param source_vectors vectors in the planes of their facets
 * \param target_vectors receives their images
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{symmetry}
 *       \cgalParamDescription{1 for vectors (the default), 2 for lines, 4 for crosses}
 *       \cgalParamType{`int`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{samples_per_facet}
 *       \cgalParamDescription{smallest number of samples, rounded up to the next square, at the centroids of equal
 *         parts of the target's facet. The facet gets their mean: for a symmetric field, that of the N-th powers, with
 *         the mean length.}
 *       \cgalParamType{`std::size_t`}
 *       \cgalParamDefault{1}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{linear_reconstruction}
 *       \cgalParamDescription{whether the field is linear on each facet of the source (for a symmetric field, its N-th
 *         power is linear, and its length is constant). The gradient fits the vectors of the facet's neighbors best,
 *         unfolded around common edges of at most 60 degrees.}
 *       \cgalParamType{`bool`}
 *       \cgalParamDefault{`false`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for facets without a vector from the source; by default, they keep their vectors}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the facets without a vector from the source, because none of their samples has one, each with
 *   the reason for its first sample; it converts to `true` if there are none. A facet without an area gets no vector,
 *   because it has no normal.
 * \pre `symmetry` is positive
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceVectorMap,
          typename TargetVectorMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_tangent_vectors(const Map& map, SourceVectorMap source_vectors, TargetVectorMap target_vectors,
                                         const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename boost::property_traits<TargetVectorMap>::value_type Vector;
  typedef typename Map::Projection_to_target::Target::Index Index;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const int symmetry = choose_parameter(get_parameter(np, parameter_tags::symmetry), 1);
  const bool is_linear = choose_parameter(get_parameter(np, parameter_tags::linear_reconstruction), false);
  const std::size_t requested_samples = choose_parameter(get_parameter(np, parameter_tags::samples_per_facet),
                                                         std::size_t(1));
  CGAL_precondition(symmetry > 0);

  const auto& source = map.to_source().target();
  const auto& target = map.to_target().target();
  Transfer_report report;
  if(!map.maps_points()) {
    internal::fail_all_facets(report, map, [&](auto f) { internal::put_default_value(np, target_vectors, f); });
    return report;
  }
  std::vector<Eigen::Vector3d> vectors = internal::eigen_vectors(source_vectors, faces(map.source()));
  typedef internal::Tangent_field Field;
  const Field field = is_linear ? Field::linear(source, std::move(vectors), symmetry)
                                : Field::constant(source, std::move(vectors));
  const std::vector<std::array<double, 3> > places = internal::centroids_of_parts(
    internal::parts_along_edge(requested_samples));
  const auto normal = [&](Index facet) { return internal::eigen_vector(target.normal(facet)); };

  std::vector<internal::Tangent_sample> samples(target.number_of_facets() * places.size());
  internal::for_each_point<ConcurrencyTag>(
    samples.size(),
    [&](std::size_t n) { return target.traced_point(Index(n / places.size()), places[n % places.size()]); }, visitor,
    [&, hint = typename Map::Projection_to_source::Hint()](std::size_t n, const auto& p) mutable {
      const Index facet = Index(n / places.size());
      samples[n] = internal::tangent_sample(map, field, symmetry, p, hint, [&](Flow_differential& differential) {
        differential.prepend_to_end(target.traced_derivative(facet, places[n % places.size()]));
        return normal(facet);
      });
    });

  for(std::size_t n = 0; n < target.number_of_facets(); ++n) {
    internal::Symmetric_mean mean(normal(Index(n)), symmetry);
    Flow_status status = samples[n * places.size()].status;
    bool is_continued = false, is_snapped = false;
    std::size_t arrived = 0;
    for(std::size_t i = 0; i < places.size(); ++i) {
      const internal::Tangent_sample& sample = samples[n * places.size() + i];
      if(sample.status != Flow_status::SUCCESS) continue;
      status = sample.status;
      is_continued = is_continued || sample.is_continued;
      is_snapped = is_snapped || sample.is_snapped;
      mean.add(sample.vector, 1);
      ++arrived;
    }
    const auto g = target.face_of(Index(n));
    if(internal::record(report, n, status, is_continued, is_snapped)) {
      // One vector is its own mean, except for rounding.
      const Eigen::Vector3d v = arrived == 1 && places.size() == 1 ? samples[n].vector : mean();
      put(target_vectors, g, Vector(v[0], v[1], v[2]));
    } else internal::put_default_value(np, target_vectors, g);
  }
  return report;
}

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief transfers tangent vectors of vertices from the source to the target, like `transfer_tangent_vectors()`, for
 * fields that are given at vertices and interpolated between them.
 *
 * In each facet of the source, the vectors of its vertices are rotated into its plane by the smallest rotation from the
 * vertex's normal. This normal is the mean of the facets' normals, weighted by angles. The rotated vectors are
 * interpolated; for a symmetric field, as N-th powers. Images are tangent to the level set of the shell's field through
 * the target's vertex, so that they do not depend on the target's facets.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3` or a `Soup_map_3`
 * \tparam SourceVectorMap a model of `ReadablePropertyMap` from vertices of the source to vectors with `v[0]`, `v[1]`,
 *   `v[2]`
 * \tparam TargetVectorMap a model of `WritablePropertyMap` from vertices of the target to vectors that are
 *   constructible from three numbers
 * \param map the map from the source to the target
 * \param source_vectors vectors; components along the normals are lost
 * \param target_vectors receives their images
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{symmetry}
 *       \cgalParamDescription{1 for vectors (the default), 2 for lines, 4 for crosses}
 *       \cgalParamType{`int`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{default_value}
 *       \cgalParamDescription{value for vertices without a vector from the source; by default, they keep their vectors}
 *       \cgalParamType{the value type of the target map}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{visitor}
 *       \cgalParamDescription{a model of `FlowVisitor`}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return a report with the vertices without a vector from the source, each with the reason; it converts to `true` if
 *   there are none
 * \pre `symmetry` is positive
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceVectorMap,
          typename TargetVectorMap, typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_vertex_tangent_vectors(const Map& map, SourceVectorMap source_vectors,
                                                TargetVectorMap target_vectors,
                                                const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename boost::property_traits<TargetVectorMap>::value_type Vector;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const int symmetry = choose_parameter(get_parameter(np, parameter_tags::symmetry), 1);
  CGAL_precondition(symmetry > 0);

  const auto& source = map.to_source().target();
  const auto& points = map.to_target().target().traced_vertices();
  std::vector<internal::Tangent_sample> samples(points.size());
  if(map.maps_points()) {
    const auto field = internal::Tangent_field::interpolated(
      source, internal::eigen_vectors(source_vectors, vertices(map.source())), internal::positions_of_corners(source),
      symmetry);
    internal::for_each_point<ConcurrencyTag>(
      points.size(), [&](std::size_t n) { return points[n]; }, visitor,
      [&, hint = typename Map::Projection_to_source::Hint()](std::size_t n, const auto& p) mutable {
        samples[n] = internal::tangent_sample(
          map, field, symmetry, p, hint, [](const Flow_differential& differential) { return differential.velocity; });
      });
  } else
    for(internal::Tangent_sample& sample : samples) sample.status = map.status();

  Transfer_report report;
  std::size_t n = 0;
  for(auto v : vertices(map.target())) {
    const internal::Tangent_sample& sample = samples[n];
    if(internal::record(report, n++, sample.status, sample.is_continued, sample.is_snapped))
      put(target_vectors, v, Vector(sample.vector[0], sample.vector[1], sample.vector[2]));
    else internal::put_default_value(np, target_vectors, v);
  }
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_TANGENT_VECTORS_H
