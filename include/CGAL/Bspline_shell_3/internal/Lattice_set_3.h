// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_INTERNAL_LATTICE_SET_3_H
#define CGAL_BSPLINE_SHELL_3_INTERNAL_LATTICE_SET_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

typedef std::array<int, 3> Lattice_point;   // (i, j, k), i along x

// A point as a key that sorts like (k, j, i); 21 bits an axis.
class Lattice_key
{
  static constexpr int bits = 21;
  static constexpr std::int64_t offset = std::int64_t(1) << (bits - 1);
  static constexpr std::uint64_t mask = (std::uint64_t(1) << bits) - 1;
public:
  static constexpr int max_coordinate = (1 << (bits - 1)) - 16;   // room for dilation

  static std::uint64_t encode(int i, int j, int k)
  {
    return (std::uint64_t(k + offset) << (2*bits)) | (std::uint64_t(j + offset) << bits) | std::uint64_t(i + offset);
  }
  static Lattice_point decode(std::uint64_t key)
  {
    return { int(std::int64_t(key & mask) - offset), int(std::int64_t((key >> bits) & mask) - offset),
             int(std::int64_t(key >> (2*bits)) - offset) };
  }
  static std::uint64_t step(int axis) { return std::uint64_t(1) << (bits * axis); }
};

// A sparse set of integer points, numbered 0, 1, ... by (k, j, i). Points of one x-row are numbered consecutively, so
// that what is contiguous on the lattice is contiguous in memory. Look-up: one table access and a search among the
// runs of a row (mostly one to four). The table of rows has the size of the set's yz-extent: no dense volume.
class Lattice_set_3
{
public:
  typedef std::uint32_t Index;
  static constexpr Index npos = std::numeric_limits<Index>::max();

  Lattice_set_3() = default;

  // `keys` sorted and unique
  explicit Lattice_set_3(const std::vector<std::uint64_t>& keys)
  {
    m_points.reserve(keys.size());
    for(std::uint64_t key : keys) m_points.push_back(Lattice_key::decode(key));
    if(keys.empty()) return;
    m_k_min = m_points.front()[2];
    m_k_size = m_points.back()[2] - m_k_min + 1;
    const auto by_j = [](const Lattice_point& a, const Lattice_point& b) { return a[1] < b[1]; };
    const auto mm = std::minmax_element(m_points.begin(), m_points.end(), by_j);
    m_j_min = (*mm.first)[1];
    m_j_size = (*mm.second)[1] - m_j_min + 1;
    m_rows.assign(std::size_t(m_j_size) * m_k_size + 1, 0);
    for(Index n = 0; n < m_points.size(); ++n) {
      const Lattice_point& p = m_points[n];
      const bool continues = n > 0 && m_points[n-1][2] == p[2] && m_points[n-1][1] == p[1] && m_points[n-1][0] + 1 == p[0];
      if(!continues) {
        m_runs.push_back({ p[0], p[0], n });
        ++m_rows[row(p[1], p[2]) + 1];
      }
      ++m_runs.back().end;
    }
    for(std::size_t r = 1; r < m_rows.size(); ++r) m_rows[r] += m_rows[r-1];
  }

  std::size_t size() const { return m_points.size(); }
  const Lattice_point& point(Index n) const { return m_points[n]; }

  Index index(int i, int j, int k) const
  {
    if(j < m_j_min || j >= m_j_min + m_j_size || k < m_k_min || k >= m_k_min + m_k_size) return npos;
    const std::size_t r = row(j, k);
    for(Index n = m_rows[r]; n < m_rows[r+1]; ++n)
      if(i < m_runs[n].end)
        return i >= m_runs[n].begin ? m_runs[n].first + Index(i - m_runs[n].begin) : npos;
    return npos;
  }
  Index index(const Lattice_point& p) const { return index(p[0], p[1], p[2]); }

  // the numbers [first, second) of the points (i, j, k) with i_begin <= i < i_end
  std::pair<Index, Index> index_range(int i_begin, int i_end, int j, int k) const
  {
    std::pair<Index, Index> range(npos, npos);
    if(j < m_j_min || j >= m_j_min + m_j_size || k < m_k_min || k >= m_k_min + m_k_size) return range;
    const std::size_t r = row(j, k);
    for(Index n = m_rows[r]; n < m_rows[r+1]; ++n) {
      const Run& run = m_runs[n];
      const int b = (std::max)(i_begin, run.begin), e = (std::min)(i_end, run.end);
      if(b >= e) continue;
      if(range.first == npos) range.first = run.first + Index(b - run.begin);
      range.second = run.first + Index(e - run.begin);
    }
    return range;
  }

private:
  struct Run { int begin, end; Index first; };

  std::size_t row(int j, int k) const { return std::size_t(k - m_k_min) * m_j_size + (j - m_j_min); }

  std::vector<Lattice_point> m_points;
  std::vector<Run> m_runs;
  std::vector<Index> m_rows;
  int m_j_min = 0, m_j_size = 0, m_k_min = 0, m_k_size = 0;
};

inline void sort_unique(std::vector<std::uint64_t>& keys)
{
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

// the sum of the set and the cube [first, last]^3, one axis after the other
inline std::vector<std::uint64_t> dilate(std::vector<std::uint64_t> keys, int first, int last)
{
  for(int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint64_t> wide;
    wide.reserve(keys.size() * std::size_t(last - first + 1));
    const std::uint64_t step = Lattice_key::step(axis);
    for(int d = first; d <= last; ++d) {
      const std::size_t middle = wide.size();
      for(std::uint64_t key : keys) wide.push_back(key + step * std::uint64_t(std::int64_t(d)));
      // both parts are sorted
      std::inplace_merge(wide.begin(), wide.begin() + middle, wide.end());
      wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
    }
    keys.swap(wide);
  }
  return keys;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_INTERNAL_LATTICE_SET_3_H
