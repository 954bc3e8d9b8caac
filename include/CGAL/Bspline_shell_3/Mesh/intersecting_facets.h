// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H
#define CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H

#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The facets of a mesh whose boxes meet the cells of a grid, cell by cell. Facets that have a point in common share a cell: rounding keeps the order of
// coordinates.
template <typename TriangleMesh>
class Facet_grid
{
  typedef typename TriangleMesh::Face_index Face_index;
public:
  // \param size about how many facets a cell gets: a surface passes through as many cells as a square has
  Facet_grid(const TriangleMesh& mesh, std::size_t size) : m_mesh(mesh)
  {
    for(Face_index f : mesh.faces()) m_bbox += bbox(f);
    const double longest = (std::max)({ m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span() });
    m_width = longest / std::ceil(std::sqrt(double(mesh.number_of_faces()) / double(size)));
    if(!(m_width > 0 && std::isfinite(m_width))) return;      // no grid for coordinates so small or large
    for(int a = 0; a < 3; ++a) m_cells[std::size_t(a)] = interval(a, (m_bbox.max)(a)) + 1;
    m_first.assign(m_cells[0] * m_cells[1] * m_cells[2] + 1, 0);
  }

  // False if that would take too much memory, as facets are large, if much of the mesh is in one cell, or if there is no grid.
  bool fill(std::size_t most)
  {
    if(m_first.empty()) return false;
    std::size_t total = 0;
    for(Face_index f : m_mesh.faces()) {
      const Range r = range(f);
      total += (r.last[0] - r.first[0] + 1) * (r.last[1] - r.first[1] + 1) * (r.last[2] - r.first[2] + 1);
      if(total > most) return false;
      visit(r, [&](std::size_t cell) { ++m_first[cell + 1]; });
    }
    if(*std::max_element(m_first.begin(), m_first.end()) > m_mesh.number_of_faces() / 4) return false;
    std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
    m_facets.resize(total);
    std::vector<std::size_t> next(m_first.begin(), m_first.end() - 1);
    for(Face_index f : m_mesh.faces()) visit(range(f), [&](std::size_t cell) { m_facets[next[cell]++] = f; });
    return true;
  }

  std::size_t number_of_cells() const { return m_first.size() - 1; }
  Iterator_range<typename std::vector<Face_index>::const_iterator> facets(std::size_t cell) const
  {
    return { m_facets.begin() + std::ptrdiff_t(m_first[cell]), m_facets.begin() + std::ptrdiff_t(m_first[cell + 1]) };
  }

private:
  struct Range { std::array<std::size_t, 3> first, last; };

  Bbox_3 bbox(Face_index f) const
  {
    const auto h = m_mesh.halfedge(f);
    return m_mesh.point(m_mesh.source(h)).bbox() + m_mesh.point(m_mesh.target(h)).bbox() + m_mesh.point(m_mesh.target(m_mesh.next(h))).bbox();
  }
  std::size_t interval(int axis, double x) const { return std::size_t((x - (m_bbox.min)(axis)) / m_width); }
  Range range(Face_index f) const
  {
    const Bbox_3 b = bbox(f);
    Range r;
    for(int a = 0; a < 3; ++a) {
      r.first[std::size_t(a)] = interval(a, (b.min)(a));
      r.last[std::size_t(a)] = interval(a, (b.max)(a));
    }
    return r;
  }
  template <typename Visitor>
  void visit(const Range& r, const Visitor& visitor) const
  {
    for(std::size_t k = r.first[2]; k <= r.last[2]; ++k)
      for(std::size_t j = r.first[1]; j <= r.last[1]; ++j)
        for(std::size_t i = r.first[0]; i <= r.last[0]; ++i) visitor((k * m_cells[1] + j) * m_cells[0] + i);
  }

  const TriangleMesh& m_mesh;
  Bbox_3 m_bbox;
  double m_width = 0;
  std::array<std::size_t, 3> m_cells = {};
  std::vector<std::size_t> m_first;
  std::vector<Face_index> m_facets;
};

// Pairs of facets that intersect, in their order, and not more than a number of them, the same with any number of threads:
// `Polygon_mesh_processing::self_intersections()`, of large meshes in the cells of a grid, most of which fit the processor's cache.
template <typename ConcurrencyTag, typename TriangleMesh>
std::vector<std::pair<typename TriangleMesh::Face_index, typename TriangleMesh::Face_index> >
intersecting_facets(const TriangleMesh& mesh, unsigned int most_pairs, std::size_t facets_of_cell = 1024)
{
  typedef typename TriangleMesh::Face_index Face_index;
  typedef std::pair<Face_index, Face_index> Pair;
  // A surface fills a few times `most_squares` cells. More cells are no faster, and each is a call, which checks the whole mesh if preconditions are on.
  constexpr std::size_t least_cells = 8, most_squares = 256, most_copies = 3;
  const auto np = CGAL::parameters::maximum_number(most_pairs);
  std::vector<Pair> pairs;
  bool is_known = false;
  if(mesh.number_of_faces() >= least_cells * facets_of_cell) {
    Facet_grid<TriangleMesh> grid(mesh, (std::max)(facets_of_cell, mesh.number_of_faces() / most_squares));
    is_known = grid.fill(most_copies * mesh.number_of_faces());
    if(is_known)
      pairs = collect_from_chunks<ConcurrencyTag, Pair>(grid.number_of_cells(), 1, [&](std::size_t begin, std::size_t, std::vector<Pair>& found) {
        const auto facets = grid.facets(begin);
        if(facets.size() > 1) Polygon_mesh_processing::self_intersections<Sequential_tag>(facets, mesh, std::back_inserter(found), np);
      });
  }
  if(!is_known) {
    Polygon_mesh_processing::self_intersections<ConcurrencyTag>(mesh, std::back_inserter(pairs), np);
    if(pairs.size() >= most_pairs) {      // which ones depends on threads
      pairs.clear();
      Polygon_mesh_processing::self_intersections<Sequential_tag>(mesh, std::back_inserter(pairs), np);
    }
  }
  for(Pair& pair : pairs)
    if(pair.second < pair.first) std::swap(pair.first, pair.second);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());      // those that share several cells
  if(pairs.size() > most_pairs) pairs.erase(pairs.begin() + most_pairs, pairs.end());
  return pairs;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H
