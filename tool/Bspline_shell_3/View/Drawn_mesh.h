// A model as it is drawn: triangles whose corners are vertices with one value of each attribute.
#ifndef TOOL_VIEW_DRAWN_MESH_H
#define TOOL_VIEW_DRAWN_MESH_H

#include "Page.h"
#include "Surface_colors.h"

#include "../Carry/Triangulated_model.h"
#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

// Numbers at the vertices that a color map shows.
struct Channel
{
  std::string title;
  bool has_labels = false;
  std::vector<std::string> names; // labels that the file gives as text: the texts, by label
  std::vector<float> values;      // by vertex; NaN if there is none
};

class Drawn_mesh
{
public:
  // \param colors colors and images of the model's polygons
  Drawn_mesh(const Model& model, const Surface_colors& colors);

  const Mesh& mesh() const { return m_triangulated.mesh(); }
  // Returns the vertex of the mesh at each drawn vertex.
  const std::vector<Mesh::Vertex_index>& vertices() const { return m_vertices; }
  const Mesh::Point& point(std::size_t vertex) const { return mesh().point(m_vertices[vertex]); }

  std::vector<Channel> channels;

  // Adds the arrays. Their names begin with a prefix, and points are relative to a center.
  void write(Page& page, const std::string& prefix, const std::array<double, 3>& center) const;

private:
  Triangulated_model m_triangulated;
  std::vector<Mesh::Vertex_index> m_vertices;
  std::vector<unsigned int> m_triangles;    // three vertices each; those without an image come first
  std::vector<unsigned int> m_groups;       // numbers of triangles: without an image, and then with each image
  std::vector<float> m_texture_coordinates; // two for each vertex; empty if no image is shown
  std::vector<unsigned char> m_colors;      // three for each vertex; empty if the model has none
};

} // namespace Tool

#endif // TOOL_VIEW_DRAWN_MESH_H
