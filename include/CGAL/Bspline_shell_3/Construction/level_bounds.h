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
#include <CGAL/Bspline_shell_3/Spline/second_derivatives.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// A cell with pieces of the mesh, and the rounding errors of bounds on these pieces.
template <typename Field>
struct Cell_with_pieces
{
  typename Field::Cell cell;
  double shift; // bounds the error of corners of pieces, in local coordinates
  double error; // bounds the difference between a Bernstein coefficient on a piece and that of f on the facet

  Cell_with_pieces(const Field& field, typename Field::Cell_index c) : cell(field.cell(c))
  {
    double reach = 0;
    for(double x : cell.corner()) reach = (std::max)(reach, std::abs(x) + cell.width());
    // The corners of a piece result from six successive cuts, each with at most ten roundings of the coordinates. Local
    // coordinates and their bisections add further roundings.
    shift = rounding * (64 * (reach + cell.width()) / cell.width() + 32);
    error = Form_error(shift)(enclosed_value(cell));
  }

  void get_corners(const Clipped_mesh_3& clipped, const Clipped_mesh_3::Piece& piece,
                   std::vector<std::array<double, 3> >& corners) const
  {
    corners.clear();
    for(std::uint32_t v = 0; v < piece.size; ++v)
      corners.push_back(cell.local_coordinates(clipped.point(piece.first + v)));
  }
};

// Bounds a field on pieces by its values at their corners v and its second derivatives on the cell. By Taylor's formula
// at x = sum_i l_i v_i for each corner,
//   f(x) >= min_i f(v_i) - sum_{i<j} l_i l_j q(v_i - v_j) / 2
//        >= min_i f(v_i) - (n-1) / (4n) max(0, max_{i<j} q(v_i - v_j))
// for n corners. The quadratic form q is at least that of all second derivatives. The same holds for -f.
class Corner_bounds
{
public:
  explicit Corner_bounds(const Enclosed_tricubic& f)
  {
    const Symmetric_matrix_range_3 h = second_derivatives(f, 1);
    m_upwards = h.largest_form();
    m_downwards = (-h).largest_form();
    m_curvature = 2 * h.size();
  }

  // Returns how far the field may be below its smallest value at a corner, and above its largest value at a corner.
  std::pair<double, double> excess(const std::vector<std::array<double, 3> >& corners, double shift) const
  {
    double up = 0, down = 0;
    for(std::size_t i = 0; i < corners.size(); ++i)
      for(std::size_t j = 0; j < i; ++j) {
        const double x = corners[i][0] - corners[j][0], y = corners[i][1] - corners[j][1],
                     z = corners[i][2] - corners[j][2];
        const Symmetric_matrix_3 products = { x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y };
        double q_up = 0, q_down = 0;
        for(int m = 0; m < 6; ++m) {
          q_up += m_upwards[m] * products[m];
          q_down += m_downwards[m] * products[m];
        }
        up = (std::max)(up, q_up);
        down = (std::max)(down, q_down);
      }
    // Corners have errors of up to `shift`, and their differences of twice as much; both are shorter than two. The term
    // exceeds the rounding errors of the products.
    const double n = double(corners.size()), part = (n - 1) / (4 * n), error = 4 * m_curvature * shift;
    return { (1 + 8 * rounding) * (part * up + error), (1 + 8 * rounding) * (part * down + error) };
  }

private:
  Symmetric_matrix_3 m_upwards, m_downwards;
  double m_curvature;
};

// A part of a triangle in local coordinates of a cell.
struct Subtriangle
{
  std::array<double, 3> p, q, r;
  int depth; // number of bisections of its edges

  void push_quarters(std::vector<Subtriangle>& stack) const
  {
    std::array<double, 3> m[3];
    for(int a = 0; a < 3; ++a) {
      m[0][a] = (q[a] + r[a]) / 2;
      m[1][a] = (r[a] + p[a]) / 2;
      m[2][a] = (p[a] + q[a]) / 2;
    }
    stack.push_back({ p, m[2], m[1], depth + 1 });
    stack.push_back({ m[2], q, m[0], depth + 1 });
    stack.push_back({ m[1], m[0], r, depth + 1 });
    stack.push_back({ m[0], m[1], m[2], depth + 1 });
  }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns the extrema of a field on the edges of the clipped mesh, as in \cgalCite{CubicBsplineShell2025}
 * (Section 4.2).
 *
 * On an edge, the field is a polynomial of degree nine, and its extrema are found by bisection (`bernstein_range()`).
 * Edges whose Bernstein coefficients lie within the range found so far are skipped. The result does not bound the field
 * on facets, because its extrema may lie in their interior (see `facet_ranges()`).
 */
template <typename ConcurrencyTag, typename Field>
Level_range edge_range(const Field& field, const Clipped_mesh_3& clipped)
{
  constexpr std::size_t chunk = 1024;
  const std::vector<Clipped_mesh_3::Piece>& pieces = clipped.pieces();
  std::vector<Level_range> ranges((pieces.size() + chunk - 1) / chunk);
  internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Level_range& range = ranges[begin / chunk];
    std::vector<std::array<double, 3> > corners;
    for(std::size_t n = begin; n < end; ++n) {
      const internal::Cell_with_pieces<Field> in(field, pieces[n].cell);
      in.get_corners(clipped, pieces[n], corners);
      for(std::size_t v = 0; v < corners.size(); ++v) {
        const std::array<double, 10> b = segment_bernstein_form<double>(in.cell.coefficients(), corners[v],
                                                                        corners[(v + 1) % corners.size()]);
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
 * \brief bounds on a field on facets and on the mesh.
 */
struct Facet_ranges
{
  std::vector<Level_range> facet; ///< coarse enclosure of the field on each triangle
  /// coarse enclosure of the field on the part of the mesh in each cell; empty if the cell has no part of the mesh
  std::vector<Level_range> cell;
  Level_range mesh; ///< enclosure of the field on the mesh, up to the tolerance
};

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief returns enclosures of a field on facets, with a derived allowance for rounding.
 *
 * The bounds use values at corners and second derivatives where these suffice, and Bernstein coefficients of degree
 * nine on triangles otherwise. Where they determine the enclosure on the mesh, they are improved by subdivision, until
 * this enclosure exceeds attained values by at most `tolerance` times their range.
 */
template <typename ConcurrencyTag, typename Field>
Facet_ranges facet_ranges(const Field& field, const Clipped_mesh_3& clipped, double tolerance = 1e-7)
{
  constexpr std::size_t chunk = 1024;
  constexpr int max_depth = 20;
  constexpr double good = 0.002; // relative to the range of values: bounds with less excess are not improved
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

  std::vector<Level_range> enclosure(chunks), piece_range(pieces.size());
  internal::for_each_chunk<ConcurrencyTag>(pieces.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Level_range found = values; // extended by the values found in this chunk
    Level_range& bound = enclosure[begin / chunk];
    std::vector<internal::Subtriangle> stack;
    std::vector<std::array<double, 3> > corners;
    std::optional<internal::Cell_with_pieces<Field> > in;
    std::optional<internal::Corner_bounds> corner_bounds;
    for(std::size_t n = begin; n < end; ++n) {
      if(n == begin || pieces[n].cell != pieces[n - 1].cell) {
        in.emplace(field, pieces[n].cell);
        corner_bounds.emplace(enclosed_value(in->cell));
      }
      in->get_corners(clipped, pieces[n], corners);
      const std::pair<double, double> excess = corner_bounds->excess(corners, in->shift);
      if((std::max)(excess.first, excess.second) <= good * (values.max - values.min)) {
        Level_range range;
        for(std::uint32_t v = 0; v < pieces[n].size; ++v)
          range.include(in->cell.value(clipped.point(pieces[n].first + v)));
        range = { range.min - excess.first - in->error, range.max + excess.second + in->error };
        if(range.min >= found.min && range.max <= found.max) {
          piece_range[n] = range;
          bound.include(range);
          continue;
        }
      }
      for(std::size_t v = 1; v + 1 < corners.size(); ++v)
        stack.push_back({ corners[0], corners[v], corners[v + 1], 0 });
      while(!stack.empty()) {
        const internal::Subtriangle t = stack.back();
        stack.pop_back();
        const std::array<double, 55> b = triangle_bernstein_form<double>(in->cell.coefficients(), t.p, t.q, t.r);
        for(int corner : { 0, 45, 54 }) found.include(b[corner]);
        const auto hull = std::minmax_element(b.begin(), b.end());
        const Level_range range = { *hull.first - in->error, *hull.second + in->error };
        if(t.depth == 0) piece_range[n].include(range);
        const double slack = tolerance * (found.max - found.min) + 2 * in->error;
        // written such that the search ends if a bound is NaN
        if(!(range.max > found.max + slack || range.min < found.min - slack) || t.depth == max_depth) {
          bound.include(range);
          continue;
        }
        t.push_quarters(stack);
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

/// \ingroup PkgBsplineShell3Construction
/// \brief number of levels per box size to which constant thresholds are rounded: \f$\tau\f$ in
/// \cgalCite{CubicBsplineShell2025} (Section 5.2). Sharp bounds on the field on the mesh would leave no room for a
/// proof that the mesh lies strictly between the thresholds.
inline constexpr double levels_per_box_size = 1e10;

/*!
 * \ingroup PkgBsplineShell3Construction
 *
 * \brief rounds a range outward to multiples of `quantum`. Rounding errors of the multiples never shrink the range.
 */
inline Level_range round_outwards(const Level_range& range, double quantum)
{
  Level_range r;
  r.min = std::floor(range.min / quantum) * quantum;
  r.max = std::ceil(range.max / quantum) * quantum;
  // If a quotient overflows, the quantum is so small that the number itself is a multiple of it. Quotients may also
  // underflow.
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
