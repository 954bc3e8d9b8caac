// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H

#include <CGAL/Bspline_shell_3/Construction/Condition_tuning.h>
#include <CGAL/Bspline_shell_3/Fit/Slope_condition.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
 * \brief returns conditions for a field on a mesh (`Slope_enforcement`): at the centers of pieces, and at the corners
 * of pieces that are not small relative to their cells. In cells with many pieces, only some centers have conditions.
 *
 * The slope varies little within a cell; the caller checks it everywhere.
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
  const std::size_t few = condition_tuning.few_pieces, most = condition_tuning.max_pieces;
  constexpr std::size_t chunk = 1024;
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  const auto is_small = [&](const Clipped_mesh_3::Piece& piece) {
    std::array<double, 3> low = clipped.point(piece.first), high = low;
    for(std::uint32_t v = 1; v < piece.size; ++v)
      for(int a = 0; a < 3; ++a) {
        low[a] = (std::min)(low[a], clipped.point(piece.first + v)[a]);
        high[a] = (std::max)(high[a], clipped.point(piece.first + v)[a]);
      }
    return !((std::max)({ high[0] - low[0], high[1] - low[1], high[2] - low[2] })
             > condition_tuning.small_piece * field.cells().width(piece.cell));
  };
  // A cell belongs to the chunk that contains its first piece.
  const auto first_of_cell = [&](std::size_t n) {
    while(0 < n && n < pieces.size() && pieces[n - 1].cell == pieces[n].cell) ++n;
    return n;
  };
  return internal::collect_from_chunks<ConcurrencyTag, Slope_condition>(
    pieces.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<Slope_condition>& conditions) {
      for(std::size_t n = first_of_cell(begin), next; n < end; n = next) {
        const std::uint32_t c = pieces[n].cell;
        for(next = n + 1; next < pieces.size() && pieces[next].cell == c; ++next) {}
        if(!needs_conditions(c)) continue;
        const typename Field::Cell cell = field.cell(c);
        const double size = largest(c);
        const std::size_t stride = (next - n + most - 1) / most;
        for(std::size_t m = n; m < next; m += stride) {
          const Clipped_mesh_3::Piece& piece = pieces[m];
          const double slope = target_slope(c, piece.facet);
          if(!(slope > 0)) continue;
          const auto add = [&](const std::array<double, 3>& p) {
            conditions.push_back(
              { c, piece.facet, cell.local_coordinates(p), clipped.normal(piece.facet), slope, size });
          };
          std::array<double, 3> middle = {};
          for(std::uint32_t v = 0; v < piece.size; ++v)
            for(int a = 0; a < 3; ++a) middle[a] += clipped.point(piece.first + v)[a] / piece.size;
          add(middle);
          if(next - n > few || is_small(piece)) continue;
          for(std::uint32_t v = 0; v < piece.size; ++v) add(clipped.point(piece.first + v));
        }
      }
    });
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
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  for(double reach : { (std::max)(2 * distance, cell.width()), 2 * distance, 1.25 * distance }) {
    const Bbox_3 box(point[0] - reach, point[1] - reach, point[2] - reach, point[0] + reach, point[1] + reach,
                     point[2] + reach);
    std::vector<std::uint32_t> facets;
    field.visit_cells(box, [&](typename Field::Cell_index n) {
      auto piece = std::lower_bound(pieces.begin(), pieces.end(), n,
                                    [](const Clipped_mesh_3::Piece& p, std::uint32_t m) { return p.cell < m; });
      for(; piece != pieces.end() && piece->cell == n; ++piece) {
        Bbox_3 b;
        for(std::uint32_t v = 0; v < piece->size; ++v) {
          const auto& p = clipped.point(piece->first + v);
          b += Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
        }
        if(do_overlap(b, box)) facets.push_back(piece->facet);
      }
    });
    sort_unique(facets);
    if(facets.empty()) continue;
    std::vector<Exact_predicates_inexact_constructions_kernel::Point_3> normals;
    for(std::uint32_t f : facets)
      normals.emplace_back(clipped.normal(f)[0], clipped.normal(f)[1], clipped.normal(f)[2]);
    std::array<double, 3> axis = cone_axis(normals);
    const double margin = internal::norm(axis);
    if(!(margin > condition_tuning.least_common_cosine)) continue;
    for(double& x : axis) x /= margin;
    return Slope_condition{ c, facets.front(), cell.local_coordinates(point), axis, fraction * margin };
  }
  return std::nullopt;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_SLOPE_CONDITIONS_H
