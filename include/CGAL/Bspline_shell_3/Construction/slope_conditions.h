// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H

#include <CGAL/Bspline_shell_3/Construction/condition_points.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the slope that a field should have along the normal of each triangle: a fraction of the slope that is
 * possible at all three vertices (`vertex_cone_margin()`), and zero if a vertex is singular.
 *
 * \param fraction fraction of the possible slope
 */
template <typename ConcurrencyTag>
std::vector<double> target_slopes(const Input_mesh_3& input, double fraction)
{
  constexpr std::size_t chunk = 1024;
  constexpr double singular = 1e-9; // smaller cone margins are within rounding errors
  const auto& mesh = input.mesh();
  std::vector<double> margin(mesh.number_of_vertices(), 1);
  internal::for_each_chunk<ConcurrencyTag>(margin.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const Input_mesh_3::Triangle_mesh::Vertex_index v(static_cast<unsigned int>(n));
      if(!mesh.is_isolated(v)) margin[n] = vertex_cone_margin(mesh, v);
    }
  });
  std::vector<double> slopes;
  slopes.reserve(mesh.number_of_faces());
  for(auto f : mesh.faces()) {
    double least = 1;
    for(auto v : mesh.vertices_around_face(mesh.halfedge(f))) least = (std::min)(least, margin[v]);
    slopes.push_back(least < singular ? 0 : fraction * least);
  }
  return slopes;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns conditions for a field on a mesh (`Slope_enforcement`), along the normals at the points of
 * `visit_condition_points()`. The slope varies little within a cell; the caller checks it everywhere.
 *
 * \tparam ConcurrencyTag the tag of `target_slopes()`; unless it is `Sequential_tag`, functions are called concurrently
 * \param target_slope the slope of a triangle in a cell (`target_slopes()`). If it is zero, no condition is added,
 *   because corrections cannot help at a singular vertex.
 * \param needs_conditions whether a cell needs conditions
 * \param largest largest allowed \f$|f|\f$ on the mesh in a cell, in units of the width of root cells
 */
template <typename ConcurrencyTag = Sequential_tag, typename Field, typename Slope, typename Predicate, typename Size>
std::vector<Slope_condition> slope_conditions(const Field& field, const Clipped_mesh_3& clipped,
                                              const Slope& target_slope, const Predicate& needs_conditions,
                                              const Size& largest)
{
  return conditions_by_cell<ConcurrencyTag>(clipped, [&](std::uint32_t c, const Clipped_mesh_3::Piece_range& pieces,
                                                         std::vector<Slope_condition>& conditions) {
    if(!needs_conditions(c)) return;
    const typename Field::Cell cell = field.cell(c);
    const double size = largest(c);
    visit_condition_points(
      clipped, pieces, cell.width(), [&](const Clipped_mesh_3::Piece& piece, const std::array<double, 3>& p) {
        const double slope = target_slope(c, piece.facet);
        if(slope > 0)
          conditions.push_back({ c, piece.facet, cell.local_coordinates(p), clipped.normal(piece.facet), slope, size });
      });
  });
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H
