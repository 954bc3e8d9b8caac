// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_SOUP_PROXY_3_H
#define CGAL_CERTIFIED_SOUP_PROXY_3_H

#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>
#include <CGAL/Bspline_shell_3/Soup/wrap_soup.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/certified_bspline_shell_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Real_timer.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief makes a clean proxy of a polygon soup, with a certified shell: for what is no surface, as it intersects itself, has gaps, or is not manifold
 * or not oriented.
 *
 * The proxy is a closed mesh around the soup (`CGAL::alpha_wrap_3()`). Each point of the soup that is in its shell has one image on it; what the
 * proxy sees of the soup gives it its attributes (`Bspline_shells::Soup_map_3`). The proxy can be simplified, remeshed and computed on as any mesh in
 * its shell.
 *
 * What the proxy cannot see, as inner parts and gaps narrower than `alpha`, gets nothing. Both sides of a sheet without thickness are nearest to the
 * same points of it: they are too far from the proxy for its shell, and images are continued by the smallest distance, and marked.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam PointRange a range of points of a \cgal kernel; coordinates are rounded to `double`s
 * \tparam PolygonRange a range of ranges of positions of points
 * \tparam NamedParameters a sequence of named parameters, begun in `CGAL::Bspline_shells::parameters` or `CGAL::parameters`
 * \param points the points
 * \param polygons the polygons
 * \param np optional named parameters:
 *   - `alpha(double)`: the width of gaps and cavities that the proxy enters, user units; default 1/50 of the longest side of the box
 *   - `offset(double)`: how far the proxy is from the soup, user units; default a quarter of `alpha`
 *   - all of `certified_bspline_shell_3()` but `vertex_point_map`, `closing` and `virtual_closing`. The thickness is at least eight times the offset,
 *     unless there is a `sizing()`: half of it is behind the proxy, and must reach what lies deep in corners. If the proxy cannot be certified in half of the
 *     `time_limit()`, one with twice the `alpha` and `offset` gets the rest.
 * \return the proxy, or the reason why there is none. `NOT_FINITE`: offending are polygons with such points. `INVALID_PARAMETER` is returned, too, if a
 *         polygon has the position of no point.
 * \cgalHeading{Cost} that of the wrap, and that of its certified shell
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename PointRange, typename PolygonRange, typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shells::Soup_proxy_3 certified_soup_proxy_3(const PointRange& points, const PolygonRange& polygons,
                                                    const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  namespace tags = Bspline_shells::parameter_tags;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::is_default_parameter;

  BS::Polygon_soup copy;
  std::vector<char> is_finite;
  for(const auto& p : points) {
    const double x = CGAL::to_double(p[0]), y = CGAL::to_double(p[1]), z = CGAL::to_double(p[2]);
    is_finite.push_back(std::isfinite(x) && std::isfinite(y) && std::isfinite(z));
    copy.points.emplace_back(x, y, z);
  }
  std::vector<std::size_t> offenders;
  for(const auto& polygon : polygons) {
    copy.polygons.emplace_back();
    bool is_usable = true;
    for(const auto& n : polygon) {
      if(std::size_t(n) >= copy.points.size()) return BS::Soup_proxy_3(BS::Shell_status::INVALID_PARAMETER, { copy.polygons.size() - 1 });
      is_usable = is_usable && is_finite[std::size_t(n)];
      copy.polygons.back().push_back(std::size_t(n));
    }
    if(!is_usable) offenders.push_back(copy.polygons.size() - 1);
  }
  if(!offenders.empty()) return BS::Soup_proxy_3(BS::Shell_status::NOT_FINITE, std::move(offenders));
  const BS::Soup_mesh_3 soup(copy);
  if(soup.mesh().number_of_faces() == 0)
    return BS::Soup_proxy_3(copy.polygons.empty() ? BS::Shell_status::EMPTY_MESH : BS::Shell_status::DEGENERATE_FACET, soup.polygons_left_out());

  const Bbox_3 box = Polygon_mesh_processing::bbox(soup.mesh());
  const double unit = (std::max)({ box.x_span(), box.y_span(), box.z_span() });
  constexpr double largest = 1e60, smallest = 1e-60;       // as for meshes
  for(int a = 0; a < 3; ++a)
    if((std::max)(std::abs((box.min)(a)), std::abs((box.max)(a))) > largest || unit < smallest)
      return BS::Soup_proxy_3(BS::Shell_status::COORDINATES_OUT_OF_RANGE);
  const double alpha = choose_parameter(get_parameter(np, tags::alpha), unit / 50);
  const double offset = choose_parameter(get_parameter(np, tags::offset), alpha / 4);
  if(!(alpha > 0 && offset > 0 && std::isfinite(alpha) && std::isfinite(offset))) return BS::Soup_proxy_3(BS::Shell_status::INVALID_PARAMETER);
  // The thinner the proxy's parts, the more cells they need: where half of the time does not suffice, a coarser proxy gets the rest.
  const double limit = choose_parameter(get_parameter(np, tags::time_limit), std::numeric_limits<double>::infinity());
  Real_timer timer;
  timer.start();
  const auto attempt = [&](double scale, double seconds) {
    BS::Soup_proxy_3::Mesh wrap;
    BS::Proxy_report report;
    const BS::Shell_status wrapped = BS::wrap_soup(soup, scale * alpha, scale * offset, wrap, report);
    if(wrapped != BS::Shell_status::SUCCESS) return BS::Soup_proxy_3(wrapped);
    typedef BS::Named_parameters<double, tags::time_limit_t, CGAL_NP_CLASS> Limited;
    const Limited limited(seconds, np);
    if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::sizing_t>::value)
      return BS::Soup_proxy_3(soup, wrap, certified_bspline_shell_3<ConcurrencyTag>(wrap, limited), report);
    else {
      double thickness = choose_parameter(get_parameter(np, tags::relative_thickness), 0.) * unit;
      thickness = (std::max)(choose_parameter(get_parameter(np, tags::thickness), thickness), 8 * report.offset);
      const BS::Named_parameters<double, tags::thickness_t, typename Limited::Pack> thick(thickness, limited);
      return BS::Soup_proxy_3(soup, wrap, certified_bspline_shell_3<ConcurrencyTag>(wrap, thick), report);
    }
  };
  BS::Soup_proxy_3 proxy = attempt(1, limit / 2);
  if(proxy.is_certified() || proxy.status() == BS::Shell_status::CANCELED || !(timer.time() < limit)) return proxy;
  BS::Soup_proxy_3 coarser = attempt(2, limit - timer.time());
  return coarser.is_certified() || !proxy ? std::move(coarser) : std::move(proxy);
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_SOUP_PROXY_3_H
