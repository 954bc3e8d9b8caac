// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H

#include <CGAL/Bspline_shell_3/Support/coordinates.h>
#include <CGAL/Bspline_shell_3/Support/instances.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
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
 * \brief Replacement of the tips of a mesh at some of its vertices, and the map between the two meshes.
 *
 * If the facets at a vertex face no common direction, no field can be transversal there. The *truncated* mesh has a
 * disc in place of the vertex: the facets at the vertex are cut near it, and triangles between the cuts replace the
 * part that is cut off.
 *
 * The map between the meshes is the identity outside the cut facets, up to the rounding of coordinates. The rest of a
 * cut facet, its *core*, is a union of triangles, which are facets of the truncated mesh; the map is affine on each.
 * The *tip* is a fan of triangles between the vertex and the cuts. The tip and the disc are both mapped to the same
 * planar polygon, by affine maps of their triangles. The map from tip to disc is the first of these maps followed by
 * the inverse of the second.
 *
 * `is_valid()` proves in exact arithmetic that the map is a homeomorphism. The proof does not depend on the coordinates
 * of cuts, which are rounded, or on how they were found.
 *
 * Facets are identified by the coordinates of their vertices, because an embedded mesh has no two vertices at the same
 * position. So the truncation fits every mesh that has the facets to be cut. Cut facets and their parts form *patches*;
 * each patch is found and replaced as a whole.
 */
class Shell_truncation_3
{
public:
  typedef std::array<double, 3> Point;
  typedef std::array<double, 2> Planar_point;
  typedef std::uint32_t Index;
  typedef std::array<Index, 3> Triangle; ///< Positions of points, counterclockwise as seen from the front of the mesh.

  static constexpr Index npos = std::numeric_limits<Index>::max();

  /// A point where a facet is cut: `center + s (first - center) + t (second - center)`, where these are corners of the
  /// facet in this order. On an edge, `t` is zero and `second` is `npos`.
  struct Cut
  {
    Index center, first, second;
    double s, t;
  };

  /// Replacement of the tip at a vertex.
  struct Disc
  {
    Index center;                    ///< The vertex.
    std::vector<Index> rim;          ///< The cuts around it, counterclockwise.
    std::vector<Index> facets;       ///< By edge of the rim, from each cut to the next: the cut facet that contains it.
    std::vector<Triangle> triangles; ///< Triangles between cuts and inner points.
  };

  /// A part of a cut facet that remains.
  struct Core
  {
    Triangle triangle;
    Index facet; ///< The cut facet.
  };

  /// A point of a cut facet, or of a facet of the truncated mesh.
  struct Place
  {
    Index facet = npos;
    std::array<double, 3> barycentric = {};
  };

  Shell_truncation_3() = default;
  /// \param points vertices of the cut facets, followed by the points of `cuts` and the inner points of discs
  /// \param cut_facets facets that are cut
  /// \param cuts of edges and facets
  /// \param cores remaining parts of the cut facets
  /// \param discs replacements of the other parts
  /// \param planar positions of cuts and inner points in the plane; the truncated vertices are at the origin
  Shell_truncation_3(std::vector<Point> points, std::vector<Triangle> cut_facets, std::vector<Cut> cuts,
                     std::vector<Core> cores, std::vector<Disc> discs, std::vector<Planar_point> planar);

  /// \name Data
  /// @{
  const std::vector<Point>& points() const { return m_points; }
  /// Number of points that are vertices of the mesh, which are the first of all points.
  std::size_t number_of_corners() const { return m_points.size() - m_planar.size(); }
  const std::vector<Triangle>& cut_facets() const { return m_cut_facets; }
  const std::vector<Cut>& cuts() const { return m_cuts; }
  const std::vector<Core>& cores() const { return m_cores; }
  const std::vector<Disc>& discs() const { return m_discs; }
  const std::vector<Planar_point>& planar() const { return m_planar; }
  /// @}

  /// Number of facets that only the truncated mesh has: cores, followed by the triangles of discs.
  std::size_t number_of_new_facets() const { return m_cores.size() + m_disc_triangles.size(); }
  Triangle new_facet(std::size_t n) const
  {
    return n < m_cores.size() ? m_cores[n].triangle : triangle_of(m_disc_triangles[n - m_cores.size()]);
  }
  /// Returns the disc of a new facet, or `npos` for a core.
  Index disc_of_new_facet(std::size_t n) const
  {
    return n < m_cores.size() ? npos : m_disc_triangles[n - m_cores.size()].first;
  }

  /// Returns whether this is the truncation of a mesh, and its map is a homeomorphism. The parts of each facet tile it,
  /// in exact arithmetic on the numbers in `cuts()`. Facets with a common edge have the same cuts on it. Hence the
  /// cores and tips are one subdivision of the cut facets. The fan of the tip is mapped onto a star-shaped polygon. So
  /// is the disc: its triangles are positively oriented in the plane, and its only border is the rim. No two new facets
  /// have the same directed edge, so that `apply()` succeeds on every mesh that has a patch.
  bool is_valid() const { return m_is_valid; }

  /// \name Map
  /// Places on edges belong to several facets, and all of these yield the same image. Images are computed in `double`s.
  /// @{
  /// Returns the image on the truncated mesh of a place on a cut facet.
  /// \pre `is_valid()`
  Place image(const Place& place) const;
  /// Returns the preimage on the original mesh of a place on a new facet.
  /// \pre `is_valid()`
  Place preimage(const Place& place) const;
  /// Returns the derivative of `image()` at a place: the matrix, given by its columns, that maps changes of the
  /// barycentric coordinates of the place to changes of those of the image.
  /// \pre `is_valid()`
  std::array<std::array<double, 3>, 3> derivative(const Place& place) const;
  /// @}

  /// Result of truncating a mesh.
  template <typename FaceGraph>
  struct Truncated
  {
    typedef typename boost::graph_traits<FaceGraph>::vertex_descriptor vertex_descriptor;
    typedef typename boost::graph_traits<FaceGraph>::face_descriptor face_descriptor;
    std::size_t patches = 0; ///< Number of patches that were replaced.
    /// By new facet; null if the mesh does not have its patch.
    std::vector<face_descriptor> facets;
    /// By point; null if there is no vertex, as for the vertices that were cut off.
    std::vector<vertex_descriptor> vertices;
  };

  /// Returns, for each facet to be cut, the halfedge of a mesh from its first corner to its second. It is null if the
  /// mesh does not have all facets of the patch. All halfedges are null if the truncation is not valid.
  /// \tparam FaceGraph a model of `FaceListGraph`
  template <typename FaceGraph, typename VertexPointMap>
  std::vector<typename boost::graph_traits<FaceGraph>::halfedge_descriptor> match(const FaceGraph& mesh,
                                                                                  VertexPointMap vpm) const;

  /// Truncates a mesh by replacing its patches. One remaining part of each cut facet keeps its properties; other new
  /// elements have default values. The result is checked: it must have all new facets and no additional border.
  /// \tparam FaceGraph a model of `MutableFaceGraph` and `FaceListGraph`
  /// \tparam VertexPointMap a model of `ReadWritePropertyMap` from its vertices to points with a constructor from three
  ///   `double`s
  /// \return nothing if the check fails; the mesh must then not be used
  /// \cgalHeading{Cost} linear in the size of the mesh
  template <typename FaceGraph, typename VertexPointMap>
  std::optional<Truncated<FaceGraph> > apply(FaceGraph& mesh, VertexPointMap vpm) const;

private:
  typedef std::pair<Index, Index> Disc_triangle; // disc, position in it
  // A part of a cut facet: a core, or a triangle of a tip, between the vertex and an edge of the rim.
  struct Cell
  {
    Index new_facet, disc, edge;                  // `new_facet` for a core, `disc` and `edge` for a tip
    std::array<std::array<double, 3>, 3> corners; // barycentric coordinates in the cut facet
  };

  // The piece of the map that contains a place: a part of the facet, and, for a tip, a triangle of the disc.
  struct Piece
  {
    const Cell* part;
    std::size_t new_facet;
  };

  Piece piece(const Place& place) const;
  Planar_point planar_point(const Cell& part, const std::array<double, 3>& barycentric) const;
  std::array<double, 3> mapped(const Piece& piece, const std::array<double, 3>& barycentric) const;
  const Triangle& triangle_of(const Disc_triangle& t) const { return m_discs[t.first].triangles[t.second]; }
  bool is_cut(Index point) const { return point >= number_of_corners() && point < number_of_corners() + m_cuts.size(); }
  bool are_indices_valid() const;
  bool do_parts_tile_facets() const;
  bool are_discs_valid() const;
  bool are_edges_unique() const;
  template <typename FaceGraph>
  bool is_replaced(const Truncated<FaceGraph>& truncated, const std::vector<char>& is_cut, std::size_t border,
                   const FaceGraph& mesh) const;
  void index();
  std::array<double, 3> barycentric_in(Index facet, Index point) const;
  const Planar_point& planar(Index point) const { return m_planar[point - number_of_corners()]; }
  std::vector<Index> patches() const;

  std::vector<Point> m_points;
  std::vector<Triangle> m_cut_facets;
  std::vector<Cut> m_cuts;
  std::vector<Core> m_cores;
  std::vector<Disc> m_discs;
  std::vector<Planar_point> m_planar;
  std::vector<Disc_triangle> m_disc_triangles;
  std::vector<std::vector<Cell> > m_cells; // by cut facet
  bool m_is_valid = false;
};

namespace internal {

// Cuts a polygonal facet into triangles between its corners, and calls `put(n, f)` with the facet of the n-th triangle.
// The original facet becomes one of them. Returns false if the triangles do not triangulate the polygon; the facet may
// then be partially cut.
// \pre `vertices` are the vertices of the points, without repetitions
template <typename FaceGraph, typename Put>
bool cut_into_triangles(typename boost::graph_traits<FaceGraph>::halfedge_descriptor in_polygon, FaceGraph& mesh,
                        const std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor>& vertices,
                        std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t> > triangles, const Put& put)
{
  typedef typename boost::graph_traits<FaceGraph>::halfedge_descriptor halfedge_descriptor;
  std::unordered_map<std::uint32_t, halfedge_descriptor> to; // by target corner, in the rest of the polygon
  std::unordered_map<std::uint32_t, std::uint32_t> next_corner;
  std::unordered_map<typename boost::graph_traits<FaceGraph>::vertex_descriptor, std::uint32_t> point;
  for(const auto& t : triangles)
    for(std::uint32_t p : t.first) point.emplace(vertices[p], p);
  halfedge_descriptor h = in_polygon;
  do {
    const auto p = point.find(source(h, mesh)), q = point.find(target(h, mesh));
    if(p == point.end() || q == point.end()) return false;
    to[q->second] = h;
    next_corner[p->second] = q->second;
    h = next(h, mesh);
  } while(h != in_polygon);
  if(next_corner.size() != point.size() || point.size() != triangles.size() + 2) return false;
  while(triangles.size() > 1) {
    std::size_t ears = 0;
    for(std::size_t n = 0; n < triangles.size() && triangles.size() > 1; ++n)
      for(int i = 0; i < 3; ++i) {
        const std::uint32_t p = triangles[n].first[i], q = triangles[n].first[(i + 1) % 3],
                            r = triangles[n].first[(i + 2) % 3];
        if(next_corner[p] != q || next_corner[q] != r) continue;
        to[r] = Euler::split_face(to[p], to[r], mesh);
        put(triangles[n].second, face(opposite(to[r], mesh), mesh));
        next_corner[p] = r;
        next_corner[q] = q; // it is cut off
        triangles.erase(triangles.begin() + std::ptrdiff_t(n--));
        ++ears;
        break;
      }
    if(ears == 0) return false;
  }
  const auto& last = triangles.front().first;
  for(int i = 0; i < 3; ++i)
    if(next_corner[last[i]] != last[(i + 1) % 3]) return false;
  put(triangles.front().second, face(to[last[0]], mesh));
  return true;
}

} // namespace internal

template <typename FaceGraph, typename VertexPointMap>
std::vector<typename boost::graph_traits<FaceGraph>::halfedge_descriptor> Shell_truncation_3::match(
  const FaceGraph& mesh, VertexPointMap vpm) const
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  std::vector<halfedge_descriptor> result(m_cut_facets.size(), Graph_traits::null_halfedge());
  if(!is_valid()) return result;
  std::unordered_map<Point, Index, internal::Hash_coordinates> corner_at;
  for(std::size_t n = 0; n < number_of_corners(); ++n) corner_at.emplace(m_points[n], Index(n));
  std::vector<vertex_descriptor> vertex(number_of_corners(), Graph_traits::null_vertex());
  for(vertex_descriptor v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    const auto found = corner_at.find(internal::rounded_coordinates(p));
    if(found != corner_at.end() && halfedge(v, mesh) != Graph_traits::null_halfedge()) vertex[found->second] = v;
  }
  std::vector<Index> facets_at(number_of_corners(), 0);
  for(const Triangle& t : m_cut_facets)
    for(Index p : t) ++facets_at[p];
  const std::vector<Index> patch_of = patches();
  std::vector<char> is_there(m_cut_facets.size(), 1); // by patch
  for(const Disc& d : m_discs) {
    const vertex_descriptor v = vertex[d.center];
    bool is_whole = v != Graph_traits::null_vertex() && degree(v, mesh) == facets_at[d.center];
    if(is_whole)
      for(Index f : d.facets) {
        if(result[f] != Graph_traits::null_halfedge()) continue;
        const Triangle& t = m_cut_facets[f];
        for(auto h : halfedges_around_target(v, mesh)) {
          if(is_border(h, mesh)) continue;
          const auto g = next(h, mesh), last = next(g, mesh);
          if(next(last, mesh) != h) continue;
          const int i = int(std::find(t.begin(), t.end(), d.center) - t.begin()); // h leads to corner i
          if(target(g, mesh) != vertex[t[(i + 1) % 3]] || target(last, mesh) != vertex[t[(i + 2) % 3]]) continue;
          result[f] = i == 0 ? g : i == 1 ? h : last;
        }
        is_whole = is_whole && result[f] != Graph_traits::null_halfedge();
      }
    if(!is_whole) is_there[patch_of[d.facets.front()]] = 0;
  }
  for(std::size_t f = 0; f < result.size(); ++f)
    if(!is_there[patch_of[f]]) result[f] = Graph_traits::null_halfedge();
  return result;
}

// Returns whether all new facets of the patches exist, connect their vertices, and have as many border edges as the cut
// facets.
template <typename FaceGraph>
bool Shell_truncation_3::is_replaced(const Truncated<FaceGraph>& truncated, const std::vector<char>& is_cut,
                                     std::size_t border, const FaceGraph& mesh) const
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  for(std::size_t n = 0; n < number_of_new_facets(); ++n) {
    const Index disc = disc_of_new_facet(n);
    if(!is_cut[disc == npos ? m_cores[n].facet : m_discs[disc].facets.front()]) continue;
    if(truncated.facets[n] == Graph_traits::null_face()) return false;
    const Triangle t = new_facet(n);
    const auto first = halfedge(truncated.facets[n], mesh);
    auto h = first;
    for(int turns = 0; turns < 2 && source(h, mesh) != truncated.vertices[t[0]]; ++turns) h = next(h, mesh);
    for(int i = 0; i < 3; ++i, h = next(h, mesh)) {
      if(source(h, mesh) != truncated.vertices[t[i]]) return false;
      if(!is_border(opposite(h, mesh), mesh)) continue;
      if(border == 0) return false;
      --border;
    }
    if(source(h, mesh) != truncated.vertices[t[0]]) return false;
  }
  return border == 0;
}

template <typename FaceGraph, typename VertexPointMap>
std::optional<Shell_truncation_3::Truncated<FaceGraph> > Shell_truncation_3::apply(FaceGraph& mesh,
                                                                                   VertexPointMap vpm) const
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  Truncated<FaceGraph> result;
  result.facets.assign(number_of_new_facets(), Graph_traits::null_face());
  result.vertices.assign(m_points.size(), Graph_traits::null_vertex());
  std::vector<halfedge_descriptor> in_core = match(mesh, vpm); // by cut facet
  const auto is_there = [&](const Disc& d) { return in_core[d.facets.front()] != Graph_traits::null_halfedge(); };
  const auto place = [&](Index p, vertex_descriptor v) {
    put(vpm, v, Point_3(m_points[p][0], m_points[p][1], m_points[p][2]));
    result.vertices[p] = v;
  };
  std::vector<char> is_counted(m_cut_facets.size(), 0), is_cut_facet(m_cut_facets.size(), 0);
  std::size_t border = 0; // border edges of cut facets
  const std::vector<Index> patch_of = patches();
  for(std::size_t f = 0; f < m_cut_facets.size(); ++f) {
    if(in_core[f] == Graph_traits::null_halfedge()) continue;
    is_cut_facet[f] = 1;
    result.patches += is_counted[patch_of[f]] ? 0 : 1;
    is_counted[patch_of[f]] = 1;
    halfedge_descriptor h = in_core[f];
    for(int i = 0; i < 3; ++i, h = next(h, mesh)) {
      result.vertices[m_cut_facets[f][i]] = source(h, mesh);
      border += is_border(opposite(h, mesh), mesh) ? 1 : 0;
    }
  }
  if(result.patches == 0) return result;

  // Returns the halfedge of a facet's polygon that leaves a vertex.
  const auto leaving = [&](Index facet, Index center) {
    halfedge_descriptor h = in_core[facet];
    while(source(h, mesh) != result.vertices[center]) h = next(h, mesh);
    return h;
  };
  for(const Disc& d : m_discs) {
    if(!is_there(d)) continue;
    for(std::size_t i = 0; i < d.rim.size(); ++i)
      if(m_cuts[d.rim[i] - number_of_corners()].second == npos)
        place(d.rim[i], target(Euler::split_edge(leaving(d.facets[i], d.center), mesh), mesh));
  }
  for(std::size_t n = 0; n < m_discs.size(); ++n) {
    const Disc& d = m_discs[n];
    if(!is_there(d)) continue;
    // Each corner is cut off along a new edge, which is then split at the cuts inside the facet.
    const std::size_t size = d.rim.size();
    halfedge_descriptor to_center = Graph_traits::null_halfedge();
    for(std::size_t i = 0; i < size; ++i) {
      if(m_cuts[d.rim[i] - number_of_corners()].second != npos) continue;
      const Index f = d.facets[i];
      const halfedge_descriptor first = leaving(f, d.center), last = prev(prev(first, mesh), mesh);
      const halfedge_descriptor across = Euler::split_face(last, first, mesh);
      in_core[f] = across;
      to_center = next(opposite(across, mesh), mesh);
      std::size_t end = i + 1;
      while(m_cuts[d.rim[end % size] - number_of_corners()].second != npos) ++end;
      for(std::size_t j = end - 1; j > i; --j) place(d.rim[j % size], target(Euler::split_edge(across, mesh), mesh));
    }
    Euler::remove_center_vertex(to_center, mesh);
    result.vertices[d.center] = Graph_traits::null_vertex();
  }

  std::vector<std::vector<std::pair<Triangle, std::size_t> > > cores(m_cut_facets.size()), in_disc(m_discs.size());
  for(std::size_t n = 0; n < number_of_new_facets(); ++n)
    (disc_of_new_facet(n) == npos ? cores[m_cores[n].facet] : in_disc[disc_of_new_facet(n)])
      .emplace_back(new_facet(n), n);
  const auto note = [&](std::size_t n, typename Graph_traits::face_descriptor f) { result.facets[n] = f; };
  for(std::size_t f = 0; f < m_cut_facets.size(); ++f)
    if(is_cut_facet[f] && !internal::cut_into_triangles(in_core[f], mesh, result.vertices, cores[f], note))
      return std::nullopt;
  for(std::size_t n = 0; n < m_discs.size(); ++n) {
    const Disc& d = m_discs[n];
    if(!is_there(d)) continue;
    // The halfedge of the disc along the first edge of the rim, opposite to that of the core.
    halfedge_descriptor h = halfedge(result.vertices[d.rim[0]], mesh);
    while(source(h, mesh) != result.vertices[d.rim[1]]) h = opposite(next(h, mesh), mesh);
    h = opposite(h, mesh);
    bool has_inner_points = false;
    for(const auto& t : in_disc[n])
      for(Index p : t.first)
        if(!is_cut(p) && result.vertices[p] == Graph_traits::null_vertex()) {
          has_inner_points = true;
          place(p, add_vertex(mesh));
        }
    if(!has_inner_points) {
      if(!internal::cut_into_triangles(h, mesh, result.vertices, in_disc[n], note)) return std::nullopt;
      continue;
    }
    Euler::remove_face(h, mesh);
    for(const auto& t : in_disc[n]) {
      std::array<vertex_descriptor, 3> corners;
      for(int i = 0; i < 3; ++i) corners[i] = result.vertices[t.first[i]];
      note(t.second, Euler::add_face(corners, mesh));
    }
  }
  if(!is_replaced(result, is_cut_facet, border, mesh)) return std::nullopt;
  return result;
}

} // namespace Bspline_shells
} // namespace CGAL

#ifndef CGAL_BSPLINE_SHELL_3_INSTANCES
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3_impl.h>
#endif

#endif // CGAL_BSPLINE_SHELL_3_MESH_SHELL_TRUNCATION_3_H
