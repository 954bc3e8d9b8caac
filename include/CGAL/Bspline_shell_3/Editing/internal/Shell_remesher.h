// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SHELL_REMESHER_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SHELL_REMESHER_H

#include <CGAL/Bspline_shell_3/Certificate/Placement_verdict.h>
#include <CGAL/Bspline_shell_3/Editing/Edit_termination.h>
#include <CGAL/Bspline_shell_3/Editing/Remeshing_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Frozen_facets.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Remeshing_tuning.h>
#include <CGAL/Bspline_shell_3/Editing/internal/move_to_level.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/for_each_chunk.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/squared_distance_3.h>
#include <CGAL/property_map.h>

#include <boost/container/static_vector.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Splits, collapses, flips and moves, each only if the oracle accepts all facets that change.
//
// Fans that wind once continue to do so. At a vertex that moves or is new, the oracle counts. At other vertices, one or
// two facets are replaced by one or two, between the same two edges. They turn by less than a full turn before and
// after, and by the same angle up to full turns. (For collapses, see Shell_filter.)
//
// Edges are processed in an order that depends on lengths and, for equal lengths, on the order of the mesh, never on
// addresses.
template <typename TriangleMesh, typename VertexPointMap, typename Oracle, typename Sizing,
          typename EdgeIsConstrainedMap, typename VertexIsConstrainedMap>
class Shell_remesher
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_of_mesh;
  typedef typename Oracle::Point_3 Point;
  typedef typename Kernel_traits<Point>::Kernel::Vector_3 Vector;
  // relative length, and a number that distinguishes equal lengths; 0 if the edge is not in the queue
  typedef std::pair<double, std::size_t> Key;
  typedef std::map<Key, halfedge_descriptor> Queue;

public:
  Shell_remesher(TriangleMesh& mesh, VertexPointMap vpm, const Oracle& oracle, const Sizing& sizing,
                 const Frozen_facets<TriangleMesh>& frozen, EdgeIsConstrainedMap edge_is_constrained,
                 VertexIsConstrainedMap vertex_is_constrained, bool protect_constraints,
                 const std::vector<vertex_descriptor>& old_vertices, std::function<bool()> go_on,
                 Remeshing_report& report)
    : m_mesh(mesh), m_vpm(vpm), m_oracle(oracle), m_sizing(sizing), m_frozen(frozen),
      m_edge_is_constrained(edge_is_constrained), m_vertex_is_constrained(vertex_is_constrained),
      m_protect_constraints(protect_constraints), m_go_on(std::move(go_on)), m_report(report),
      m_key(get(dynamic_edge_property_t<Key>(), mesh)), m_first_old(get(dynamic_vertex_property_t<std::size_t>(), mesh))
  {
    for(vertex_descriptor v : vertices(mesh)) put(m_first_old, v, none);
    for(vertex_descriptor v : old_vertices) {
      put(m_first_old, v, m_next_old.size());
      m_next_old.push_back(m_next_old.size());
    }
  }

  // Once the remesher is stopped, by the caller or by `go_on`, no pass changes anything.
  void stop() { m_goes_on = false; }
  bool goes_on() const { return m_goes_on; }

  // Returns the vertices into which the old vertices were collapsed.
  std::vector<vertex_descriptor> images() const
  {
    std::vector<vertex_descriptor> result(m_next_old.size());
    for(vertex_descriptor v : vertices(m_mesh)) {
      const std::size_t first = get(m_first_old, v);
      if(first == none) continue;
      std::size_t n = first;
      do {
        result[n] = v;
        n = m_next_old[n];
      } while(n != first);
    }
    return result;
  }

  void split_long_edges()
  {
    m_rejected_before = m_report.placements.rejected(); // the splits and collapses of an iteration begin here
    Queue queue;
    const auto add = [&](halfedge_descriptor h) {
      const edge_descriptor e = edge(h, m_mesh);
      if(m_frozen.has_edge(e) || (m_protect_constraints && get(m_edge_is_constrained, e))) return;
      const double length = relative_length(h);
      if(length > remeshing_tuning.longest) insert(queue, -length, h);
    };
    for(edge_descriptor e : edges(m_mesh)) add(halfedge(e, m_mesh));
    while(!queue.empty() && asks_to_go_on()) {
      const halfedge_descriptor h = queue.begin()->second;
      queue.erase(queue.begin());
      if(const vertex_descriptor v = split(h); v != Graph_traits::null_vertex())
        for(halfedge_descriptor g : CGAL::halfedges_around_target(v, m_mesh)) add(g);
    }
  }

  void collapse_short_edges()
  {
    Queue queue;
    const auto add = [&](halfedge_descriptor h) {
      const edge_descriptor e = edge(h, m_mesh);
      remove(queue, e);
      if(m_frozen.has_end_of(e) || m_frozen.has_edge(e) || (m_protect_constraints && get(m_edge_is_constrained, e)))
        return;
      const double length = relative_length(h);
      if(length < remeshing_tuning.shortest) insert(queue, length, h);
    };
    for(edge_descriptor e : edges(m_mesh)) put(m_key, e, Key());
    for(edge_descriptor e : edges(m_mesh)) add(halfedge(e, m_mesh));
    while(!queue.empty() && asks_to_go_on()) {
      halfedge_descriptor h = queue.begin()->second;
      queue.erase(queue.begin());
      put(m_key, edge(h, m_mesh), Key());
      // With the edge, one of the two other edges of each of its facets vanishes.
      const std::array<edge_descriptor, 4> sides = { { edge(next(h, m_mesh), m_mesh), edge(prev(h, m_mesh), m_mesh),
                                                       edge(next(opposite(h, m_mesh), m_mesh), m_mesh),
                                                       edge(prev(opposite(h, m_mesh), m_mesh), m_mesh) } };
      Point p;
      if(!find_place_to_collapse_to(h, p)) continue;
      for(edge_descriptor e : sides) remove(queue, e);
      const vertex_descriptor v = collapse(h, p);
      for(halfedge_descriptor g : CGAL::halfedges_around_target(v, m_mesh)) add(g);
    }
  }

  // Returns the reason why edges differ from the target length.
  Edit_termination end() const
  {
    const auto is_about_right = [&](edge_descriptor e) {
      const double length = relative_length(halfedge(e, m_mesh));
      return m_frozen.has_edge(e) || (length >= remeshing_tuning.shortest && length <= remeshing_tuning.longest);
    };
    if(std::all_of(edges(m_mesh).begin(), edges(m_mesh).end(), is_about_right)) return Edit_termination::TARGET;
    if(!m_goes_on) return Edit_termination::VISITOR;
    return m_has_rejected ? Edit_termination::SHELL : Edit_termination::ITERATIONS;
  }

  void flip_to_regular_valences()
  {
    m_has_rejected = m_report.placements.rejected() > m_rejected_before;
    const auto deviation = [&](vertex_descriptor v, int change) {
      return std::abs(int(degree(v, m_mesh)) + change - 6);
    };
    for(edge_descriptor e : edges(m_mesh)) {
      if(!asks_to_go_on()) return;
      const Quadrilateral q(halfedge(e, m_mesh), m_mesh);
      const int before = deviation(q.a, 0) + deviation(q.b, 0) + deviation(q.c, 0) + deviation(q.d, 0);
      const int after = deviation(q.a, -1) + deviation(q.b, -1) + deviation(q.c, 1) + deviation(q.d, 1);
      if(after < before) flip(halfedge(e, m_mesh), q, (std::min)(quality_before(q), remeshing_tuning.regular_quality));
    }
  }

  // Repeats passes until no edge is flipped, or up to a limit, when passes change almost nothing.
  void flip_to_larger_angles()
  {
    for(int pass = 0; pass < remeshing_tuning.max_flip_passes; ++pass) {
      std::size_t flipped = 0;
      for(edge_descriptor e : edges(m_mesh)) {
        if(!asks_to_go_on()) return;
        const Quadrilateral q(halfedge(e, m_mesh), m_mesh);
        flipped += flip(halfedge(e, m_mesh), q, remeshing_tuning.least_gain * quality_before(q));
      }
      if(flipped == 0) return;
    }
  }

  // Moves vertices towards the centroids of their facets, within the tangent plane. Vertices on sharp edges move only
  // along these, and corners do not move. Then `project` may change the position. Vertices without a common edge are
  // moved concurrently.
  template <typename ConcurrencyTag, typename Projection>
  void relax(const Projection& project)
  {
    constexpr std::size_t chunk = 64;
    for(const std::vector<vertex_descriptor>& independent : independent_vertices()) {
      if(!asks_to_go_on()) return;
      std::vector<Move> moves(independent.size());
      for_each_chunk<ConcurrencyTag>(independent.size(), chunk, [&](std::size_t begin, std::size_t end) {
        Link link;
        for(std::size_t n = begin; n < end; ++n) {
          find_link(independent[n], link);
          moves[n] = find_move(point(independent[n]), link, project);
        }
      });
      for(std::size_t n = 0; n < moves.size(); ++n) {
        for(Placement_verdict verdict : moves[n].verdicts) count(verdict);
        if(moves[n].verdicts.empty() || moves[n].verdicts.back() != Placement_verdict::ACCEPTED) continue;
        set_point(independent[n], moves[n].place);
        ++m_report.moves;
      }
    }
  }

private:
  bool asks_to_go_on()
  {
    m_goes_on = m_goes_on && m_go_on();
    return m_goes_on;
  }

  typedef std::vector<Point> Link;

  // The verdicts on the positions that were tried for a vertex, and the last position, which may have been accepted.
  struct Move
  {
    boost::container::static_vector<Placement_verdict, 3> verdicts;
    Point place;
  };

  // The facets (a, b, c) and (b, a, d) at a halfedge from a to b.
  struct Quadrilateral
  {
    Quadrilateral(halfedge_descriptor h, const TriangleMesh& mesh)
      : a(source(h, mesh)), b(target(h, mesh)), c(target(next(h, mesh), mesh)),
        d(target(next(opposite(h, mesh), mesh), mesh))
    {}
    vertex_descriptor a, b, c, d;
  };

  static constexpr std::array<double, 3> parts_of_moves = { { 1, 0.5, 0.25 } }; // fractions of a move that are tried

  // Returns a reference or a point, depending on the map.
  decltype(auto) point(vertex_descriptor v) const { return converted<Point>(get(m_vpm, v)); }
  void set_point(vertex_descriptor v, const Point& p) { put(m_vpm, v, converted<Point_of_mesh>(p)); }

  double relative_length(halfedge_descriptor h) const
  {
    const Point &p = point(source(h, m_mesh)), &q = point(target(h, m_mesh));
    return std::sqrt(CGAL::squared_distance(p, q)) / m_sizing(CGAL::midpoint(p, q));
  }

  void insert(Queue& queue, double priority, halfedge_descriptor h)
  {
    const Key key(priority, ++m_serial);
    queue.emplace(key, h);
    put(m_key, edge(h, m_mesh), key);
  }

  void remove(Queue& queue, edge_descriptor e)
  {
    const Key key = get(m_key, e);
    if(key.second == 0) return;
    queue.erase(key);
    put(m_key, e, Key());
  }

  static constexpr bool has_constrained_edges =
    !std::is_same<EdgeIsConstrainedMap, Static_boolean_property_map<edge_descriptor, false> >::value;

  std::size_t number_of_constrained_edges(vertex_descriptor v) const
  {
    std::size_t number = 0;
    if constexpr(has_constrained_edges)
      for(halfedge_descriptor h : CGAL::halfedges_around_target(v, m_mesh))
        if(get(m_edge_is_constrained, edge(h, m_mesh))) ++number;
    return number;
  }
  bool is_fixed(vertex_descriptor v) const
  {
    return m_frozen.has_vertex(v) || m_frozen.is_fixed(v) || get(m_vertex_is_constrained, v)
           || number_of_constrained_edges(v) > 0;
  }
  // Returns whether constrained edges pass through a vertex, so that it may vanish with one of them.
  bool is_passed(vertex_descriptor v) const
  {
    return !m_protect_constraints && !m_frozen.is_fixed(v) && !get(m_vertex_is_constrained, v)
           && number_of_constrained_edges(v) == 2;
  }

  // Returns twice the inradius divided by the circumradius.
  static double quality(const Point& p, const Point& q, const Point& r)
  {
    const double a = std::sqrt(CGAL::squared_distance(q, r)), b = std::sqrt(CGAL::squared_distance(r, p)),
                 c = std::sqrt(CGAL::squared_distance(p, q));
    const double denominator = (a + b + c) * a * b * c;
    return denominator > 0 ? 4 * CGAL::cross_product(q - p, r - p).squared_length() / denominator : 0;
  }

  double quality_before(const Quadrilateral& q) const
  {
    return (std::min)(quality(point(q.a), point(q.b), point(q.c)), quality(point(q.b), point(q.a), point(q.d)));
  }

  // Returns the worst quality of the facets (p, link[n], link[n+1]).
  static double quality_of_star(const Point& p, const Link& link)
  {
    double least = 1;
    for(std::size_t n = 0; n < link.size(); ++n)
      least = (std::min)(least, quality(p, link[n], link[(n + 1) % link.size()]));
    return least;
  }

  // Returns the worst quality of the facets at the ends of an edge, except for its own two facets.
  double quality_around(halfedge_descriptor h) const
  {
    double least = 1;
    for(halfedge_descriptor end : { h, opposite(h, m_mesh) })
      for(halfedge_descriptor g = turn(end); turn(g) != end; g = turn(g))
        least = (std::min)(least,
                           quality(point(target(g, m_mesh)), point(source(g, m_mesh)), point(source(turn(g), m_mesh))));
    return least;
  }

  Placement_verdict count(Placement_verdict verdict)
  {
    ++m_report.placements.by_verdict[std::size_t(verdict)];
    return verdict;
  }
  Placement_verdict judge(const Point& p)
  {
    typename Oracle::Memory none;
    return count(m_oracle(p, m_link, none));
  }

  // Returns the next halfedge to the same target, in the direction in which facets turn.
  halfedge_descriptor turn(halfedge_descriptor h) const { return prev(opposite(h, m_mesh), m_mesh); }

  void find_link(vertex_descriptor v, Link& link) const
  {
    link.clear();
    const halfedge_descriptor first = halfedge(v, m_mesh);
    halfedge_descriptor h = first;
    do {
      link.push_back(point(source(h, m_mesh)));
      h = turn(h);
    } while(h != first);
  }

  // Finds the link of an edge: the remaining parts of the links of its ends.
  void find_link(halfedge_descriptor h)
  {
    m_link.clear();
    for(halfedge_descriptor end : { h, opposite(h, m_mesh) })
      for(halfedge_descriptor g = turn(end); turn(g) != end; g = turn(g)) m_link.push_back(point(source(g, m_mesh)));
  }

  // The oracle limits its effort for a whole star, and large facets may need more. Four facets around a vertex, less
  // than half a turn each, wind once in any case.
  bool may_split_at(const Point& p)
  {
    if(judge(p) == Placement_verdict::ACCEPTED) return true;
    for(std::size_t n = 0; n < m_link.size(); ++n)
      if(count(m_oracle(p, m_link[n], m_link[(n + 1) % m_link.size()])) != Placement_verdict::ACCEPTED) return false;
    return true;
  }

  vertex_descriptor split(halfedge_descriptor h)
  {
    const Quadrilateral q(h, m_mesh);
    const bool is_constrained = get(m_edge_is_constrained, edge(h, m_mesh));
    m_link = { point(q.b), point(q.c), point(q.a), point(q.d) };
    Point p = CGAL::midpoint(point(q.a), point(q.b));
    // If the longest edge of a facet must not be split, splits of its other edges may create new edges that are no
    // shorter, forever.
    const double longest_new = (std::max)(CGAL::squared_distance(p, point(q.c)), CGAL::squared_distance(p, point(q.d)));
    if(longest_new > remeshing_tuning.largest_new_edge * remeshing_tuning.largest_new_edge
                       * CGAL::squared_distance(point(q.a), point(q.b)))
      return Graph_traits::null_vertex();
    // The midpoint is rounded, and rounding may move it out of a thin shell.
    if(!may_split_at(p)) {
      const auto moved = move_to_mean_level(m_oracle.shell().field(), p, point(q.a), point(q.b));
      if(is_constrained || !moved || !may_split_at(*moved)) return Graph_traits::null_vertex();
      p = *moved;
    }
    const halfedge_descriptor half = Euler::split_edge(h, m_mesh);
    const vertex_descriptor v = target(half, m_mesh);
    set_point(v, p);
    put(m_first_old, v, none);
    // New edges may have any value in a map until it is set.
    set_constrained(edge(half, m_mesh), is_constrained);
    set_constrained(edge(Euler::split_face(half, next(h, m_mesh), m_mesh), m_mesh), false);
    set_constrained(edge(Euler::split_face(opposite(h, m_mesh), next(opposite(half, m_mesh), m_mesh), m_mesh), m_mesh),
                    false);
    ++m_report.splits;
    return v;
  }

  void set_constrained(edge_descriptor e, bool value)
  {
    if constexpr(has_constrained_edges) put(m_edge_is_constrained, e, value);
  }

  // Returns how sharp the mesh is at a vertex: 1 minus the length of the mean normal of its facets.
  double sharpness(vertex_descriptor v) const
  {
    Vector sum(0, 0, 0);
    double facets = 0;
    for(halfedge_descriptor h : CGAL::halfedges_around_target(v, m_mesh)) {
      const Vector n = unit_normal(point(source(h, m_mesh)), point(v), point(target(next(h, m_mesh), m_mesh)));
      sum = sum + n;
      facets += 1;
    }
    return 1 - std::sqrt(sum.squared_length()) / facets;
  }

  static Vector unit_normal(const Point& p, const Point& q, const Point& r)
  {
    const Vector n = CGAL::cross_product(q - p, r - p);
    const double length = std::sqrt(n.squared_length());
    return length > 0 ? n / length : n;
  }

  // Finds the position for a collapse of the edge: the end where the mesh is sharper, the other end, or the midpoint.
  // The halfedge is reversed if necessary, so that its target is the vertex to keep.
  bool find_place_to_collapse_to(halfedge_descriptor& h, Point& p)
  {
    if(!Euler::does_satisfy_link_condition(edge(h, m_mesh), m_mesh)) return false;
    const bool is_constrained = get(m_edge_is_constrained, edge(h, m_mesh));
    const auto must_stay = [&](vertex_descriptor v) { return is_constrained ? !is_passed(v) : is_fixed(v); };
    const bool is_source_fixed = must_stay(source(h, m_mesh)), is_target_fixed = must_stay(target(h, m_mesh));
    if(is_source_fixed && is_target_fixed) return false;
    if(is_source_fixed || (!is_target_fixed && sharpness(source(h, m_mesh)) > sharpness(target(h, m_mesh))))
      h = opposite(h, m_mesh);
    // Two sides of a facet become one: at most one of them may be constrained.
    for(halfedge_descriptor g : { h, opposite(h, m_mesh) })
      if(get(m_edge_is_constrained, edge(next(g, m_mesh), m_mesh))
         && get(m_edge_is_constrained, edge(prev(g, m_mesh), m_mesh)))
        return false;
    // Euler::collapse_edge() keeps the target of the edge's halfedge, which must therefore be `h`.
    if(halfedge(edge(h, m_mesh), m_mesh) != h) return false;
    find_link(h);
    const Point &a = point(source(h, m_mesh)), &b = point(target(h, m_mesh));
    const std::array<Point, 3> places = { { b, a, CGAL::midpoint(a, b) } };
    const std::size_t number = is_source_fixed || is_target_fixed || is_constrained ? 1 : places.size();
    const double before = (std::min)(quality_around(h), remeshing_tuning.regular_quality);
    for(std::size_t n = 0; n < number; ++n) {
      const bool is_short = std::all_of(m_link.begin(), m_link.end(), [&](const Point& q) {
        return std::sqrt(CGAL::squared_distance(places[n], q))
               <= remeshing_tuning.longest * m_sizing(CGAL::midpoint(places[n], q));
      });
      if(is_short && quality_of_star(places[n], m_link) >= before && judge(places[n]) == Placement_verdict::ACCEPTED) {
        p = places[n];
        return true;
      }
    }
    return false;
  }

  vertex_descriptor collapse(halfedge_descriptor h, const Point& p)
  {
    set_constrained(edge(h, m_mesh), false);
    join_old_vertices(source(h, m_mesh), target(h, m_mesh));
    const vertex_descriptor v = Euler::collapse_edge(edge(h, m_mesh), m_mesh, m_edge_is_constrained);
    set_point(v, p);
    ++m_report.collapses;
    return v;
  }

  // Old vertices with the same image form a ring. Two rings are joined by exchanging the successors of two vertices.
  void join_old_vertices(vertex_descriptor removed, vertex_descriptor kept)
  {
    const std::size_t from = get(m_first_old, removed), to = get(m_first_old, kept);
    if(from == none) return;
    if(to == none) put(m_first_old, kept, from);
    else std::swap(m_next_old[from], m_next_old[to]);
  }

  // Flips an edge if the facets become better than `least`.
  bool flip(halfedge_descriptor h, const Quadrilateral& q, double least)
  {
    if(m_frozen.has_edge(edge(h, m_mesh)) || get(m_edge_is_constrained, edge(h, m_mesh)) || degree(q.a, m_mesh) <= 3
       || degree(q.b, m_mesh) <= 3 || halfedge(q.c, q.d, m_mesh).second)
      return false;
    const Point &a = point(q.a), &b = point(q.b), &c = point(q.c), &d = point(q.d);
    if(!((std::min)(quality(a, d, c), quality(d, b, c)) > least)) return false;
    // Sharp edges remain, and no facets are created across them.
    if(unit_normal(a, b, c) * unit_normal(b, a, d) < remeshing_tuning.least_cosine) return false;
    for(const auto& facet : { std::array<Point, 3>{ { a, d, c } }, std::array<Point, 3>{ { d, b, c } } })
      if(count(m_oracle(facet[0], facet[1], facet[2])) != Placement_verdict::ACCEPTED) return false;
    Euler::flip_edge(h, m_mesh);
    ++m_report.flips;
    return true;
  }

  // Returns the vertices that may move, in classes without edges within a class. Each vertex is in the first class that
  // contains none of its neighbors.
  std::vector<std::vector<vertex_descriptor> > independent_vertices() const
  {
    std::vector<std::vector<vertex_descriptor> > classes;
    const auto class_of = get(dynamic_vertex_property_t<std::size_t>(), m_mesh);
    for(vertex_descriptor v : vertices(m_mesh)) put(class_of, v, none);
    std::vector<char> is_taken;
    for(vertex_descriptor v : vertices(m_mesh)) {
      if(halfedge(v, m_mesh) == Graph_traits::null_halfedge() || is_fixed(v)) continue;
      is_taken.assign(classes.size() + 1, 0);
      for(halfedge_descriptor h : CGAL::halfedges_around_target(v, m_mesh))
        if(const std::size_t c = get(class_of, source(h, m_mesh)); c != none) is_taken[c] = 1;
      const std::size_t c = std::size_t(std::find(is_taken.begin(), is_taken.end(), 0) - is_taken.begin());
      if(c == classes.size()) classes.emplace_back();
      classes[c].push_back(v);
      put(class_of, v, c);
    }
    return classes;
  }

  // Returns the first of several fractions of a vertex's move after which its facets are good.
  template <typename Projection>
  Move find_move(const Point& p, const Link& link, const Projection& project) const
  {
    Move found;
    const Vector move = tangential_move(p, link);
    const double before = (std::min)(quality_of_star(p, link), remeshing_tuning.good_quality);
    for(double part : parts_of_moves) {
      found.place = project(p + part * move);
      if(found.place == p || !(quality_of_star(found.place, link) >= before)) continue;
      typename Oracle::Memory none;
      found.verdicts.push_back(m_oracle(found.place, link, none));
      if(found.verdicts.back() == Placement_verdict::ACCEPTED) break;
    }
    return found;
  }

  static Vector tangential_move(const Point& p, const Link& link)
  {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double area = 0;
    for(std::size_t n = 0; n < link.size(); ++n) {
      const Vector u = link[n] - p, v = link[(n + 1) % link.size()] - p, normal = CGAL::cross_product(u, v);
      const double a = std::sqrt(normal.squared_length());
      if(!(a > 0)) continue;
      const Eigen::Vector3d e(normal.x(), normal.y(), normal.z());
      tensor += e * e.transpose() / a;
      center += a / 3 * Eigen::Vector3d(u.x() + v.x(), u.y() + v.y(), u.z() + v.z());
      area += a;
    }
    if(!(area > 0)) return NULL_VECTOR;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(tensor / area);
    // Directions without normals: two on a smooth surface, one along an edge, none at a corner.
    Eigen::Vector3d move = Eigen::Vector3d::Zero();
    for(int i = 0; i < 2; ++i)
      if(eigen.eigenvalues()[i] < remeshing_tuning.crease)
        move += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).dot(center / area);
    return Vector(move[0], move[1], move[2]);
  }

  static constexpr std::size_t none = std::size_t(-1);

  TriangleMesh& m_mesh;
  VertexPointMap m_vpm;
  const Oracle& m_oracle;
  const Sizing& m_sizing;
  const Frozen_facets<TriangleMesh>& m_frozen;
  EdgeIsConstrainedMap m_edge_is_constrained;
  VertexIsConstrainedMap m_vertex_is_constrained;
  bool m_protect_constraints;
  std::function<bool()> m_go_on;
  bool m_goes_on = true;
  Remeshing_report& m_report;
  typename boost::property_map<TriangleMesh, dynamic_edge_property_t<Key> >::type m_key;
  std::size_t m_serial = 0;
  std::size_t m_rejected_before = 0;
  bool m_has_rejected = false; // whether the oracle rejected a split or a collapse in the last iteration
  // rings of the original vertices, by number: for each vertex, the first one of its ring, and for each of them the
  // next one
  typename boost::property_map<TriangleMesh, dynamic_vertex_property_t<std::size_t> >::type m_first_old;
  std::vector<std::size_t> m_next_old;
  Link m_link;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_SHELL_REMESHER_H
