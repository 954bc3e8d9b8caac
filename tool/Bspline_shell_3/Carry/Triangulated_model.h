// A model as a mesh of triangles.
#ifndef TOOL_CARRY_TRIANGULATED_MODEL_H
#define TOOL_CARRY_TRIANGULATED_MODEL_H

#include "Mesh_origins.h"

#include "../Files/Model.h"

#include <cstddef>
#include <vector>

namespace Tool {

// Points at equal positions are one vertex, unless the polygons are not manifold there. Polygons without area are left
// out.
class Triangulated_model
{
public:
  explicit Triangulated_model(const Model& model);

  const Mesh& mesh() const { return m_mesh; }
  // Reverses the orientation of all facets.
  void reverse();

  std::size_t polygon_of(Mesh::Face_index f) const { return m_polygon[f]; }
  // Returns a vertex at a point of the model, or the null vertex if there is none.
  Mesh::Vertex_index vertex_at(std::size_t point) const { return m_vertex[point]; }
  // Returns the corner of the model at the target of a halfedge.
  // \pre the halfedge has a facet
  std::size_t corner_at(Mesh::Halfedge_index h) const;
  // Returns a halfedge to a corner of the model, or the null halfedge if its polygon has no facet there.
  Mesh::Halfedge_index halfedge_to(std::size_t corner) const { return m_halfedge[corner]; }

private:
  void find_halfedges();

  const Model* m_model;
  Mesh m_mesh;
  std::vector<std::size_t> m_polygon;           // by facet
  std::vector<std::size_t> m_first;             // corners of the model, by polygon
  std::vector<std::size_t> m_merged;            // by point of the model: the first point at this position
  std::vector<std::size_t> m_point;             // by vertex: the first point of the model at its position
  std::vector<Mesh::Vertex_index> m_vertex;     // by point of the model
  std::vector<Mesh::Halfedge_index> m_halfedge; // by corner of the model
};

} // namespace Tool

#endif // TOOL_CARRY_TRIANGULATED_MODEL_H
