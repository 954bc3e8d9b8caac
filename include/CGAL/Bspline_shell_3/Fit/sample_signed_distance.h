// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_SAMPLE_SIGNED_DISTANCE_H
#define CGAL_BSPLINE_SHELL_3_FIT_SAMPLE_SIGNED_DISTANCE_H

#include <CGAL/Bspline_shell_3/Cells/Cell_hierarchy_3.h>
#include <CGAL/Bspline_shell_3/Fit/Any_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief the positions of the samples of the signed distance: two along each axis of a cell, hence eight per cell. On
 * cells of one size, the samples form a lattice with half the spacing of the cells.
 */
struct Distance_samples
{
  static constexpr int per_cell = 8;
  /// returns the position of a sample in its cell; sample `s` is at 1/4 or 3/4 of axis `a` if bit `a` of `s` is 0 or 1
  static double position(int s, int axis) { return (s >> axis) & 1 ? 0.75 : 0.25; }
  template <typename Point_3>
  static Point_3 point(const Cell_hierarchy_3& cells, std::uint32_t c, int s)
  {
    const std::array<double, 3> corner = cells.corner(c);
    const double width = cells.width(c);
    return Point_3(corner[0] + position(s, 0) * width, corner[1] + position(s, 1) * width,
                   corner[2] + position(s, 2) * width);
  }
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief returns the signed distance at the samples of the given cells, in the units of the coordinates:
 * `Distance_samples::per_cell` values per cell.
 *
 * \param oracle any model of `SignedDistanceOracle_3`
 */
template <typename ConcurrencyTag>
std::vector<double> sample_signed_distance(const Any_signed_distance_3& oracle, const Cell_hierarchy_3& cells,
                                           const std::vector<std::uint32_t>& of_cells)
{
  constexpr std::size_t n = Distance_samples::per_cell, chunk = 64;
  typedef Any_signed_distance_3::Point_3 Point_3;
  std::vector<double> samples(of_cells.size() * n);
  internal::for_each_chunk<ConcurrencyTag>(of_cells.size(), chunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Point_3> points;
    points.reserve(chunk * n);
    for(std::size_t c = begin; c < end; ++c)
      for(std::size_t s = 0; s < n; ++s) points.push_back(Distance_samples::point<Point_3>(cells, of_cells[c], int(s)));
    oracle(points, &samples[begin * n]);
  });
  return samples;
}

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief returns the signed distance at the samples of all cells.
 */
template <typename ConcurrencyTag>
std::vector<double> sample_signed_distance(const Any_signed_distance_3& oracle, const Cell_hierarchy_3& cells)
{
  std::vector<std::uint32_t> all(cells.number_of_cells());
  std::iota(all.begin(), all.end(), std::uint32_t(0));
  return sample_signed_distance<ConcurrencyTag>(oracle, cells, all);
}

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief converts the samples of one hierarchy to those of another; samples of leaves that both contain are reused.
 *
 * \return the leaves with new samples
 */
template <typename ConcurrencyTag>
std::vector<std::uint32_t> update_signed_distance(const Any_signed_distance_3& oracle, const Cell_hierarchy_3& before,
                                                  const Cell_hierarchy_3& cells, std::vector<double>& samples)
{
  constexpr std::size_t n = Distance_samples::per_cell;
  std::vector<std::uint32_t> fresh;
  std::vector<double> updated(cells.number_of_cells() * n);
  for(std::uint32_t c = 0; c < cells.number_of_cells(); ++c) {
    const std::uint32_t old = cells.level(c) < before.number_of_levels()
                                ? before.leaf(cells.level(c), cells.lattice_point(c))
                                : Cell_hierarchy_3::npos;
    if(old == Cell_hierarchy_3::npos) fresh.push_back(c);
    else std::copy_n(&samples[old * n], n, &updated[c * n]);
  }
  const std::vector<double> more = sample_signed_distance<ConcurrencyTag>(oracle, cells, fresh);
  for(std::size_t m = 0; m < fresh.size(); ++m) std::copy_n(&more[m * n], n, &updated[fresh[m] * n]);
  samples.swap(updated);
  return fresh;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_SAMPLE_SIGNED_DISTANCE_H
