// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_TRANSFER_MAP_POLYLINE_H
#define CGAL_BSPLINE_SHELL_3_TRANSFER_MAP_POLYLINE_H

#include <CGAL/Bspline_shell_3/Mesh/common_facet.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Transfer/Polyline_image.h>
#include <CGAL/Bspline_shell_3/Transfer/internal/Segment_image.h>

#include <CGAL/assertions.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Transfer
 *
 * \brief maps a polyline on the source to the target: a seam, a feature line, a cut, or a path.
 *
 * The result has a vertex for each vertex of the polyline, and one at each edge of the target that the image crosses.
 * Where the image bends, there are further vertices in facets. Consecutive vertices lie in a common facet, so the
 * result can be drawn on the target, be measured, and be made a sequence of edges (`cut_along_polylines()`).
 *
 * If both meshes are certified in the same shell, the image of the polyline is a curve. It does not meet itself if the
 * polyline does not meet itself. The vertices of the result are images of points of the polyline. The
 * tolerance of the map applies to them, twice where a vertex is moved to an edge. Between two vertices, the distance of
 * the image curve from the result is checked at three points and is at most 0.45 times the tolerance there. This is not
 * a proof. It bounds the distance by the tolerance if the image between the vertices is a polynomial of degree four.
 * Where facets are small compared with the radii of curvature of the level sets, such polynomials are accurate. If a
 * curve enters a facet and leaves it between two checked points, within the tolerance, its vertices may be missing.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam Map a `Shell_map_3`
 * \tparam LocationRange a random access range of `Map::Source_location`, which is a
 *   `CGAL::Polygon_mesh_processing::Face_location`
 * \param map the map from the source to the target. `Shell_map_3::inverse()` maps in the other direction.
 * \param polyline the vertices of the polyline. Consecutive vertices lie in a common facet of the source, whichever of
 *   their facets are given; barycentric coordinates of a vertex on an edge contain an exact 0. A closed polyline ends
 *   with its first vertex. Vertices may be repeated.
 * \param np optional named parameters
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{tolerance}
 *       \cgalParamDescription{largest distance between the image and the result, in the units of the coordinates; at
 *         least 16 tolerances of the map}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{1e-4 of the box size of the mesh for which the shell was built; also if the value is not
 *         positive}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 * \return the image of each part that has one, and the gaps between these parts with reasons; it converts to `true` if
 *   there are no gaps. Repeated vertices are merged. The image of a closed polyline ends with its first vertex; if
 *   there are gaps, the last part ends where the first part begins.
 *
 * \cgalHeading{Cost} The time is linear in the number of vertices of the result: a vertex takes about six projections
 * of a point. Segments of the polyline are mapped concurrently.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename Map, typename LocationRange,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Polyline_image<typename Map::Target_mesh, typename Map::Shell::Point_3> map_polyline(
  const Map& map, const LocationRange& polyline, const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  typedef internal::Segment_image<Map> Segment_image;
  typedef typename Segment_image::Result Result;
  typedef typename Segment_image::Sample Sample;
  typedef typename Map::Source_location Source_location;
  constexpr double default_tolerance = 1e-4; // box sizes; less than a pixel in a picture of the mesh

  const double requested = choose_parameter(get_parameter(np, parameter_tags::tolerance), 0.);
  const double tolerance = (std::max)(requested > 0 ? requested : default_tolerance * map.shell().report().unit,
                                      internal::polyline_tuning.least_tolerance * map.to_target().tolerance());
  const std::vector<Source_location> vertices(std::begin(polyline), std::end(polyline));
  for(const Source_location& v : vertices) {
    CGAL_USE(v);
    CGAL_precondition(v.first != boost::graph_traits<typename Map::Source_mesh>::null_face());
  }

  Result result;
  if(vertices.empty()) return result;
  if(!map.maps_points()) {
    result.gaps.push_back({ 0, double(vertices.size() - 1), Polyline_status::NO_IMAGE, map.status() });
    return result;
  }
  // Without hints, images depend only on the points. Polylines with a common vertex have the same image there, and
  // closed polylines have closed images.
  std::vector<typename Map::Target_image> images(vertices.size());
  internal::for_each_chunk<ConcurrencyTag>(images.size(), 1,
                                           [&](std::size_t n, std::size_t) { images[n] = map(vertices[n]); });
  const auto end_of_segment = [&](std::size_t v, double t) { return Segment_image::sample_of(map, t, images[v]); };
  // Each segment has its own hint and result, so that the results do not depend on the number of threads.
  std::vector<Result> segments(vertices.size() - 1);
  internal::for_each_chunk<ConcurrencyTag>(segments.size(), 1, [&](std::size_t n, std::size_t) {
    const Sample first = end_of_segment(n, 0), last = end_of_segment(n + 1, 1);
    if(first.has_image()) Segment_image::begin_part(segments[n], n, first);
    Source_location a = vertices[n], b = vertices[n + 1];
    if(internal::move_to_common_facet(map.source(), a, b))
      return Segment_image(map, tolerance, n, a, b).trace(first, last, segments[n]);
    Segment_image::add_gap(segments[n], { double(n), double(n + 1), Polyline_status::NO_COMMON_FACET });
    if(last.has_image()) Segment_image::begin_part(segments[n], n, last);
  });

  result.traced_points = vertices.size();
  const Sample first = end_of_segment(0, 0);
  if(first.has_image()) Segment_image::begin_part(result, 0, first);
  else result.gaps.push_back({ 0, 0, Polyline_status::NO_IMAGE, first.status });
  for(std::size_t n = 0; n < segments.size(); ++n) {
    result.traced_points += segments[n].traced_points;
    auto part = segments[n].parts.begin();
    if(end_of_segment(n, 0).has_image()) { // the first part continues the last one
      result.parts.back().insert(result.parts.back().end(), part->begin() + 1, part->end());
      ++part;
    }
    result.parts.insert(result.parts.end(), part, segments[n].parts.end());
    for(const Polyline_gap& gap : segments[n].gaps) Segment_image::add_gap(result, gap);
  }
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_TRANSFER_MAP_POLYLINE_H
