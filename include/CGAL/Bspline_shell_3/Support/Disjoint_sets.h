// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SUPPORT_DISJOINT_SETS_H
#define CGAL_BSPLINE_SHELL_3_SUPPORT_DISJOINT_SETS_H

#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Sets of the numbers 0, ..., size - 1, which are joined step by step. At first, each number is a set of its own.
class Disjoint_sets
{
public:
  explicit Disjoint_sets(std::size_t size) : m_parent(size)
  {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t(0));
  }

  // Returns a member of the set of `n`, the same one for all its members.
  std::size_t root(std::size_t n)
  {
    for(; m_parent[n] != n; n = m_parent[n]) m_parent[n] = m_parent[m_parent[n]];
    return n;
  }
  void join(std::size_t m, std::size_t n) { m_parent[root(m)] = root(n); }

private:
  std::vector<std::size_t> m_parent;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SUPPORT_DISJOINT_SETS_H
