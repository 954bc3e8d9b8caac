// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_BACKUP_H
#define CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_BACKUP_H

#include <CGAL/Bspline_shell_3/Editing/internal/Edge_constraints.h>

#include <CGAL/Surface_mesh/Surface_mesh_fwd.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether a restored mesh has its original elements, so that external descriptors remain valid.
template <typename TriangleMesh>
bool is_restored_in_place(const TriangleMesh&)
{
  return false;
}
template <typename Point>
bool is_restored_in_place(const Surface_mesh<Point>& mesh)
{
  return !mesh.has_garbage();
}

template <typename TriangleMesh>
void assign(const TriangleMesh& before, TriangleMesh& mesh)
{
  mesh = before;
}

// Assignment to a Surface_mesh would replace its properties. The caller's maps would dangle, and dynamic maps would
// remove other properties when they are destroyed. The mesh is therefore emptied and filled again.
// \pre `before` is a copy of the original mesh
template <typename Point>
void assign(const Surface_mesh<Point>& before, Surface_mesh<Point>& mesh)
{
  for(auto v : mesh.vertices()) mesh.remove_vertex(v);
  for(auto e : mesh.edges()) mesh.remove_edge(e);
  for(auto f : mesh.faces()) mesh.remove_face(f);
  mesh.collect_garbage();
  mesh.join(before);
}

// A copy of a mesh before an edit, with the values of its maps of points and of constrained edges.
template <typename TriangleMesh, typename VertexPointMap>
class Mesh_backup
{
  typedef typename boost::property_map<TriangleMesh, vertex_point_t>::type Point_map_of_mesh;
  static constexpr bool has_own_points = std::is_same<VertexPointMap, Point_map_of_mesh>::value;
public:
  typedef typename boost::property_traits<VertexPointMap>::value_type Point;

  Mesh_backup(const TriangleMesh& mesh, VertexPointMap vpm, const Edge_constraints<TriangleMesh>& constraints)
    : m_mesh(mesh), m_vpm(vpm), m_constraints(constraints)
  {
    for(auto v : vertices(mesh)) m_points.push_back(get(vpm, v));
    if(m_constraints.is_writable()) // other maps need no copy
      for(auto e : edges(mesh)) m_is_constrained.push_back(get(m_constraints, e) ? 1 : 0);
  }

  // Returns the points in the order of vertices(mesh).
  const std::vector<Point>& points() const { return m_points; }

  // Restores the original mesh. Its elements are new, unless it is restored in place.
  void restore(TriangleMesh& mesh)
  {
    if(m_constraints.is_writable())
      for(auto e : edges(mesh)) put(m_constraints, e, false); // edges may be keys of the map, and vanish
    assign(m_mesh, mesh);
    std::size_t n = 0;
    if constexpr(!has_own_points)
      for(auto v : vertices(mesh)) put(m_vpm, v, m_points[n++]);
    n = 0;
    if(m_constraints.is_writable())
      for(auto e : edges(mesh)) put(m_constraints, e, m_is_constrained[n++] != 0);
  }

private:
  TriangleMesh m_mesh;
  VertexPointMap m_vpm;
  Edge_constraints<TriangleMesh> m_constraints;
  std::vector<Point> m_points;
  std::vector<char> m_is_constrained; // values, ordered as edges(mesh)
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_EDITING_INTERNAL_MESH_BACKUP_H
