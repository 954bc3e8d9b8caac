// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CLIP_MESH_TO_CELLS_H
#define CGAL_BSPLINE_SHELL_3_CLIP_MESH_TO_CELLS_H

#include <CGAL/Bspline_shell_3/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/internal/for_each_chunk.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the mesh cut along the planes of a lattice (Remark 4.1 of the paper): convex polygons, each in one closed cell
 * and part of one facet.
 *
 * It serves quadrature and the search for extrema, where rounding of the cuts does no harm (a cut point lies within
 * a few units in the last place of the facet and exactly on its lattice planes). Both facets at an edge are cut at the
 * same points. Facets that lie in a plane between two cells belong to the cell behind them.
 */
class Clipped_mesh_3
{
public:
  typedef std::array<double, 3> Point;

  struct Piece
  {
    std::uint64_t cell;           ///< lattice key of the cell; after `sort_by_cell()`, pieces ascend by it
    std::uint32_t facet;          ///< number of the triangle it is a part of
    std::uint32_t size;           ///< number of its vertices
    std::size_t first;            ///< its vertices are `point(first)` ... `point(first + size - 1)`
  };

  std::size_t number_of_pieces() const { return m_pieces.size(); }
  const std::vector<Piece>& pieces() const { return m_pieces; }
  const Point& point(std::size_t n) const { return m_points[n]; }
  /// unit normal of a triangle of the mesh
  const Point& normal(std::uint32_t facet) const { return m_normals[facet]; }
  std::size_t number_of_facets() const { return m_normals.size(); }

  /// the lattice keys of the cells that have pieces, ascending, each once
  std::vector<std::uint64_t> cells() const
  {
    std::vector<std::uint64_t> keys;
    for(const Piece& p : m_pieces)
      if(keys.empty() || keys.back() != p.cell) keys.push_back(p.cell);
    return keys;
  }

  double area(const Piece& piece) const
  {
    const Point& n = m_normals[piece.facet];
    double sum = 0;
    const Point& o = m_points[piece.first];
    for(std::uint32_t v = 1; v + 1 < piece.size; ++v) {
      const Point& a = m_points[piece.first + v];
      const Point& b = m_points[piece.first + v + 1];
      const double u[3] = { a[0] - o[0], a[1] - o[1], a[2] - o[2] }, w[3] = { b[0] - o[0], b[1] - o[1], b[2] - o[2] };
      sum += n[0] * (u[1]*w[2] - u[2]*w[1]) + n[1] * (u[2]*w[0] - u[0]*w[2]) + n[2] * (u[0]*w[1] - u[1]*w[0]);
    }
    return sum / 2;
  }

  /// about how many pieces `clip_mesh_to_cells()` makes at that spacing, without making them
  template <typename InputMesh>
  static double estimated_number_of_pieces(const InputMesh& input, double spacing)
  {
    double pieces = 0;
    for(auto f : input.mesh().faces()) {
      const auto t = input.triangle(f);
      const auto n = CGAL::cross_product((t[1] - t[0]) / spacing, (t[2] - t[0]) / spacing);
      // a plane of unit normal n crosses |n|_1 cells per unit of area; a curve of length s at most 1 + sqrt(3) s
      double l1 = 0, perimeter = 0;
      for(int a = 0; a < 3; ++a) {
        l1 += std::abs(n[a]);
        perimeter += std::sqrt((t[(a+1) % 3] - t[a]).squared_length());
      }
      pieces += 1 + l1 / 2 + perimeter / spacing;
    }
    return pieces;
  }

private:
  template <typename ConcurrencyTag, typename InputMesh>
  friend Clipped_mesh_3 clip_mesh_to_cells(const InputMesh& input, const Lattice_3& lattice);

  // The part of one facet's polygon on one side of, and between, lattice planes; scratch memory is reused.
  class Cutter
  {
  public:
    Cutter(const Lattice_3& lattice, std::vector<Piece>& pieces, std::vector<Point>& points)
      : m_lattice(lattice), m_pieces(pieces), m_points(points) {}

    void cut(const std::array<Point, 3>& triangle, const Point& normal, std::uint32_t facet)
    {
      m_facet = facet;
      for(int a = 0; a < 3; ++a) m_behind[a] = normal[a] > 0 ? 1 : 0;
      m_polygon[0].assign(triangle.begin(), triangle.end());
      slice(0);
    }

  private:
    // cuts m_polygon[axis] into slabs across the axis, and these further
    void slice(int axis)
    {
      if(axis == 3) { emit(); return; }
      double lowest = m_polygon[axis][0][axis], highest = lowest;
      for(const Point& p : m_polygon[axis]) {
        lowest = (std::min)(lowest, p[axis]);
        highest = (std::max)(highest, p[axis]);
      }
      int first = m_lattice.interval(axis, lowest);
      int last = m_lattice.interval(axis, highest);
      if(last > first) {
        // a polygon that merely touches a plane from below does not enter the slab above
        if(m_lattice.coordinate(axis, last) == highest) --last;
      } else if(lowest == highest && m_lattice.coordinate(axis, first) == lowest) {
        first = last = first - m_behind[axis];
      }
      for(int i = first; i <= last; ++i) {
        m_cell[axis] = i;
        if(first == last) {
          m_polygon[axis + 1] = m_polygon[axis];
        } else {
          m_half.clear();
          keep(m_polygon[axis], axis, m_lattice.coordinate(axis, i), true, i == first, m_half);
          m_polygon[axis + 1].clear();
          keep(m_half, axis, m_lattice.coordinate(axis, i + 1), false, i == last, m_polygon[axis + 1]);
        }
        if(m_polygon[axis + 1].size() >= 3) slice(axis + 1);
      }
    }

    // the part of a convex polygon where the coordinate is at least (or at most) c
    static void keep(const std::vector<Point>& in, int axis, double c, bool above, bool all, std::vector<Point>& out)
    {
      if(all) { out = in; return; }
      for(std::size_t n = 0; n < in.size(); ++n) {
        const Point& p = in[n];
        const Point& q = in[n + 1 == in.size() ? 0 : n + 1];
        const double dp = above ? p[axis] - c : c - p[axis], dq = above ? q[axis] - c : c - q[axis];
        if(dp >= 0) out.push_back(p);
        if((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) out.push_back(crossing(p, q, axis, c));
      }
    }

    // the same point whichever way the edge is walked, between its ends in every coordinate
    static Point crossing(Point p, Point q, int axis, double c)
    {
      if(q < p) std::swap(p, q);
      const double t = (c - p[axis]) / (q[axis] - p[axis]);
      Point r;
      for(int a = 0; a < 3; ++a) {
        const double x = p[a] + t * (q[a] - p[a]);
        r[a] = (std::min)((std::max)(x, (std::min)(p[a], q[a])), (std::max)(p[a], q[a]));
      }
      r[axis] = c;
      return r;
    }

    void emit()
    {
      Piece piece;
      piece.cell = internal::Lattice_key::encode(m_cell[0], m_cell[1], m_cell[2]);
      piece.facet = m_facet;
      piece.first = m_points.size();
      piece.size = std::uint32_t(m_polygon[3].size());
      m_points.insert(m_points.end(), m_polygon[3].begin(), m_polygon[3].end());
      m_pieces.push_back(piece);
    }

    const Lattice_3& m_lattice;
    std::vector<Piece>& m_pieces;
    std::vector<Point>& m_points;
    std::array<std::vector<Point>, 4> m_polygon;
    std::vector<Point> m_half;
    Lattice_3::Point m_cell;
    std::array<int, 3> m_behind = {};     // per axis, 1 if the cell behind a facet is the one of smaller coordinates
    std::uint32_t m_facet = 0;
  };

  std::vector<Piece> m_pieces;
  std::vector<Point> m_points;
  std::vector<Point> m_normals;
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * cuts every triangle of `input` by the cells of `lattice`. Linear in the number of pieces; they are sorted by cell,
 * then by facet, and do not depend on the number of threads.
 *
 * \pre the coordinates of `input` divided by the lattice's spacing are at most `Lattice_key::max_coordinate`
 */
template <typename ConcurrencyTag, typename InputMesh>
Clipped_mesh_3 clip_mesh_to_cells(const InputMesh& input, const Lattice_3& lattice)
{
  typedef Clipped_mesh_3::Point Point;
  const auto& mesh = input.mesh();
  Clipped_mesh_3 clipped;
  std::vector<std::array<Point, 3> > triangles;
  triangles.reserve(mesh.number_of_faces());
  clipped.m_normals.reserve(mesh.number_of_faces());
  for(auto f : mesh.faces()) {
    const auto t = input.triangle(f);
    triangles.push_back({ Point{ t[0].x(), t[0].y(), t[0].z() }, Point{ t[1].x(), t[1].y(), t[1].z() },
                          Point{ t[2].x(), t[2].y(), t[2].z() } });
    // scaled first: the squares of a tiny facet's lengths would underflow
    auto u = t[1] - t[0], w = t[2] - t[0];
    double scale = 0;
    for(int a = 0; a < 3; ++a) scale = (std::max)({ scale, std::abs(u[a]), std::abs(w[a]) });
    auto n = CGAL::cross_product(u / scale, w / scale);
    double scale_n = (std::max)({ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) });
    if(scale_n > 0) {
      n = n / scale_n;
      n = n / std::sqrt(n.squared_length());
    }
    clipped.m_normals.push_back({ n[0], n[1], n[2] });
  }

  constexpr std::size_t chunk = 512;
  std::vector<std::vector<Clipped_mesh_3::Piece> > pieces((triangles.size() + chunk - 1) / chunk);
  std::vector<std::vector<Point> > points(pieces.size());
  internal::for_each_chunk<ConcurrencyTag>(triangles.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Clipped_mesh_3::Cutter cutter(lattice, pieces[begin / chunk], points[begin / chunk]);
    for(std::size_t n = begin; n < end; ++n) cutter.cut(triangles[n], clipped.m_normals[n], std::uint32_t(n));
  });

  std::size_t number_of_pieces = 0, number_of_points = 0;
  for(const auto& p : pieces) number_of_pieces += p.size();
  for(const auto& p : points) number_of_points += p.size();
  clipped.m_pieces.reserve(number_of_pieces);
  clipped.m_points.reserve(number_of_points);
  for(std::size_t c = 0; c < pieces.size(); ++c) {
    for(Clipped_mesh_3::Piece& p : pieces[c]) {
      p.first += clipped.m_points.size();
      clipped.m_pieces.push_back(p);
    }
    clipped.m_points.insert(clipped.m_points.end(), points[c].begin(), points[c].end());
    std::vector<Clipped_mesh_3::Piece>().swap(pieces[c]);
    std::vector<Point>().swap(points[c]);
  }
  std::stable_sort(clipped.m_pieces.begin(), clipped.m_pieces.end(),
                   [](const Clipped_mesh_3::Piece& a, const Clipped_mesh_3::Piece& b) { return a.cell < b.cell; });
  return clipped;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CLIP_MESH_TO_CELLS_H
