// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_H

#include <CGAL/Bspline_shell_3/Construction/Shell_construction.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Fit/Energy_weights.h>
#include <CGAL/Bspline_shell_3/Shell/Bspline_shell_3.h>
#include <CGAL/Bspline_shell_3/Support/Invalid_parameter.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <limits>
#include <optional>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the parameters of `bspline_shell_3()`.
 */
struct Uniform_shell_parameters
{
  double resolution = 50;        ///< cells along the longest side of the mesh's bounding box
  std::optional<double> spacing; ///< edge length of a cell, used instead of `resolution`
  std::optional<int> rings;      ///< layers of cells around the cells that the mesh intersects; if not set, as needed
  bool dense = false;            ///< whether all cells of the mesh's bounding box and layers around it are used
  Energy_weights weights;
  double max_bytes = std::numeric_limits<double>::infinity(); ///< approximate limit
  bool allow_open_shell = false;

  /// returns the first invalid parameter, if there is one
  Invalid_parameter invalid() const
  {
    Invalid_parameter found;
    found.check("resolution", resolution, Parameter_bounds::positive());
    if(spacing) found.check("grid_spacing", *spacing, Parameter_bounds::positive());
    if(rings) found.check("number_of_rings", *rings, { 1, std::numeric_limits<double>::infinity(), true, false });
    found.check("memory_limit", max_bytes, Parameter_bounds::positive_or_infinite());
    weights.check(found);
    return found;
  }
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief builds a shell of a checked mesh as described for `bspline_shell_3()`. The oracle, if set, is used instead of
 * the signed distance to the mesh. Not a template of mesh, oracle, and solver, so that the library can contain compiled
 * instances.
 *
 * \pre the parameters are valid
 */
template <typename ConcurrencyTag>
Bspline_shell_3<> build_uniform_shell(Shell_construction& construction, const Uniform_shell_parameters& parameters,
                                      const std::optional<Any_signed_distance_3>& oracle, const Any_spd_solver& solver);

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief builds a shell of a checked mesh with the default solver.
 */
template <typename ConcurrencyTag>
Bspline_shell_3<> build_uniform_shell(Shell_construction& construction, const Uniform_shell_parameters& parameters,
                                      const std::optional<Any_signed_distance_3>& oracle);

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Construction/build_uniform_shell_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_BUILD_UNIFORM_SHELL_H
