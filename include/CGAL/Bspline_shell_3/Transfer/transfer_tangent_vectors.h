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
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/attribute_samples.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief moves tangent vectors at points of one surface to those of another, for `transfer_vertex_attribute()` with `mapping()`: the
 * images are tangent to the level sets of the field, and so do not jump from facet to facet. What a vector has along the curve is lost.
 */
struct Tangent_vector_mapping
{
  /// \tparam Vector has three coordinates and is constructible from three
  template <typename Vector>
  Vector operator()(const Vector& v, const Flow_differential& differential) const
  {
    const Eigen::Vector3d image = differential.onto_level_set() * Eigen::Vector3d(v[0], v[1], v[2]);
    return Vector(image[0], image[1], image[2]);
  }
};

namespace internal {

// The direction of which all rotations by 2 pi / N about the normal fit the images of the N vectors of a symmetric field best,
// in the sense of the representation by N-th powers, next to the image of the first. Its length is the geometric mean of theirs.
inline Eigen::Vector3d map_symmetric_vector(const Eigen::Matrix3d& differential, const Eigen::Vector3d& source_normal,
                                            const Eigen::Vector3d& target_normal, const Eigen::Vector3d& vector, int symmetry)
{
  const Eigen::Vector3d first = differential * vector;
  if(symmetry == 1 || !(first.norm() > 0)) return first;
  constexpr double pi = 3.14159265358979323846;
  const Eigen::Vector3d x = first.normalized(), y = target_normal.normalized().cross(x);
  std::complex<double> power = 0;
  double log_length = 0;
  for(int k = 0; k < symmetry; ++k) {
    const Eigen::Vector3d image = differential * (Eigen::AngleAxisd(2 * pi * k / symmetry, source_normal.normalized()) * vector);
    power += std::polar(1., symmetry * std::atan2(y.dot(image), x.dot(image)));
    log_length += std::log(image.norm());
  }
  const double angle = std::arg(power) / symmetry;
  return std::exp(log_length / symmetry) * (std::cos(angle) * x + std::sin(angle) * y);
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief moves tangent vectors at the facets of the source to those of the target, by the differential of the map: vector fields, line
 * fields, cross fields and others that are symmetric under rotations.
 *
 * The vector of a target's facet is the image of that of the source's facet where the curve through its centroid meets it; it is in
 * the facet's plane. For a symmetric field, given by one of its vectors for each facet, all of them are moved, and as they need not be
 * symmetric then, the symmetric ones that fit them best are returned.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam Map a `Shell_map_3`
 * \tparam SourceVectorMap a model of `ReadablePropertyMap` from faces of the source to vectors with `v[0]`, `v[1]`, `v[2]`
 * \tparam TargetVectorMap a model of `WritablePropertyMap` from faces of the target to vectors that are constructible from three numbers
 * \param map the map from the source to the target
 * \param source_vectors vectors in the planes of their facets
 * \param target_vectors what gets their images
 * \param np optional named parameters
 *   - `symmetry(int)`: 1 for vectors (the default), 2 for lines, 4 for crosses
 *   - `default_value(x)`: what facets without a vector get; by default they keep what they have
 *   - `visitor(V)`: a model of `FlowVisitor`
 * \return which facets have no vector from the source, and why. A facet without an area has none: it faces no way.
 * \pre `symmetry` is positive
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename SourceVectorMap, typename TargetVectorMap,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Transfer_report transfer_tangent_vectors(const Map& map, SourceVectorMap source_vectors, TargetVectorMap target_vectors,
                                         const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef typename boost::property_traits<TargetVectorMap>::value_type Vector;
  auto&& visitor = internal::argument<Default_flow_visitor>(np, internal_np::visitor);
  const int symmetry = choose_parameter(get_parameter(np, parameter_tags::symmetry), 1);
  CGAL_precondition(symmetry > 0);

  const auto& source = map.to_source().target();
  const auto& target = map.to_target().target();
  Transfer_report report;
  if(map.status() != Flow_status::SUCCESS) {
    internal::fail_all_facets(report, map, [&](auto f) { internal::put_default_value(np, target_vectors, f); });
    return report;
  }
  std::vector<typename Map::Source_image> images(target.number_of_facets());
  std::vector<Flow_differential> differentials(images.size());
  internal::for_each_point<ConcurrencyTag>(images.size(), [&](std::size_t n) {
    return target.traced_point(typename Map::Projection_to_target::Target::Index(n), { 1/3., 1/3., 1/3. });
  }, visitor, [&](std::size_t n, const auto& p) {
    images[n] = map.to_source()(p);
    if(images[n]) {
      differentials[n] = internal::differential_from_image(map, images[n], p);
      differentials[n].prepend_to_end(target.traced_derivative(typename Map::Projection_to_target::Target::Index(n), { 1/3., 1/3., 1/3. }));
      images[n].status = differentials[n].status;
    }
  });
  const auto eigen = [](const auto& v) { return Eigen::Vector3d(CGAL::to_double(v[0]), CGAL::to_double(v[1]), CGAL::to_double(v[2])); };
  for(std::size_t n = 0; n < images.size(); ++n) {
    const auto g = target.face_of(typename Map::Projection_to_target::Target::Index(n));
    const Eigen::Vector3d normal = eigen(target.normal(typename Map::Projection_to_target::Target::Index(n)));
    if(images[n] && internal::is_along(normal, differentials[n])) images[n].status = Flow_status::FACES_WRONG_WAY;
    if(!internal::record(report, n, images[n].status, images[n].is_continued, images[n].is_snapped)) {
      internal::put_default_value(np, target_vectors, g);
      continue;
    }
    const auto f = images[n].location.first;
    const Eigen::Vector3d image = internal::map_symmetric_vector(
      differentials[n].onto_plane(normal), eigen(source.normal(source.facet_of(f))), normal, eigen(get(source_vectors, f)), symmetry);
    put(target_vectors, g, Vector(image[0], image[1], image[2]));
  }
  return report;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_TRANSFER_TANGENT_VECTORS_H
