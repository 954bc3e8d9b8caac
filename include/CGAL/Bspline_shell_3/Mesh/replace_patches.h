// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_REPLACE_PATCHES_H
#define CGAL_BSPLINE_SHELL_3_MESH_REPLACE_PATCHES_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/Union_find.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the patches of a truncation that a mesh has. Elements of other patches are null.
 */
template <typename FaceGraph>
struct Truncation_patches
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  /// by cut facet: the halfedge from its first corner to its second
  std::vector<typename Graph_traits::halfedge_descriptor> cut_facets;
  /// by disc: the vertex that it replaces
  std::vector<typename Graph_traits::vertex_descriptor> centers;

  /// returns whether the mesh has a cut facet, with its whole patch
  bool has(std::size_t cut_facet) const { return cut_facets[cut_facet] != Graph_traits::null_halfedge(); }
  /// returns whether the mesh has none of the patches
  bool empty() const
  {
    const auto is_null = [](const auto& v) { return v == Graph_traits::null_vertex(); };
    return std::all_of(centers.begin(), centers.end(), is_null);
  }
};

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief finds the patches of which a mesh has all facets; none if the truncation is not valid.
 *
 * \tparam FaceGraph a model of `FaceListGraph`
 * \tparam VertexPointMap a model of `ReadablePropertyMap` from its vertices to points of a \cgal kernel
 * \cgalHeading{Cost} Linear in the size of the mesh.
 */
template <typename FaceGraph, typename VertexPointMap>
Truncation_patches<FaceGraph> find_patches(const Shell_truncation_3& truncation, const FaceGraph& mesh,
                                           VertexPointMap vpm)
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef Shell_truncation_3::Index Index;
  Truncation_patches<FaceGraph> patches;
  auto& result = patches.cut_facets;
  result.assign(truncation.cut_facets().size(), Graph_traits::null_halfedge());
  patches.centers.assign(truncation.discs().size(), Graph_traits::null_vertex());
  if(!truncation.is_valid()) return patches;
  const std::size_t corners = truncation.number_of_corners();
  std::unordered_map<Shell_truncation_3::Point, Index, internal::Hash_coordinates> corner_at;
  for(std::size_t n = 0; n < corners; ++n) corner_at.emplace(truncation.points()[n], Index(n));
  std::vector<vertex_descriptor> vertex(corners, Graph_traits::null_vertex());
  for(vertex_descriptor v : vertices(mesh)) {
    const auto& p = get(vpm, v);
    const auto found = corner_at.find(internal::rounded_coordinates(p));
    if(found != corner_at.end() && halfedge(v, mesh) != Graph_traits::null_halfedge()) vertex[found->second] = v;
  }
  std::vector<Index> facets_at(corners, 0);
  for(const auto& t : truncation.cut_facets())
    for(Index p : t) ++facets_at[p];
  // Discs that cut a common facet belong to the same patch.
  Union_find<char> sets; // whether the mesh has the patch
  std::vector<Union_find<char>::handle> patch;
  for(std::size_t f = 0; f < result.size(); ++f) patch.push_back(sets.make_set(1));
  for(const auto& d : truncation.discs())
    for(Index f : d.facets) sets.unify_sets(patch[d.facets.front()], patch[f]);
  for(const auto& d : truncation.discs()) {
    const vertex_descriptor v = vertex[d.center];
    bool is_whole = v != Graph_traits::null_vertex() && degree(v, mesh) == facets_at[d.center];
    if(is_whole)
      for(Index f : d.facets) {
        if(patches.has(f)) continue;
        const auto& t = truncation.cut_facets()[f];
        for(auto h : halfedges_around_target(v, mesh)) {
          if(is_border(h, mesh)) continue;
          const auto g = next(h, mesh), last = next(g, mesh);
          if(next(last, mesh) != h) continue;
          const int i = int(Shell_truncation_3::corner(t, d.center)); // h leads to corner i
          if(target(g, mesh) != vertex[t[(i + 1) % 3]] || target(last, mesh) != vertex[t[(i + 2) % 3]]) continue;
          result[f] = i == 0 ? g : i == 1 ? h : last;
        }
        is_whole = is_whole && patches.has(f);
      }
    if(!is_whole) *sets.find(patch[d.facets.front()]) = 0;
  }
  for(std::size_t f = 0; f < result.size(); ++f)
    if(!*sets.find(patch[f])) result[f] = Graph_traits::null_halfedge();
  for(std::size_t n = 0; n < truncation.discs().size(); ++n) {
    const auto& d = truncation.discs()[n];
    if(patches.has(d.facets.front())) patches.centers[n] = vertex[d.center];
  }
  return patches;
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief the new elements of a mesh whose patches were replaced.
 */
template <typename FaceGraph>
struct Truncated_elements
{
  /// by new facet; null if the mesh does not have its patch
  std::vector<typename boost::graph_traits<FaceGraph>::face_descriptor> facets;
  /// by point of the truncation; null if there is no vertex, as for the vertices that were cut off
  std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor> vertices;
};

namespace internal {

// Cuts a polygonal facet into triangles between its corners, and calls `put(n, f)` with the facet of the n-th triangle.
// The original facet becomes one of them. Returns false if the triangles do not triangulate the polygon; the facet may
// then be partially cut.
// \pre `vertices` are the vertices of the points, without repetitions
template <typename FaceGraph, typename Put>
bool cut_into_triangles(typename boost::graph_traits<FaceGraph>::halfedge_descriptor in_polygon, FaceGraph& mesh,
                        const std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor>& vertices,
                        std::vector<std::pair<Shell_truncation_3::Triangle, std::size_t> > triangles, const Put& put)
{
  typedef typename boost::graph_traits<FaceGraph>::halfedge_descriptor halfedge_descriptor;
  typedef Shell_truncation_3::Index Index;
  std::unordered_map<Index, halfedge_descriptor> to; // by target corner, in the rest of the polygon
  std::unordered_map<Index, Index> next_corner;
  std::unordered_map<typename boost::graph_traits<FaceGraph>::vertex_descriptor, Index> point;
  for(const auto& t : triangles)
    for(Index p : t.first) point.emplace(vertices[p], p);
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
        const Index p = triangles[n].first[i], q = triangles[n].first[(i + 1) % 3], r = triangles[n].first[(i + 2) % 3];
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

// Returns whether all new facets of the patches exist, connect their vertices, and have as many border edges as the cut
// facets.
template <typename FaceGraph>
bool are_patches_replaced(const Shell_truncation_3& truncation, const Truncation_patches<FaceGraph>& patches,
                          const Truncated_elements<FaceGraph>& truncated, std::size_t border, const FaceGraph& mesh)
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  for(std::size_t n = 0; n < truncation.new_facets().size(); ++n) {
    if(!patches.has(truncation.new_facets()[n].cut_facet)) continue;
    if(truncated.facets[n] == Graph_traits::null_face()) return false;
    const auto& t = truncation.new_facets()[n].triangle;
    auto h = halfedge(truncated.facets[n], mesh);
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

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief truncates a mesh by replacing its patches.
 *
 * One remaining part of each cut facet keeps its properties; other new elements have default values. The result is
 * checked: it must have all new facets and no additional border.
 *
 * \tparam FaceGraph a model of `MutableFaceGraph` and `FaceListGraph`
 * \tparam VertexPointMap a model of `ReadWritePropertyMap` from its vertices to points with a constructor from three
 *   `double`s
 * \param patches the result of `find_patches()`
 * \return nothing if the check fails; the mesh must then not be used
 * \cgalHeading{Cost} Linear in the size of the truncation.
 */
template <typename FaceGraph, typename VertexPointMap>
std::optional<Truncated_elements<FaceGraph> > replace_patches(const Shell_truncation_3& truncation,
                                                              const Truncation_patches<FaceGraph>& patches,
                                                              FaceGraph& mesh, VertexPointMap vpm)
{
  typedef boost::graph_traits<FaceGraph> Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor halfedge_descriptor;
  typedef typename Graph_traits::vertex_descriptor vertex_descriptor;
  typedef Shell_truncation_3::Index Index;
  typedef Shell_truncation_3::Disc Disc;
  typedef std::vector<std::pair<Shell_truncation_3::Triangle, std::size_t> > Numbered_triangles;
  constexpr Index npos = Shell_truncation_3::npos;
  Truncated_elements<FaceGraph> result;
  result.facets.assign(truncation.new_facets().size(), Graph_traits::null_face());
  result.vertices.assign(truncation.points().size(), Graph_traits::null_vertex());
  const auto has_disc = [&](const Disc& d) { return patches.has(d.facets.front()); };
  const auto place = [&](Index p, vertex_descriptor v) {
    const auto& x = truncation.points()[p];
    put(vpm, v, typename boost::property_traits<VertexPointMap>::value_type(x[0], x[1], x[2]));
    result.vertices[p] = v;
  };
  if(patches.empty()) return result;
  std::vector<halfedge_descriptor> in_core = patches.cut_facets;
  std::size_t border = 0; // border edges of cut facets
  for(std::size_t f = 0; f < in_core.size(); ++f) {
    if(!patches.has(f)) continue;
    halfedge_descriptor h = in_core[f];
    for(int i = 0; i < 3; ++i, h = next(h, mesh)) {
      result.vertices[truncation.cut_facets()[f][i]] = source(h, mesh);
      border += is_border(opposite(h, mesh), mesh) ? 1 : 0;
    }
  }

  // Returns the halfedge of a facet's polygon that leaves a vertex.
  const auto leaving = [&](Index facet, Index center) {
    halfedge_descriptor h = in_core[facet];
    while(source(h, mesh) != result.vertices[center]) h = next(h, mesh);
    return h;
  };
  for(const Disc& d : truncation.discs()) {
    if(!has_disc(d)) continue;
    for(std::size_t i = 0; i < d.rim.size(); ++i)
      if(truncation.cut(d.rim[i]).second == npos)
        place(d.rim[i], target(Euler::split_edge(leaving(d.facets[i], d.center), mesh), mesh));
  }
  for(const Disc& d : truncation.discs()) {
    if(!has_disc(d)) continue;
    // Each corner is cut off along a new edge, which is then split at the cuts inside the facet.
    const std::size_t size = d.rim.size();
    halfedge_descriptor to_center = Graph_traits::null_halfedge();
    for(std::size_t i = 0; i < size; ++i) {
      if(truncation.cut(d.rim[i]).second != npos) continue;
      const Index f = d.facets[i];
      const halfedge_descriptor first = leaving(f, d.center), last = prev(prev(first, mesh), mesh);
      const halfedge_descriptor across = Euler::split_face(last, first, mesh);
      in_core[f] = across;
      to_center = next(opposite(across, mesh), mesh);
      std::size_t end = i + 1;
      while(truncation.cut(d.rim[end % size]).second != npos) ++end;
      for(std::size_t j = end - 1; j > i; --j) place(d.rim[j % size], target(Euler::split_edge(across, mesh), mesh));
    }
    Euler::remove_center_vertex(to_center, mesh);
    result.vertices[d.center] = Graph_traits::null_vertex();
  }

  std::vector<Numbered_triangles> cores(in_core.size()), in_disc(truncation.discs().size());
  for(std::size_t n = 0; n < truncation.new_facets().size(); ++n) {
    const Shell_truncation_3::New_facet& facet = truncation.new_facets()[n];
    (facet.disc == npos ? cores[facet.cut_facet] : in_disc[facet.disc]).emplace_back(facet.triangle, n);
  }
  const auto note = [&](std::size_t n, typename Graph_traits::face_descriptor f) { result.facets[n] = f; };
  for(std::size_t f = 0; f < in_core.size(); ++f)
    if(patches.has(f) && !internal::cut_into_triangles(in_core[f], mesh, result.vertices, cores[f], note))
      return std::nullopt;
  for(std::size_t n = 0; n < truncation.discs().size(); ++n) {
    const Disc& d = truncation.discs()[n];
    if(!has_disc(d)) continue;
    // The halfedge of the disc along the first edge of the rim, opposite to that of the core.
    halfedge_descriptor h = halfedge(result.vertices[d.rim[0]], mesh);
    while(source(h, mesh) != result.vertices[d.rim[1]]) h = opposite(next(h, mesh), mesh);
    h = opposite(h, mesh);
    bool has_inner_points = false;
    for(const auto& t : in_disc[n])
      for(Index p : t.first)
        if(!truncation.is_cut(p) && result.vertices[p] == Graph_traits::null_vertex()) {
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
  if(!internal::are_patches_replaced(truncation, patches, result, border, mesh)) return std::nullopt;
  return result;
}

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief finds and replaces patches. If the mesh has none, it is left unchanged.
 */
template <typename FaceGraph, typename VertexPointMap>
std::optional<Truncated_elements<FaceGraph> > replace_patches(const Shell_truncation_3& truncation, FaceGraph& mesh,
                                                              VertexPointMap vpm)
{
  return replace_patches(truncation, find_patches(truncation, mesh, vpm), mesh, vpm);
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_REPLACE_PATCHES_H
