// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EXTRACT_LEVEL_SET_H
#define CGAL_BSPLINE_SHELL_3_EXTRACT_LEVEL_SET_H

#include <CGAL/Bspline_shell_3/internal/for_each_chunk.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/assertions.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief what became of a level set. Every value but `SUCCESS` means that no facet was made.
 */
enum class Level_set_status
{
  SUCCESS,
  LEVEL_SET_EMPTY,           ///< the field does not pass the level on the selected cells
  LEVEL_SET_LEAVES_CELLS     ///< the level set reaches a face of a selected cell that has no selected cell behind it
};

/// \ingroup PkgBsplineShell3Ref
/// what is wrong and what can be done about it, in one sentence
inline const char* message(Level_set_status status)
{
  switch(status) {
    case Level_set_status::SUCCESS:
      return "The level set was extracted.";
    case Level_set_status::LEVEL_SET_EMPTY:
      return "The field does not pass the level on the selected cells: choose a level between its least and largest value there.";
    case Level_set_status::LEVEL_SET_LEAVES_CELLS:
      return "The level set runs into the end of the selected cells, so that its mesh would have a border: select all cells that it passes, or widen the band of cells.";
  }
  return "";
}

namespace internal {

// How a cell is cut: n^3 equal subcells, each into the six tetrahedra of the Kuhn decomposition, which go from the
// subcell's least to its largest corner along the axes in one of six orders. All subcells are cut the same way, so that
// tetrahedra on two sides of a face agree. Edges go from a node (corner of a subcell) by 1 along one, two or three
// axes; bit `a` of an edge's direction is set if it advances along axis `a`.
class Kuhn_subdivision
{
public:
  typedef std::array<int, 3> Node;      // in a cell, from 0 to n along each axis

  explicit Kuhn_subdivision(int n) : m_n(n) {}

  int size() const { return m_n; }
  std::size_t number_of_nodes() const { return std::size_t(m_n + 1) * (m_n + 1) * (m_n + 1); }
  std::size_t number(const Node& v) const { return (std::size_t(v[2]) * (m_n + 1) + v[1]) * (m_n + 1) + v[0]; }

  static Node advanced(const Node& v, int direction)
  {
    return { v[0] + (direction & 1), v[1] + ((direction >> 1) & 1), v[2] + ((direction >> 2) & 1) };
  }

  // ascends with the node's number, then the direction
  std::uint32_t edge(const Node& v, int direction) const { return std::uint32_t(8 * number(v) + direction); }

  // calls visit(v) for all nodes up to `last` along each axis, ascending
  template <typename Visitor>
  static void visit_nodes(int last, const Visitor& visit)
  {
    Node v;
    for(v[2] = 0; v[2] <= last; ++v[2])
      for(v[1] = 0; v[1] <= last; ++v[1])
        for(v[0] = 0; v[0] <= last; ++v[0]) visit(v);
  }

  // calls visit(v, direction) for all edges of a cell, ascending
  template <typename Visitor>
  void visit_edges(const Visitor& visit) const
  {
    visit_nodes(m_n, [&](const Node& v) {
      for(int direction = 1; direction < 8; ++direction) {
        const Node w = advanced(v, direction);
        if(w[0] <= m_n && w[1] <= m_n && w[2] <= m_n) visit(v, direction);
      }
    });
  }

  // Calls visit(corner, is_direct) for the six tetrahedra of a subcell: the directions from its least node to the four
  // corners, each a superset of the one before, and whether the tetrahedron is positively oriented.
  template <typename Visitor>
  static void visit_tetrahedra(const Visitor& visit)
  {
    for(int first = 0; first < 3; ++first)
      for(int turn = 1; turn < 3; ++turn) {
        const int a = 1 << first, b = 1 << ((first + turn) % 3);
        visit(std::array<int, 4>{ 0, a, a | b, 7 }, turn == 1);
      }
  }

private:
  int m_n;
};

// The cells that share a face, edge or corner with a cell: the only place that knows that cells are those of a lattice
// and of one size. What several cells have in common, all of them see with the same cells around it in the same order.
template <typename Field>
class Cell_block
{
public:
  typedef typename Field::Cell_index Index;
  typedef Kuhn_subdivision::Node Node;

  Cell_block(const Field& field, Index c, int n) : m_n(n)
  {
    const auto& p = field.cells().lattice_point(c);
    for(int k = 0; k < 3; ++k)
      for(int j = 0; j < 3; ++j)
        for(int i = 0; i < 3; ++i)
          m_cells[9*k + 3*j + i] = field.cells().cell({ p[0] + i - 1, p[1] + j - 1, p[2] + k - 1 });
  }

  // the cell across a face, `Field::npos` if there is none
  Index neighbor(int axis, bool positive) const
  {
    const int stride = axis == 0 ? 1 : axis == 1 ? 3 : 9;
    return m_cells[13 + (positive ? stride : -stride)];
  }

  // calls visit(c, v_in_c) for the cells that contain the nodes v and w (v <= w along each axis), until it returns true
  template <typename Visitor>
  void visit_cells_around(const Node& v, const Node& w, const Visitor& visit) const
  {
    Node first, last, o;
    for(int a = 0; a < 3; ++a) {
      first[a] = w[a] == 0 ? -1 : 0;
      last[a] = v[a] == m_n ? 1 : 0;
    }
    for(o[2] = first[2]; o[2] <= last[2]; ++o[2])
      for(o[1] = first[1]; o[1] <= last[1]; ++o[1])
        for(o[0] = first[0]; o[0] <= last[0]; ++o[0]) {
          const Index c = m_cells[13 + 9*o[2] + 3*o[1] + o[0]];
          if(c == Field::npos) continue;
          if(visit(c, Node{ v[0] - m_n * o[0], v[1] - m_n * o[1], v[2] - m_n * o[2] })) return;
        }
  }

private:
  int m_n;
  std::array<Index, 27> m_cells;
};

// Marching tetrahedra. Cells that the level certainly misses are left out. The topology depends on the nodes' signs
// alone, and these on the node, not on the cell that asks; a node on the level counts as above. So the triangles of
// each tetrahedron fit those of its neighbours, and the surface is a closed manifold unless a tetrahedron has no
// neighbour. Vertices lie on edges. An edge is owned by the first selected cell around it, which numbers its edges
// consecutively: other cells find a vertex by the owner and the edge in it.
template <typename Field>
class Level_set_soup
{
  typedef typename Field::Cell_index Index;
  typedef Kuhn_subdivision::Node Node;

public:
  typedef std::array<double, 3> Point;
  typedef std::array<std::size_t, 3> Triangle;

  template <typename ConcurrencyTag, typename Cell_filter>
  static Level_set_status extract(const Field& field, double level, int n, Cell_filter& filter,
                                  std::vector<Point>& points, std::vector<Triangle>& triangles)
  {
    Level_set_soup soup(field, level, n);
    soup.template find_candidates<ConcurrencyTag>(filter);
    if(soup.template find_vertices<ConcurrencyTag>()) return Level_set_status::LEVEL_SET_LEAVES_CELLS;
    if(soup.m_edges.empty()) return Level_set_status::LEVEL_SET_EMPTY;
    soup.template place_vertices<ConcurrencyTag>(points);
    soup.template make_triangles<ConcurrencyTag>(triangles);
    return Level_set_status::SUCCESS;
  }

private:
  // What is known of a cell: its number among the candidates, the selected cells that the level may pass, or one of
  // these. All of a cell that is `above` (`below`) is proved to be.
  static constexpr Index above = Field::npos, below = Field::npos - 1, not_selected = Field::npos - 2;
  static constexpr std::size_t chunk = 256;

  Level_set_soup(const Field& field, double level, int n) : m_field(field), m_level(level), m_subdivision(n) {}

  static bool is_candidate(Index state) { return state < not_selected; }

  template <typename ConcurrencyTag, typename Cell_filter>
  void find_candidates(Cell_filter& filter)
  {
    m_state.resize(m_field.number_of_cells());
    for_each_chunk<ConcurrencyTag>(m_state.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t c = begin; c < end; ++c) {
        const auto cell = m_field.cell(Index(c));
        const std::pair<double, double> range = cell.coefficient_range();
        // rounding is monotone: what holds for the rounded sums holds for the sums
        m_state[c] = range.first - cell.error_radius() > m_level ? above
                   : range.second + cell.error_radius() < m_level ? below : not_selected;
      }
    });
    for(Index c = 0; c < m_state.size(); ++c)
      if(m_state[c] == not_selected && filter(c)) {
        m_state[c] = Index(m_candidates.size());
        m_candidates.push_back(c);
      }
  }

  // Copies of the polynomials on two sides of a face differ in their last bits, and a copy may contradict what is
  // proved of the other cell. So the sign comes from the first cell around the node of which one is proved, else from
  // the value in the first cell.
  bool is_above(const Cell_block<Field>& block, const Node& v) const
  {
    Index proved = not_selected, first = Field::npos;
    Node v_in_first = v;
    block.visit_cells_around(v, v, [&](Index c, const Node& v_in_c) {
      if(m_state[c] == above || m_state[c] == below) {
        proved = m_state[c];
        return true;
      }
      if(first == Field::npos) { first = c; v_in_first = v_in_c; }
      return false;
    });
    if(proved != not_selected) return proved == above;
    const auto cell = m_field.cell(first);
    return !(cell.value(position(cell, v_in_first)) < m_level);
  }

  bool is_above(std::size_t candidate, const Node& v) const
  {
    return m_is_above[candidate * m_subdivision.number_of_nodes() + m_subdivision.number(v)] != 0;
  }

  // the candidate that owns an edge of a candidate, and the edge in it
  std::pair<Index, std::uint32_t> owner(const Cell_block<Field>& block, const Node& v, int direction) const
  {
    std::pair<Index, std::uint32_t> result;
    block.visit_cells_around(v, Kuhn_subdivision::advanced(v, direction), [&](Index c, const Node& v_in_c) {
      if(!is_candidate(m_state[c])) return false;
      result = { m_state[c], m_subdivision.edge(v_in_c, direction) };
      return true;
    });
    return result;
  }

  // signs, and the edges with a vertex; returns whether the level set leaves the selected cells
  template <typename ConcurrencyTag>
  bool find_vertices()
  {
    const std::size_t size = m_candidates.size();
    std::vector<std::vector<std::uint32_t> > edges((size + chunk - 1) / chunk);
    std::vector<char> leaves(edges.size(), 0);
    m_is_above.resize(size * m_subdivision.number_of_nodes());
    m_first_edge.assign(size + 1, 0);
    for_each_chunk<ConcurrencyTag>(size, chunk, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& own = edges[begin / chunk];
      for(std::size_t n = begin; n < end; ++n) {
        const Cell_block<Field> block(m_field, m_candidates[n], m_subdivision.size());
        char* const signs = &m_is_above[n * m_subdivision.number_of_nodes()];
        m_subdivision.visit_nodes(m_subdivision.size(), [&](const Node& v) {
          signs[m_subdivision.number(v)] = is_above(block, v);
        });
        if(!is_cut(n)) continue;
        const std::size_t before = own.size();
        m_subdivision.visit_edges([&](const Node& v, int direction) {
          const Node w = Kuhn_subdivision::advanced(v, direction);
          if(is_above(n, v) != is_above(n, w) && owner(block, v, direction).first == n)
            own.push_back(m_subdivision.edge(v, direction));
        });
        m_first_edge[n + 1] = own.size() - before;
        if(leaves_at_a_face(block, n)) leaves[begin / chunk] = 1;
      }
    });
    for(std::size_t n = 0; n < size; ++n) m_first_edge[n + 1] += m_first_edge[n];
    m_edges.reserve(m_first_edge.back());
    for(std::vector<std::uint32_t>& own : edges) {
      m_edges.insert(m_edges.end(), own.begin(), own.end());
      std::vector<std::uint32_t>().swap(own);
    }
    return std::find(leaves.begin(), leaves.end(), 1) != leaves.end();
  }

  bool is_cut(std::size_t candidate) const
  {
    const auto begin = m_is_above.begin() + candidate * m_subdivision.number_of_nodes();
    const auto end = begin + m_subdivision.number_of_nodes();
    return std::find(begin, end, char(*begin == 0)) != end;
  }

  // whether there is no candidate behind a face that is cut: one whose nodes have both signs
  bool leaves_at_a_face(const Cell_block<Field>& block, std::size_t candidate) const
  {
    for(int axis = 0; axis < 3; ++axis)
      for(bool positive : { false, true }) {
        const Index c = block.neighbor(axis, positive);
        if(c != Field::npos && is_candidate(m_state[c])) continue;
        bool has[2] = { false, false };
        m_subdivision.visit_nodes(m_subdivision.size(), [&](const Node& v) {
          if(v[axis] == (positive ? m_subdivision.size() : 0)) has[is_above(candidate, v)] = true;
        });
        if(has[0] && has[1]) return true;
      }
    return false;
  }

  template <typename ConcurrencyTag>
  void place_vertices(std::vector<Point>& points) const
  {
    points.resize(m_edges.size());
    for_each_chunk<ConcurrencyTag>(m_candidates.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        if(m_first_edge[n] == m_first_edge[n + 1]) continue;
        std::size_t e = m_first_edge[n];
        m_subdivision.visit_edges([&](const Node& v, int direction) {
          if(e == m_first_edge[n + 1] || m_edges[e] != m_subdivision.edge(v, direction)) return;
          points[e++] = vertex(n, v, direction);
        });
      }
    });
  }

  Point vertex(std::size_t candidate, const Node& v, int direction) const
  {
    const auto cell = m_field.cell(m_candidates[candidate]);
    const Point p = position(cell, v), q = position(cell, Kuhn_subdivision::advanced(v, direction));
    const auto at = [&](double t) {
      return Point{ p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2]) };
    };
    const auto height = [&](double t) { return cell.value(at(t)) - m_level; };
    const double t = root(height, is_above(candidate, v), cell.error_radius());
    // At the ends, the vertices of many edges would coincide. A distance of some thousand roundings of the coordinates
    // keeps all points apart and all triangles from collapsing, whatever the rounding does to the points.
    double reach = 0;
    for(double x : cell.corner()) reach = (std::max)({ reach, std::abs(x), std::abs(x + cell.width()) });
    const double distance = 1024 * std::numeric_limits<double>::epsilon() * reach;
    const double margin = (std::min)(0.25, distance * m_subdivision.size() / cell.width());
    return at((std::min)((std::max)(t, margin), 1 - margin));
  }

  // A zero of f in [0, 1], to within the tolerance on values or to the last bits: regula falsi (Illinois), with a
  // bisection now and then. An end with the wrong sign, or none, is on the level but for rounding: it is the zero.
  template <typename Function>
  static double root(const Function& f, bool is_above_at_0, double tolerance)
  {
    constexpr int max_steps = 120;
    double low = is_above_at_0 ? 1 : 0, high = 1 - low, f_low = f(low), f_high = f(high);
    if(!(f_low < 0)) return low;
    if(!(f_high > 0)) return high;
    int last = 0;
    double t = 0.5;
    for(int step = 1; step <= max_steps; ++step) {
      if(!(std::abs(high - low) > 2 * std::numeric_limits<double>::epsilon())) break;
      t = low + (high - low) * (f_low / (f_low - f_high));
      if(step % 4 == 0 || !((std::min)(low, high) < t && t < (std::max)(low, high))) t = low + (high - low) / 2;
      const double f_t = f(t);
      if(std::abs(f_t) <= tolerance) break;
      if(f_t < 0) {
        low = t;
        f_low = f_t;
        if(last < 0) f_high /= 2;
        last = -1;
      } else {
        high = t;
        f_high = f_t;
        if(last > 0) f_low /= 2;
        last = 1;
      }
    }
    return t;
  }

  template <typename ConcurrencyTag>
  void make_triangles(std::vector<Triangle>& triangles) const
  {
    std::vector<std::vector<Triangle> > parts((m_candidates.size() + chunk - 1) / chunk);
    for_each_chunk<ConcurrencyTag>(m_candidates.size(), chunk, [&](std::size_t begin, std::size_t end) {
      for(std::size_t n = begin; n < end; ++n) {
        if(!is_cut(n)) continue;
        const Cell_block<Field> block(m_field, m_candidates[n], m_subdivision.size());
        m_subdivision.visit_nodes(m_subdivision.size() - 1, [&](const Node& v) {
          m_subdivision.visit_tetrahedra([&](const std::array<int, 4>& corner, bool is_direct) {
            cut_tetrahedron(block, n, v, corner, is_direct, parts[begin / chunk]);
          });
        });
      }
    });
    std::size_t size = 0;
    for(const std::vector<Triangle>& part : parts) size += part.size();
    triangles.reserve(size);
    for(std::vector<Triangle>& part : parts) {
      triangles.insert(triangles.end(), part.begin(), part.end());
      std::vector<Triangle>().swap(part);
    }
  }

  void cut_tetrahedron(const Cell_block<Field>& block, std::size_t candidate, const Node& v,
                       const std::array<int, 4>& corner, bool is_direct, std::vector<Triangle>& triangles) const
  {
    // the corners below, then those above; every swap turns the tetrahedron over
    int order[4], below_count = 0, above_count = 0, above_corner[4];
    for(int i = 0; i < 4; ++i) {
      if(is_above(candidate, Kuhn_subdivision::advanced(v, corner[i]))) {
        above_corner[above_count++] = i;
      } else {
        order[below_count++] = i;
        if(above_count % 2) is_direct = !is_direct;
      }
    }
    if(below_count == 0 || above_count == 0) return;
    std::copy(above_corner, above_corner + above_count, order + below_count);

    const auto crossing = [&](int i, int j) {
      const int x = corner[(std::min)(order[i], order[j])], y = corner[(std::max)(order[i], order[j])];
      return vertex_number(owner(block, Kuhn_subdivision::advanced(v, x), y ^ x));
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if(is_direct) triangles.push_back({ a, b, c });
      else triangles.push_back({ a, c, b });
    };
    if(below_count == 1) {
      add(crossing(0, 1), crossing(0, 2), crossing(0, 3));
    } else if(below_count == 3) {
      add(crossing(0, 3), crossing(1, 3), crossing(2, 3));
    } else {
      const std::size_t a = crossing(0, 2), b = crossing(0, 3), c = crossing(1, 3), d = crossing(1, 2);
      add(a, b, c);
      add(a, c, d);
    }
  }

  std::size_t vertex_number(const std::pair<Index, std::uint32_t>& owned_edge) const
  {
    const auto begin = m_edges.begin() + m_first_edge[owned_edge.first];
    const auto end = m_edges.begin() + m_first_edge[owned_edge.first + 1];
    return std::size_t(std::lower_bound(begin, end, owned_edge.second) - m_edges.begin());
  }

  template <typename Cell>
  Point position(const Cell& cell, const Node& v) const
  {
    Point p = cell.corner();
    for(int a = 0; a < 3; ++a) p[a] += v[a] * cell.width() / m_subdivision.size();
    return p;
  }

  const Field& m_field;
  const double m_level;
  const Kuhn_subdivision m_subdivision;
  std::vector<Index> m_state;                  // per cell
  std::vector<Index> m_candidates;             // their cells, ascending
  std::vector<char> m_is_above;                // per candidate and node
  std::vector<std::uint32_t> m_edges;          // those with a vertex, by owner and ascending: vertex e is on m_edges[e]
  std::vector<std::size_t> m_first_edge;       // per candidate, that of the first edge it owns
};

struct All_cells
{
  template <typename Index>
  bool operator()(Index) const { return true; }
};

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Ref
 *
 * \brief makes a triangle mesh of the level set \f$\{f = level\}\f$ of a field.
 *
 * Each cell is cut into subcells and these into tetrahedra, and each tetrahedron that the level passes gets one or two
 * triangles (*marching tetrahedra*). The mesh is closed and 2-manifold by construction, also where the level set is
 * singular; there it is that of a slightly lower level. It is oriented the way the field grows: what is below the level
 * lies behind the facets. Its vertices lie on the level set up to rounding, but are kept off the ends of the
 * tetrahedra's edges by about a thousand roundings of the coordinates, so that no two coincide. Facets may be as small:
 * write them with all digits. Parts of the level set that lie within one tetrahedron, or closer together, may be missed
 * or joined.
 *
 * \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`; the result is the same
 * \tparam Field a model of `BsplineField_3` with cells of one size
 * \tparam TriangleMesh a model of `MutableFaceGraph`
 * \tparam NamedParameters a sequence of named parameters
 *
 * \param field the field
 * \param level the level, in units of the field
 * \param out the mesh, to which the level set is added; unchanged if there is none to add
 * \param np optional named parameters:
 *   - `filter(F)`: which cells to use, a functor `bool(Field::Cell_index)`; default all. It selects the components of a
 *     level set by the cells that they pass. Pass `std::cref(filter)` not to copy it
 *   - `subdivision_ratio(int)`: subcells along each axis of a cell; default 2
 *   - `vertex_point_map(VPM)`: as in all of \cgal; default `get(CGAL::vertex_point, out)`
 *
 * \return whether there is a mesh, or why not
 * \pre `subdivision_ratio` is at least 1 and at most 256
 * \cgalHeading{Cost} one look at every cell, and time and memory linear in the number of subcells of the cells that the
 * level may pass
 */
template <typename ConcurrencyTag = Sequential_tag,
          typename Field, typename TriangleMesh, typename CGAL_NP_TEMPLATE_PARAMETERS>
Level_set_status extract_level_set(const Field& field, double level, TriangleMesh& out,
                                   const CGAL_NP_CLASS& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using CGAL::parameters::get_parameter_reference;
  typedef internal::Level_set_soup<Field> Soup;
  typedef typename internal_np::Lookup_named_param_def<
    internal_np::filter_t, CGAL_NP_CLASS, internal::All_cells>::reference Cell_filter;

  auto vpm = choose_parameter(get_parameter(np, internal_np::vertex_point), get_property_map(vertex_point, out));
  const int ratio = choose_parameter(get_parameter(np, internal_np::subdivision_ratio), 2);
  internal::All_cells all_cells;
  Cell_filter filter = choose_parameter(get_parameter_reference(np, internal_np::filter), all_cells);
  CGAL_precondition(ratio >= 1 && ratio <= 256);

  std::vector<typename Soup::Point> points;
  std::vector<typename Soup::Triangle> triangles;
  const Level_set_status status =
    Soup::template extract<ConcurrencyTag>(field, level, ratio, filter, points, triangles);
  if(status == Level_set_status::SUCCESS)
    Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, out, CGAL::parameters::default_values(),
                                                          CGAL::parameters::vertex_point_map(vpm));
  return status;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EXTRACT_LEVEL_SET_H
