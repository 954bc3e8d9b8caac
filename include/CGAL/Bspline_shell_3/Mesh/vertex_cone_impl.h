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

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE std::optional<std::array<Exact_rational, 3> > exact_cone_direction(const Vertex_fan& fan)
{
  typedef Exact_rational ET;
  const auto& wings = fan.wings;
  CGAL::Quadratic_program<ET> program(CGAL::LARGER, false, 0, false, 0); // n_i . g >= 1, g free
  for(std::size_t i = 0; i < wings.size(); ++i) {
    ET a[3], b[3];
    for(int c = 0; c < 3; ++c) {
      a[c] = ET(wings[i].first[c]) - ET(fan.apex[c]);
      b[c] = ET(wings[i].second[c]) - ET(fan.apex[c]);
    }
    for(int c = 0; c < 3; ++c)
      program.set_a(c, int(i), a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]);
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
  for(ET& x : g) x /= largest; // rounded components neither overflow nor underflow
  return g;
}

typedef boost::container::small_vector<Facet_normal, 8> Fan_normals;

inline Fan_normals facet_normals(const Vertex_fan& fan)
{
  Fan_normals normals;
  for(const auto& w : fan.wings) normals.push_back(facet_normal(fan.apex, w.first, w.second));
  return normals;
}

// Returns whether a facet is proved to face the exact difference of two points, given the rounded difference.
// \pre the difference is zero, or far from underflow
inline bool certainly_faces(const Facet_normal& normal,
                            const Exact_predicates_inexact_constructions_kernel::Vector_3& difference)
{
  // Each component of the difference has a rounding error, and components of the normal are at most one.
  constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
  const double size = std::abs(difference.x()) + std::abs(difference.y()) + std::abs(difference.z());
  return dot(normal.direction, difference) > (normal.radius + roundings) * size;
}

inline std::optional<Exact_predicates_inexact_constructions_kernel::Vector_3> cone_direction(const Vertex_fan& fan,
                                                                                             const Fan_normals& normals)
{
  typedef Exact_predicates_inexact_constructions_kernel::Point_3 Point_3;
  typedef Exact_predicates_inexact_constructions_kernel::Vector_3 Vector_3;
  typedef std::optional<Vector_3> Result;
  const Point_3& p = fan.apex;
  const auto& wings = fan.wings;
  Vector_3 mean = NULL_VECTOR;
  double reach = 0;
  for(std::size_t i = 0; i < wings.size(); ++i) {
    const auto& n = normals[i].direction; // not normalized
    const double length = norm(n);
    if(length > 0) mean = mean + Vector_3(n[0], n[1], n[2]) / length;
    reach = (std::max)(reach, (wings[i].first - p).squared_length());
  }
  const auto unit = [](const Vector_3& g) { return Vector_3(g / std::sqrt(g.squared_length())); };

  // The exact direction is that from p to the rounded point s.
  if(mean != NULL_VECTOR) {
    const Point_3 s = p + std::sqrt(reach) * unit(mean);
    const Vector_3 g = s - p; // has the length of an edge whose square does not underflow, or is zero
    // Not if squared edge lengths overflow or normals cancel.
    bool faced = std::isfinite(s.x()) && std::isfinite(s.y()) && std::isfinite(s.z());
    for(std::size_t i = 0; i < wings.size() && faced; ++i)
      faced = certainly_faces(normals[i], g) || CGAL::orientation(p, wings[i].first, wings[i].second, s) == POSITIVE;
    if(faced) return Result(unit(g));
  }

  const auto g = exact_cone_direction(fan);
  if(!g) return Result();
  return Result(unit(Vector_3(rounded((*g)[0]), rounded((*g)[1]), rounded((*g)[2]))));
}

CGAL_BSPLINE_SHELL_3_INLINE std::optional<Exact_predicates_inexact_constructions_kernel::Vector_3> cone_direction(
  const Vertex_fan& fan)
{
  return cone_direction(fan, facet_normals(fan));
}

inline double cone_margin(const Fan_normals& normals)
{
  std::vector<Exact_predicates_inexact_constructions_kernel::Point_3> unit_normals;
  for(const Facet_normal& normal : normals) {
    const auto& n = normal.direction;
    const double length = norm(n);
    unit_normals.emplace_back(n[0] / length, n[1] / length, n[2] / length);
  }
  const std::array<double, 3> axis = cone_axis(unit_normals);
  return norm(axis);
}

CGAL_BSPLINE_SHELL_3_INLINE double cone_margin(const Vertex_fan& fan)
{
  return cone_margin(facet_normals(fan));
}

CGAL_BSPLINE_SHELL_3_INLINE std::optional<double> bounded_cone_margin(const Vertex_fan& fan, double bound)
{
  const Fan_normals normals = facet_normals(fan);
  const auto g = cone_direction(fan, normals);
  if(!g) return std::nullopt;
  const bool is_enough = std::all_of(normals.begin(), normals.end(), [&](const Facet_normal& n) {
    return dot(n.direction, *g) >= bound * norm(n.direction);
  });
  return is_enough ? bound : (std::min)(bound, cone_margin(normals));
}

// A separate type, because the layout of Min_sphere_of_spheres_d depends on NDEBUG: a program that uses CGAL's traits
// may be compiled with other assertions than the library.
struct Cone_axis_traits : Min_sphere_of_points_d_traits_3<Exact_predicates_inexact_constructions_kernel, double>
{};

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE
std::array<double, 3> cone_axis(const std::vector<Exact_predicates_inexact_constructions_kernel::Point_3>& unit_vectors)
{
  CGAL_precondition(!unit_vectors.empty());
  Min_sphere_of_spheres_d<internal::Cone_axis_traits> ball(unit_vectors.begin(), unit_vectors.end());
  std::array<double, 3> axis;
  std::copy(ball.center_cartesian_begin(), ball.center_cartesian_end(), axis.begin());
  return axis;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_VERTEX_CONE_IMPL_H
