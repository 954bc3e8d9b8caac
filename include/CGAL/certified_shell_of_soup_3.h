// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CERTIFIED_SHELL_OF_SOUP_3_H
#define CGAL_CERTIFIED_SHELL_OF_SOUP_3_H

#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/near_duplicates.h>
#include <CGAL/Bspline_shell_3/Soup/repair_and_weld.h>
#include <CGAL/Bspline_shell_3/Soup/repair_soup.h>
#include <CGAL/Bspline_shell_3/Soup/try_excision.h>
#include <CGAL/Bspline_shell_3/Soup/unite_parts.h>
#include <CGAL/Bspline_shell_3/Support/Named_parameters.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>
#include <CGAL/Bspline_shell_3/Support/Run.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>
#include <CGAL/certified_bspline_shell_3.h>
#include <CGAL/certified_soup_proxy_3.h>

#include <CGAL/Real_timer.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace CGAL {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief builds a certified shell of the mesh that a polygon soup represents, or of a proxy mesh around the soup.
 *
 * The polygons are repaired (`Bspline_shells::repair_soup()`). If they are not closed, cracks between points that
 * differ in the last digits are closed, too (`Bspline_shells::weld_soup()`). If the polygons then form a mesh, a shell
 * of this mesh is built, with a virtual closing if the mesh is open. If the mesh intersects itself because closed parts
 * overlap, the parts are united first (`Bspline_shells::unite_parts()`). If the polygons do not form a mesh, or if this
 * shell is not certified, triangles with defects are excised. A shell of the others is then built
 * (`Bspline_shells::choose_excision()`). If too many would be excised, or if this shell is not certified either, a
 * proxy is built with its shell (`certified_soup_proxy_3()`).
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag`, or `Parallel_if_available_tag`; all give the same result
 * \tparam NamedParameters a sequence of \ref BsplineShell3NamedParameters "named parameters"
 * \param soup the polygons, as returned by `Bspline_shells::read_polygon_soup()`
 * \param np optional named parameters:
 *   \cgalNamedParamsBegin
 *     \cgalParamNBegin{weld_tolerance}
 *       \cgalParamDescription{distance of points that are welded where this closes cracks, in the units of the
 *         coordinates; at least 0, and finite. All checks of `Bspline_shells::weld_soup()` apply to it.}
 *       \cgalParamType{`double`, or `std::optional<double>`, which is the default if it is empty}
 *       \cgalParamDefault{four units in the last digit of the coordinates, or less if edges or the shell are small}
 *     \cgalParamNEnd
 *     \cgalParamNBegin{largest_excised_share}
 *       \cgalParamDescription{the largest fraction of the area of the polygons that may be excised; at least 0 and at
 *         most 1. If it is 0, nothing is excised.}
 *       \cgalParamType{`double`}
 *       \cgalParamDefault{0.1}
 *     \cgalParamNEnd
 *   \cgalNamedParamsEnd
 *   Others are those of `certified_soup_proxy_3()` and, for the shell of the mesh, those of
 *   `certified_bspline_shell_3()`. With `closing()`, nothing is welded or excised, as the border of the mesh must not
 *   change; without `virtual_closing()`, nothing is excised. The `time_limit()` applies to the mesh, the meshes after
 *   excision, and the proxy together; once it is reached, no further attempt begins. Limits of effort and memory apply
 *   to each attempt; those after excision have a quarter of the limit of effort (`Excision_limits::effort`).
 * \return the shell and its kind. If neither shell is certified, the shell of the mesh is returned if it was built.
 */
template <typename ConcurrencyTag = Parallel_if_available_tag, typename CGAL_NP_TEMPLATE_PARAMETERS>
Bspline_shells::Shell_of_soup_3 certified_shell_of_soup_3(const Bspline_shells::Polygon_soup& soup,
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
  Real_timer timer;
  timer.start();

  BS::Shell_of_soup_3 result;
  result.invalid_parameter.check("time_limit", max_seconds, BS::Parameter_bounds::positive_or_infinite());
  BS::Weld_parameters welding;
  welding.relative_thickness = choose_parameter(get_parameter(np, tags::relative_thickness),
                                                welding.relative_thickness);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::thickness_t>::value)
    welding.thickness = get_parameter(np, tags::thickness);
  if constexpr(!is_default_parameter<CGAL_NP_CLASS, tags::weld_tolerance_t>::value) {
    welding.tolerance = get_parameter(np, tags::weld_tolerance);
    if(welding.tolerance)
      result.invalid_parameter.check("weld_tolerance", *welding.tolerance, BS::Parameter_bounds::not_negative());
  }
  BS::Excision_limits excision;
  excision.share = choose_parameter(get_parameter(np, tags::largest_excised_share), excision.share);
  result.invalid_parameter.check("largest_excised_share", excision.share, { 0, 1, true, true });
  if(!is_default_parameter<CGAL_NP_CLASS, tags::closing_t>::value
     || !choose_parameter(get_parameter(np, tags::virtual_closing), true))
    excision.share = 0;
  result.largest_excised_share = excision.share;
  if(result.invalid_parameter) {
    result.mesh_status = BS::Shell_status::INVALID_PARAMETER;
    return result;
  }
  BS::Shell_status* status = &result.mesh_status; // or that of the excision or the proxy, once it is tried
  const auto attempt_all = [&] {
    std::optional<BS::Welded_soup> welded;
    if constexpr(is_default_parameter<CGAL_NP_CLASS, tags::closing_t>::value)
      welded = BS::internal::repair_and_weld(soup, welding, result);
    else result.mesh_status = BS::repair_soup(soup, result.repaired_mesh, result.repairs, result.offending_simplices);
    if(result.mesh_status == BS::Shell_status::INVALID_PARAMETER)
      result.invalid_parameter = BS::internal::invalid_position(soup, result.offending_simplices);
    if(result.mesh_status == BS::Shell_status::SUCCESS) {
      const auto build = [&] {
        result.shell_of_mesh = certified_bspline_shell_3<ConcurrencyTag>(result.own_mesh(), np);
        result.mesh_status = result.shell_of_mesh.status();
        result.offending_simplices = result.shell_of_mesh.report().offending_simplices;
        result.invalid_parameter = result.shell_of_mesh.report().invalid_parameter;
      };
      build();
      if(result.mesh_status == BS::Shell_status::SELF_INTERSECTION && CGAL::is_closed(result.repaired_mesh)) {
        auto united = std::make_shared<BS::United_mesh>();
        result.unite_report = BS::unite_parts<ConcurrencyTag>(result.repaired_mesh, *united);
        if(result.unite_report) {
          result.united = std::move(united);
          build();
        }
      }
      if(result.mesh_status == BS::Shell_status::INCONSISTENT_ORIENTATION
         && BS::orient_components(result.repaired_mesh)) {
        result.repairs.reversed_components = true;
        build();
      }
    }
    if(result.shell_of_mesh.is_certified() || BS::internal::ends_all_attempts(result.mesh_status)) return;
    status = &result.excision_status;
    const auto build_capped = [&](const BS::Excised_soup_3::Mesh& mesh, const auto& requires_cap) {
      typedef BS::Named_parameters<std::decay_t<decltype(requires_cap)>, tags::hole_requires_cap_t, CGAL_NP_CLASS> Caps;
      typedef BS::Named_parameters<double, tags::effort_limit_t, Caps> Pack;
      const double effort = choose_parameter(get_parameter(np, tags::effort_limit),
                                             BS::Refinement_parameters().max_cells);
      // A limit that is rejected is named as it was passed.
      const double part = effort > 0 ? excision.effort * effort : effort;
      return certified_bspline_shell_3<ConcurrencyTag>(mesh, Pack(part, Caps(requires_cap, np)));
    };
    BS::internal::try_excision(soup, welded, excision, build_capped, result);
    if(result.excised || BS::internal::ends_all_attempts(result.excision_status)) return;
    switch(result.mesh_status) {
      case BS::Shell_status::NON_MANIFOLD:
      case BS::Shell_status::NOT_ORIENTABLE:
      case BS::Shell_status::NOT_CLOSABLE:
      case BS::Shell_status::SELF_INTERSECTION:
        if(result.weld.is_none()) result.near_duplicates = BS::number_of_near_duplicates(soup.points);
        break;
      default: break;
    }
    status = &result.proxy_status;
    auto proxy = std::make_shared<const BS::Soup_proxy_3>(
      certified_soup_proxy_3<ConcurrencyTag>(soup.points, soup.polygons, np));
    result.proxy_status = proxy->status();
    if(!result.invalid_parameter) result.invalid_parameter = proxy->invalid_parameter();
    if(proxy->is_certified()) result.proxy = std::move(proxy);
  };
  run(attempt_all, [&](BS::internal::Run::End end) { *status = BS::internal::status(end); });
  result.seconds = timer.time();
  return result;
}

} // namespace CGAL

#endif // CGAL_CERTIFIED_SHELL_OF_SOUP_3_H
