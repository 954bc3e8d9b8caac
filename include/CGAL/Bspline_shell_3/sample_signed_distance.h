// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SAMPLE_SIGNED_DISTANCE_H
#define CGAL_BSPLINE_SHELL_3_SAMPLE_SIGNED_DISTANCE_H

#include <CGAL/Bspline_shell_3/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Mesh_signed_distance_3.h>
#include <CGAL/Bspline_shell_3/internal/for_each_chunk.h>

#include <array>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Distance
 *
 * \brief where the signed distance is sampled: two points per cell and axis, which together form a uniform lattice of
 * half the cells' spacing.
 */
struct Distance_samples
{
  static constexpr int per_cell = 8;
  /// position of a sample in its cell; sample `s` is at 1/4 or 3/4 of axis `a` as bit `a` of `s` is 0 or 1
  static double position(int s, int axis) { return (s >> axis) & 1 ? 0.75 : 0.25; }
  template <typename Point_3>
  static Point_3 point(const Cell_complex_3& cells, Cell_complex_3::Index c, int s)
  {
    const std::array<double, 3> corner = cells.corner(c);
    return Point_3(corner[0] + position(s, 0) * cells.width(), corner[1] + position(s, 1) * cells.width(),
                   corner[2] + position(s, 2) * cells.width());
  }
};

namespace internal {

// Cells that the mesh does not enter, by connected component; the sign of the distance is constant on each.
// `surface_cells`: keys of the cells that have a piece of the mesh, ascending.
class Sides_of_mesh
{
public:
  static constexpr std::uint32_t on_surface = std::uint32_t(-1);

  Sides_of_mesh(const Cell_complex_3& cells, const std::vector<std::uint64_t>& surface_cells)
    : m_component(cells.number_of_cells(), unseen)
  {
    typedef Cell_complex_3::Index Index;
    for(std::uint64_t key : surface_cells) {
      const Index c = cells.cell(Lattice_key::decode(key));
      if(c != Cell_complex_3::npos) m_component[c] = on_surface;
    }
    std::vector<Index> stack;
    for(Index seed = 0; seed < m_component.size(); ++seed) {
      if(m_component[seed] != unseen) continue;
      const std::uint32_t id = std::uint32_t(m_seeds.size());
      m_seeds.push_back(seed);
      m_component[seed] = id;
      stack.push_back(seed);
      while(!stack.empty()) {
        const Index c = stack.back();
        stack.pop_back();
        for(int axis = 0; axis < 3; ++axis)
          for(bool positive : { false, true }) {
            const Index n = cells.neighbor(c, axis, positive);
            if(n == Cell_complex_3::npos || m_component[n] != unseen) continue;
            m_component[n] = id;
            stack.push_back(n);
          }
      }
    }
  }

  std::uint32_t component(Cell_complex_3::Index c) const { return m_component[c]; }
  const std::vector<Cell_complex_3::Index>& seeds() const { return m_seeds; }

private:
  static constexpr std::uint32_t unseen = std::uint32_t(-2);
  std::vector<std::uint32_t> m_component;
  std::vector<Cell_complex_3::Index> m_seeds;
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Distance
 *
 * \brief the signed distance at the samples of all cells, in user units: `Distance_samples::per_cell` values a cell.
 *
 * \tparam Oracle a model of `SignedDistanceOracle_3`
 */
template <typename ConcurrencyTag, typename Oracle>
std::vector<double> sample_signed_distance(const Oracle& oracle, const Cell_complex_3& cells)
{
  std::vector<double> samples(cells.number_of_cells() * Distance_samples::per_cell);
  internal::for_each_chunk<ConcurrencyTag>(cells.number_of_cells(), 64, [&](std::size_t begin, std::size_t end) {
    for(std::size_t c = begin; c < end; ++c)
      for(int s = 0; s < Distance_samples::per_cell; ++s)
        samples[c * Distance_samples::per_cell + s] =
          oracle(Distance_samples::point<typename Oracle::Point_3>(cells, Cell_complex_3::Index(c), s));
  });
  return samples;
}

/*!
 * \ingroup PkgBsplineShell3Distance
 *
 * \brief the same for a mesh whose cells are known, and faster: the closest facet of one sample is where the search for
 * the next one starts, and one exact side-of-mesh query serves all cells that are connected without crossing the mesh.
 *
 * \param oracle the distance to the mesh
 * \param cells where it is sampled
 * \param surface_cells the lattice keys of all cells that the oracle's mesh enters, ascending
 *        (`Clipped_mesh_3::cells()`). Signs are wrong where one is missing.
 */
template <typename ConcurrencyTag>
std::vector<double> sample_distance_to_mesh(const Mesh_signed_distance_3& oracle, const Cell_complex_3& cells,
                                            const std::vector<std::uint64_t>& surface_cells)
{
  typedef Mesh_signed_distance_3::Point_3 Point_3;
  const internal::Sides_of_mesh sides(cells, surface_cells);
  std::vector<signed char> sign(sides.seeds().size());
  for(std::size_t i = 0; i < sign.size(); ++i)
    sign[i] = static_cast<signed char>(oracle.sign(Distance_samples::point<Point_3>(cells, sides.seeds()[i], 0)));

  std::vector<double> samples(cells.number_of_cells() * Distance_samples::per_cell);
  internal::for_each_chunk<ConcurrencyTag>(cells.number_of_cells(), 256, [&](std::size_t begin, std::size_t end) {
    Mesh_signed_distance_3::Hint hint = oracle.any_hint();
    for(std::size_t c = begin; c < end; ++c) {
      const std::uint32_t component = sides.component(Cell_complex_3::Index(c));
      for(int s = 0; s < Distance_samples::per_cell; ++s) {
        const Point_3 p = Distance_samples::point<Point_3>(cells, Cell_complex_3::Index(c), s);
        const int side = component == internal::Sides_of_mesh::on_surface ? oracle.sign(p) : int(sign[component]);
        samples[c * Distance_samples::per_cell + s] = side * oracle.distance(p, hint);
      }
    }
  });
  return samples;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SAMPLE_SIGNED_DISTANCE_H
