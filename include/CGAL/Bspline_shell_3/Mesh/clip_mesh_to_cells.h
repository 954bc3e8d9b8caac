// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_CLIP_MESH_TO_CELLS_H
#define CGAL_BSPLINE_SHELL_3_MESH_CLIP_MESH_TO_CELLS_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Iterator_range.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

typedef std::array<double, 3> Clip_point;

// Cuts convex polygons by planes perpendicular to the axes; scratch memory is reused.
class Polygon_cutter
{
public:
  typedef std::vector<Clip_point> Polygon;

  explicit Polygon_cutter(const Lattice_3& lattice) : m_lattice(lattice) {}

  // Calls visit(p, polygon) for the part of a triangle in each cell that it enters, where p is the cell's lattice
  // point. A triangle in a plane between two cells belongs to the cell behind it, as given by `normal`.
  template <typename Visitor>
  void cut(const std::array<Clip_point, 3>& triangle, const Clip_point& normal, const Visitor& visit)
  {
    for(int a = 0; a < 3; ++a) m_behind[a] = normal[a] > 0 ? 1 : 0;
    m_polygon[0].assign(triangle.begin(), triangle.end());
    slice(0, visit);
  }

  // Computes the parts of a polygon below and above a plane; a part is empty if the polygon does not enter its side.
  void halve(const Polygon& polygon, int axis, double c, std::array<Polygon, 2>& halves) const
  {
    double lowest, highest;
    extent(polygon, axis, lowest, highest);
    halves[0].clear();
    halves[1].clear();
    if(highest < c || (highest == c && lowest < c)) halves[0] = polygon;
    else if(lowest > c || (lowest == c && highest > c)) halves[1] = polygon;
    else if(lowest == highest) halves[1 - m_behind[axis]] = polygon;
    else {
      keep(polygon, axis, c, false, false, halves[0]);
      keep(polygon, axis, c, true, false, halves[1]);
    }
    for(Polygon& half : halves)
      if(half.size() < 3) half.clear();
  }

private:
  static void extent(const Polygon& polygon, int axis, double& lowest, double& highest)
  {
    lowest = highest = polygon[0][axis];
    for(const Clip_point& p : polygon) {
      lowest = (std::min)(lowest, p[axis]);
      highest = (std::max)(highest, p[axis]);
    }
  }

  // Cuts m_polygon[axis] into slabs across the axis, and the slabs across the remaining axes.
  template <typename Visitor>
  void slice(int axis, const Visitor& visit)
  {
    if(axis == 3) {
      visit(m_cell, m_polygon[3]);
      return;
    }
    double lowest, highest;
    extent(m_polygon[axis], axis, lowest, highest);
    int first = m_lattice.interval(axis, lowest);
    int last = m_lattice.interval(axis, highest);
    if(last > first) {
      // A polygon that merely touches a plane from below does not enter the slab above.
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
      if(m_polygon[axis + 1].size() >= 3) slice(axis + 1, visit);
    }
  }

  // Computes the part of a convex polygon where the coordinate is at least (or at most) c.
  static void keep(const Polygon& in, int axis, double c, bool above, bool all, Polygon& out)
  {
    if(all) {
      out = in;
      return;
    }
    for(std::size_t n = 0; n < in.size(); ++n) {
      const Clip_point& p = in[n];
      const Clip_point& q = in[n + 1 == in.size() ? 0 : n + 1];
      const double dp = above ? p[axis] - c : c - p[axis], dq = above ? q[axis] - c : c - q[axis];
      if(dp >= 0) out.push_back(p);
      if((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) out.push_back(crossing(p, q, axis, c));
    }
  }

  // Returns the same point for both directions of the edge; each coordinate is between those of the ends.
  static Clip_point crossing(Clip_point p, Clip_point q, int axis, double c)
  {
    if(q < p) std::swap(p, q);
    const double t = (c - p[axis]) / (q[axis] - p[axis]);
    Clip_point r;
    for(int a = 0; a < 3; ++a) {
      const double x = p[a] + t * (q[a] - p[a]);
      r[a] = (std::min)((std::max)(x, (std::min)(p[a], q[a])), (std::max)(p[a], q[a]));
    }
    r[axis] = c;
    return r;
  }

  const Lattice_3& m_lattice;
  std::array<Polygon, 4> m_polygon;
  Polygon m_half;
  Lattice_3::Point m_cell;
  std::array<int, 3> m_behind = {}; // by axis: 1 if the cell behind a facet has the smaller coordinate
};

// Cuts the part of a polygon in a cell of a level further, down to the leaves, and calls visit(leaf, polygon).
class Leaf_cutter
{
public:
  explicit Leaf_cutter(const Polygon_cutter& cutter) : m_cutter(cutter) {}

  template <typename Visitor>
  void cut(const Cell_hierarchy_3& cells, int level, const Lattice_3::Point& p, const Polygon_cutter::Polygon& polygon,
           const Visitor& visit)
  {
    const Cell_hierarchy_3::Index c = cells.leaf(level, p);
    if(c != Cell_hierarchy_3::npos) {
      visit(c, polygon);
      return;
    }
    while(m_halves.size() <= std::size_t(level)) m_halves.emplace_back();
    std::array<std::array<Polygon_cutter::Polygon, 2>, 3>& halves = m_halves[std::size_t(level)];
    const auto middle = [&](int a) { return cells.coordinate(level + 1, a, 2 * p[a] + 1); };
    m_cutter.halve(polygon, 0, middle(0), halves[0]);
    for(int i = 0; i < 2; ++i) {
      if(halves[0][i].empty()) continue;
      m_cutter.halve(halves[0][i], 1, middle(1), halves[1]);
      for(int j = 0; j < 2; ++j) {
        if(halves[1][j].empty()) continue;
        m_cutter.halve(halves[1][j], 2, middle(2), halves[2]);
        for(int k = 0; k < 2; ++k)
          if(!halves[2][k].empty())
            cut(cells, level + 1, { 2 * p[0] + i, 2 * p[1] + j, 2 * p[2] + k }, halves[2][k], visit);
      }
    }
  }

private:
  const Polygon_cutter& m_cutter;
  std::deque<std::array<std::array<Polygon_cutter::Polygon, 2>, 3> > m_halves; // by level; references stay valid
};

// \pre facets are numbered consecutively
template <typename InputMesh>
std::array<Clip_point, 3> triangle_to_clip(const InputMesh& input, std::size_t n)
{
  const auto t = input.triangle(typename InputMesh::Face_index(static_cast<unsigned int>(n)));
  return { Clip_point{ t[0].x(), t[0].y(), t[0].z() }, Clip_point{ t[1].x(), t[1].y(), t[1].z() },
           Clip_point{ t[2].x(), t[2].y(), t[2].z() } };
}

// Returns the indices of the corners of a triangle, in the order of `triangle_to_clip()`.
template <typename InputMesh>
std::array<std::uint32_t, 3> corners_to_clip(const InputMesh& input, std::size_t n)
{
  const auto& mesh = input.mesh();
  const auto h = mesh.halfedge(typename InputMesh::Face_index(static_cast<unsigned int>(n)));
  return { { std::uint32_t(mesh.source(h)), std::uint32_t(mesh.target(h)), std::uint32_t(mesh.target(mesh.next(h))) } };
}

// Returns the unit normal; zero for a facet too flat for `double`s.
inline Clip_point unit_normal(const std::array<Clip_point, 3>& t)
{
  // Scaled first, because the squares of a tiny facet's lengths would underflow.
  typedef Simple_cartesian<double>::Vector_3 Vector_3;
  Vector_3 u(t[1][0] - t[0][0], t[1][1] - t[0][1], t[1][2] - t[0][2]),
    w(t[2][0] - t[0][0], t[2][1] - t[0][1], t[2][2] - t[0][2]);
  double scale = 0;
  for(int a = 0; a < 3; ++a) scale = (std::max)({ scale, std::abs(u[a]), std::abs(w[a]) });
  Vector_3 n = CGAL::cross_product(u / scale, w / scale);
  const double scale_n = (std::max)({ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) });
  if(scale_n > 0) {
    n = n / scale_n;
    n = n / std::sqrt(n.squared_length());
  }
  return { n[0], n[1], n[2] };
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief a mesh cut by the cells of a field (Remark 4.1 of \cgalCite{CubicBsplineShell2025}): convex polygons, each in
 * one closed cell and part of one facet.
 *
 * It is used for quadrature and for the search for extrema, which tolerate rounding of the cuts: a cut point lies
 * within a few units in the last place of the facet, and exactly on the planes between cells. The two facets at an edge
 * are cut at the same points, unless the edge lies in a plane between leaves of different sizes. Facets in a plane
 * between two cells belong to the cell behind them.
 */
class Clipped_mesh_3
{
public:
  typedef std::array<double, 3> Point;

  struct Piece
  {
    std::uint32_t cell;  ///< index of the leaf cell, by which pieces are sorted
    std::uint32_t facet; ///< index of the triangle to which the piece belongs
    std::uint32_t size;  ///< number of vertices of the piece
    std::size_t first;   ///< its vertices are `point(first)` ... `point(first + size - 1)`
  };
  /// successive pieces, for example those in a cell
  typedef Iterator_range<std::vector<Piece>::const_iterator> Piece_range;

  std::size_t number_of_pieces() const { return m_pieces.size(); }
  const std::vector<Piece>& pieces() const { return m_pieces; }
  /// returns the pieces in a cell
  Piece_range pieces(std::uint32_t cell) const
  {
    const auto begin = std::lower_bound(m_pieces.begin(), m_pieces.end(), cell,
                                        [](const Piece& p, std::uint32_t c) { return p.cell < c; });
    auto end = begin;
    while(end != m_pieces.end() && end->cell == cell) ++end;
    return Piece_range(begin, end);
  }
  const Point& point(std::size_t n) const { return m_points[m_corners[n]]; }
  /// returns the unit normal of a triangle of the mesh
  const Point& normal(std::uint32_t facet) const { return m_normals[facet]; }
  std::size_t number_of_facets() const { return m_normals.size(); }

  /// returns the cells that have pieces, ascending, without duplicates
  std::vector<std::uint32_t> cells() const
  {
    std::vector<std::uint32_t> cells;
    for(const Piece& p : m_pieces)
      if(cells.empty() || cells.back() != p.cell) cells.push_back(p.cell);
    return cells;
  }

  double area(const Piece& piece) const
  {
    const Point& n = m_normals[piece.facet];
    double sum = 0;
    const Point& o = point(piece.first);
    for(std::uint32_t v = 1; v + 1 < piece.size; ++v) {
      const Point& a = point(piece.first + v);
      const Point& b = point(piece.first + v + 1);
      const double u[3] = { a[0] - o[0], a[1] - o[1], a[2] - o[2] }, w[3] = { b[0] - o[0], b[1] - o[1], b[2] - o[2] };
      sum += internal::dot(n, internal::cross(u, w));
    }
    return sum / 2;
  }

  /// estimates the number of pieces that `clip_mesh_to_cells()` creates at a spacing, without creating them
  template <typename InputMesh>
  static double estimated_number_of_pieces(const InputMesh& input, double spacing)
  {
    double pieces = 0;
    for(auto f : input.mesh().faces()) {
      const auto t = input.triangle(f);
      const auto n = CGAL::cross_product((t[1] - t[0]) / spacing, (t[2] - t[0]) / spacing);
      // A plane with unit normal n crosses |n|_1 cells per unit of area, and a curve of length s at most 1 + sqrt(3) s
      // cells.
      double l1 = 0, perimeter = 0;
      for(int a = 0; a < 3; ++a) {
        l1 += std::abs(n[a]);
        perimeter += std::sqrt((t[(a + 1) % 3] - t[a]).squared_length());
      }
      pieces += 1 + l1 / 2 + perimeter / spacing;
    }
    return pieces;
  }

private:
  template <typename ConcurrencyTag, typename InputMesh>
  friend Clipped_mesh_3 clip_mesh_to_cells(const InputMesh& input, const Cell_hierarchy_3& cells);

  std::vector<Piece> m_pieces;
  std::vector<std::uint32_t> m_corners; // indices of the points of all pieces
  std::vector<Point> m_points;          // vertices of the mesh first, because most pieces are facets of a fine mesh
  std::vector<Point> m_normals;
};

namespace internal {

// Calls visit(cell, part of a triangle in the cell, keys), which adds lattice keys. Returns them ascending, without
// duplicates.
template <typename ConcurrencyTag, typename InputMesh, typename Visitor>
std::vector<std::uint64_t> cells_at_mesh(const InputMesh& input, const Lattice_3& lattice, const Visitor& visit)
{
  const std::size_t size = input.mesh().number_of_faces(), chunk = chunk_size(size, 512);
  typedef std::vector<std::uint64_t> Keys;
  const auto find = [&](std::size_t begin, std::size_t end, Keys& found) {
    Polygon_cutter cutter(lattice);
    for(std::size_t n = begin; n < end; ++n) {
      const auto triangle = triangle_to_clip(input, n);
      cutter.cut(triangle, unit_normal(triangle),
                 [&](const Lattice_3::Point& p, const Polygon_cutter::Polygon& polygon) { visit(p, polygon, found); });
    }
    sort_unique(found);
  };
  Keys keys = collect_from_chunks<ConcurrencyTag, std::uint64_t>(size, chunk, find);
  sort_unique(keys);
  return keys;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the lattice keys of the cells that the mesh enters, ascending.
 *
 * \pre the coordinates of `input` divided by the lattice's spacing are at most `Lattice_key::max_coordinate`
 */
template <typename ConcurrencyTag, typename InputMesh>
std::vector<std::uint64_t> cells_entered_by_mesh(const InputMesh& input, const Lattice_3& lattice)
{
  return internal::cells_at_mesh<ConcurrencyTag>(
    input, lattice, [](const Lattice_3::Point& p, const auto&, std::vector<std::uint64_t>& keys) {
      keys.push_back(Lattice_key::encode(p[0], p[1], p[2]));
    });
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief lattice keys of cells at a mesh, ascending.
 */
struct Cells_near_mesh
{
  std::vector<std::uint64_t> entered; ///< cells that the mesh enters
  std::vector<std::uint64_t> near;    ///< cells that the mesh enters, and cells near it
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief returns the cells that the mesh enters, and all cells whose interior has a point at less than `distance` from
 * a point of the mesh along each axis. A few other cells are included, because the part of a facet in a cell is
 * replaced by its bounding box.
 *
 * \pre the distance is less than the lattice's spacing (`dilate()` finds cells farther away), and the coordinates of
 * `input` divided by the spacing are at most `Lattice_key::max_coordinate`
 */
template <typename ConcurrencyTag, typename InputMesh>
Cells_near_mesh cells_near_mesh(const InputMesh& input, const Lattice_3& lattice, double distance)
{
  constexpr std::uint64_t entered = std::uint64_t(1) << 63; // above all keys
  static_assert(Lattice_key::bits * 3 < 64);
  CGAL_precondition(distance < lattice.spacing());
  Cells_near_mesh cells;
  cells.near = internal::cells_at_mesh<ConcurrencyTag>(
    input, lattice, [&](const Lattice_3::Point& p, const auto& polygon, std::vector<std::uint64_t>& keys) {
      Lattice_3::Point first, last;
      for(int a = 0; a < 3; ++a) {
        double lowest = polygon[0][a], highest = lowest;
        for(const auto& q : polygon) {
          lowest = (std::min)(lowest, q[a]);
          highest = (std::max)(highest, q[a]);
        }
        first[a] = (std::min)(p[a], lattice.interval(a, lowest - distance));
        last[a] = lattice.interval(a, highest + distance);
        if(lattice.coordinate(a, last[a]) == highest + distance) --last[a]; // a reflected mesh has the reflected cells
        last[a] = (std::max)(p[a], last[a]);
      }
      keys.push_back(entered | Lattice_key::encode(p[0], p[1], p[2]));
      for(int k = first[2]; k <= last[2]; ++k)
        for(int j = first[1]; j <= last[1]; ++j)
          for(int i = first[0]; i <= last[0]; ++i) keys.push_back(Lattice_key::encode(i, j, k));
    });
  const auto first_entered = std::lower_bound(cells.near.begin(), cells.near.end(), entered);
  for(auto key = first_entered; key != cells.near.end(); ++key) cells.entered.push_back(*key - entered);
  cells.near.erase(first_entered, cells.near.end());
  return cells;
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * cuts every triangle of `input` by the leaf cells. Pieces are sorted by cell and then by facet, and do not depend on
 * the number of threads. A facet that is not cut takes about 70 bytes.
 *
 * \pre `cells` contain the mesh (`cells_entered_by_mesh()`)
 * \cgalHeading{Cost} Linear in the number of pieces.
 */
template <typename ConcurrencyTag, typename InputMesh>
Clipped_mesh_3 clip_mesh_to_cells(const InputMesh& input, const Cell_hierarchy_3& cells)
{
  typedef Clipped_mesh_3::Point Point;
  typedef Clipped_mesh_3::Piece Piece;
  const auto& mesh = input.mesh();
  const std::size_t size = mesh.number_of_faces();
  Clipped_mesh_3 clipped;
  clipped.m_normals.resize(size);
  CGAL_precondition(!mesh.has_garbage());
  clipped.m_points.reserve(mesh.number_of_vertices());
  for(auto v : mesh.vertices()) clipped.m_points.push_back({ mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() });
  const std::uint32_t first_cut = std::uint32_t(clipped.m_points.size());

  // Cut points are numbered separately in each chunk until chunks are joined.
  struct Chunk
  {
    std::vector<Piece> pieces;
    std::vector<std::uint32_t> corners;
    std::vector<Point> points;
  };
  const std::size_t chunk_size = internal::chunk_size(size, 512);
  std::vector<Chunk> chunks((size + chunk_size - 1) / chunk_size);
  internal::for_each_chunk<ConcurrencyTag>(size, chunk_size, [&](std::size_t begin, std::size_t end) {
    internal::Polygon_cutter cutter(cells.lattice());
    internal::Leaf_cutter leaf_cutter(cutter);
    Chunk& chunk = chunks[begin / chunk_size];
    for(std::size_t n = begin; n < end; ++n) {
      const auto triangle = internal::triangle_to_clip(input, n);
      clipped.m_normals[n] = internal::unit_normal(triangle);
      cutter.cut(triangle, clipped.m_normals[n], [&](const Lattice_3::Point& p, const std::vector<Point>& in_cell) {
        leaf_cutter.cut(cells, 0, p, in_cell, [&](std::uint32_t leaf, const std::vector<Point>& polygon) {
          chunk.pieces.push_back({ leaf, std::uint32_t(n), std::uint32_t(polygon.size()), chunk.corners.size() });
          if(std::equal(polygon.begin(), polygon.end(), triangle.begin(), triangle.end())) {
            for(std::uint32_t v : internal::corners_to_clip(input, n)) chunk.corners.push_back(v);
          } else {
            for(const Point& x : polygon) {
              chunk.corners.push_back(first_cut + std::uint32_t(chunk.points.size()));
              chunk.points.push_back(x);
            }
          }
        });
      });
    }
  });

  // First position of the pieces of each cell.
  std::vector<std::size_t> first_of_cell(std::size_t(cells.number_of_cells()) + 1, 0);
  std::size_t number_of_corners = 0, number_of_points = first_cut;
  for(const Chunk& chunk : chunks) {
    for(const Piece& p : chunk.pieces) ++first_of_cell[std::size_t(p.cell) + 1];
    number_of_corners += chunk.corners.size();
    number_of_points += chunk.points.size();
  }
  CGAL_assertion(number_of_points <= std::numeric_limits<std::uint32_t>::max());
  std::partial_sum(first_of_cell.begin(), first_of_cell.end(), first_of_cell.begin());
  clipped.m_pieces.resize(first_of_cell.back());
  clipped.m_corners.reserve(number_of_corners);
  clipped.m_points.reserve(number_of_points);
  for(Chunk& chunk : chunks) {
    const std::uint32_t shift = std::uint32_t(clipped.m_points.size()) - first_cut;
    for(Piece p : chunk.pieces) {
      p.first += clipped.m_corners.size();
      clipped.m_pieces[first_of_cell[p.cell]++] = p;
    }
    for(std::uint32_t corner : chunk.corners) clipped.m_corners.push_back(corner < first_cut ? corner : corner + shift);
    clipped.m_points.insert(clipped.m_points.end(), chunk.points.begin(), chunk.points.end());
    chunk = Chunk();
  }
  return clipped;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_CLIP_MESH_TO_CELLS_H
