// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_UNKNOWN_BLOCKS_H
#define CGAL_BSPLINE_SHELL_3_FIT_UNKNOWN_BLOCKS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief overlapping sets of unknowns that are strongly coupled to each other. Together, they contain all unknowns.
 */
struct Unknown_blocks
{
  /// the unknowns of all blocks, one block after the other, in ascending order within a block
  std::vector<std::uint32_t> unknowns;
  /// first position of each block in `unknowns`, and the end
  std::vector<std::size_t> first = { 0 };

  std::size_t size() const { return first.size() - 1; }
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief returns blocks of the free coefficients of a field: for each level, the coefficients in cubes of five lattice
 * points per side, which overlap their neighbors by two points. Takes time linear in the number of coefficients. Each
 * coefficient is in up to eight blocks, and in 4.6 blocks on average.
 *
 * \tparam Field a model of `FittableBsplineField_3`
 */
template <typename Field>
Unknown_blocks overlapping_blocks(const Field& field)
{
  constexpr int stride = 3, overlap = 1;
  const auto tile = [](int i) { return i >= 0 ? i / stride : -((-i + stride - 1) / stride); };
  Unknown_blocks blocks;
  for(int level = field.number_of_levels() - 1; level >= 0; --level) {
    const Lattice_set_3& points = field.points(level);
    const auto coefficient = [&](std::uint32_t n) { return field.coefficient_of_point(field.first_point(level) + n); };
    std::vector<std::uint64_t> tiles;
    for(std::uint32_t n = 0; n < points.size(); ++n) {
      if(coefficient(n) == Field::npos) continue;
      const Lattice_point& p = points.point(n);
      const std::uint64_t key = Lattice_key::encode(tile(p[0]), tile(p[1]), tile(p[2]));
      if(tiles.empty() || tiles.back() != key) tiles.push_back(key);
    }
    sort_unique(tiles);
    for(std::uint64_t key : tiles) {
      const Lattice_point t = Lattice_key::decode(key);
      const int i = t[0] * stride - overlap, j = t[1] * stride - overlap, k = t[2] * stride - overlap;
      constexpr int width = stride + 2 * overlap;
      for(int z = k; z < k + width; ++z)
        for(int y = j; y < j + width; ++y) {
          const auto row = points.index_range(i, i + width, y, z);
          for(auto n = row.first; n < row.second; ++n)
            if(coefficient(n) != Field::npos) blocks.unknowns.push_back(coefficient(n));
        }
      blocks.first.push_back(blocks.unknowns.size());
    }
  }
  return blocks;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_UNKNOWN_BLOCKS_H
