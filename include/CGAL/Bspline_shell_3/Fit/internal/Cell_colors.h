// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CELL_COLORS_H
#define CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CELL_COLORS_H

#include <CGAL/Bspline_shell_3/Cells/Lattice_set_3.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Colors tiles of 4 x 4 cells of a level across y and z with four colors, so that no function acts on two tiles of one
// color.
template <typename Field>
class Cell_colors
{
  typedef typename Field::Cell_index Index;
public:
  explicit Cell_colors(const Field& field)
  {
    constexpr int tile = 4;
    const auto floor_div = [](int a) { return a >= 0 ? a / tile : -((-a + tile - 1) / tile); };
    std::array<std::vector<std::pair<std::uint64_t, Index> >, 4> order;
    for(Index c = 0; c < field.number_of_cells(); ++c) {
      const auto& p = field.cells().lattice_point(c);
      const int j = floor_div(p[1]), k = floor_div(p[2]);
      order[(j & 1) + 2 * (k & 1)].emplace_back(Lattice_key::encode(field.cells().level(c), j, k), c);
    }
    for(int color = 0; color < 4; ++color) {
      std::sort(order[color].begin(), order[color].end());
      for(std::size_t n = 0; n < order[color].size(); ++n) {
        if(n == 0 || order[color][n].first != order[color][n - 1].first) m_tiles[color].emplace_back();
        m_tiles[color].back().push_back(order[color][n].second);
      }
    }
  }

  // Calls f(cell) for every cell. Cells with a common function are never processed at the same time. The order in which
  // an entry is summed does not depend on the number of threads.
  template <typename ConcurrencyTag, typename Function>
  void for_each_cell(const Function& f) const
  {
    for(const std::vector<std::vector<Index> >& tiles : m_tiles)
      for_each_chunk<ConcurrencyTag>(tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
        for(std::size_t t = begin; t < end; ++t)
          for(Index c : tiles[t]) f(c);
      });
  }

private:
  std::array<std::vector<std::vector<Index> >, 4> m_tiles;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_FIT_INTERNAL_CELL_COLORS_H
