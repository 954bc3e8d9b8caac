// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_SHELL_OF_SOUP_3_H
#define CGAL_CERTIFIED_SHELL_OF_SOUP_3_H

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_soup_proxy_3.h>

#include <CGAL/Real_timer.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief makes a certified shell of polygons, whatever they form: of the mesh that they are, repaired where little is missing
 * (`Bspline_shells::repair_soup()`), and closed virtually where it is open; or of a proxy (`certified_soup_proxy_3()`).
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam NamedParameters a sequence of named parameters, begun in `CGAL::Bspline_shells::parameters` or `CGAL::parameters`
 * \param soup the polygons, as `Bspline_shells::read_polygon_soup()` reads them
 * \param np optional named parameters: those of `certified_soup_proxy_3()`. The proxy gets what the mesh leaves of the `time_limit()`, a third of it or
 *        more.
 * \return the shell, and what it is of. If neither the mesh nor the proxy gets a certified shell, one of the mesh that is not certified, if there is one.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shells::Shell_of_soup_3 certified_shell_of_soup_3(const Bspline_shells::Polygon_soup& soup,
                                                          const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  namespace BS = Bspline_shells;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const double limit = choose_parameter(get_parameter(np, BS::parameter_tags::time_limit), std::numeric_limits<double>::infinity());
  Real_timer timer;
  timer.start();
  const auto limited = [&](double seconds) { return BS::Named_parameters<double, BS::parameter_tags::time_limit_t, CGAL_NP_CLASS>(seconds, np); };

  BS::Shell_of_soup_3 result;
  result.mesh_status = BS::repair_soup(soup, result.repaired_mesh, result.repairs, result.offending_simplices);
  if(result.mesh_status == BS::Shell_status::INVALID_PARAMETER)
    result.invalid_parameter = BS::internal::invalid_position(soup, result.offending_simplices);
  if(result.mesh_status == BS::Shell_status::SUCCESS) {
    const auto build = [&] {
      result.shell_of_mesh = certified_bspline_shell_3<ConcurrencyTag>(result.repaired_mesh, limited(2 * limit / 3));
      result.mesh_status = result.shell_of_mesh.status();
      result.offending_simplices = result.shell_of_mesh.report().offending_simplices;
      result.invalid_parameter = result.shell_of_mesh.report().invalid_parameter;
    };
    build();
    if(result.mesh_status == BS::Shell_status::INCONSISTENT_ORIENTATION && BS::orient_components(result.repaired_mesh)) {
      result.repairs.turned_components = true;
      build();
    }
  }
  result.seconds = timer.time();
  if(result.shell_of_mesh.is_certified() || result.mesh_status == BS::Shell_status::CANCELED || result.mesh_status == BS::Shell_status::INVALID_PARAMETER
     || result.mesh_status == BS::Shell_status::UNSOUND_ARITHMETIC) return result;
  auto proxy = std::make_shared<const BS::Soup_proxy_3>(
    certified_soup_proxy_3<ConcurrencyTag>(soup.points, soup.polygons, limited((std::max)(limit / 3, limit - timer.time()))));
  result.proxy_status = proxy->status();
  if(!result.invalid_parameter) result.invalid_parameter = proxy->invalid_parameter();
  if(proxy->is_certified()) result.proxy = std::move(proxy);
  result.seconds = timer.time();
  return result;
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_SHELL_OF_SOUP_3_H
