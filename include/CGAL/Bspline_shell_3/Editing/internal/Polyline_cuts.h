// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_POLYLINE_CUTS_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_POLYLINE_CUTS_H

#include <CGAL/Bspline_shell_3/Editing/Cut_report.h>
#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>
#include <CGAL/Bspline_shell_3/Editing/internal/triangulate_cut_facet.h>
#include <CGAL/Bspline_shell_3/Mesh/common_facet.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The cuts of a mesh along polylines. add() collects them, triangulate() computes the new facets, and apply() replaces
// facets. Only apply() changes the mesh.
template <typename TriangleMesh, typename VertexPointMap>
class Polyline_cuts
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::edge_descriptor edge_descriptor;
  typedef typename Graph_traits::face_descriptor face_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;
  typedef Cut_facet_triangulation::Weights Weights;
  static constexpr std::size_t none = std::size_t(-1);

public:
  typedef std::pair<face_descriptor, std::array<double, 3> > Location;

  // pre: the mesh is a triangle mesh
  Polyline_cuts(TriangleMesh& mesh, VertexPointMap vpm)
    : m_mesh(mesh), m_vpm(vpm), m_node(get(dynamic_vertex_property_t<std::size_t>(), mesh)),
      m_cut_edge(get(dynamic_edge_property_t<std::size_t>(), mesh)),
      m_cut_facet(get(dynamic_face_property_t<std::size_t>(), mesh))
  {
    for(auto v : vertices(mesh)) put(m_node, v, none);
    for(auto e : edges(mesh)) put(m_cut_edge, e, none);
    for(auto f : faces(mesh)) put(m_cut_facet, f, none);
  }

  // Adds a polyline. Sets `vertex` to the first vertex where this fails.
  template <typename LocationRange>
  Cut_status add(const LocationRange& polyline, std::size_t& vertex)
  {
    vertex = 0;
    Location previous(Graph_traits::null_face(), {});
    for(const Location& given : polyline) {
      Location location = given;
      if(!normalize(location)) return Cut_status::INVALID_LOCATION;
      node(location);
      if(vertex > 0) {
        Location a = previous, b = location;
        if(!move_to_common_facet(m_mesh, a, b)) {
          --vertex;
          return Cut_status::NO_COMMON_FACET;
        }
        add_chord(a, b);
      }
      previous = location;
      ++vertex;
    }
    return Cut_status::SUCCESS;
  }

  // Computes the new facets, and checks that they face in the same direction as the facets that they replace.
  Cut_status triangulate()
  {
    for(const Cut_edge& e : m_edges) {
      if(e.nodes.empty()) continue;
      for(auto h : { e.halfedge, opposite(e.halfedge, m_mesh) })
        if(face(h, m_mesh) != Graph_traits::null_face()) cut_facet(face(h, m_mesh));
    }
    for(Cut_facet& f : m_facets)
      if(!triangulate(f)) return Cut_status::FACET_TURNS;
    return Cut_status::SUCCESS;
  }

  // Replaces the facets, and marks the edges on polylines.
  void apply(Edge_constraints<TriangleMesh> marks, Cut_report& report)
  {
    for(const Cut_edge& e : m_edges) split(e, marks, report);
    for(const Cut_facet& f : m_facets) replace(f, marks, report);
    report.cut_facets = m_facets.size();
    report.crossings = m_crossings;
  }

private:
  struct Node
  {
    vertex_descriptor vertex; // null before it is created
    Point point;
  };
  // An edge with vertices of polylines, or with segments of them that run along it. Positions are the barycentric
  // coordinates of the target of `halfedge`, which is either one of the edge.
  struct Cut_edge
  {
    halfedge_descriptor halfedge;
    std::map<double, std::size_t> nodes;              // numbers, by position
    std::vector<std::pair<double, double> > segments; // positions of their ends
  };
  struct Cut_facet
  {
    face_descriptor facet;
    std::map<Weights, std::size_t> inside; // nodes inside the facet
    std::vector<std::pair<std::size_t, std::size_t> > chords;
    std::vector<std::array<std::size_t, 3> > triangles;
    std::vector<std::pair<std::size_t, std::size_t> > chord_parts;
  };

  // Makes the sum of the coordinates of a point on an edge exactly one. Returns whether the location is valid.
  static bool normalize(Location& location)
  {
    constexpr double largest_error = 1e-9; // limits the sum's difference from 1
    Weights& w = location.second;
    double sum = 0;
    for(double x : w) {
      if(!(x >= 0)) return false;
      sum += x;
    }
    if(location.first == Graph_traits::null_face() || !(std::abs(sum - 1) <= largest_error)) return false;
    const std::size_t largest = std::size_t(std::max_element(w.begin(), w.end()) - w.begin());
    if(std::count(w.begin(), w.end(), 0.) == 2) w[largest] = 1;
    if(std::count(w.begin(), w.end(), 0.) == 1)
      for(std::size_t i = 0; i < 3; ++i)
        if(i != largest && w[i] != 0) {
          if(w[largest] + w[i] != 1) w[largest] /= sum;
          w[i] = 1 - w[largest]; // exact, because the largest coordinate is at least 1/2
        }
    return true;
  }

  std::size_t add_node(vertex_descriptor v, const Point& p)
  {
    m_nodes.push_back({ v, p });
    return m_nodes.size() - 1;
  }

  std::size_t node_of(vertex_descriptor v)
  {
    if(get(m_node, v) == none) put(m_node, v, add_node(v, get(m_vpm, v)));
    return get(m_node, v);
  }

  Cut_edge& cut_edge(halfedge_descriptor h)
  {
    const auto e = edge(h, m_mesh);
    if(get(m_cut_edge, e) == none) {
      put(m_cut_edge, e, m_edges.size());
      m_edges.push_back({ h, {}, {} });
    }
    return m_edges[get(m_cut_edge, e)];
  }

  Cut_facet& cut_facet(face_descriptor f)
  {
    if(get(m_cut_facet, f) == none) {
      put(m_cut_facet, f, m_facets.size());
      m_facets.push_back({ f, {}, {}, {}, {} });
    }
    return m_facets[get(m_cut_facet, f)];
  }

  // Returns the point with these coordinates. For a point on an edge, it is the same in both facets.
  Point point(face_descriptor f, const Weights& w) const
  {
    std::array<double, 3> p = {};
    auto h = halfedge(f, m_mesh);
    for(std::size_t i = 0; i < 3; ++i, h = next(h, m_mesh)) {
      const Point& v = get(m_vpm, source(h, m_mesh));
      for(int k = 0; k < 3; ++k) p[std::size_t(k)] += w[i] * v[k];
    }
    return Point(p[0], p[1], p[2]);
  }

  // Returns the position on an edge of a location on it that is given in the facet of `h`, a halfedge of the edge.
  double position(const Cut_edge& cut, halfedge_descriptor h, const Weights& w) const
  {
    const int i = corner_at_source(m_mesh, h);
    return w[std::size_t(h == cut.halfedge ? (i + 1) % 3 : i)];
  }

  // Returns the number of the node at a normalized location, which may be new.
  std::size_t node(const Location& location)
  {
    const Weights& w = location.second;
    const auto zeros = std::count(w.begin(), w.end(), 0.);
    if(zeros == 2) {
      const int corner = int(std::max_element(w.begin(), w.end()) - w.begin());
      return node_of(source(halfedge_at_corner(m_mesh, location.first, corner), m_mesh));
    }
    if(zeros == 1) {
      const int i = (int(std::find(w.begin(), w.end(), 0.) - w.begin()) + 1) % 3;
      const auto h = halfedge_at_corner(m_mesh, location.first, i);
      Cut_edge& cut = cut_edge(h);
      return find_or_add(cut.nodes, position(cut, h, w), location);
    }
    return find_or_add(cut_facet(location.first).inside, w, location);
  }

  template <typename Position>
  std::size_t find_or_add(std::map<Position, std::size_t>& nodes, const Position& at, const Location& location)
  {
    const auto found = nodes.find(at);
    if(found != nodes.end()) return found->second;
    return nodes[at] = add_node(Graph_traits::null_vertex(), point(location.first, location.second));
  }

  // pre: the locations are in the same facet
  void add_chord(const Location& a, const Location& b)
  {
    const std::size_t first = node(a), last = node(b);
    if(first == last) return;
    for(std::size_t i = 0; i < 3; ++i)
      if(a.second[i] == 0 && b.second[i] == 0) {
        const auto h = halfedge_at_corner(m_mesh, a.first, int(i + 1) % 3);
        Cut_edge& cut = cut_edge(h);
        const double p = position(cut, h, a.second), q = position(cut, h, b.second);
        cut.segments.emplace_back((std::min)(p, q), (std::max)(p, q));
        return;
      }
    cut_facet(a.first).chords.emplace_back(first, last);
  }

  bool triangulate(Cut_facet& f)
  {
    std::vector<Weights> points;
    std::vector<std::size_t> nodes;
    std::array<double, 3> lengths;
    std::array<Point, 3> corners;
    auto h = halfedge(f.facet, m_mesh);
    for(std::size_t i = 0; i < 3; ++i, h = next(h, m_mesh)) {
      corners[i] = get(m_vpm, source(h, m_mesh));
      lengths[i] = std::sqrt(CGAL::squared_distance(corners[i], get(m_vpm, target(h, m_mesh))));
      points.push_back({});
      points.back()[i] = 1;
      nodes.push_back(node_of(source(h, m_mesh)));
    }
    for(std::size_t i = 0; i < 3; ++i, h = next(h, m_mesh)) {
      if(get(m_cut_edge, edge(h, m_mesh)) == none) continue;
      const Cut_edge& cut = m_edges[get(m_cut_edge, edge(h, m_mesh))];
      const bool is_along = h == cut.halfedge;
      for(const auto& n : cut.nodes) {
        points.push_back({});
        points.back()[is_along ? (i + 1) % 3 : i] = n.first;
        points.back()[is_along ? i : (i + 1) % 3] = 1 - n.first; // exact
        nodes.push_back(n.second);
      }
    }
    for(const auto& n : f.inside) {
      points.push_back(n.first);
      nodes.push_back(n.second);
    }
    std::map<std::size_t, std::size_t> number;
    for(std::size_t n = 0; n < nodes.size(); ++n) number[nodes[n]] = n;
    std::vector<std::pair<std::size_t, std::size_t> > chords;
    for(const auto& chord : f.chords) chords.emplace_back(number.at(chord.first), number.at(chord.second));
    const Cut_facet_triangulation triangulation = triangulate_cut_facet(lengths, points, chords);
    for(const Weights& w : triangulation.crossings) {
      nodes.push_back(add_node(Graph_traits::null_vertex(), point(f.facet, w)));
      f.inside[w] = nodes.back();
    }
    m_crossings += triangulation.crossings.size();
    for(const auto& t : triangulation.triangles) f.triangles.push_back({ nodes[t[0]], nodes[t[1]], nodes[t[2]] });
    for(const auto& e : triangulation.chord_parts) f.chord_parts.emplace_back(nodes[e.first], nodes[e.second]);
    return !f.triangles.empty() && keeps_orientation(f, corners);
  }

  // Returns whether the new triangles are oriented as the facet in the projection along the axis nearest to its normal.
  bool keeps_orientation(const Cut_facet& f, const std::array<Point, 3>& corners) const
  {
    typedef Exact_predicates_inexact_constructions_kernel Kernel;
    const auto normal = CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
    int axis = 0;
    for(int k = 1; k < 3; ++k)
      if(std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    const auto orientation = [&](const Point& p, const Point& q, const Point& r) {
      const auto flat = [&](const Point& x) { return Kernel::Point_2(x[(axis + 1) % 3], x[(axis + 2) % 3]); };
      return CGAL::orientation(flat(p), flat(q), flat(r));
    };
    const auto expected = orientation(corners[0], corners[1], corners[2]);
    return expected != CGAL::COLLINEAR && std::all_of(f.triangles.begin(), f.triangles.end(), [&](const auto& t) {
             return orientation(m_nodes[t[0]].point, m_nodes[t[1]].point, m_nodes[t[2]].point) == expected;
           });
  }

  void create(std::size_t node, vertex_descriptor v)
  {
    m_nodes[node].vertex = v;
    put(m_vpm, v, m_nodes[node].point);
    put(m_node, v, node);
  }

  void mark(edge_descriptor e, Edge_constraints<TriangleMesh>& marks, Cut_report& report) const
  {
    put(marks, e, true);
    ++report.cut_edges;
  }

  void split(const Cut_edge& cut, Edge_constraints<TriangleMesh>& marks, Cut_report& report)
  {
    const auto h = cut.halfedge;
    const bool is_marked = get(marks, edge(h, m_mesh));
    double begin = 0;
    const auto mark_part = [&](edge_descriptor e, double end) {
      put(marks, e, is_marked);
      for(const auto& segment : cut.segments)
        if(segment.first <= begin && end <= segment.second) {
          mark(e, marks, report);
          break;
        }
      begin = end;
    };
    for(const auto& n : cut.nodes) {
      const auto part = CGAL::Euler::split_edge(h, m_mesh); // ends at the new vertex, where h now begins
      create(n.second, target(part, m_mesh));
      mark_part(edge(part, m_mesh), n.first);
    }
    mark_part(edge(h, m_mesh), 1);
  }

  void replace(const Cut_facet& cut, Edge_constraints<TriangleMesh>& marks, Cut_report& report)
  {
    std::map<std::pair<std::size_t, std::size_t>, halfedge_descriptor> halfedges; // by nodes
    const auto first = halfedge(cut.facet, m_mesh);
    auto h = first;
    do {
      halfedges[{ get(m_node, source(h, m_mesh)), get(m_node, target(h, m_mesh)) }] = h;
      h = next(h, m_mesh);
    } while(h != first);
    for(const auto& n : cut.inside) create(n.second, add_vertex(m_mesh));
    const auto halfedge_between = [&](std::size_t from, std::size_t to) {
      const auto found = halfedges.find({ from, to });
      if(found != halfedges.end()) return found->second;
      const auto created = halfedge(add_edge(m_mesh), m_mesh), other = opposite(created, m_mesh);
      put(marks, edge(created, m_mesh), false);
      set_target(created, m_nodes[to].vertex, m_mesh);
      set_target(other, m_nodes[from].vertex, m_mesh);
      halfedges[{ from, to }] = created;
      halfedges[{ to, from }] = other;
      return created;
    };
    for(const auto& t : cut.triangles) {
      const auto f = &t == &cut.triangles[0] ? cut.facet : add_face(m_mesh);
      const std::array<halfedge_descriptor, 3> sides = { halfedge_between(t[0], t[1]), halfedge_between(t[1], t[2]),
                                                         halfedge_between(t[2], t[0]) };
      for(std::size_t i = 0; i < 3; ++i) {
        set_face(sides[i], f, m_mesh);
        set_next(sides[i], sides[(i + 1) % 3], m_mesh);
        // Vertices on the boundary of the facet keep their halfedges.
        if(halfedge(m_nodes[t[i]].vertex, m_mesh) == Graph_traits::null_halfedge())
          set_halfedge(m_nodes[t[i]].vertex, sides[(i + 2) % 3], m_mesh);
      }
      set_halfedge(f, sides[0], m_mesh);
    }
    for(const auto& e : cut.chord_parts) mark(edge(halfedge_between(e.first, e.second), m_mesh), marks, report);
  }

  TriangleMesh& m_mesh;
  VertexPointMap m_vpm;
  typename boost::property_map<TriangleMesh, dynamic_vertex_property_t<std::size_t> >::type m_node;
  typename boost::property_map<TriangleMesh, dynamic_edge_property_t<std::size_t> >::type m_cut_edge;
  typename boost::property_map<TriangleMesh, dynamic_face_property_t<std::size_t> >::type m_cut_facet;
  std::vector<Node> m_nodes;
  std::vector<Cut_edge> m_edges;
  std::vector<Cut_facet> m_facets;
  std::size_t m_crossings = 0;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_POLYLINE_CUTS_H
