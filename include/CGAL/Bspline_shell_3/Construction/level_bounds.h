// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CONSTRUCTION_LEVEL_BOUNDS_H
#define CGAL_BSPLINE_SHELL_3_CONSTRUCTION_LEVEL_BOUNDS_H

#include <CGAL/Bspline_shell_3/Mesh/clip_mesh_to_cells.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_forms.h>
#include <CGAL/Bspline_shell_3/Spline/bernstein_range.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// A piece of the mesh, the cell that it lies in, and what rounding can do to bounds there.
template <typename Field>
struct Piece_in_cell
{
  typename Field::Cell cell;
  std::vector<std::array<double, 3> > corner;    // in the cell
  double error;                                  // bounds how far a Bernstein coefficient on the piece is from that of f on the facet

  Piece_in_cell(const Field& field, const Clipped_mesh_3& clipped, const Clipped_mesh_3::Piece& piece)
    : cell(field.cell(piece.cell))
  {
    double reach = 0;
    for(std::uint32_t v = 0; v < piece.size; ++v) {
      const Clipped_mesh_3::Point& p = clipped.point(piece.first + v);
      corner.push_back(cell.local_coordinates(p));
      for(int a = 0; a < 3; ++a) reach = (std::max)(reach, std::abs(p[a]));
    }
    // Corners of a piece: six cuts one after the other, each off by at most ten roundings of the coordinates, and the
    // local coordinates with their bisections.
    const double shift = rounding * (64 * (reach + cell.width()) / cell.width() + 32);
    error = Form_error(shift)(enclosed_value(cell));
  }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief the extrema of a field on the edges of the clipped mesh, as the paper computes them (Section 4.2).
 *
 * On an edge the field is a polynomial of degree nine; its extrema are found by bisection (`bernstein_range()`).
 * Edges whose Bernstein coefficients lie within what was already found are skipped. The field's extrema on a facet may
 * lie in its interior, so that this is no bound (see `facet_range()`).
 */
template <typename ConcurrencyTag, typename Field>
Level_range edge_range(const Field& field, const Clipped_mesh_3& clipped)
{
  constexpr std::size_t chunk = 1024;
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  std::vector<Level_range> ranges((pieces.size() + chunk - 1) / chunk);
  internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Level_range& range = ranges[begin / chunk];
    for(std::size_t n = begin; n < end; ++n) {
      const internal::Piece_in_cell<Field> piece(field, clipped, pieces[n]);
      for(std::size_t v = 0; v < piece.corner.size(); ++v) {
        const std::array<double, 10> b = segment_bernstein_form<double>(
          piece.cell.coefficients(), piece.corner[v], piece.corner[(v + 1) % piece.corner.size()]);
        range.include(b.front());
        const auto hull = std::minmax_element(b.begin(), b.end());
        if(*hull.first < range.min || *hull.second > range.max) range.include(bernstein_range(b));
      }
    }
  });
  Level_range range;
  for(const Level_range& r : ranges) range.include(r);
  return range;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief bounds of a field on whole facets, and on the mesh.
 */
struct Facet_ranges
{
  std::vector<Level_range> facet;     ///< encloses the field on each triangle; not refined
  std::vector<Level_range> cell;      ///< encloses the field on the part of the mesh in each cell; not refined, empty without mesh
  Level_range mesh;                   ///< encloses the field on the mesh, to within the tolerance
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief encloses a field on the facets: Bernstein coefficients of degree nine on triangles, with a derived allowance
 * for rounding.
 *
 * The enclosure of the mesh is refined by subdivision, where it decides, until it exceeds values that the field takes by
 * at most `tolerance` times their range.
 */
template <typename ConcurrencyTag, typename Field>
Facet_ranges facet_ranges(const Field& field, const Clipped_mesh_3& clipped, double tolerance = 1e-7)
{
  typedef std::array<double, 3> Local_point;
  constexpr std::size_t chunk = 1024;
  constexpr int max_depth = 20;
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  const std::size_t chunks = (pieces.size() + chunk - 1) / chunk;

  std::vector<Level_range> attained(chunks);
  internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
    for(std::size_t n = begin; n < end; ++n) {
      const auto cell = field.cell(pieces[n].cell);
      for(std::uint32_t v = 0; v < pieces[n].size; ++v)
        attained[begin / chunk].include(cell.value(clipped.point(pieces[n].first + v)));
    }
  });
  Level_range values;
  for(const Level_range& r : attained) values.include(r);

  struct Triangle { Local_point p, q, r; int depth; };
  std::vector<Level_range> enclosure(chunks), piece_range(pieces.size());
  internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Level_range found = values;           // grows by what this chunk finds
    Level_range& bound = enclosure[begin / chunk];
    std::vector<Triangle> stack;
    for(std::size_t n = begin; n < end; ++n) {
      const internal::Piece_in_cell<Field> piece(field, clipped, pieces[n]);
      for(std::size_t v = 1; v + 1 < piece.corner.size(); ++v)
        stack.push_back({ piece.corner[0], piece.corner[v], piece.corner[v+1], 0 });
      while(!stack.empty()) {
        const Triangle t = stack.back();
        stack.pop_back();
        const std::array<double, 55> b = triangle_bernstein_form<double>(piece.cell.coefficients(), t.p, t.q, t.r);
        for(int corner : { 0, 45, 54 }) found.include(b[corner]);
        const auto hull = std::minmax_element(b.begin(), b.end());
        const Level_range range = { *hull.first - piece.error, *hull.second + piece.error };
        if(t.depth == 0) piece_range[n].include(range);
        const double slack = tolerance * (found.max - found.min) + 2 * piece.error;
        // so written that bounds that are not numbers end the search
        if(!(range.max > found.max + slack || range.min < found.min - slack) || t.depth == max_depth) {
          bound.include(range);
          continue;
        }
        Local_point m[3];
        for(int a = 0; a < 3; ++a) {
          m[0][a] = (t.q[a] + t.r[a]) / 2;
          m[1][a] = (t.r[a] + t.p[a]) / 2;
          m[2][a] = (t.p[a] + t.q[a]) / 2;
        }
        stack.push_back({ t.p, m[2], m[1], t.depth + 1 });
        stack.push_back({ m[2], t.q, m[0], t.depth + 1 });
        stack.push_back({ m[1], m[0], t.r, t.depth + 1 });
        stack.push_back({ m[0], m[1], m[2], t.depth + 1 });
      }
    }
  });

  Facet_ranges ranges;
  ranges.facet.resize(clipped.number_of_facets());
  ranges.cell.resize(field.number_of_cells());
  for(std::size_t n = 0; n < pieces.size(); ++n) {
    ranges.facet[pieces[n].facet].include(piece_range[n]);
    ranges.cell[pieces[n].cell].include(piece_range[n]);
  }
  for(const Level_range& r : enclosure) ranges.mesh.include(r);
  return ranges;
}

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief rounds a range outwards to multiples of `quantum` (the paper's \f$\tau\f$, Section 5.2, is the unit of length
 * divided by the quantum), and never inwards by the rounding of the multiples themselves.
 */
inline Level_range round_outwards(const Level_range& range, double quantum)
{
  Level_range r;
  r.min = std::floor(range.min / quantum) * quantum;
  r.max = std::ceil(range.max / quantum) * quantum;
  // quotients that overflow: to a quantum that small every such number is a multiple; and some that underflow
  if(!std::isfinite(r.min)) r.min = range.min;
  if(!std::isfinite(r.max)) r.max = range.max;
  if(r.min == 0 && range.min < 0) r.min = -quantum;
  if(r.max == 0 && range.max > 0) r.max = quantum;
  while(r.min > range.min) r.min = std::nextafter(r.min, -std::numeric_limits<double>::infinity());
  while(r.max < range.max) r.max = std::nextafter(r.max, std::numeric_limits<double>::infinity());
  return r;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CONSTRUCTION_LEVEL_BOUNDS_H
