// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CERTIFICATE_DISPLACEMENT_BOUNDS_H
#define CGAL_BSPLINE_SHELL_3_CERTIFICATE_DISPLACEMENT_BOUNDS_H

#include <CGAL/Bspline_shell_3/Field/Thresholds.h>
#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Spline/Bernstein_bounds.h>
#include <CGAL/Bspline_shell_3/Spline/Level_range.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns an upper bound on the length of curves between two values of the field, where the gradient has at least a
// given length. The last term accounts for the rounding of subnormal quotients.
inline double longest_curve(const Level_range& levels, double least_gradient)
{
  return (levels.max - levels.min) / least_gradient * (1 + 4 * rounding) + std::numeric_limits<double>::denorm_min();
}

// Cubes of equal size that cover some cells (*tiles*). Each stores a bound on the length of curves through it. Along a
// curve, the field increases by at least the smallest length of the gradient per unit of length. The gradient and the
// thresholds within a distance of a tile suffice if they imply that curves through the tile end within that distance.
class Displacement_tiles
{
public:
  Displacement_tiles(const Bbox_3& box, double width) : m_box(box), m_width(width)
  {
    for(int a = 0; a < 3; ++a)
      if(!((box.max)(a) - (box.min)(a) < m_width * most_tiles_of_axis))
        m_width = ((box.max)(a) - (box.min)(a)) / most_tiles_of_axis;
  }

  // Inserts a part of the shell, with a lower bound on the gradient and a range that encloses the thresholds.
  void insert(const Bbox_3& box, double gradient, const Level_range& levels)
  {
    visit(box, [&](const Index& i) {
      Tile& tile = m_tiles[i];
      tile.gradient = (std::min)(tile.gradient, gradient);
      tile.levels.include(levels);
    });
  }

  // Computes bounds on the length of curves through each tile; no curve is longer than `of_all`.
  void bound(double of_all)
  {
    constexpr int farthest = 4;
    for(auto& t : m_tiles) {
      t.second.bound = of_all;
      for(int distance = 1; distance <= farthest; ++distance) {
        const Tile near = neighborhood(t.first, distance);
        const double length = longest_curve(near.levels, near.gradient);
        if(!(length < distance * m_width * (1 - 4 * margin))) continue;
        t.second.bound = (std::min)(length, of_all);
        break;
      }
    }
  }

  // Returns a bound on the length of curves that meet a box, or `of_all` if the box has too many tiles.
  double largest_bound(const Bbox_3& box, double of_all) const
  {
    double longest = 0;
    const bool is_visited = visit(box, [&](const Index& i) {
      const auto tile = m_tiles.find(i);
      if(tile != m_tiles.end()) longest = (std::max)(longest, tile->second.bound);
    });
    return is_visited ? longest : of_all;
  }

private:
  typedef std::array<int, 3> Index;
  struct Tile
  {
    double gradient = std::numeric_limits<double>::infinity();
    Level_range levels;
    double bound = 0;
  };
  static constexpr double margin = 1e-6;     // relative to a width; exceeds the rounding of positions of tiles
  static constexpr double most_tiles = 4096; // number of tiles of a box
  static constexpr double most_tiles_of_axis = double(1 << 20);

  // Calls visit(index) for the tiles that may meet a box. Returns false if there are too many.
  template <typename Visit>
  bool visit(const Bbox_3& box, const Visit& visit) const
  {
    Index first, last;
    double number = 1;
    for(int a = 0; a < 3; ++a) {
      const auto place = [&](double x) {
        return int(std::floor((std::min)((std::max)((x - (m_box.min)(a)) / m_width, -2.), 2 * most_tiles_of_axis)));
      };
      first[a] = place((box.min)(a)-margin * m_width);
      last[a] = place((box.max)(a) + margin * m_width);
      number *= last[a] - first[a] + 1.;
    }
    if(number > most_tiles) return false;
    for(int i = first[0]; i <= last[0]; ++i)
      for(int j = first[1]; j <= last[1]; ++j)
        for(int k = first[2]; k <= last[2]; ++k) visit(Index{ i, j, k });
    return true;
  }

  // Returns bounds that hold on all tiles within a distance.
  Tile neighborhood(const Index& center, int distance) const
  {
    Tile near;
    for(int i = -distance; i <= distance; ++i)
      for(int j = -distance; j <= distance; ++j)
        for(int k = -distance; k <= distance; ++k) {
          const auto other = m_tiles.find({ center[0] + i, center[1] + j, center[2] + k });
          if(other == m_tiles.end()) continue;
          near.gradient = (std::min)(near.gradient, other->second.gradient);
          near.levels.include(other->second.levels);
        }
    return near;
  }

  Bbox_3 m_box;
  double m_width;
  std::map<Index, Tile> m_tiles;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Certificate
 *
 * \brief returns, for each facet of a mesh, an upper bound on the length in the shell of the integral curves that meet
 * it.
 *
 * \tparam Cover a `Shell_cover_3`
 * \param cover the cover of the shell, without undecided boxes
 * \param inner, outer the thresholds
 * \param mesh a mesh in the shell
 * \param of_all a bound for all curves
 * \return the bounds in the units of the coordinates, in the order of the user's facets
 */
template <typename ConcurrencyTag, typename Cover, typename Threshold>
std::vector<double> displacement_bounds(const Cover& cover, const Threshold& inner, const Threshold& outer,
                                        const Input_mesh_3& mesh, double of_all)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto& field = cover.field();
  // Bounds are infinite outside the shell.
  const std::vector<double> gradients = cover.template least_gradients<ConcurrencyTag>();
  double width = 0;
  Bbox_3 box;
  for(std::uint32_t c = 0; c < gradients.size(); ++c)
    if(gradients[c] < infinity) {
      width = (std::max)(width, field.cell(c).width());
      box += field.cell(c).bbox();
    }
  internal::Displacement_tiles tiles(box, width);
  for(std::uint32_t c = 0; c < gradients.size(); ++c)
    if(gradients[c] < infinity) tiles.insert(field.cell(c).bbox(), gradients[c], threshold_range(inner, outer, c));
  tiles.bound(of_all);
  std::vector<double> displacements(mesh.number_of_facets_of_origin(), 0.);
  for(Input_mesh_3::Face_index f : mesh.mesh().faces()) {
    const auto t = mesh.triangle(f);
    double& displacement = displacements[mesh.facet_of_origin(f)];
    displacement = (std::max)(displacement, tiles.largest_bound(t[0].bbox() + t[1].bbox() + t[2].bbox(), of_all));
  }
  return displacements;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CERTIFICATE_DISPLACEMENT_BOUNDS_H
