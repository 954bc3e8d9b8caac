// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_CELLS_CELL_HIERARCHY_3_H
#define CGAL_BSPLINE_SHELL_3_CELLS_CELL_HIERARCHY_3_H

#include <CGAL/Bspline_shell_3/Cells/Cell_complex_3.h>
#include <CGAL/Bspline_shell_3/Support/sort_unique.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Cells
 *
 * \brief a forest of octrees whose roots are the cells of a `Cell_complex_3`, graded for splines.
 *
 * A cell of level \f$l\f$ has the width of a root cell divided by \f$2^l\f$. It is a *leaf*, or it is split into eight
 * cells of the next level. The leaves are numbered from 0, coarse leaves first. Around a split cell, there are three
 * layers of cells of the same level within the domain, which are leaves or split themselves. Hence a spline function of
 * level \f$l\f$ that acts on a split cell acts on no cell coarser than \f$l\f$.
 *
 * Corners of all cells are exact `double`s. Memory is linear in the number of cells.
 */
class Cell_hierarchy_3
{
  typedef std::vector<std::uint64_t> Keys; // lattice keys, sorted, unique
public:
  typedef Cell_complex_3::Index Index;                ///< index of a leaf
  static constexpr Index npos = Cell_complex_3::npos; ///< no leaf
  Cell_hierarchy_3() : Cell_hierarchy_3(Cell_complex_3()) {}

  /// constructs a hierarchy without split cells: its leaves are the root cells, with the same indices
  Cell_hierarchy_3(Cell_complex_3 roots) : m_roots(std::move(roots))
  {
    int largest = 0;
    for(Index c = 0; c < m_roots.number_of_cells(); ++c)
      for(int i : m_roots.lattice_point(c)) largest = (std::max)(largest, std::abs(i) + 1);
    // Lattice points of finer levels need keys, also in layers around the domain.
    const int finest = (std::min)(int(most_levels), m_roots.number_of_halvings() - subdivisions_of_a_leaf);
    while(m_max_level < finest && largest < Lattice_key::max_coordinate >> (m_max_level + 1)) ++m_max_level;
    number_cells();
  }

  /// returns the hierarchy with the given leaves and `rings` layers of cells around each of them split. Without such
  /// layers, the split region would be narrower than a function of the next level. With two layers, only functions of
  /// the next level act on the leaf. More cells are split if the grading requires it. Leaves of level `max_level()` are
  /// not split.
  Cell_hierarchy_3 refined(const std::vector<Index>& leaves, int rings = 2) const
  {
    Cell_hierarchy_3 finer;
    finer.m_roots = m_roots;
    finer.m_max_level = m_max_level;
    finer.m_split = m_split;
    finer.m_split.resize(std::size_t(m_max_level));
    std::vector<Keys> marked(finer.m_split.size());
    for(Index c : leaves)
      if(level(c) < m_max_level) marked[std::size_t(level(c))].push_back(key(lattice_point(c)));
    for(int l = m_max_level - 1; l >= 0; --l) {
      sort_unique(marked[l]);
      merge(in_domain(dilate(std::move(marked[l]), -rings, rings), l), finer.m_split[l]);
      if(l > 0) merge(finer.needed_by_grading(l), finer.m_split[l - 1]);
    }
    while(!finer.m_split.empty() && finer.m_split.back().empty()) finer.m_split.pop_back();
    finer.number_cells();
    return finer;
  }

  /// returns the hierarchy with the given leaves, which are sorted and unique keys of lattice points for each level.
  /// Returns nothing if leaves overlap or do not fill a split cell, if they are too small, or if they violate the
  /// grading.
  static std::optional<Cell_hierarchy_3> from_leaves(const Lattice_3& lattice,
                                                     const std::vector<std::vector<std::uint64_t> >& leaves)
  {
    std::vector<Keys> split(leaves.size());
    Keys cells;
    for(std::size_t l = leaves.size(); l-- > 0;) {
      cells = split[l];
      merge(leaves[l], cells);
      if(l > 0) split[l - 1] = parents(cells);
    }
    Cell_hierarchy_3 hierarchy(Cell_complex_3(lattice, cells));
    while(!split.empty() && split.back().empty()) split.pop_back();
    if(split.size() > std::size_t(hierarchy.m_max_level)) return std::nullopt;
    hierarchy.m_split = std::move(split);
    for(std::size_t l = 1; l < hierarchy.m_split.size(); ++l) {
      const Keys coarser = hierarchy.needed_by_grading(int(l));
      if(!std::includes(hierarchy.m_split[l - 1].begin(), hierarchy.m_split[l - 1].end(), coarser.begin(),
                        coarser.end()))
        return std::nullopt;
    }
    hierarchy.number_cells();
    Index c = 0;
    for(std::size_t l = 0; l < leaves.size(); ++l)
      for(std::uint64_t k : leaves[l]) {
        if(c == hierarchy.number_of_cells() || hierarchy.level(c) != int(l) || key(hierarchy.lattice_point(c)) != k)
          return std::nullopt;
        ++c;
      }
    if(c != hierarchy.number_of_cells()) return std::nullopt;
    return hierarchy;
  }

  const Cell_complex_3& roots() const { return m_roots; }
  const Lattice_3& lattice() const { return m_roots.lattice(); } ///< lattice of the root cells
  bool is_exact() const { return m_roots.is_exact(); }           ///< whether the corners of all cells are exact
  int number_of_levels() const { return int(m_levels.size()); }
  int max_level() const { return m_max_level; }                   ///< cells of this level are not split
  std::size_t number_of_cells() const { return m_leaves.size(); } ///< number of leaves
  int level(Index c) const { return m_leaves[c].level; }
  /// returns the leaf's smallest corner, on the lattice of its level
  const Lattice_3::Point& lattice_point(Index c) const { return m_leaves[c].point; }
  double width(Index c) const { return level_width(level(c)); }
  double level_width(int level) const { return m_level_width[std::size_t(level)]; }
  /// returns the exact coordinate of plane `i` across an axis between cells of a level
  double coordinate(int level, int axis, int i) const
  {
    return m_roots.lattice().origin()[axis] + i * level_width(level);
  }
  std::array<double, 3> corner(Index c) const { return corner(level(c), lattice_point(c)); }
  /// returns the first leaf of a level; leaves of a level are numbered consecutively
  Index first_leaf(int level) const { return m_levels[std::size_t(level)].first_leaf; }

  /// returns all cells of a level, leaves and split cells
  const Lattice_set_3& cells(int level) const { return m_levels[std::size_t(level)].cells; }
  /// returns the leaf that is the given cell of a level; `npos` if the cell is split or does not exist
  Index leaf(int level, const Lattice_3::Point& p) const
  {
    const Level& l = m_levels[std::size_t(level)];
    const Index n = l.cells.index(p);
    return n == npos ? npos : l.nodes[n].leaf;
  }
  /// returns whether the cell of a level with this lattice point exists and is split
  bool is_split(int level, const Lattice_3::Point& p) const
  {
    const Level& l = m_levels[std::size_t(level)];
    const Index n = l.cells.index(p);
    return n != npos && l.nodes[n].leaf == npos;
  }
  /// returns the leaf that is or contains the cell of a level with this lattice point; `npos` if there is none
  Index leaf_around(int level, Lattice_3::Point p) const
  {
    for(int l = level; l >= 0; --l) {
      const Index n = m_levels[std::size_t(l)].cells.index(p);
      if(n != npos) return m_levels[std::size_t(l)].nodes[n].leaf;
      for(int& i : p) i = floor_shift(i, 1);
    }
    return npos;
  }
  /// returns whether the cell of a level with this lattice point is part of the domain, whatever the size of its leaves
  bool is_in_domain(int level, Lattice_3::Point p) const
  {
    for(int& i : p) i = floor_shift(i, level);
    return m_roots.cell(p) != npos;
  }

  /// returns a leaf that contains the point; `npos` if there is none
  template <typename Point>
  Index locate(const Point& p) const
  {
    Index n = m_roots.locate(p);
    if(n == npos || number_of_levels() == 1) return n;
    Lattice_3::Point cell = m_roots.lattice_point(n);
    for(int l = 0;; ++l) {
      const Node& node = m_levels[std::size_t(l)].nodes[n];
      if(node.leaf != npos) return node.leaf;
      int octant = 0;
      for(int a = 0; a < 3; ++a) octant |= int(p[a] >= coordinate(l + 1, a, 2 * cell[a] + 1)) << a;
      n = child(l, node, octant);
      cell = child(cell, octant);
    }
  }

  /// calls `visit(c)` once for every leaf that meets the closed box; returns whether the closed leaves cover the box
  template <typename Visitor>
  bool visit_cells(const Bbox_3& box, const Visitor& visit) const
  {
    return m_roots.visit_cells(box,
                               [&](Index root) { visit_leaves(0, root, m_roots.lattice_point(root), box, visit); });
  }

  /// calls `visit(n)` for every leaf that shares a part of the given face of `c`; returns whether there is any
  template <typename Visitor>
  bool visit_neighbors(Index c, int axis, bool positive, const Visitor& visit) const
  {
    Lattice_3::Point p = lattice_point(c);
    p[axis] += positive ? 1 : -1;
    if(!is_in_domain(level(c), p)) return false;
    for(int l = level(c);; --l) {
      const Index n = m_levels[std::size_t(l)].cells.index(p);
      if(n != npos) {
        visit_leaves_at_face(l, p, axis, !positive, visit);
        return true;
      }
      for(int& i : p) i = floor_shift(i, 1);
    }
  }

private:
  struct Leaf
  {
    Lattice_3::Point point;
    int level;
  };
  struct Node
  {
    Index leaf; // npos if the cell is split
    Index rows; // position of the children in `rows`, if it is split
  };
  struct Level
  {
    Lattice_set_3 cells;
    std::vector<Node> nodes; // by index of the cell
    // For each split cell, the first children in its four rows along x, as indices in the next level.
    std::vector<std::array<Index, 4> > rows;
    Index first_leaf = 0;
  };

  // Returns a child of a split cell, by the bits of its octant: its index in the next level, or its lattice point.
  Index child(int level, const Node& node, int octant) const
  {
    return m_levels[std::size_t(level)].rows[node.rows][std::size_t(octant >> 1)] + Index(octant & 1);
  }
  static Lattice_3::Point child(const Lattice_3::Point& p, int octant)
  {
    return { 2 * p[0] + (octant & 1), 2 * p[1] + (octant >> 1 & 1), 2 * p[2] + (octant >> 2) };
  }

  static std::uint64_t key(const Lattice_3::Point& p) { return Lattice_key::encode(p[0], p[1], p[2]); }
  static int floor_shift(int i, int bits) { return (i - (i & ((1 << bits) - 1))) / (1 << bits); }

  static void merge(const Keys& more, Keys& keys)
  {
    const std::size_t middle = keys.size();
    keys.insert(keys.end(), more.begin(), more.end());
    std::inplace_merge(keys.begin(), keys.begin() + std::ptrdiff_t(middle), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  }

  static Keys parents(const Keys& keys)
  {
    Keys result;
    for(std::uint64_t k : keys) {
      Lattice_3::Point p = Lattice_key::decode(k);
      for(int& i : p) i = floor_shift(i, 1);
      const std::uint64_t parent = key(p);
      if(result.empty() || result.back() != parent) result.push_back(parent);
    }
    sort_unique(result);
    return result;
  }

  Keys in_domain(Keys keys, int level) const
  {
    keys.erase(std::remove_if(keys.begin(), keys.end(),
                              [&](std::uint64_t k) { return !is_in_domain(level, Lattice_key::decode(k)); }),
               keys.end());
    return keys;
  }

  // Returns the cells one level above that must be split because of the split cells of level `l`.
  Keys needed_by_grading(int l) const { return parents(in_domain(dilate(m_split[std::size_t(l)], -3, 3), l)); }

  void number_cells()
  {
    for(std::size_t l = 0; l < m_level_width.size(); ++l) m_level_width[l] = std::ldexp(m_roots.width(), -int(l));
    m_levels.clear();
    m_leaves.clear();
    Keys keys;
    for(Index c = 0; c < m_roots.number_of_cells(); ++c) keys.push_back(key(m_roots.lattice_point(c)));
    for(std::size_t l = 0; l <= m_split.size(); ++l) {
      m_levels.emplace_back();
      Level& level = m_levels.back();
      level.cells = Lattice_set_3(keys);
      level.nodes.assign(keys.size(), { npos, npos });
      level.first_leaf = Index(m_leaves.size());
      Keys children;
      std::size_t s = 0;
      for(std::size_t n = 0; n < keys.size(); ++n) {
        const Lattice_3::Point& p = level.cells.point(Index(n));
        if(l < m_split.size() && s < m_split[l].size() && m_split[l][s] == keys[n]) {
          level.nodes[n].rows = Index(s++);
          for(int o = 0; o < 8; ++o) children.push_back(key(child(p, o)));
        } else {
          level.nodes[n].leaf = Index(m_leaves.size());
          m_leaves.push_back({ p, int(l) });
        }
      }
      std::sort(children.begin(), children.end());
      keys.swap(children);
    }
    for(std::size_t l = 0; l < m_split.size(); ++l)
      for(std::uint64_t k : m_split[l]) {
        m_levels[l].rows.emplace_back();
        for(int row = 0; row < 4; ++row)
          m_levels[l].rows.back()[std::size_t(row)] = m_levels[l + 1].cells.index(
            child(Lattice_key::decode(k), 2 * row));
      }
  }

  std::array<double, 3> corner(int level, const Lattice_3::Point& p) const
  {
    return { coordinate(level, 0, p[0]), coordinate(level, 1, p[1]), coordinate(level, 2, p[2]) };
  }

  // Visits the leaves that meet the box, in a cell that meets it.
  template <typename Visitor>
  void visit_leaves(int level, Index n, const Lattice_3::Point& p, const Bbox_3& box, const Visitor& visit) const
  {
    const Node& node = m_levels[std::size_t(level)].nodes[n];
    if(node.leaf != npos) {
      visit(node.leaf);
      return;
    }
    bool meets[3][2];
    for(int a = 0; a < 3; ++a) {
      const double middle = coordinate(level + 1, a, 2 * p[a] + 1);
      meets[a][0] = (box.min)(a) <= middle;
      meets[a][1] = (box.max)(a) >= middle;
    }
    for(int o = 0; o < 8; ++o)
      if(meets[0][o & 1] && meets[1][o >> 1 & 1] && meets[2][o >> 2])
        visit_leaves(level + 1, child(level, node, o), child(p, o), box, visit);
  }

  template <typename Visitor>
  void visit_leaves_at_face(int level, const Lattice_3::Point& p, int axis, bool positive, const Visitor& visit) const
  {
    const Index c = leaf(level, p);
    if(c != npos) {
      visit(c);
      return;
    }
    for(int o = 0; o < 8; ++o)
      if((o >> axis & 1) == int(positive)) visit_leaves_at_face(level + 1, child(p, o), axis, positive, visit);
  }

  static constexpr int most_levels = 10;
  static constexpr int subdivisions_of_a_leaf = 8; // number of times that a leaf can be split with exact corners

  Cell_complex_3 m_roots;
  int m_max_level = 0;
  std::array<double, most_levels + 2> m_level_width;
  std::vector<Keys> m_split; // split cells of each level
  std::vector<Level> m_levels;
  std::vector<Leaf> m_leaves;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_CELLS_CELL_HIERARCHY_3_H
