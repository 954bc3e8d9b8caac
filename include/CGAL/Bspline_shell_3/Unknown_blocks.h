// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_UNKNOWN_BLOCKS_H
#define CGAL_BSPLINE_SHELL_3_UNKNOWN_BLOCKS_H

#include <CGAL/Bspline_shell_3/internal/Lattice_set_3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief sets of unknowns that are strongly coupled among each other. They overlap, and cover all unknowns.
 */
struct Unknown_blocks
{
  /// of all blocks, one after the other; ascending within a block
  std::vector<std::uint32_t> unknowns;
  /// where each block begins in `unknowns`, and the end
  std::vector<std::size_t> first = { 0 };

  std::size_t size() const { return first.size() - 1; }
};

/*!
 * \ingroup PkgBsplineShell3Fit
 *
 * \brief blocks of B-spline functions: those centred in cubes of five lattice points a side, which overlap their
 * neighbours by two. Linear in the number of functions, of which each is in up to eight blocks, 4.6 on average.
 */
inline Unknown_blocks overlapping_blocks(const internal::Lattice_set_3& functions)
{
  using internal::Lattice_key;
  constexpr int stride = 3, overlap = 1;
  const auto tile = [](int i) { return i >= 0 ? i / stride : -((-i + stride - 1) / stride); };
  std::vector<std::uint64_t> tiles;
  for(internal::Lattice_set_3::Index n = 0; n < functions.size(); ++n) {
    const internal::Lattice_point& p = functions.point(n);
    const std::uint64_t key = Lattice_key::encode(tile(p[0]), tile(p[1]), tile(p[2]));
    if(tiles.empty() || tiles.back() != key) tiles.push_back(key);
  }
  internal::sort_unique(tiles);
  Unknown_blocks blocks;
  for(std::uint64_t key : tiles) {
    const internal::Lattice_point t = Lattice_key::decode(key);
    const int i = t[0] * stride - overlap, j = t[1] * stride - overlap, k = t[2] * stride - overlap;
    constexpr int width = stride + 2 * overlap;
    for(int z = k; z < k + width; ++z)
      for(int y = j; y < j + width; ++y) {
        const auto row = functions.index_range(i, i + width, y, z);
        for(auto n = row.first; n < row.second; ++n) blocks.unknowns.push_back(n);
      }
    blocks.first.push_back(blocks.unknowns.size());
  }
  return blocks;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_UNKNOWN_BLOCKS_H
