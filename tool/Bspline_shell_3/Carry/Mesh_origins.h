// Where the facets of a mesh lie in the polygons of a model from which it was made.
#ifndef TOOL_CARRY_MESH_ORIGINS_H
#define TOOL_CARRY_MESH_ORIGINS_H

#include "Mix.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Soup/Soup_proxy_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Tool {

typedef BS::Soup_proxy_3::Mesh Mesh;
typedef BS::Soup_proxy_3::Shell Shell;

// Returns halfedges to the corners of a facet, in the order of barycentric coordinates.
inline std::array<Mesh::Halfedge_index, 3> corners_of(const Mesh& mesh, Mesh::Face_index f)
{
  const auto h = mesh.halfedge(f); // leads to the second corner
  return { mesh.prev(h), h, mesh.next(h) };
}

// A facet belongs to a polygon that has its three corners. If there is none, because points were welded, polygons
// united, or degenerate facets removed, it belongs to the nearest polygon.
class Mesh_origins
{
public:
  // The mesh has triangles.
  Mesh_origins(const Model& model, const Mesh& mesh);

  std::size_t polygon_of(Mesh::Face_index f) const { return m_polygon[f]; }
  // Returns the corner of a facet at the target of a halfedge.
  const Mix& at(Mesh::Halfedge_index h) const { return m_corner[h]; }

private:
  std::vector<std::size_t> m_polygon;
  std::vector<Mix> m_corner;
};

} // namespace Tool

#endif // TOOL_CARRY_MESH_ORIGINS_H
