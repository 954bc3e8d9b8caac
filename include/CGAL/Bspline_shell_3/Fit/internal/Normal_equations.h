// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_NORMAL_EQUATIONS_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_NORMAL_EQUATIONS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Assembles a symmetric matrix and a right-hand side for the coefficients at all points of all levels, from 64 x 64
// matrices of cells. Coefficients of different levels are not coupled. The matrix stores its lower triangle: the column
// of a point has rows for the points at lattice offsets that do not precede (0, 0, 0) in the order (k, j, i). The
// points of an x-row are numbered consecutively. A column therefore consists of 25 segments of consecutive rows, one
// for each offset (dj, dk), and no search for indices is necessary. If points are chosen, the columns of other points
// are empty.
template <typename Field>
class Normal_equations
{
  typedef typename Field::Cell_index Index;
  typedef Eigen::SparseMatrix<double> Matrix;
  typedef Eigen::VectorXd Vector;
  static constexpr int segments = 25;

  struct Segment
  {
    Index first;            // row index of the first entry
    std::uint32_t position; // position of that entry, from the start of the column
  };

  // The offsets (dk, dj) are (0, 0..3) and (1..3, -3..3).
  static int segment(int dj, int dk) { return dk == 0 ? dj : 4 + (dk - 1) * 7 + dj + 3; }

public:
  // `chosen` is a flag for each point, or null for all points; it outlives this object.
  explicit Normal_equations(const Field& field, const std::vector<char>* chosen = nullptr)
    : m_field(field), m_chosen(chosen)
  {
    m_segments.resize(field.number_of_points() * segments);
    m_column_size.resize(field.number_of_points());
    for(int level = 0; level < field.number_of_levels(); ++level)
      for(Index n = 0; n < field.points(level).size(); ++n) {
        const Index c = field.first_point(level) + n;
        if(!is_chosen(c)) continue;
        std::uint32_t position = 0;
        for_each_segment(level, n, [&](int dj, int dk, const std::pair<Index, Index>& range) {
          m_segments[std::size_t(c) * segments + segment(dj, dk)] = { range.first, position };
          position += range.second - range.first;
        });
        m_column_size[c] = position;
      }
  }

  bool has_all_points() const { return m_chosen == nullptr; }
  bool is_chosen(Index point) const { return m_chosen == nullptr || (*m_chosen)[point]; }

  // Returns the number of entries of the lower triangle.
  std::size_t number_of_entries() const
  {
    std::size_t n = 0;
    for(std::uint32_t s : m_column_size) n += s;
    return n;
  }

  template <typename ConcurrencyTag>
  void set_zero(Matrix& A, Vector& b) const
  {
    constexpr std::size_t chunk = 1024;
    const Index n = Index(m_column_size.size());
    A.resize(n, n);
    A.resizeNonZeros(Eigen::Index(number_of_entries()));
    auto* outer = A.outerIndexPtr();
    outer[0] = 0;
    for(Index c = 0; c < n; ++c) outer[c + 1] = outer[c] + int(m_column_size[c]);
    for(int level = 0; level < m_field.number_of_levels(); ++level)
      for_each_chunk<ConcurrencyTag>(m_field.points(level).size(), chunk, [&](std::size_t begin, std::size_t end) {
        for(std::size_t m = begin; m < end; ++m) {
          const Index column = m_field.first_point(level) + Index(m);
          if(!is_chosen(column)) continue;
          auto* inner = A.innerIndexPtr() + outer[column];
          for_each_segment(level, Index(m), [&](int, int, const std::pair<Index, Index>& range) {
            for(Index r = range.first; r < range.second; ++r) *inner++ = int(r);
          });
          std::fill(A.valuePtr() + outer[column], A.valuePtr() + outer[column + 1], 0.);
        }
      });
    b = Vector::Zero(n);
  }

  // Reads only the lower triangle of `local`.
  void add(Index cell, const Eigen::Matrix<double, 64, 64>& local, const Eigen::Matrix<double, 64, 1>& rhs, Matrix& A,
           Vector& b) const
  {
    const std::array<Index, 16> rows = m_field.coefficient_rows(cell);
    double* values = A.valuePtr();
    const auto* outer = A.outerIndexPtr();
    for(int r = 0; r < 16; ++r)
      for(int i = 0; i < 4; ++i) {
        const Index column = rows[r] + i;
        if(!is_chosen(column)) continue;
        const Segment* column_segments = &m_segments[std::size_t(column) * segments];
        const double* entry = local.data() + (4 * r + i) * 64;
        b[column] += rhs[4 * r + i];
        for(int s = r; s < 16; ++s) {
          const Segment& g = column_segments[segment(s % 4 - r % 4, s / 4 - r / 4)];
          const int begin = s == r ? i : 0;
          double* target = values + outer[column] + g.position + (rows[s] + begin - g.first);
          for(int j = begin; j < 4; ++j) *target++ += entry[4 * s + j];
        }
      }
  }

  // Returns the entry of two chosen points of a level. Their lattice offset, from column to row, is at most three along
  // each axis.
  double entry(const Matrix& A, Index row, Index column, int dj, int dk) const
  {
    if(row < column) return entry(A, column, row, -dj, -dk);
    const Segment& s = m_segments[std::size_t(column) * segments + segment(dj, dk)];
    return A.valuePtr()[std::size_t(A.outerIndexPtr()[column]) + s.position + (row - s.first)];
  }

private:
  // Calls visit(dj, dk, rows) for the rows of the column of a point.
  template <typename Visitor>
  void for_each_segment(int level, Index n, const Visitor& visit) const
  {
    const auto& points = m_field.points(level);
    const Lattice_point& p = points.point(n);
    for(int dk = 0; dk <= 3; ++dk)
      for(int dj = dk == 0 ? 0 : -3; dj <= 3; ++dj) {
        std::pair<Index, Index> range = points.index_range(p[0] + (dk == 0 && dj == 0 ? 0 : -3), p[0] + 4, p[1] + dj,
                                                           p[2] + dk);
        if(range.first != range.second) {
          range.first += m_field.first_point(level);
          range.second += m_field.first_point(level);
        }
        visit(dj, dk, range);
      }
  }

  const Field& m_field;
  const std::vector<char>* m_chosen;
  std::vector<Segment> m_segments;
  std::vector<std::uint32_t> m_column_size;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_NORMAL_EQUATIONS_H
