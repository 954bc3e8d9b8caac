// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H
#define CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H

#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Iterator_range.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Lists, for each cell of a grid, the facets of a mesh whose boxes meet it. Facets with a common point share a cell,
// because rounding preserves the order of coordinates.
template <typename TriangleMesh>
class Facet_grid
{
  typedef typename TriangleMesh::Face_index Face_index;
public:
  // \param size approximate number of facets per cell, if a surface passes through as many cells as a square
  Facet_grid(const TriangleMesh& mesh, std::size_t size) : m_mesh(mesh)
  {
    for(Face_index f : mesh.faces()) m_bbox += bbox(f);
    const double longest = (std::max)({ m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span() });
    m_width = longest / std::ceil(std::sqrt(double(mesh.number_of_faces()) / double(size)));
    if(!(m_width > 0 && std::isfinite(m_width))) return; // no grid for coordinates so small or large
    for(int a = 0; a < 3; ++a) m_cells[std::size_t(a)] = interval(a, (m_bbox.max)(a)) + 1;
    m_first.assign(m_cells[0] * m_cells[1] * m_cells[2] + 1, 0);
  }

  // Fills the cells. Returns false if this takes too much memory because facets are large, if one cell has more than
  // 1/4 of the facets, or if there is no grid.
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
  struct Range
  {
    std::array<std::size_t, 3> first, last;
  };

  Bbox_3 bbox(Face_index f) const
  {
    const auto h = m_mesh.halfedge(f);
    return m_mesh.point(m_mesh.source(h)).bbox() + m_mesh.point(m_mesh.target(h)).bbox()
           + m_mesh.point(m_mesh.target(m_mesh.next(h))).bbox();
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

// Finds pairs of facets that intersect, except for pairs of two *unclear* facets. A facet is unclear if the fan of one
// of its vertices may not be embedded. Facets that share a vertex with a clear facet intersect it only in common
// vertices and edges, and are not tested. Such pairs are the most frequent and, because neighbors are almost coplanar,
// the most expensive to test.
template <typename TriangleMesh>
class Facet_intersections
{
  typedef typename TriangleMesh::Face_index Face_index;
  typedef typename TriangleMesh::Vertex_index Vertex_index;
public:
  typedef std::pair<Face_index, Face_index> Pair;

  // \param is_embedded result of `embedded_fans()` for the mesh
  Facet_intersections(const TriangleMesh& mesh, const std::vector<char>& is_embedded)
    : m_mesh(mesh), m_is_embedded(is_embedded)
  {}

  bool is_unclear(Face_index f) const { return facet(f).is_unclear; }

  // Appends the intersecting pairs among some facets, until `most` are found.
  template <typename FaceRange>
  void find(const FaceRange& facets, std::size_t most, std::vector<Pair>& found) const
  {
    std::vector<Box> boxes;
    boxes.reserve(facets.size());
    for(Face_index f : facets) {
      const Facet facet = this->facet(f);
      boxes.emplace_back(point(facet, 0).bbox() + point(facet, 1).bbox() + point(facet, 2).bbox(), facet);
    }
    struct Enough
    {}; // the only way to end a search for boxes
    try {
      CGAL::box_self_intersection_d<Sequential_tag>(
        boxes.begin(), boxes.end(),
        [&](const Box& a, const Box& b) {
          const Facet f = a.info(), g = b.info();
          if((f.is_unclear && g.is_unclear) || have_common_vertex(f, g)
             || !CGAL::do_intersect(triangle(f), triangle(g)))
            return;
          found.emplace_back(f.face, g.face);
          if(found.size() >= most) throw Enough();
        },
        cutoff);
    } catch(const Enough&) {}
  }

private:
  struct Facet
  {
    Face_index face;
    std::array<Vertex_index, 3> vertices;
    bool is_unclear;
  };
  typedef Box_intersection_d::Box_with_info_d<double, 3, Facet> Box;
  static constexpr std::ptrdiff_t cutoff = 2000; // fewer boxes are compared one by one, along an axis

  Facet facet(Face_index f) const
  {
    const auto h = m_mesh.halfedge(f);
    const std::array<Vertex_index, 3> v = { m_mesh.source(h), m_mesh.target(h), m_mesh.target(m_mesh.next(h)) };
    return { f, v, !(m_is_embedded[v[0]] && m_is_embedded[v[1]] && m_is_embedded[v[2]]) };
  }
  const typename TriangleMesh::Point& point(const Facet& f, std::size_t corner) const
  {
    return m_mesh.point(f.vertices[corner]);
  }
  auto triangle(const Facet& f) const
  {
    typedef typename Kernel_traits<typename TriangleMesh::Point>::Kernel Kernel;
    return typename Kernel::Triangle_3(point(f, 0), point(f, 1), point(f, 2));
  }
  static bool have_common_vertex(const Facet& f, const Facet& g)
  {
    const auto has_g = [&](Vertex_index v) { return v == g.vertices[0] || v == g.vertices[1] || v == g.vertices[2]; };
    return has_g(f.vertices[0]) || has_g(f.vertices[1]) || has_g(f.vertices[2]);
  }

  const TriangleMesh& m_mesh;
  const std::vector<char>& m_is_embedded;
};

// Returns at most `most_pairs` pairs of facets that intersect, in their order. The result does not depend on the number
// of threads. For large meshes, pairs are found in the cells of a grid, so that the facets of a cell fit into the
// processor's cache.
// \param is_embedded result of `embedded_fans()` for the mesh
template <typename ConcurrencyTag, typename TriangleMesh>
std::vector<std::pair<typename TriangleMesh::Face_index, typename TriangleMesh::Face_index> > intersecting_facets(
  const TriangleMesh& mesh, const std::vector<char>& is_embedded, unsigned int most_pairs,
  std::size_t facets_of_cell = 64)
{
  typedef typename TriangleMesh::Face_index Face_index;
  typedef std::pair<Face_index, Face_index> Pair;
  // A surface fills a few times `most_squares` cells; the grid then has about 250,000 cells, and takes less memory than
  // very large meshes.
  constexpr std::size_t least_cells = 8, most_squares = 4096, most_copies = 3;
  std::vector<Pair> pairs;
  std::vector<Face_index> unclear;
  std::optional<Facet_grid<TriangleMesh> > grid;
  if(mesh.number_of_faces() >= least_cells * facets_of_cell)
    grid.emplace(mesh, (std::max)(facets_of_cell, mesh.number_of_faces() / most_squares));
  if(grid && grid->fill(most_copies * mesh.number_of_faces())) {
    const Facet_intersections<TriangleMesh> intersections(mesh, is_embedded);
    pairs = collect_from_chunks<ConcurrencyTag, Pair>(grid->number_of_cells(), 1,
                                                      [&](std::size_t begin, std::size_t, std::vector<Pair>& found) {
                                                        const auto facets = grid->facets(begin);
                                                        if(facets.size() > 1)
                                                          intersections.find(facets, most_pairs, found);
                                                      });
    for(Face_index f : mesh.faces())
      if(intersections.is_unclear(f)) unclear.push_back(f);
  } else unclear.assign(mesh.faces().begin(), mesh.faces().end());

  if(unclear.size() > 1) {
    const auto np = CGAL::parameters::maximum_number(most_pairs);
    std::vector<Pair> found;
    Polygon_mesh_processing::self_intersections<ConcurrencyTag>(unclear, mesh, std::back_inserter(found), np);
    if(found.size() >= most_pairs) { // these pairs depend on the threads
      found.clear();
      Polygon_mesh_processing::self_intersections<Sequential_tag>(unclear, mesh, std::back_inserter(found), np);
    }
    pairs.insert(pairs.end(), found.begin(), found.end());
  }
  for(Pair& pair : pairs)
    if(pair.second < pair.first) std::swap(pair.first, pair.second);
  sort_unique(pairs); // a pair may share several cells
  if(pairs.size() > most_pairs) pairs.erase(pairs.begin() + most_pairs, pairs.end());
  return pairs;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INTERSECTING_FACETS_H
