// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDENSE_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDENSE_H

#include <CGAL/Bspline_shell_3/Fit/internal/Normal_equations.h>
#include <CGAL/Bspline_shell_3/Spline/Cubic_bspline.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Converts equations for the coefficients at all points to equations for the free coefficients, P^T A P and P^T b. The
// matrix P computes all coefficients from the free coefficients.
//
// Take a point near a dependent point, restrict its row of A to dependent points, and multiply it by P. The result is a
// window of six coefficients per side of the level above. It is computed one axis after the other. The window of a free
// point couples it to that level, and is needed once. Windows of dependent points are added, with their weights, to the
// rows of the coefficients on which they depend. All columns are computed independently. If points were chosen, rows
// and columns of other free points are empty; all points that depend on a chosen point must also be chosen.
template <typename Field>
class Condensation
{
  typedef typename Field::Cell_index Index;
  typedef Eigen::SparseMatrix<double> Matrix;
  static constexpr int stencil = 7, width = 6;
  static constexpr Index npos = Field::npos, own = npos - 1;

  struct Window
  {
    Lattice_point first; // smallest lattice point, on the level above
    std::array<double, width * width * width> entry;
  };

public:
  Condensation(const Field& field, const Normal_equations<Field>& equations, const Matrix& all)
    : m_field(field), m_equations(equations), m_all(all)
  {}

  template <typename ConcurrencyTag>
  void operator()(Matrix& A)
  {
    find_windows();
    m_windows.reset(new Window[m_dependent.size()]); // uninitialized, because threads write each of them once
    for_each_chunk<ConcurrencyTag>(m_dependent.size(), 256, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) compute_window(m_dependent[n][0], m_dependent[n][1], m_windows[n]);
    });
    // First the lengths of the columns, then their entries.
    const std::size_t size = m_field.number_of_coefficients();
    std::vector<int> length(size);
    A.resize(Eigen::Index(size), Eigen::Index(size));
    for_each_column<ConcurrencyTag>([&](int level, Index n, Index c) {
      int entries = 0;
      visit_rows(
        level, n, [&](Index, int, int, int) { ++entries; }, [&](Index, int) { ++entries; });
      length[c] = entries;
    });
    std::size_t entries = 0;
    for(std::size_t c = 0; c < size; ++c) {
      A.outerIndexPtr()[c] = int(entries);
      entries += std::size_t(length[c]);
    }
    A.outerIndexPtr()[size] = int(entries);
    A.resizeNonZeros(Eigen::Index(entries));
    for_each_column<ConcurrencyTag>([&](int level, Index n, Index c) { fill_column(level, n, c, A); });
  }

private:
  static int floor_half(int i) { return (i - (i & 1)) / 2; }

  bool is_chosen(int level, Index n) const { return m_equations.is_chosen(m_field.first_point(level) + n); }

  // Calls f(level, number in the level, coefficient) for the chosen free points, in parallel.
  template <typename ConcurrencyTag, typename Function>
  void for_each_column(const Function& f) const
  {
    for(int level = 0; level < m_field.number_of_levels(); ++level)
      for_each_chunk<ConcurrencyTag>(m_field.points(level).size(), 256, [&](std::size_t begin, std::size_t end) {
        for(std::size_t n = begin; n < end; ++n) {
          const Index c = m_field.coefficient_of_point(m_field.first_point(level) + Index(n));
          if(c != npos && is_chosen(level, Index(n))) f(level, Index(n), c);
        }
      });
  }

  // Finds dependent points, and the free points that are coupled to them.
  void find_windows()
  {
    m_window_of.assign(m_field.number_of_points(), npos);
    for(int level = 1; level < m_field.number_of_levels(); ++level) {
      const Lattice_set_3& points = m_field.points(level);
      const Index first = m_field.first_point(level);
      for(Index n = 0; n < points.size(); ++n) {
        if(m_field.coefficient_of_point(first + n) != npos || !m_equations.is_chosen(first + n)) continue;
        m_window_of[first + n] = Index(m_dependent.size());
        m_dependent.push_back({ Index(level), n });
        const Lattice_point& p = points.point(n);
        for(int dk = -3; dk <= 3; ++dk)
          for(int dj = -3; dj <= 3; ++dj) {
            const auto range = points.index_range(p[0] - 3, p[0] + 4, p[1] + dj, p[2] + dk);
            for(Index m = range.first; m < range.second; ++m)
              if(m_window_of[first + m] == npos && m_equations.is_chosen(first + m)) m_window_of[first + m] = own;
          }
      }
    }
  }

  // Returns the smallest parent of p - 3.
  static Lattice_point first_of_window(const Lattice_point& p)
  {
    Lattice_point first;
    for(int a = 0; a < 3; ++a) first[a] = floor_half(p[a] - 3) - ((p[a] - 3) & 1 ? 0 : 1);
    return first;
  }

  void compute_window(int level, Index n, Window& window) const
  {
    const Lattice_set_3& points = m_field.points(level);
    const Lattice_point& p = points.point(n);
    const Index first = m_field.first_point(level), column = first + n;
    std::array<double, stencil* stencil* stencil> row = {};
    for(int dk = -3; dk <= 3; ++dk)
      for(int dj = -3; dj <= 3; ++dj) {
        const auto range = points.index_range(p[0] - 3, p[0] + 4, p[1] + dj, p[2] + dk);
        for(Index m = range.first; m < range.second; ++m)
          if(m_field.coefficient_of_point(first + m) == npos && m_equations.is_chosen(first + m))
            row[std::size_t(((dk + 3) * stencil + dj + 3) * stencil + points.point(m)[0] - p[0] + 3)] =
              m_equations.entry(m_all, first + m, column, dj, dk);
      }
    window.first = first_of_window(p);
    const auto mask = Cubic_bspline<>::two_scale_mask();
    std::array<std::array<std::array<double, width>, stencil>, 3> weight = {};
    for(int a = 0; a < 3; ++a)
      for(int i = 0; i < stencil; ++i)
        for(int h = 0; h < width; ++h) {
          const int offset = p[a] - 3 + i - 2 * (window.first[a] + h);
          if(-2 <= offset && offset <= 2) weight[a][i][h] = mask[std::size_t(offset + 2)];
        }
    std::array<double, stencil* stencil* width> x = {};
    for(int line = 0; line < stencil * stencil; ++line)
      for(int i = 0; i < stencil; ++i)
        for(int h = 0; h < width; ++h) x[line * width + h] += weight[0][i][h] * row[line * stencil + i];
    std::array<double, stencil* width* width> y = {};
    for(int k = 0; k < stencil; ++k)
      for(int j = 0; j < stencil; ++j)
        for(int g = 0; g < width; ++g)
          for(int h = 0; h < width; ++h)
            y[(k * width + g) * width + h] += weight[1][j][g] * x[(k * stencil + j) * width + h];
    window.entry.fill(0);
    for(int k = 0; k < stencil; ++k)
      for(int f = 0; f < width; ++f)
        for(int gh = 0; gh < width * width; ++gh)
          window.entry[f * width * width + gh] += weight[2][k][f] * y[k * width * width + gh];
  }

  // Calls same(row, di, dj, dk) for the rows of the point's level, and then above(row, entry of the window) for those
  // of the level above, ascending.
  template <typename Same, typename Above>
  void visit_rows(int level, Index n, const Same& same, const Above& above) const
  {
    const Lattice_set_3& points = m_field.points(level);
    const Lattice_point& p = points.point(n);
    for(int dk = 0; dk <= 3; ++dk)
      for(int dj = dk == 0 ? 0 : -3; dj <= 3; ++dj) {
        const auto range = points.index_range(p[0] + (dk == 0 && dj == 0 ? 0 : -3), p[0] + 4, p[1] + dj, p[2] + dk);
        for(Index m = range.first; m < range.second; ++m) {
          const Index row = m_field.coefficient_of_point(m_field.first_point(level) + m);
          if(row != npos && is_chosen(level, m)) same(row, points.point(m)[0] - p[0], dj, dk);
        }
      }
    if(m_window_of[m_field.first_point(level) + n] == npos) return;
    const Lattice_point first = first_of_window(p);
    const Lattice_set_3& coarse = m_field.points(level - 1);
    for(int k = 0; k < width; ++k)
      for(int j = 0; j < width; ++j) {
        const auto range = coarse.index_range(first[0], first[0] + width, first[1] + j, first[2] + k);
        for(Index m = range.first; m < range.second; ++m) {
          const Index row = m_field.coefficient_of_point(m_field.first_point(level - 1) + m);
          if(row != npos && is_chosen(level - 1, m))
            above(row, (k * width + j) * width + coarse.point(m)[0] - first[0]);
        }
      }
  }

  void fill_column(int level, Index n, Index c, Matrix& A) const
  {
    const Lattice_point& p = m_field.points(level).point(n);
    const Index column = m_field.first_point(level) + n;
    // contributions of dependent coefficients of the next level, by lattice offset
    std::array<double, 4 * stencil* stencil> sums = {};
    bool any = false;
    if(level + 1 < m_field.number_of_levels()) {
      const Lattice_set_3& fine = m_field.points(level + 1);
      const auto mask = Cubic_bspline<>::two_scale_mask();
      for(int ck = -2; ck <= 2; ++ck)
        for(int cj = -2; cj <= 2; ++cj) {
          const auto range = fine.index_range(2 * p[0] - 2, 2 * p[0] + 3, 2 * p[1] + cj, 2 * p[2] + ck);
          for(Index m = range.first; m < range.second; ++m) {
            const Index child = m_field.first_point(level + 1) + m;
            if(m_field.coefficient_of_point(child) != npos) continue;
            any = true;
            const double weight = mask[std::size_t(fine.point(m)[0] - 2 * p[0] + 2)] * mask[std::size_t(cj + 2)]
                                  * mask[std::size_t(ck + 2)];
            add_window(m_windows[m_window_of[child]], weight, p, sums);
          }
        }
    }
    Window window;
    if(m_window_of[column] != npos) compute_window(level, n, window);
    int position = A.outerIndexPtr()[c];
    visit_rows(
      level, n,
      [&](Index row, int di, int dj, int dk) {
        const Index point = m_field.point_of_coefficient(row);
        double value = m_equations.entry(m_all, point, column, dj, dk);
        if(any) value += sums[std::size_t((dk * stencil + dj + 3) * stencil + di + 3)];
        A.innerIndexPtr()[position] = int(row);
        A.valuePtr()[position++] = value;
      },
      [&](Index row, int entry) {
        A.innerIndexPtr()[position] = int(row);
        A.valuePtr()[position++] = window.entry[std::size_t(entry)];
      });
  }

  // Adds the part of a window that does not precede p.
  static void add_window(const Window& w, double weight, const Lattice_point& p,
                         std::array<double, 4 * stencil * stencil>& sums)
  {
    for(int k = 0; k < width; ++k) {
      const int dk = w.first[2] + k - p[2];
      if(dk < 0 || dk > 3) continue;
      for(int j = 0; j < width; ++j) {
        const int dj = w.first[1] + j - p[1];
        if(dj < -3 || dj > 3) continue;
        for(int i = 0; i < width; ++i) {
          const int di = w.first[0] + i - p[0];
          if(di < -3 || di > 3) continue;
          sums[std::size_t((dk * stencil + dj + 3) * stencil + di + 3)] +=
            weight * w.entry[std::size_t((k * width + j) * width + i)];
        }
      }
    }
  }

  const Field& m_field;
  const Normal_equations<Field>& m_equations;
  const Matrix& m_all;
  std::vector<Index> m_window_of; // by point: the index of its window; or `own`, which is not stored; or npos
  std::vector<std::array<Index, 2> > m_dependent; // chosen dependent points: level and index in it
  std::unique_ptr<Window[]> m_windows;            // windows of the dependent points
};

// Computes P^T all P and P^T b. If all coefficients are free and chosen, the equations are moved.
template <typename ConcurrencyTag, typename Field>
void condense(const Field& field, const Normal_equations<Field>& equations, Eigen::SparseMatrix<double>& all,
              Eigen::VectorXd& all_rhs, Eigen::SparseMatrix<double>& A, Eigen::VectorXd& b)
{
  if(field.number_of_points() == field.number_of_coefficients() && equations.has_all_points()) {
    A.swap(all);
    b.swap(all_rhs);
    return;
  }
  Condensation<Field>(field, equations, all).template operator()<ConcurrencyTag>(A);
  b = field.collect(all_rhs);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CONDENSE_H
