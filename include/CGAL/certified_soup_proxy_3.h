// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_SOUP_PROXY_3_H
#define CGAL_CERTIFIED_SOUP_PROXY_3_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Construction/Resolution_tuning.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>
#include <CGAL/Bspline_shell_3/Soup/wrap_soup.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a closed mesh around a polygon soup (a *proxy*), and a certified shell of it.
 *
 * The soup need not be a surface: it may intersect itself, have gaps, and be non-manifold or not oriented.
 *
 * The proxy is the result of `CGAL::alpha_wrap_3()`. Each point of the soup that lies in the shell has one image on the
 * proxy. The proxy receives the attributes of the parts of the soup that integral curves reach from it
 * (`Bspline_shells::Soup_map_3`). Like any mesh in its shell, the proxy can be simplified, remeshed, and used for
 * computations.
 *
 * Parts that are not visible from the proxy, such as inner parts and gaps narrower than `alpha`, are not represented on
 * it. A surface without thickness lies in the middle between two sides of the proxy, where the shell does not reach.
 * Points outside the shell are mapped to the closest point of the proxy, and these images are marked.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam PointRange a range of points of a \cgal kernel; coordinates are rounded to `double`s
 * \tparam PolygonRange a range of ranges of indices of points
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 * \param points the points
 * \param polygons the polygons
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{alpha}
 *       \cgalParamDescription{width of the gaps and cavities that the proxy enters, in the units of the coordinates}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{1/50 of the longest side of the bounding box}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{offset}
 *       \cgalParamDescription{distance of the proxy from the soup, in the units of the coordinates}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{a quarter of `alpha`}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{time_limit}
 *       \cgalParamDescription{seconds for all wraps and shells together, after which the status is
 *         `TIME_LIMIT_EXCEEDED`. A limit that is not reached does not affect the result.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{infinite}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *   All parameters of `certified_bspline_shell_3()` except `vertex_point_map`, `closing`, and `virtual_closing` are
 *   accepted. A `signed_distance_oracle()` would have to return the distance to the proxy, which does not exist before
 *   the call, so the default is the right one. Unless `sizing()` is given, the thickness is increased to eight times
 *   the offset, but not above 19 root cells. The inner half of the shell then reaches the soup in concave corners. If
 *   the proxy cannot be certified within the limits of memory, effort, and rounds, a second proxy is built with twice
 *   the `alpha` and `offset`.
 * \return the proxy, or the reason why there is none and the polygons and points at fault:
 *   - `EMPTY_MESH`, `NOT_FINITE`, `COORDINATES_OUT_OF_RANGE`;
 *   - `INVALID_PARAMETER`, also if a polygon refers to a point that does not exist;
 *   - `DEGENERATE_FACET` if no polygon has an area;
 *   - `GRID_TOO_FINE` if the offset is too small for the coordinates;
 *   - `MEMORY_LIMIT_EXCEEDED`, or another status of `certified_bspline_shell_3()` for the proxy.
 * \cgalHeading{Cost} The cost of the wrap plus that of the shell.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange, typename PolygonRange,
          typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shells::Soup_proxy_3 certified_soup_proxy_3(const PointRange& points, const PolygonRange& polygons,
                                                    const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::is_default_parameter;

  const double max_seconds = choose_parameter(get_parameter(np, internal_np::maximum_running_time),
                                              std::numeric_limits<double>::infinity());
  auto&& visitor = BS::internal::argument<BS::Default_shell_visitor>(np, internal_np::visitor);
  BS::internal::Run run(max_seconds, BS::internal::Go_on<std::remove_reference_t<decltype(visitor)> >::of(visitor));
  BS::Polygon_soup copy;
  for(const auto& p : points)
    copy.points.emplace_back(BS::internal::rounded(p[0]), BS::internal::rounded(p[1]), BS::internal::rounded(p[2]));
  for(const auto& polygon : polygons) {
    copy.polygons.emplace_back();
    for(const auto& n : polygon) copy.polygons.back().push_back(std::size_t(n));
  }
  BS::Offending_simplices offenders;
  const BS::Shell_status checked = BS::internal::check_soup(copy, offenders);
  BS::Invalid_parameter invalid;
  if(checked == BS::Shell_status::INVALID_PARAMETER) invalid = BS::internal::invalid_position(copy, offenders);
  if(checked != BS::Shell_status::SUCCESS) return BS::Soup_proxy_3(checked, std::move(offenders), invalid);
  const BS::Soup_mesh_3 soup(copy);
  if(soup.mesh().number_of_faces() == 0) {
    offenders.facets = soup.polygons_left_out();
    return BS::Soup_proxy_3(BS::Shell_status::DEGENERATE_FACET, std::move(offenders));
  }

  const Bbox_3 box = Polygon_mesh_processing::bbox(soup.mesh());
  const double unit = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  const double alpha = choose_parameter(get_parameter(np, tags::alpha), unit / 50);
  const double offset = choose_parameter(get_parameter(np, tags::offset), alpha / 4);
  const double resolution = choose_parameter(get_parameter(np, tags::resolution), BS::resolution_tuning.finest);
  const double relative_thickness = choose_parameter(get_parameter(np, tags::relative_thickness), 1.);
  const double thickness = choose_parameter(get_parameter(np, tags::thickness), 1.);
  const double max_bytes = choose_parameter(get_parameter(np, tags::memory_limit), 4e9);
  invalid.check("alpha", alpha, BS::Parameter_bounds::positive());
  invalid.check("offset", offset, BS::Parameter_bounds::positive());
  invalid.check("resolution", resolution, BS::Parameter_bounds::positive());
  invalid.check("relative_thickness", relative_thickness, BS::Parameter_bounds::positive());
  invalid.check("thickness", thickness, BS::Parameter_bounds::positive());
  invalid.check("time_limit", max_seconds, BS::Parameter_bounds::positive_or_infinite());
  invalid.check("memory_limit", max_bytes, BS::Parameter_bounds::positive_or_infinite());
  if(invalid) return BS::Soup_proxy_3(BS::Shell_status::INVALID_PARAMETER, BS::Offending_simplices(), invalid);

  // Bound of the automatic increase of the thickness: 19 root cells. The shell must be thinner than 20 root cells.
  const double deepest = 19 * unit / resolution;
  double last_scale = 1; // relative to `alpha`
  const auto attempt = [&](double scale) {
    BS::Soup_proxy_3::Mesh wrap;
    BS::Proxy_report report;
    const BS::Shell_status wrapped = BS::wrap_soup<ConcurrencyTag>(soup, scale * alpha, scale * offset, max_bytes, wrap,
                                                                   report);
    if(report.alpha > 0) last_scale = report.alpha / alpha;
    if(wrapped != BS::Shell_status::SUCCESS) return BS::Soup_proxy_3(wrapped);
    if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::sizing_t>::value) {
      auto shell = certified_bspline_shell_3<ConcurrencyTag>(wrap, np);
      return BS::Soup_proxy_3(soup, std::move(wrap), std::move(shell), report);
    } else {
      double requested = 0, reach = (std::min)(8 * report.offset, deepest);
      if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::thickness_t>::value) requested = thickness;
      else if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::relative_thickness_t>::value)
        requested = relative_thickness * unit;
      report.exceeds_requested_thickness = requested > 0 && reach > requested;
      reach = (std::max)(requested, reach);
      auto shell = certified_bspline_shell_3<ConcurrencyTag>(
        wrap, BS::Named_parameters<double, tags::thickness_t, CGAL_NP_CLASS>(reach, np));
      return BS::Soup_proxy_3(soup, std::move(wrap), std::move(shell), report);
    }
  };
  const auto is_final = [](const BS::Soup_proxy_3& proxy) {
    return proxy.is_certified() || BS::internal::ends_all_attempts(proxy.status());
  };
  return run(
    [&] {
      BS::Soup_proxy_3 proxy = attempt(1);
      if(is_final(proxy)) return proxy;
      // A coarser proxy has thicker walls, which need fewer cells.
      BS::Soup_proxy_3 coarser = attempt(2 * last_scale);
      return is_final(coarser) || !proxy ? std::move(coarser) : std::move(proxy);
    },
    [](BS::internal::Run::End end) { return BS::Soup_proxy_3(BS::internal::status(end)); });
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_SOUP_PROXY_3_H
