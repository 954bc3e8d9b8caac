// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_CLOSING_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_CLOSING_3_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief triangles that close an open mesh: caps of its holes, and back sheets.
 *
 * The shell of an open mesh is built for the closed mesh, and stores the closing. Every mesh with the same border, bit
 * for bit, can be closed by the same triangles. If two such closed meshes are certified in the shell, the integral
 * curves map the open meshes one-to-one onto each other: a curve that meets a triangle of the closing meets both closed
 * meshes there. The border is mapped to itself.
 *
 * Border points are identified by their coordinates, because a closed and embedded mesh has no two vertices at the same
 * position.
 */
class Shell_closing_3
{
public:
  typedef std::array<double, 3> Point;
  typedef std::uint32_t Index;
  typedef std::array<Index, 3> Triangle; ///< indices of points, counterclockwise as seen from the front of the mesh

  static constexpr Index npos = std::numeric_limits<Index>::max();

  enum class Kind : unsigned char
  {
    CAP, ///< part of a cap that fills a hole
    BACK ///< part of a sheet behind the mesh, or of the strips that connect it to the border
  };

  Shell_closing_3() = default;
  /// \param points border points first
  /// \param border number of border points
  /// \param triangles the triangles
  /// \param kinds of the triangles
  Shell_closing_3(std::vector<Point> points, std::size_t border, std::vector<Triangle> triangles,
                  std::vector<Kind> kinds)
    : m_points(std::move(points)), m_border(border), m_triangles(std::move(triangles)), m_kinds(std::move(kinds))
  {
    for(std::size_t n = 0; n < (std::min)(m_border, m_points.size()); ++n)
      m_border_point.emplace(m_points[n], Index(n));
    m_is_valid = can_close();
  }

  const std::vector<Point>& points() const { return m_points; }
  /// returns the number of border points, which are the first of all points
  std::size_t number_of_border_points() const { return m_border; }
  const std::vector<Triangle>& triangles() const { return m_triangles; }
  const std::vector<Kind>& kinds() const { return m_kinds; }
  /// returns, for each border point, the next one along the border of the triangles, which lie on the left.
  /// \pre `is_valid()`
  std::vector<Index> next_border_points() const;
  /// returns whether the triangles can close a mesh: coordinates are finite, and triangles have different corners; each
  /// border point has one edge to the next border point, and all other edges have one triangle on each side; the
  /// triangles at each point form one fan
  bool is_valid() const { return m_is_valid; }
  /// returns the index of the border point with these coordinates, or `npos`
  Index border_point(const Point& p) const
  {
    const auto found = m_border_point.find(p);
    return found == m_border_point.end() ? npos : found->second;
  }

  /// the elements added to a mesh: the facets in the order of the triangles, and the vertices that are not border
  /// points, in the order of the points
  template <typename FaceGraph>
  struct Attached
  {
    std::vector<typename boost::graph_traits<FaceGraph>::face_descriptor> faces;
    std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor> vertices;
  };

  /// closes a mesh by adding vertices and facets, and checks that the result is closed.
  /// \tparam FaceGraph a model of `MutableFaceGraph` and `HalfedgeListGraph`
  /// \tparam VertexPointMap a model of `ReadWritePropertyMap` from its vertices to points with a constructor from three
  ///   `double`s
  /// \return nothing if the border of the mesh is not that of the closing, or if the mesh has another edge of the
  ///   closing; the mesh is then unchanged
  /// \cgalHeading{Cost} Linear in the size of the mesh.
  template <typename FaceGraph, typename VertexPointMap>
  std::optional<Attached<FaceGraph> > attach(FaceGraph& mesh, VertexPointMap vpm) const;

  /// opens the mesh again; vertices that lose all facets are removed
  template <typename FaceGraph>
  static void detach(FaceGraph& mesh, const Attached<FaceGraph>& attached)
  {
    for(auto f = attached.faces.rbegin(); f != attached.faces.rend(); ++f) Euler::remove_face(halfedge(*f, mesh), mesh);
  }

  /// returns the border halfedges of a mesh, by `key(source, target)` of the border points that they connect. Returns
  /// nothing if the border is not that of the closing.
  template <typename FaceGraph, typename VertexPointMap>
  std::optional<std::unordered_map<std::uint64_t, typename boost::graph_traits<FaceGraph>::halfedge_descriptor> >
  match_border(const FaceGraph& mesh, VertexPointMap vpm) const;

  static std::uint64_t key(Index source, Index target) { return std::uint64_t(source) << 32 | target; }

private:
  bool can_close() const;

  std::vector<Point> m_points;
  std::size_t m_border = 0;
  std::vector<Triangle> m_triangles;
  std::vector<Kind> m_kinds;
  std::unordered_map<Point, Index, internal::Hash_coordinates> m_border_point;
  bool m_is_valid = false;
};

inline bool Shell_closing_3::can_close() const
{
  if(m_points.size() >= npos || m_border > m_points.size() || m_border_point.size() != m_border) return false;
  if(m_kinds.size() != m_triangles.size()) return false;
  for(const Point& p : m_points)
    if(!std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); })) return false;
  std::vector<std::size_t> corners(m_points.size(), 0); // by point
  std::unordered_map<std::uint64_t, Index> third;       // third corner of the triangle of a directed edge
  for(const Triangle& t : m_triangles)
    for(int i = 0; i < 3; ++i) {
      const Index p = t[i], q = t[(i + 1) % 3];
      if(p >= m_points.size() || p == q || !third.emplace(key(p, q), t[(i + 2) % 3]).second) return false;
      ++corners[p];
    }
  std::vector<Index> next(m_points.size(), npos); // along the border; for an inner point, any edge
  std::vector<int> outgoing(m_border, 0), incoming(m_border, 0);
  for(const auto& edge : third) {
    const Index p = Index(edge.first >> 32), q = Index(edge.first & npos);
    if(third.count(key(q, p)) > 0) {
      if(p >= m_border) next[p] = q;
      continue;
    }
    if(p >= m_border || q >= m_border) return false;
    ++outgoing[p];
    ++incoming[q];
    next[p] = q;
  }
  const auto is_one = [](int n) { return n == 1; };
  if(!std::all_of(outgoing.begin(), outgoing.end(), is_one)) return false;
  if(!std::all_of(incoming.begin(), incoming.end(), is_one)) return false;
  // A walk around the point, from one edge to the next, must meet all of its triangles.
  for(Index p = 0; p < m_points.size(); ++p) {
    std::size_t met = 0;
    Index q = next[p];
    do {
      const auto edge = third.find(key(p, q));
      if(edge == third.end()) break;
      q = edge->second;
      ++met;
    } while(q != next[p]);
    if(met == 0 || met != corners[p]) return false;
  }
  return true;
}

inline std::vector<Shell_closing_3::Index> Shell_closing_3::next_border_points() const
{
  std::unordered_map<std::uint64_t, char> is_open; // by directed edge
  for(const Triangle& t : m_triangles)
    for(int i = 0; i < 3; ++i) {
      const Index p = t[i], q = t[(i + 1) % 3];
      if(p < m_border && q < m_border && is_open.erase(key(q, p)) == 0) is_open.emplace(key(p, q), 1);
    }
  std::vector<Index> next(m_border, npos);
  for(const auto& edge : is_open) next[edge.first >> 32] = Index(edge.first & npos);
  return next;
}

template <typename FaceGraph, typename VertexPointMap>
std::optional<std::unordered_map<std::uint64_t, typename boost::graph_traits<FaceGraph>::halfedge_descriptor> >
Shell_closing_3::match_border(const FaceGraph& mesh, VertexPointMap vpm) const
{
  typedef std::unordered_map<std::uint64_t, typename boost::graph_traits<FaceGraph>::halfedge_descriptor> Border;
  if(!is_valid()) return std::nullopt;
  const std::vector<Index> next = next_border_points();
  Border border;
  std::vector<char> is_met(m_border, 0);
  for(auto h : halfedges(mesh)) {
    if(!is_border(h, mesh) || is_border(opposite(h, mesh), mesh)) continue;
    std::array<Index, 2> ends;
    for(int i = 0; i < 2; ++i) {
      const auto& p = get(vpm, i == 0 ? source(h, mesh) : target(h, mesh));
      ends[i] = border_point(internal::rounded_coordinates(p));
      if(ends[i] == npos) return std::nullopt;
    }
    // A border with a repeated point touches itself.
    if(next[ends[0]] != ends[1] || is_met[ends[0]]) return std::nullopt;
    is_met[ends[0]] = 1;
    border.emplace(key(ends[0], ends[1]), h);
  }
  if(border.size() != next.size()) return std::nullopt;
  return border;
}

template <typename FaceGraph, typename VertexPointMap>
std::optional<Shell_closing_3::Attached<FaceGraph> > Shell_closing_3::attach(FaceGraph& mesh, VertexPointMap vpm) const
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  const auto border = match_border(mesh, vpm);
  if(!border) return std::nullopt;
  std::vector<typename Graph_traits::vertex_descriptor> vertex(m_points.size());
  for(const auto& pair : *border) vertex[pair.first >> 32] = source(pair.second, mesh);
  Attached<FaceGraph> attached;
  for(std::size_t n = m_border; n < m_points.size(); ++n) {
    vertex[n] = add_vertex(mesh);
    put(vpm, vertex[n], Point_3(m_points[n][0], m_points[n][1], m_points[n][2]));
    attached.vertices.push_back(vertex[n]);
  }
  for(const Triangle& t : m_triangles) {
    const auto f = Euler::add_face(
      std::array<typename Graph_traits::vertex_descriptor, 3>{ vertex[t[0]], vertex[t[1]], vertex[t[2]] }, mesh);
    if(f == Graph_traits::null_face()) break; // the mesh has an edge of the closing that is not on the border
    attached.faces.push_back(f);
  }
  if(attached.faces.size() == m_triangles.size() && CGAL::is_closed(mesh)) return attached;
  // Vertices with facets are removed together with them.
  std::vector<typename Graph_traits::vertex_descriptor> isolated;
  for(auto v : attached.vertices)
    if(halfedge(v, mesh) == Graph_traits::null_halfedge()) isolated.push_back(v);
  detach(mesh, attached);
  for(auto v : isolated) remove_vertex(v, mesh);
  return std::nullopt;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_CLOSING_3_H
