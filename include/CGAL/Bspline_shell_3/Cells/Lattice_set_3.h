// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CELLS_LATTICE_SET_3_H
#define CGAL_BSPLINE_SHELL_3_CELLS_LATTICE_SET_3_H

#include <CGAL/Bspline_shell_3/Support/sort_unique.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/// \ingroup PkgBsplineShell3Cells
/// an integer point \f$(i, j, k)\f$, with \f$i\f$ along \f$x\f$
typedef std::array<int, 3> Lattice_point;

/// \ingroup PkgBsplineShell3Cells
/// the lattice points from `first` to `last`, both included; none if a coordinate of `first` is larger
struct Lattice_box
{
  Lattice_point first, last;
};

/// \ingroup PkgBsplineShell3Cells
/// a lattice point as a 64-bit key with 21 bits for each axis. Keys are sorted by \f$(k, j, i)\f$.
class Lattice_key
{
public:
  static constexpr int bits = 21; ///< bits of a coordinate; keys have three times as many
private:
  static constexpr std::int64_t offset = std::int64_t(1) << (bits - 1);
  static constexpr std::uint64_t mask = (std::uint64_t(1) << bits) - 1;
public:
  static constexpr int max_coordinate = (1 << (bits - 1)) - 16; // room for dilation

  static std::uint64_t encode(int i, int j, int k)
  {
    return (std::uint64_t(k + offset) << (2 * bits)) | (std::uint64_t(j + offset) << bits) | std::uint64_t(i + offset);
  }
  static Lattice_point decode(std::uint64_t key)
  {
    return { int(std::int64_t(key & mask) - offset), int(std::int64_t((key >> bits) & mask) - offset),
             int(std::int64_t(key >> (2 * bits)) - offset) };
  }
  static std::uint64_t step(int axis) { return std::uint64_t(1) << (bits * axis); }
};

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief a sparse set of integer points, numbered from 0 in the order of \f$(k, j, i)\f$.
 *
 * The points of a row along \f$x\f$ have consecutive indices, so that neighbors on the lattice are neighbors in memory.
 *
 * \cgalHeading{Cost} Memory is linear in the number of points. A look-up searches the runs of consecutive rows in a
 *   slice, and the runs of consecutive points in a row: usually one to four runs.
 */
class Lattice_set_3
{
public:
  typedef std::uint32_t Index;
  static constexpr Index npos = std::numeric_limits<Index>::max();

  Lattice_set_3() = default;

  /// \pre `keys` are sorted and unique
  explicit Lattice_set_3(const std::vector<std::uint64_t>& keys)
  {
    CGAL_precondition(std::adjacent_find(keys.begin(), keys.end(), std::greater_equal<std::uint64_t>()) == keys.end());
    m_points.reserve(keys.size());
    for(std::uint64_t key : keys) m_points.push_back(Lattice_key::decode(key));
    if(keys.empty()) return;
    m_least = m_most = m_points.front();
    for(const Lattice_point& p : m_points)
      for(int a = 0; a < 3; ++a) {
        m_least[a] = (std::min)(m_least[a], p[a]);
        m_most[a] = (std::max)(m_most[a], p[a]);
      }
    m_k_min = m_points.front()[2];
    m_slices.assign(std::size_t(m_points.back()[2] - m_k_min) + 2, 0);
    for(Index n = 0; n < m_points.size(); ++n) {
      const Lattice_point& p = m_points[n];
      const bool same_slice = n > 0 && m_points[n - 1][2] == p[2], same_row = same_slice && m_points[n - 1][1] == p[1];
      if(!same_slice || (!same_row && m_points[n - 1][1] + 1 != p[1])) {
        m_row_runs.push_back({ p[1], p[1], Index(m_rows.size()) });
        ++m_slices[std::size_t(p[2] - m_k_min) + 1];
      }
      if(!same_row) {
        ++m_row_runs.back().end;
        m_rows.push_back(Index(m_runs.size()));
      }
      if(!same_row || m_points[n - 1][0] + 1 != p[0]) m_runs.push_back({ p[0], p[0], n });
      ++m_runs.back().end;
    }
    m_rows.push_back(Index(m_runs.size()));
    for(std::size_t s = 1; s < m_slices.size(); ++s) m_slices[s] += m_slices[s - 1];
  }

  std::size_t size() const { return m_points.size(); }
  const Lattice_point& point(Index n) const { return m_points[n]; }

  Index index(int i, int j, int k) const
  {
    const Index r = row(j, k);
    return r == npos ? npos : find(m_runs, m_rows[r], m_rows[r + 1], i);
  }
  Index index(const Lattice_point& p) const { return index(p[0], p[1], p[2]); }

  /// returns the indices `[first, second)` of the points \f$(i, j, k)\f$ with `i_begin` \f$\le i <\f$ `i_end`
  std::pair<Index, Index> index_range(int i_begin, int i_end, int j, int k) const
  {
    std::pair<Index, Index> range(npos, npos);
    const Index r = row(j, k);
    if(r == npos) return range;
    for(Index n = m_rows[r]; n < m_rows[r + 1]; ++n) {
      const Run& run = m_runs[n];
      const int b = (std::max)(i_begin, run.begin), e = (std::min)(i_end, run.end);
      if(b >= e) continue;
      if(range.first == npos) range.first = run.first + Index(b - run.begin);
      range.second = run.first + Index(e - run.begin);
    }
    return range;
  }

  /// returns the lattice points in a box that is enlarged by `margin` spacings, clipped to the extent of the set. The
  /// lattice has the given origin and spacing.
  Lattice_box clip(const Bbox_3& box, const std::array<double, 3>& origin, double spacing, int margin) const
  {
    Lattice_box range;
    for(int a = 0; a < 3; ++a) {
      const double first = std::floor(((box.min)(a)-origin[a]) / spacing) - margin,
                   last = std::ceil(((box.max)(a)-origin[a]) / spacing) + margin;
      range.first[a] = first > m_least[a] ? int(first) : m_least[a];
      range.last[a] = last < m_most[a] ? int(last) : m_most[a];
    }
    return range;
  }

private:
  struct Run
  {
    int begin, end;
    Index first;
  }; // consecutive coordinates, and the index of the first

  static Index find(const std::vector<Run>& runs, Index begin, Index end, int coordinate)
  {
    for(Index n = begin; n < end; ++n)
      if(coordinate < runs[n].end)
        return coordinate >= runs[n].begin ? runs[n].first + Index(coordinate - runs[n].begin) : npos;
    return npos;
  }

  Index row(int j, int k) const
  {
    const std::size_t slice = std::size_t(std::int64_t(k) - m_k_min);
    return k < m_k_min || slice + 1 >= m_slices.size() ? npos
                                                       : find(m_row_runs, m_slices[slice], m_slices[slice + 1], j);
  }

  std::vector<Lattice_point> m_points;
  std::vector<Run> m_runs;     // along x
  std::vector<Index> m_rows;   // first run of each row, and the end
  std::vector<Run> m_row_runs; // runs of rows, along y
  std::vector<Index> m_slices; // first run of rows of each k, and the end
  int m_k_min = 0;
  Lattice_point m_least = {}, m_most = { { -1, -1, -1 } };
};

/// \ingroup PkgBsplineShell3Cells
/// returns the sum of a set and the cube `[first, last]`\f$^3\f$.
/// \param keys sorted and unique, like the returned keys
inline std::vector<std::uint64_t> dilate(std::vector<std::uint64_t> keys, int first, int last)
{
  for(int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint64_t> wide;
    wide.reserve(keys.size() * std::size_t(last - first + 1));
    const std::uint64_t step = Lattice_key::step(axis);
    for(int d = first; d <= last; ++d) {
      const std::size_t middle = wide.size();
      for(std::uint64_t key : keys) wide.push_back(key + step * std::uint64_t(std::int64_t(d)));
      // Both parts are sorted.
      std::inplace_merge(wide.begin(), wide.begin() + middle, wide.end());
      wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
    }
    keys.swap(wide);
  }
  return keys;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CELLS_LATTICE_SET_3_H
