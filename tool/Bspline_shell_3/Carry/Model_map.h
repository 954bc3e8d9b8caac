// The map from a mesh to the polygons of a model.
#ifndef TOOL_CARRY_MODEL_MAP_H
#define TOOL_CARRY_MODEL_MAP_H

#include "Mesh_origins.h"

#include "../Files/Model.h"

#include <CGAL/Bspline_shell_3/Projection/Proxy_projection_3.h>
#include <CGAL/Bspline_shell_3/Projection/Shell_map_3.h>
#include <CGAL/Bspline_shell_3/Soup/Shell_of_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3.h>

#include <memory>
#include <optional>

namespace Tool {

// Points are mapped along curves through the shell of the model, to its mesh. If triangles are excised, or a proxy is
// used, they are mapped to the visible polygons instead. Other points are mapped to the nearest point; if there is no
// certified shell, these are all points.
class Model_map
{
  typedef BS::Proxy_projection_3<Shell, Mesh> Projection;

public:
  typedef BS::Shell_map_3<Shell, Mesh, Mesh, Projection, Projection> Mesh_map; // does not compare components
  typedef BS::Soup_proxy_3::Map Soup_map;

  // \pre the arguments outlive this object
  Model_map(const Model& model, const BS::Shell_of_soup_3& found, const Mesh& mesh) : m_found(&found), m_mesh(&mesh)
  {
    const BS::Certification certification = found.certification();
    if(certification == BS::Certification::WHOLE && !found.proxy) {
      m_mesh_map.emplace(found.shell(), found.mesh(), mesh);
      m_origins.emplace(model, found.mesh());
      return;
    }
    if(!found.proxy) m_soup = std::make_unique<const BS::Soup_mesh_3>(model.soup);
    const Mesh& soup_mesh = found.proxy ? found.proxy->soup().mesh() : m_soup->mesh();
    m_soup_map.emplace(certification == BS::Certification::NONE ? m_no_shell : found.shell(), soup_mesh, mesh);
    m_origins.emplace(model, soup_mesh);
  }
  Model_map(const Model_map&) = delete;
  Model_map& operator=(const Model_map&) = delete;

  const BS::Shell_of_soup_3& found() const { return *m_found; }
  const Mesh& mesh() const { return *m_mesh; }
  // Returns the origins of the source of the map.
  const Mesh_origins& origins() const { return *m_origins; }
  // Calls a function with the map, whose target is the mesh.
  template <typename Function>
  auto visit(const Function& f) const
  {
    return m_mesh_map ? f(*m_mesh_map) : f(*m_soup_map);
  }

private:
  const BS::Shell_of_soup_3* m_found;
  const Mesh* m_mesh;
  const Shell m_no_shell;
  std::unique_ptr<const BS::Soup_mesh_3> m_soup;
  std::optional<Mesh_map> m_mesh_map;
  std::optional<Soup_map> m_soup_map;
  std::optional<Mesh_origins> m_origins;
};

} // namespace Tool

#endif // TOOL_CARRY_MODEL_MAP_H
