// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SYMMETRIC_MATRIX_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SYMMETRIC_MATRIX_H

#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

template <typename ConcurrencyTag>
class Symmetric_matrix;

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

namespace Eigen {
namespace internal {

template <typename ConcurrencyTag>
struct traits<CGAL::Bspline_shells::internal::Symmetric_matrix<ConcurrencyTag> > : traits<SparseMatrix<double> >
{};

} // namespace internal
} // namespace Eigen

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// A sparse symmetric matrix, given by its lower triangle, for Eigen's iterative solvers. Eigen's product with a
// triangle is single-threaded. Here, each of a fixed number of column ranges adds to its own vector. The vectors are
// summed in order, so that the product does not depend on the number of threads.
template <typename ConcurrencyTag>
class Symmetric_matrix : public Eigen::EigenBase<Symmetric_matrix<ConcurrencyTag> >
{
public:
  typedef Eigen::SparseMatrix<double> Triangle;
  typedef double Scalar;
  typedef double RealScalar;
  typedef int StorageIndex;
  typedef Eigen::Index Index;
  enum
  {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };

  // pre: the columns of `lower` are compressed and begin with the diagonal; `lower` outlives this object
  explicit Symmetric_matrix(const Triangle& lower) : m_lower(lower)
  {
    const Index size = lower.cols();
    m_begin[0] = 0;
    for(std::size_t r = 1; r <= ranges; ++r) {
      const int entries = int(std::size_t(lower.nonZeros()) * r / ranges);
      const int* end = std::upper_bound(lower.outerIndexPtr(), lower.outerIndexPtr() + size + 1, entries);
      m_begin[r] = r == ranges ? size : (std::max)(m_begin[r - 1], Index(end - lower.outerIndexPtr()) - 1);
    }
    for(std::size_t r = 0; r < ranges; ++r) m_sums[r].resize(size - m_begin[r]);
  }

  Index rows() const { return m_lower.rows(); }
  Index cols() const { return m_lower.cols(); }
  const Triangle& lower() const { return m_lower; }

  template <typename Vector>
  Eigen::Product<Symmetric_matrix, Vector, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Vector>& x) const
  {
    return Eigen::Product<Symmetric_matrix, Vector, Eigen::AliasFreeProduct>(*this, x.derived());
  }

  // y += alpha * (this matrix) * x
  template <typename Result, typename Vector>
  void add_product(Result& y, const Vector& x, double alpha) const
  {
    for_each_chunk<ConcurrencyTag>(ranges, 1, [&](std::size_t r, std::size_t) {
      const Index first = m_begin[r];
      m_sums[r].setZero();
      double* sums = m_sums[r].data();
      for(Index c = first; c < m_begin[r + 1]; ++c) {
        const int end = m_lower.outerIndexPtr()[c + 1];
        int n = m_lower.outerIndexPtr()[c];
        if(n == end) continue;
        const double at_c = x[c];
        double sum = m_lower.valuePtr()[n] * at_c;
        for(++n; n < end; ++n) {
          const int row = m_lower.innerIndexPtr()[n];
          const double value = m_lower.valuePtr()[n];
          sum += value * x[row];
          sums[row - first] += value * at_c;
        }
        sums[c - first] += sum;
      }
    });
    constexpr std::size_t chunk = 4096;
    for_each_chunk<ConcurrencyTag>(std::size_t(cols()), chunk, [&](std::size_t begin, std::size_t end) {
      for(Index c = Index(begin); c < Index(end); ++c) {
        double sum = 0;
        for(std::size_t r = 0; r < ranges && m_begin[r] <= c; ++r) sum += m_sums[r][c - m_begin[r]];
        y[c] += alpha * sum;
      }
    });
  }

private:
  static constexpr std::size_t ranges = 16;

  const Triangle& m_lower;
  std::array<Index, ranges + 1> m_begin;              // first columns; about as many entries in each range
  mutable std::array<Eigen::VectorXd, ranges> m_sums; // by range, from its first column
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

namespace Eigen {
namespace internal {

template <typename ConcurrencyTag, typename Vector>
struct generic_product_impl<CGAL::Bspline_shells::internal::Symmetric_matrix<ConcurrencyTag>, Vector, SparseShape,
                            DenseShape, GemvProduct>
  : generic_product_impl_base<
      CGAL::Bspline_shells::internal::Symmetric_matrix<ConcurrencyTag>, Vector,
      generic_product_impl<CGAL::Bspline_shells::internal::Symmetric_matrix<ConcurrencyTag>, Vector> >
{
  template <typename Result>
  static void scaleAndAddTo(Result& y, const CGAL::Bspline_shells::internal::Symmetric_matrix<ConcurrencyTag>& A,
                            const Vector& x, double alpha)
  {
    A.add_product(y, x, alpha);
  }
};

} // namespace internal
} // namespace Eigen

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_SYMMETRIC_MATRIX_H
