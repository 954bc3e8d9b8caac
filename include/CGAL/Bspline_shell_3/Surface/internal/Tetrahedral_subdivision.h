// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_TETRAHEDRAL_SUBDIVISION_H
#define CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_TETRAHEDRAL_SUBDIVISION_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Divides leaves into tetrahedra. A leaf is divided into n^3 equal subcells, and each subcell into the cones from its
// center over the triangles of its faces. A face with smaller leaves behind it is divided into the squares of their
// subcells. Other squares are divided by a fan. It starts at the midpoint of the first edge that smaller leaves around
// it bisect or, if there is none, at the smallest corner. Triangles thus depend only on the square and the leaves
// around it, and tetrahedra on both sides conform. Leaves that touch must differ by at most one level, as in graded
// hierarchies.
//
// Nodes are corners of tetrahedra. They have integer coordinates. In a leaf, these range from 0 to 2n along each axis.
// In space, their unit is 1/2n of the width of the smallest leaves, and they may need more than 32 bits.
template <typename Cells>
class Tetrahedral_subdivision
{
public:
  typedef typename Cells::Index Index;
  typedef std::array<int, 3> Node;
  typedef std::array<std::int64_t, 3> Node_in_space;

  Tetrahedral_subdivision(const Cells& cells, int n) : m_cells(&cells), m_n(n), m_finest(cells.number_of_levels() - 1)
  {}

  // Returns the number of nodes of a leaf. Some are nodes of no tetrahedron.
  std::size_t number_of_nodes() const { return cubed(std::size_t(2 * m_n + 1)); }
  std::size_t number(const Node& v) const { return (std::size_t(v[2]) * (2 * m_n + 1) + v[1]) * (2 * m_n + 1) + v[0]; }
  Node node(std::size_t number) const
  {
    const std::size_t row = 2 * m_n + 1;
    return { int(number % row), int(number / row % row), int(number / row / row) };
  }

  Node_in_space in_space(Index c, const Node& v) const
  {
    Node_in_space w;
    for(int a = 0; a < 3; ++a) w[a] = (std::int64_t(m_cells->lattice_point(c)[a]) * 2 * m_n + v[a]) * scale(c);
    return w;
  }
  Node in_leaf(Index c, const Node_in_space& w) const
  {
    Node v;
    for(int a = 0; a < 3; ++a) v[a] = int(w[a] / scale(c) - std::int64_t(m_cells->lattice_point(c)[a]) * 2 * m_n);
    return v;
  }

  // Calls visit(c) for the leaves that contain the midpoint of two nodes, until it returns true. The order depends on
  // this point only.
  template <typename Visitor>
  void visit_leaves_around(const Node_in_space& v, const Node_in_space& w, const Visitor& visit) const
  {
    const int width = 4 * m_n;
    Node first;
    bool is_between[3];
    for(int a = 0; a < 3; ++a) {
      first[a] = floor_quotient(v[a] + w[a], width);
      is_between[a] = std::int64_t(first[a]) * width == v[a] + w[a];
    }
    for(int o = 0; o < 8; ++o) {
      Node cell = first;
      bool contains = true;
      for(int a = 0; a < 3; ++a)
        if((o >> a) & 1) {
          contains = contains && is_between[a];
          --cell[a];
        }
      if(!contains) continue;
      const Index c = m_cells->leaf_around(m_finest, cell);
      if(c != Cells::npos && visit(c)) return;
    }
  }

  // Returns the leaf behind a triangle on a face of a leaf.
  Index leaf_behind(const Node_in_space& u, const Node_in_space& v, const Node_in_space& w, int axis,
                    bool positive) const
  {
    Node cell;
    for(int a = 0; a < 3; ++a) cell[a] = floor_quotient(u[a] + v[a] + w[a], 6 * m_n);
    if(!positive) --cell[axis];
    return m_cells->leaf_around(m_finest, cell);
  }

  // The smaller leaves around a leaf, which determine which of its edges are bisected and which of its faces are
  // divided.
  class Surroundings
  {
  public:
    Surroundings(const Tetrahedral_subdivision& subdivision, Index c) : m_last(2 * subdivision.m_n)
    {
      const int level = subdivision.m_cells->level(c);
      for(int n = 0; n < 27; ++n) {
        Node p = subdivision.m_cells->lattice_point(c);
        p[0] += n % 3 - 1;
        p[1] += n / 3 % 3 - 1;
        p[2] += n / 9 - 1;
        m_is_split[n] = subdivision.m_cells->is_split(level, p);
      }
    }
    // Returns whether a node of the leaf is in a closed smaller leaf. The node must not be the center of a subcell.
    bool are_smaller(const Node& v) const
    {
      bool smaller = false;
      for(int o = 1; o < 8; ++o) {
        int direction = 13;
        bool is_there = true;
        for(int a = 0, stride = 1; a < 3; ++a, stride *= 3)
          if((o >> a) & 1) {
            is_there = is_there && (v[a] == 0 || v[a] == m_last);
            direction += v[a] == 0 ? -stride : stride;
          }
        smaller = smaller || (is_there && m_is_split[direction]);
      }
      return smaller;
    }

  private:
    int m_last;
    std::array<bool, 27> m_is_split;
  };

  // Calls visit(v) for the nodes of a leaf that are corners of tetrahedra.
  template <typename Visitor>
  void visit_nodes(const Surroundings& surroundings, const Visitor& visit) const
  {
    Node v;
    for(v[2] = 0; v[2] <= 2 * m_n; ++v[2])
      for(v[1] = 0; v[1] <= 2 * m_n; ++v[1])
        for(v[0] = 0; v[0] <= 2 * m_n; ++v[0]) {
          const int odd = (v[0] & 1) + (v[1] & 1) + (v[2] & 1);
          if(odd == 0 || odd == 3 || surroundings.are_smaller(v)) visit(v);
        }
  }

  // Calls visit(corners, axis, positive) for the tetrahedra of a leaf, which are positively oriented. The first corner
  // is the center of a subcell. The others are on its face orthogonal to `axis`, on the side of larger (`positive`) or
  // smaller coordinates.
  template <typename Visitor>
  void visit_tetrahedra(const Surroundings& surroundings, const Visitor& visit) const
  {
    Node v;
    for(v[2] = 0; v[2] < 2 * m_n; v[2] += 2)
      for(v[1] = 0; v[1] < 2 * m_n; v[1] += 2)
        for(v[0] = 0; v[0] < 2 * m_n; v[0] += 2)
          for(int axis = 0; axis < 3; ++axis)
            for(bool positive : { false, true })
              visit_triangles(surroundings, v, axis, positive, [&](const Node& a, const Node& b, const Node& c) {
                const Node middle = { v[0] + 1, v[1] + 1, v[2] + 1 };
                visit(std::array<Node, 4>{ middle, a, positive ? b : c, positive ? c : b }, axis, positive);
              });
  }

private:
  static std::size_t cubed(std::size_t x) { return x * x * x; }
  static int floor_quotient(std::int64_t i, int d) { return int(i / d - (i % d < 0 ? 1 : 0)); }
  int scale(Index c) const { return 1 << (m_finest - m_cells->level(c)); }

  // Visits the triangles of a face of the subcell with the smallest node `v`, seen from the side of larger coordinates.
  template <typename Visitor>
  void visit_triangles(const Surroundings& surroundings, const Node& v, int axis, bool positive,
                       const Visitor& visit) const
  {
    const auto at = [&](int i, int j) {
      Node w = v;
      if(positive) w[axis] += 2;
      w[(axis + 1) % 3] += i;
      w[(axis + 2) % 3] += j;
      return w;
    };
    if(surroundings.are_smaller(at(1, 1))) {
      for(int j = 0; j < 2; ++j)
        for(int i = 0; i < 2; ++i) {
          visit(at(i, j), at(i + 1, j), at(i + 1, j + 1));
          visit(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
      return;
    }
    const std::array<Node, 8> around = {
      at(0, 0), at(1, 0), at(2, 0), at(2, 1), at(2, 2), at(1, 2), at(0, 2), at(0, 1)
    };
    std::array<Node, 8> polygon;
    std::size_t size = 0, apex = 0;
    for(std::size_t n = 0; n < 8; ++n) {
      if(n % 2 == 1 && !surroundings.are_smaller(around[n])) continue;
      if(n % 2 == 1 && apex == 0) apex = size;
      polygon[size++] = around[n];
    }
    for(std::size_t n = 1; n + 1 < size; ++n)
      visit(polygon[apex], polygon[(apex + n) % size], polygon[(apex + n + 1) % size]);
  }

  const Cells* m_cells;
  int m_n, m_finest;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SURFACE_INTERNAL_TETRAHEDRAL_SUBDIVISION_H
