// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_COMMON_DIRECTION_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_COMMON_DIRECTION_H

#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Construction
/// a direction at less than 90 degrees to normals
struct Common_direction
{
  std::array<double, 3> direction; ///< unit vector
  double margin;                   ///< smallest product with a unit normal; positive
  std::uint32_t facet;             ///< one of the facets
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the direction with the largest margin to the normals of all facets with pieces in a box; nothing if
 * there are no facets, or if the margin is at most `Condition_tuning::least_common_cosine`.
 */
template <typename Field>
std::optional<Common_direction> common_direction(const Field& field, const Clipped_mesh_3& clipped, const Bbox_3& box)
{
  std::vector<std::uint32_t> facets;
  field.visit_cells(box, [&](typename Field::Cell_index c) {
    for(const Clipped_mesh_3::Piece& piece : clipped.pieces(c)) {
      Bbox_3 b;
      for(std::uint32_t v = 0; v < piece.size; ++v) {
        const auto& p = clipped.point(piece.first + v);
        b += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
      }
      if(do_overlap(b, box)) facets.push_back(piece.facet);
    }
  });
  sort_unique(facets);
  if(facets.empty()) return std::nullopt;
  std::vector<Exact_predicates_inexact_constructions_kernel::Point_3> normals;
  for(std::uint32_t f : facets) normals.emplace_back(clipped.normal(f)[0], clipped.normal(f)[1], clipped.normal(f)[2]);
  std::array<double, 3> axis = cone_axis(normals);
  const double margin = internal::norm(axis);
  if(!(margin > condition_tuning.least_common_cosine)) return std::nullopt;
  for(double& x : axis) x /= margin;
  return Common_direction{ axis, margin, facets.front() };
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns a slope condition at a point near a mesh, along a direction at less than 90 degrees to the normals of
 * all facets nearby; nothing if there is no such direction.
 *
 * \param c,point a cell, and a point in it
 * \param distance distance of the point from the mesh
 * \param fraction fraction of the possible slope
 */
template <typename Field>
std::optional<Slope_condition> common_slope(const Field& field, const Clipped_mesh_3& clipped,
                                            typename Field::Cell_index c, const std::array<double, 3>& point,
                                            double distance, double fraction)
{
  const typename Field::Cell cell = field.cell(c);
  for(double reach : { (std::max)(2 * distance, cell.width()), 2 * distance, 1.25 * distance }) {
    const auto common = common_direction(field, clipped,
                                         Bbox_3(point[0] - reach, point[1] - reach, point[2] - reach, point[0] + reach,
                                                point[1] + reach, point[2] + reach));
    if(common)
      return Slope_condition{ c, common->facet, cell.local_coordinates(point), common->direction,
                              fraction * common->margin };
  }
  return std::nullopt;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_COMMON_DIRECTION_H
