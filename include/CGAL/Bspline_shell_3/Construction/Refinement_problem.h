// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PROBLEM_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PROBLEM_H

#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Construction/Refinement_parameters.h>
#include <CGAL/Bspline_shell_3/Construction/slope_conditions.h>
#include <CGAL/Bspline_shell_3/Field/Hierarchical_bspline_field_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_spd_solver.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Local_gap_3.h>
#include <CGAL/Bspline_shell_3/Support/Progress.h>

#include <CGAL/Bbox_3.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the input of a refinement, which is constant in all rounds.
 */
class Refinement_problem
{
public:
  typedef Hierarchical_bspline_field_3<> Field;

  /// returns the requested thickness near a point, in the units of the coordinates
  typedef std::function<double(const Field::Point_3&)> Thickness;
  /// called at the beginning of each step; throws to cancel
  typedef std::function<void(Shell_step)> Start;

  template <typename ConcurrencyTag>
  Refinement_problem(ConcurrencyTag, std::shared_ptr<const Input_mesh_3> mesh, const Any_signed_distance_3& distance,
                     const Thickness& thickness, const Any_spd_solver& solver, const Start& start,
                     const Refinement_parameters& parameters)
    : input(std::move(mesh)), oracle(distance), thickness(thickness), solver(solver), start(start),
      parameters(parameters),
      target_slopes(Bspline_shells::target_slopes<ConcurrencyTag>(*input, parameters.slope_fraction))
  {}

  /// returns half of the requested thickness at the center of a cell, which bounds |f| on the mesh in the cell
  double half_thickness(const Field& field, Field::Cell_index c) const
  {
    const Bbox_3 b = field.cell(c).bbox();
    return thickness(Field::Point_3((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2))
           / 2;
  }

  /// returns whether a triangle is at a fold: the slope possible at one of its vertices is below
  /// `Condition_tuning::fold_margin`
  bool is_at_fold(std::uint32_t triangle) const
  {
    return target_slopes[triangle] < condition_tuning.fold_margin * parameters.slope_fraction;
  }

  /// returns the local gap of the mesh, which the first call builds
  const Local_gap_3& gap()
  {
    if(!m_gap) m_gap.emplace(*input);
    return *m_gap;
  }

  const std::shared_ptr<const Input_mesh_3> input;
  const Any_signed_distance_3 oracle;
  const Thickness& thickness;
  const Any_spd_solver& solver;
  const Start& start;
  const Refinement_parameters parameters;
  const std::vector<double> target_slopes; ///< by triangle, per user unit; zero at singular vertices

private:
  std::optional<Local_gap_3> m_gap;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_REFINEMENT_PROBLEM_H
