// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SCHWARZ_PRECONDITIONER_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SCHWARZ_PRECONDITIONER_H

#include <CGAL/Bspline_shell_3/Fit/Unknown_blocks.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Additive Schwarz preconditioner: the sum over overlapping blocks of the inverses of the matrix restricted to them.
// Functions of a cell are coupled so strongly that the diagonal alone takes at least nine times as many iterations.
// Models Eigen's preconditioner concept. A block is stored as the inverse W of its Cholesky factor, in single
// precision, because W^T W is positive definite despite rounding.
template <typename ConcurrencyTag>
class Schwarz_preconditioner
{
public:
  typedef double Scalar;
  typedef double RealScalar;
  typedef int StorageIndex;
  enum
  {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic
  };

  // Without blocks, each unknown is a block.
  void set_blocks(const Unknown_blocks* blocks) { m_blocks = blocks; }

  template <typename Matrix>
  Schwarz_preconditioner& analyzePattern(const Matrix&)
  {
    return *this;
  }

  // pre: the columns of the lower triangle of `matrix` are compressed, and their rows ascend
  template <typename Matrix>
  Schwarz_preconditioner& factorize(const Matrix& matrix)
  {
    const auto& lower = matrix.lower();
    set_up(std::uint32_t(lower.cols()));
    for_each_chunk<ConcurrencyTag>(m_first.size() - 1, chunk, [&](std::size_t begin, std::size_t end) {
      Eigen::MatrixXd B;
      for(std::size_t b = begin; b < end; ++b) factorize_block(lower, b, B);
    });
    return *this;
  }

  template <typename Matrix>
  Schwarz_preconditioner& compute(const Matrix& matrix)
  {
    return factorize(matrix);
  }

  // Returns a reference to memory that is overwritten by the next call.
  template <typename Vector>
  const Eigen::VectorXd& solve(const Vector& r) const
  {
    for_each_chunk<ConcurrencyTag>(m_first.size() - 1, chunk, [&](std::size_t begin, std::size_t end) {
      std::vector<float> in;
      for(std::size_t b = begin; b < end; ++b) {
        const std::size_t size = m_first[b + 1] - m_first[b];
        const std::uint32_t* unknown = &m_unknowns[m_first[b]];
        in.resize(size);
        for(std::size_t i = 0; i < size; ++i) in[i] = float(r[unknown[i]]);
        float* out = &m_local[m_first[b]];
        std::fill(out, out + size, 0.f);
        const float* row = &m_factors[m_first_factor[b]];
        const Eigen::Map<const Eigen::VectorXf> x(in.data(), Eigen::Index(size));
        Eigen::Map<Eigen::VectorXf> y(out, Eigen::Index(size));
        for(std::size_t i = 0; i < size; row += ++i) {
          const Eigen::Map<const Eigen::VectorXf> w(row, Eigen::Index(i + 1));
          y.head(Eigen::Index(i + 1)) += w.dot(x.head(Eigen::Index(i + 1))) * w;
        }
      }
    });
    for_each_chunk<ConcurrencyTag>(std::size_t(m_result.size()), 4096, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        double sum = 0;
        for(std::size_t p = m_first_position[n]; p < m_first_position[n + 1]; ++p) sum += m_local[m_positions[p]];
        m_result[Eigen::Index(n)] = sum;
      }
    });
    return m_result;
  }

  Eigen::ComputationInfo info() const { return Eigen::Success; }

private:
  static constexpr std::size_t chunk = 32;

  void set_up(std::uint32_t n)
  {
    if(m_blocks != nullptr && m_blocks->size() > 0) {
      m_unknowns = m_blocks->unknowns;
      m_first = m_blocks->first;
    } else {
      m_unknowns.resize(n);
      m_first.resize(std::size_t(n) + 1);
      for(std::uint32_t i = 0; i < n; ++i) m_unknowns[i] = m_first[i] = i;
      m_first[n] = n;
    }
    m_first_factor.assign(1, 0);
    for(std::size_t b = 0; b + 1 < m_first.size(); ++b) {
      const std::size_t size = m_first[b + 1] - m_first[b];
      m_first_factor.push_back(m_first_factor.back() + size * (size + 1) / 2);
    }
    m_factors.resize(m_first_factor.back());
    m_local.resize(m_unknowns.size());
    m_result.resize(n);
    // positions of the results of each unknown, by a counting sort
    m_first_position.assign(std::size_t(n) + 1, 0);
    for(std::uint32_t u : m_unknowns) ++m_first_position[u + 1];
    for(std::size_t u = 0; u < n; ++u) m_first_position[u + 1] += m_first_position[u];
    m_positions.resize(m_unknowns.size());
    std::vector<std::size_t> next(m_first_position.begin(), m_first_position.end() - 1);
    for(std::size_t p = 0; p < m_unknowns.size(); ++p) m_positions[next[m_unknowns[p]]++] = std::uint32_t(p);
  }

  template <typename Matrix>
  void factorize_block(const Matrix& lower, std::size_t b, Eigen::MatrixXd& B)
  {
    const std::uint32_t* begin = &m_unknowns[m_first[b]];
    const std::uint32_t* end = begin + (m_first[b + 1] - m_first[b]);
    const Eigen::Index size = end - begin;
    B.setZero(size, size);
    for(Eigen::Index c = 0; c < size; ++c) {
      const std::uint32_t* row = begin + c; // rows ascend in both
      for(typename Matrix::InnerIterator it(lower, Eigen::Index(begin[c])); it && row != end; ++it) {
        while(row != end && *row < std::uint32_t(it.row())) ++row;
        if(row != end && *row == std::uint32_t(it.row())) B(row - begin, c) = it.value();
      }
    }
    // Scaled to a unit diagonal, because functions at the boundary of the domain are smaller by orders of magnitude.
    Eigen::VectorXd scale(size);
    for(Eigen::Index i = 0; i < size; ++i) scale[i] = B(i, i) > 0 ? 1 / std::sqrt(B(i, i)) : 1;
    for(Eigen::Index c = 0; c < size; ++c)
      for(Eigen::Index r = c; r < size; ++r) B(r, c) *= scale[r] * scale[c];
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd> > factorization(B);
    // If rounding prevents the factorization of a block, its diagonal is used.
    if(factorization.info() == Eigen::Success) invert_lower_triangle(B);
    else B.setIdentity();
    float* packed = &m_factors[m_first_factor[b]];
    for(Eigen::Index i = 0; i < size; ++i)
      for(Eigen::Index j = 0; j <= i; ++j) *packed++ = float(B(i, j) * scale[j]);
  }

  // Inverts the matrix by halves, so that most of the work is in products of matrices, without multiplications by zero.
  static void invert_lower_triangle(Eigen::Ref<Eigen::MatrixXd> L)
  {
    constexpr int small = 16;
    const Eigen::Index size = L.rows(), half = size / 2, rest = size - half;
    if(size <= small) {
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, small, small> W;
      W.setIdentity(size, size);
      L.triangularView<Eigen::Lower>().solveInPlace(W);
      L.triangularView<Eigen::Lower>() = W;
      return;
    }
    invert_lower_triangle(L.topLeftCorner(half, half));
    invert_lower_triangle(L.bottomRightCorner(rest, rest));
    const Eigen::MatrixXd product = L.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>()
                                    * L.bottomLeftCorner(rest, half);
    L.bottomLeftCorner(rest, half).noalias() = -product * L.topLeftCorner(half, half).triangularView<Eigen::Lower>();
  }

  const Unknown_blocks* m_blocks = nullptr;
  std::vector<std::uint32_t> m_unknowns; // unknowns, block by block
  std::vector<std::size_t> m_first;      // first unknown of each block, and the end
  std::vector<float> m_factors;          // W of each block, its rows packed
  std::vector<std::size_t> m_first_factor;
  std::vector<std::size_t> m_first_position; // first position of each unknown, and the end
  std::vector<std::uint32_t> m_positions;    // positions of its results in m_local
  mutable std::vector<float> m_local;        // results of the blocks
  mutable Eigen::VectorXd m_result;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SCHWARZ_PRECONDITIONER_H
