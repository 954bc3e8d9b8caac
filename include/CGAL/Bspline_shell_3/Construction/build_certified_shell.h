// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_H

#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>

namespace CGAL {

namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the parameters of `certified_bspline_shell_3()`.
 */
struct Certified_shell_parameters
{
  /// root cells along the longest side of the mesh's bounding box; if not set, `choose_resolution()`, or the finest
  /// resolution if `sizing` is set
  std::optional<double> resolution;
  double relative_thickness = 0.01;               ///< fraction of the longest side of the mesh's bounding box
  std::shared_ptr<const Shell_closing_3> closing; ///< closes the mesh if it is open
  /// whether the hole at a point on the border must be closed by a cap; empty if none must
  std::function<bool(const std::array<double, 3>&)> hole_requires_cap;
  bool closes_virtually = true;    ///< whether an open mesh is closed by `close_virtually()` if there is no `closing`
  bool truncates = true;           ///< whether vertices are truncated, unless self-intersections are tolerated
  double least_cone_margin = 0.02; ///< vertices with a smaller cone margin are truncated
  std::optional<double> thickness; ///< replaces `relative_thickness`; in the units of the coordinates
  /// returns the requested thickness near a point, in the units of the coordinates; used instead of the two above
  std::function<double(const Certified_bspline_shell_3::Point_3&)> sizing;
  Refinement_parameters refinement;

  double largest_thickness(double unit) const { return thickness ? *thickness : relative_thickness * unit; }
  /// returns the distance of back sheets from open meshes, which leaves room for a shell of full thickness without
  /// small cells
  double closing_offset(double unit) const
  {
    constexpr double thicknesses = 3;
    return thicknesses * largest_thickness(unit);
  }
  /// returns the first invalid parameter, if there is one
  Invalid_parameter invalid() const
  {
    Invalid_parameter found;
    if(resolution) found.check("resolution", *resolution, Parameter_bounds::positive());
    found.check("relative_thickness", relative_thickness, Parameter_bounds::positive());
    if(thickness) found.check("thickness", *thickness, Parameter_bounds::positive());
    found.check("least_cone_margin", least_cone_margin, { 0, 1, true, false });
    found.check("effort_limit", refinement.max_cells, Parameter_bounds::positive_or_infinite());
    found.check("memory_limit", refinement.max_bytes, Parameter_bounds::positive_or_infinite());
    refinement.weights.check(found);
    return found;
  }
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief builds a shell of a checked mesh as described for `certified_bspline_shell_3()`. The oracle, if set, is used
 * instead of the signed distance to the mesh. The function is not a template of mesh, oracle, and solver, so that the
 * library can contain compiled instances.
 *
 * \pre the parameters are valid
 */
template <typename ConcurrencyTag>
Certified_bspline_shell_3 build_certified_shell(Shell_construction& construction,
                                                const Certified_shell_parameters& parameters,
                                                const std::optional<Any_signed_distance_3>& oracle,
                                                const Any_spd_solver& solver);

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief builds a shell of a checked mesh with the default solver.
 */
template <typename ConcurrencyTag>
Certified_bspline_shell_3 build_certified_shell(Shell_construction& construction,
                                                const Certified_shell_parameters& parameters,
                                                const std::optional<Any_signed_distance_3>& oracle);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Construction/build_certified_shell_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_CERTIFIED_SHELL_H
