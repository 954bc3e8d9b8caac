// The normals of the surface of a model, as colors.
#ifndef TOOL_BAKE_NORMAL_SOURCE_H
#define TOOL_BAKE_NORMAL_SOURCE_H

#include "bake.h"

#include "../Carry/Mix.h"
#include "../Carry/Model_map.h"
#include "../Carry/corner_normals.h"

#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <cstddef>
#include <vector>

namespace Tool {

// Normals are those of the file, or otherwise means of those of facets. Their coordinates from -1 to 1 become colors
// from 0 to 255.
class Normal_source
{
public:
  Normal_source(const Model& model, const Model_map& map) : m_mixer(model)
  {
    for(Element element : { Element::CORNER, Element::POINT })
      if(m_normals == nullptr) m_normals = model.find(Kind::NORMAL, element);
    if(m_normals != nullptr && m_normals->dimension() != 3) m_normals = nullptr;
    map.visit([&](const auto& m) {
      m_mesh = &m.source();
      m_of_vertices.resize(m_mesh->num_vertices());
      for(auto v : m_mesh->vertices())
        m_of_vertices[v] = CGAL::Polygon_mesh_processing::compute_vertex_normal(v, *m_mesh);
    });
  }

  Color operator()(const Source_point& point, const Mix& mix) const
  {
    Vector normal(0, 0, 0);
    if(m_normals != nullptr) {
      const std::vector<double> n = m_mixer(*m_normals, mix);
      normal = Vector(n[0], n[1], n[2]);
    }
    if(!(normal.squared_length() > 0)) {
      normal = Vector(0, 0, 0);
      for(std::size_t i = 0; i < 3; ++i)
        normal = normal + point.weights[i] * m_of_vertices[m_mesh->target(point.corners[i])];
    }
    normal = unit(normal);
    constexpr double half = 127.5;
    return { half * (1 + normal.x()), half * (1 + normal.y()), half * (1 + normal.z()) };
  }

private:
  Mixer m_mixer;
  const Attribute* m_normals = nullptr;
  const Mesh* m_mesh = nullptr;
  std::vector<Vector> m_of_vertices; // of the source of the map
};

} // namespace Tool

#endif // TOOL_BAKE_NORMAL_SOURCE_H
