// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_ATTRIBUTE_SAMPLES_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_ATTRIBUTE_SAMPLES_H

#include <CGAL/Bspline_shell_3/Projection/Flow_status.h>
#include <CGAL/Bspline_shell_3/Projection/Gradient_flow_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/for_each_point.h>
#include <CGAL/Bspline_shell_3/Transfer/Transfer_report.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/property_map.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Records a status. Returns whether there is a value to write.
inline bool record(Transfer_report& report, std::size_t position, Flow_status status, bool is_continued = false,
                   bool is_snapped = false)
{
  if(status == Flow_status::SUCCESS) {
    ++report.transferred;
    if(is_continued) report.continued.push_back(position);
    if(is_snapped) ++report.snapped;
  } else report.failures.emplace_back(position, status);
  return status == Flow_status::SUCCESS;
}

// Gives an element without a value from the source the caller's default value, if there is one.
template <typename NamedParameters, typename ValueMap, typename Simplex>
void put_default_value(const NamedParameters& np, ValueMap values, const Simplex& simplex)
{
  if constexpr(!CGAL::parameters::is_default_parameter<NamedParameters, parameter_tags::default_value_t>::value)
    put(values, simplex, CGAL::parameters::get_parameter_reference(np, parameter_tags::default_value));
}

// Records the status of a map that does not map points for all facets of its target. `put(f)` completes a facet.
template <typename Map, typename Put>
void fail_all_facets(Transfer_report& report, const Map& map, const Put& put)
{
  const auto& target = map.to_target().target();
  for(std::size_t n = 0; n < target.number_of_facets(); ++n) {
    record(report, n, map.status());
    put(target.face_of(n));
  }
}

// Returns the vertices of a facet in the order of its barycentric coordinates.
template <typename TriangleMesh>
std::array<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, 3> corners(
  const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::face_descriptor f)
{
  const auto h = halfedge(f, mesh);
  return { source(h, mesh), target(h, mesh), target(next(h, mesh), mesh) };
}

template <typename TriangleMesh, typename VertexValueMap>
std::array<typename boost::property_traits<VertexValueMap>::value_type, 3> corner_values(
  const TriangleMesh& mesh, typename boost::graph_traits<TriangleMesh>::face_descriptor f, VertexValueMap values)
{
  const auto v = corners(mesh, f);
  return { { get(values, v[0]), get(values, v[1]), get(values, v[2]) } };
}

// Returns the position of each corner in vertices(mesh); corner i of facet f has the index 3 f + i.
template <typename Target>
std::vector<std::size_t> positions_of_corners(const Target& target)
{
  const auto& mesh = target.mesh();
  auto position = get(dynamic_vertex_property_t<std::size_t>(), mesh);
  std::size_t n = 0;
  for(auto v : vertices(mesh)) put(position, v, n++);
  std::vector<std::size_t> result;
  for(auto f : faces(mesh))
    for(auto v : corners(mesh, f)) result.push_back(get(position, v));
  return result;
}

// Returns the centroids of the equal triangles into which a facet is divided, with `parts` triangles along each edge.
// If the facet's centroid is among them, it comes first.
inline std::vector<std::array<double, 3> > centroids_of_parts(int parts)
{
  std::vector<std::array<double, 3> > centroids;
  for(int i = 0; i < parts; ++i)
    for(int j = 0; i + j < parts; ++j)
      for(int turned = 0; turned < (i + j + 1 < parts ? 2 : 1); ++turned) {
        const int a = 3 * i + 1 + turned, b = 3 * j + 1 + turned;
        if(a == parts && b == parts) centroids.insert(centroids.begin(), { 1 / 3., 1 / 3., 1 / 3. });
        else centroids.push_back({ 1 - double(a + b) / (3 * parts), double(a) / (3 * parts), double(b) / (3 * parts) });
      }
  return centroids;
}

// Returns the number of parts along each edge for which there are at least `samples` parts.
inline int parts_along_edge(std::size_t samples)
{
  return (std::max)(1, int(std::ceil(std::sqrt(double(samples)))));
}

// Returns whether a plane with this normal is parallel to the curve, up to rounding. If so, nothing can be moved to the
// plane along the curve.
template <typename Normal>
bool is_along(const Normal& normal, const Flow_differential& d)
{
  constexpr double least_sine = 1e-8;
  const Eigen::Vector3d n(normal[0], normal[1], normal[2]);
  return !(std::abs(n.dot(d.velocity)) > least_sine * n.norm() * d.velocity.norm());
}

// Returns the differential of the map from the source at the image of a point of the target, without its truncation.
template <typename Map, typename Point>
Flow_differential differential_from_image(const Map& map, const typename Map::Source_image& image, const Point& p)
{
  const auto& shell = map.shell();
  const auto& source = map.to_source().target();
  if(image.is_continued) return orthogonal_differential(source.normal(source.facet_of(image.location.first)));
  const typename Map::Shell::Point_3 q(p[0], p[1], p[2]);
  const auto level = shell.field().value(q);
  const auto facet = source.facet_of(image.location.first);
  Flow_differential d = Gradient_flow_3<typename Map::Shell>(shell, map.to_source().tolerance())
                          .differential(source.traced_point(facet, image.location.second), *level);
  d.append_to_start(source.traced_derivative(facet, image.location.second));
  return d;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_INTERNAL_ATTRIBUTE_SAMPLES_H
