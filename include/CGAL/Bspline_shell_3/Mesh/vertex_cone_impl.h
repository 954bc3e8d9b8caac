// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/facet_normal.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE std::optional<std::array<Exact_rational, 3> > exact_cone_direction(const Vertex_fan& fan)
{
  typedef Exact_rational ET;
  const auto& wings = fan.wings;
  CGAL::Quadratic_program<ET> program(CGAL::LARGER, false, 0, false, 0);     // n_i . g >= 1, g free
  for(std::size_t i = 0; i < wings.size(); ++i) {
    ET a[3], b[3];
    for(int c = 0; c < 3; ++c) {
      a[c] = ET(wings[i].first[c]) - ET(fan.apex[c]);
      b[c] = ET(wings[i].second[c]) - ET(fan.apex[c]);
    }
    for(int c = 0; c < 3; ++c)
      program.set_a(c, int(i), a[(c+1) % 3] * b[(c+2) % 3] - a[(c+2) % 3] * b[(c+1) % 3]);
    program.set_b(int(i), ET(1));
  }
  const CGAL::Quadratic_program_solution<ET> solution = CGAL::solve_linear_program(program, ET());
  if(solution.is_infeasible()) return std::nullopt;
  std::array<ET, 3> g;
  ET largest = 0;
  int c = 0;
  for(auto it = solution.variable_values_begin(); it != solution.variable_values_end() && c < 3; ++it, ++c) {
    g[c] = it->numerator() / it->denominator();
    largest = (std::max)(largest, ET(CGAL::abs(g[c])));
  }
  for(ET& x : g) x /= largest;     // to_double of the components neither overflows nor vanishes
  return g;
}

CGAL_BSPLINE_SHELL_3_INLINE std::optional<Exact_predicates_inexact_constructions_kernel::Vector_3> cone_direction(const Vertex_fan& fan)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef Exact_predicates_inexact_constructions_kernel::Vector_3 Vector_3;
  typedef std::optional<Vector_3> Result;
  const Point_3& p = fan.apex;
  const auto& wings = fan.wings;
  Vector_3 mean = NULL_VECTOR;
  double reach = 0;
  for(const auto& w : wings) {
    const auto n = facet_normal(p, w.first, w.second).direction;       // at any scale
    const double length = norm(n);
    if(length > 0) mean = mean + Vector_3(n[0], n[1], n[2]) / length;
    reach = (std::max)(reach, (w.first - p).squared_length());
  }
  const auto unit = [](const Vector_3& g) { return Vector_3(g / std::sqrt(g.squared_length())); };

  // The exact direction is the one from p to the rounded point s.
  if(mean != NULL_VECTOR) {
    const Point_3 s = p + std::sqrt(reach) * unit(mean);
    bool faced = true;
    for(const auto& w : wings) faced = faced && CGAL::orientation(p, w.first, w.second, s) == POSITIVE;
    if(faced) return Result(unit(s - p));
  }

  const auto g = exact_cone_direction(fan);
  if(!g) return Result();
  return Result(unit(Vector_3(CGAL::to_double((*g)[0]), CGAL::to_double((*g)[1]), CGAL::to_double((*g)[2]))));
}

CGAL_BSPLINE_SHELL_3_INLINE double cone_margin(const Vertex_fan& fan)
{
  std::vector<Exact_predicates_inexact_constructions_kernel::Point_3> normals;
  for(const auto& w : fan.wings) {
    const auto n = facet_normal(fan.apex, w.first, w.second).direction;
    const double length = norm(n);
    normals.emplace_back(n[0] / length, n[1] / length, n[2] / length);
  }
  const std::array<double, 3> axis = cone_axis(normals);
  return norm(axis);
}

CGAL_BSPLINE_SHELL_3_INLINE std::optional<double> bounded_cone_margin(const Vertex_fan& fan, double bound)
{
  const auto g = cone_direction(fan);
  if(!g) return std::nullopt;
  const bool is_enough = std::all_of(fan.wings.begin(), fan.wings.end(), [&](const auto& w) {
    const auto n = facet_normal(fan.apex, w.first, w.second).direction;
    return n[0] * g->x() + n[1] * g->y() + n[2] * g->z() >= bound * norm(n);
  });
  return is_enough ? bound : (std::min)(bound, cone_margin(fan));
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE
std::array<double, 3> cone_axis(const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& unit_vectors)
{
  typedef Min_sphere_of_points_d_traits_3<Exact_predicates_inexact_constructions_kernel, double> Traits;
  CGAL_precondition(!unit_vectors.empty());
  Min_sphere_of_spheres_d<Traits> ball(unit_vectors.begin(), unit_vectors.end());
  std::array<double, 3> axis;
  std::copy(ball.center_cartesian_begin(), ball.center_cartesian_end(), axis.begin());
  return axis;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_IMPL_H
