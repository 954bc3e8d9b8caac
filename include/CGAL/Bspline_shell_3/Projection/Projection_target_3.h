// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H
#define CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H

#include <CGAL/Bspline_shell_3/Mesh/Shell_closing_3.h>
#include <CGAL/Bspline_shell_3/Mesh/Shell_truncation_3.h>
#include <CGAL/Bspline_shell_3/Mesh/replace_patches.h>
#include <CGAL/Bspline_shell_3/Projection/Projection_facets_3.h>
#include <CGAL/Bspline_shell_3/Projection/internal/Truncated_facets.h>
#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Projection
 *
 * \brief the triangles of a mesh to project onto: their coordinates as `double`s, their neighbors, and an AABB tree.
 *
 * Facets are numbered in the order of `faces(mesh)`. Vertices 0, 1, and 2 of a facet are `source(h)`, `target(h)`, and
 * `target(next(h))` of its halfedge `h`, as for `CGAL::Polygon_mesh_processing::Face_location`. Edge `i` leads from
 * vertex `i` to the next. Objects cannot be copied. Const member functions may be called concurrently.
 *
 * \tparam TriangleMesh a model of `FaceListGraph`
 */
template <typename TriangleMesh>
class Projection_target_3 : public Projection_facets_3
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;

public:
  typedef TriangleMesh Mesh;
  typedef typename Graph_traits::face_descriptor face_descriptor;

  /// copies coordinates and neighbors. If a facet is not a triangle or a coordinate is not finite, the target is not
  /// valid. If `truncation` truncates tips of the mesh, curves are traced to the truncated mesh. `closing` may be null;
  /// otherwise, curves that meet it instead of the mesh are detected (`closing_facets()`).
  /// \param vpm a model of `ReadablePropertyMap` from the mesh's vertices to points of a kernel
  /// \pre the mesh outlives this object and does not change. A mesh that stores its dynamic properties, such as a
  ///   `Surface_mesh`, must not be prepared by two threads at once.
  template <typename VertexPointMap>
  Projection_target_3(const TriangleMesh& mesh, VertexPointMap vpm,
                      const std::shared_ptr<const Shell_truncation_3>& truncation = nullptr,
                      const std::shared_ptr<const Shell_closing_3>& closing = nullptr)
    : m_mesh(&mesh), m_index(get(dynamic_face_property_t<Index>(), mesh)), m_closing(closing)
  {
    for(face_descriptor f : faces(mesh)) {
      put(m_index, f, Index(m_faces.size()));
      m_faces.push_back(f);
    }
    for(auto v : vertices(mesh)) m_traced_vertices.push_back(internal::rounded_coordinates(get(vpm, v)));
    std::vector<Facet> facets;
    for(face_descriptor f : m_faces) {
      m_valid = m_valid && is_triangle(halfedge(f, mesh), mesh);
      if(!m_valid) return;
      Facet facet;
      auto h = halfedge(f, mesh);
      for(int i = 0; i < 3; ++i, h = next(h, mesh)) {
        facet.vertex[i] = internal::rounded_coordinates(get(vpm, source(h, mesh)));
        for(double c : facet.vertex[i]) m_valid = m_valid && std::isfinite(c);
        const auto neighbor = face(opposite(h, mesh), mesh);
        facet.neighbor[i] = neighbor == Graph_traits::null_face() ? npos : facet_of(neighbor);
        if(facet.neighbor[i] == npos) m_border.emplace(facet.vertex[i], Corner{ Index(facets.size()), i });
      }
      facets.push_back(facet);
    }
    if(!m_valid) return;
    if(truncation && truncation->is_valid()) truncate(truncation, vpm, facets);
    if(m_closing && m_closing->is_valid() && !m_border.empty()) {
      m_closing_facets = facets_of(*m_closing);
      set_border_edges(facets);
    }
    static_cast<Projection_facets_3&>(*this) = Projection_facets_3(std::move(facets));
  }

  template <typename VertexPointMap>
  Projection_target_3(const TriangleMesh&&, VertexPointMap, const std::shared_ptr<const Shell_truncation_3>& = nullptr,
                      const std::shared_ptr<const Shell_closing_3>& = nullptr) = delete;
  Projection_target_3(const Projection_target_3&) = delete;
  Projection_target_3& operator=(const Projection_target_3&) = delete;

  bool is_valid() const { return m_valid; }
  const TriangleMesh& mesh() const { return *m_mesh; }
  /// a vertex of a facet
  struct Corner
  {
    Index facet;
    int vertex;
  };
  /// returns the corner at a border vertex with these coordinates, or null
  const Corner* border_corner(const Coordinates& p) const
  {
    const auto found = m_border.find(p);
    return found == m_border.end() ? nullptr : &found->second;
  }
  /// returns the place (facet and barycentric coordinates) of the border that is nearest to a point.
  /// \pre there are `closing_facets()`
  std::pair<Index, Coordinates> closest_on_border(const Coordinates& p) const
  {
    const auto [n, weights] = m_border_edges.closest(p);
    const auto [facet, i] = m_edge_corners[n];
    std::pair<Index, Coordinates> place(facet, Coordinates{});
    place.second[i] = weights[0];
    place.second[(i + 1) % 3] = weights[1] + weights[2];
    return place;
  }
  /// returns the closing that was passed to the constructor
  const std::shared_ptr<const Shell_closing_3>& closing() const { return m_closing; }
  /// returns the triangles of this closing; there are none if it is null or not valid, or if the mesh is closed
  const Projection_facets_3& closing_facets() const { return m_closing_facets; }
  /// \name Truncation
  /// Curves are traced from and to the truncated mesh, which lies in the shell. If no tips are truncated, it is the
  /// mesh itself.
  /// @{
  /// returns the facets to which curves are traced; they have their own indices
  const Projection_facets_3& traced_facets() const { return m_truncated ? m_truncated->facets() : *this; }
  /// maps a place (facet and barycentric coordinates) on the mesh to the traced facets
  std::pair<Index, Coordinates> traced(const std::pair<Index, Coordinates>& place) const
  {
    return m_truncated ? m_truncated->traced(place) : place;
  }
  /// maps a place on the traced facets to the mesh
  std::pair<Index, Coordinates> untraced(const std::pair<Index, Coordinates>& place) const
  {
    return m_truncated ? m_truncated->untraced(place) : place;
  }
  /// returns the point from which the curve through a place of the mesh is traced
  Coordinates traced_point(Index facet, const Coordinates& barycentric) const
  {
    const auto place = traced({ facet, barycentric });
    return traced_facets().point(place.first, place.second);
  }
  /// returns these points for all vertices, in the order of `vertices(mesh)`
  const std::vector<Coordinates>& traced_vertices() const { return m_traced_vertices; }
  /// returns the derivative of the map from the mesh to the truncated mesh. It maps the plane of a facet to that of its
  /// image, and the normal to the normal.
  Eigen::Matrix3d traced_derivative(Index facet, const Coordinates& barycentric) const
  {
    return m_truncated
             ? m_truncated->derivative({ facet, barycentric }, { vertex(facet, 0), vertex(facet, 1), vertex(facet, 2) })
             : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  }
  /// @}
  std::size_t number_of_facets() const { return m_faces.size(); } ///< even if the target is not valid
  face_descriptor face_of(Index facet) const { return m_faces[facet]; }
  Index facet_of(face_descriptor f) const { return get(m_index, f); }

private:
  static Projection_facets_3 facets_of(const Shell_closing_3& closing)
  {
    std::unordered_map<std::uint64_t, Index> facet; // by directed edge
    for(std::size_t n = 0; n < closing.triangles().size(); ++n)
      for(int i = 0; i < 3; ++i)
        facet.emplace(Shell_closing_3::key(closing.triangles()[n][i], closing.triangles()[n][(i + 1) % 3]), Index(n));
    std::vector<Facet> facets(closing.triangles().size());
    for(std::size_t n = 0; n < facets.size(); ++n)
      for(int i = 0; i < 3; ++i) {
        const auto p = closing.triangles()[n][i], q = closing.triangles()[n][(i + 1) % 3];
        facets[n].vertex[i] = closing.points()[p];
        const auto found = facet.find(Shell_closing_3::key(q, p));
        facets[n].neighbor[i] = found == facet.end() ? npos : found->second;
      }
    return Projection_facets_3(std::move(facets));
  }

  void set_border_edges(const std::vector<Facet>& facets)
  {
    std::vector<Facet> edges; // without area
    for(Index n = 0; n < facets.size(); ++n)
      for(int i = 0; i < 3; ++i) {
        if(facets[n].neighbor[i] != npos) continue;
        const Coordinates &source = facets[n].vertex[i], &target = facets[n].vertex[(i + 1) % 3];
        edges.push_back({ { source, target, target }, { npos, npos, npos }, {} });
        m_edge_corners.push_back({ n, i });
      }
    m_border_edges = Projection_facets_3(std::move(edges));
  }

  template <typename VertexPointMap>
  void truncate(const std::shared_ptr<const Shell_truncation_3>& truncation, VertexPointMap vpm,
                const std::vector<Facet>& facets)
  {
    const auto patches = find_patches(*truncation, *m_mesh, vpm);
    if(patches.empty()) return;
    std::vector<internal::Truncated_facets::Cut_facet> cut;
    for(auto first : patches.cut_facets) {
      cut.push_back({ npos, 0 });
      if(first == Graph_traits::null_halfedge()) continue;
      cut.back().facet = facet_of(face(first, *m_mesh));
      for(auto h = halfedge(face(first, *m_mesh), *m_mesh); h != first; h = next(h, *m_mesh)) ++cut.back().corner;
    }
    m_truncated = std::make_unique<const internal::Truncated_facets>(truncation, facets, std::move(cut));
    std::size_t n = 0;
    for(auto v : vertices(*m_mesh)) {
      const auto h = halfedge(v, *m_mesh);
      const auto f = h == Graph_traits::null_halfedge() ? Graph_traits::null_face() : face(h, *m_mesh);
      if(f != Graph_traits::null_face() && m_truncated->is_cut(facet_of(f))) {
        Coordinates corner = {};
        auto to = prev(halfedge(f, *m_mesh), *m_mesh); // halfedge to the first corner
        for(int i = 0; i < 3; ++i, to = next(to, *m_mesh))
          if(target(to, *m_mesh) == v) corner[i] = 1;
        const auto place = m_truncated->traced({ facet_of(f), corner });
        m_traced_vertices[n] = m_truncated->facets().point(place.first, place.second);
      }
      ++n;
    }
  }

  const TriangleMesh* m_mesh;
  typename boost::property_map<TriangleMesh, dynamic_face_property_t<Index> >::const_type m_index;
  std::vector<face_descriptor> m_faces;
  std::vector<Coordinates> m_traced_vertices;
  std::unique_ptr<const internal::Truncated_facets> m_truncated; // null if nothing is replaced
  std::shared_ptr<const Shell_closing_3> m_closing;
  Projection_facets_3 m_closing_facets, m_border_edges;
  std::vector<Corner> m_edge_corners; // at the sources of the border edges
  std::unordered_map<Coordinates, Corner, internal::Hash_coordinates> m_border;
  bool m_valid = true;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_PROJECTION_PROJECTION_TARGET_3_H
