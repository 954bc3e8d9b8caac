#include "Triangulated_model.h"

#include <CGAL/Bspline_shell_3/Soup/Soup_mesh_3.h>

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <map>

namespace Tool {

Triangulated_model::Triangulated_model(const Model& model) : m_model(&model), m_first(model.first_corners())
{
  const auto& points = model.soup.points;
  std::map<Mesh::Point, std::size_t> first_at;
  for(std::size_t n = 0; n < points.size(); ++n) m_merged.push_back(first_at.emplace(points[n], n).first->second);
  BS::Polygon_soup merged = model.soup;
  for(auto& polygon : merged.polygons)
    for(std::size_t& v : polygon) v = m_merged[v];
  const BS::Soup_mesh_3 soup_mesh(merged);
  m_mesh = soup_mesh.mesh();
  for(auto f : m_mesh.faces()) m_polygon.push_back(soup_mesh.polygon_of(f));
  std::vector<Mesh::Vertex_index> vertex_at(points.size(), Mesh::null_vertex());
  for(auto v : m_mesh.vertices()) {
    m_point.push_back(soup_mesh.point_of(v));
    if(m_mesh.halfedge(v) != Mesh::null_halfedge()) vertex_at[m_point[v]] = v;
  }
  for(std::size_t n : m_merged) m_vertex.push_back(vertex_at[n]);
  find_halfedges();
}

void Triangulated_model::reverse()
{
  CGAL::Polygon_mesh_processing::reverse_face_orientations(m_mesh);
  find_halfedges();
}

std::size_t Triangulated_model::corner_at(Mesh::Halfedge_index h) const
{
  const std::size_t polygon = m_polygon[m_mesh.face(h)];
  const auto& corners = m_model->soup.polygons[polygon];
  std::size_t i = 0;
  while(m_merged[corners[i]] != m_point[m_mesh.target(h)]) ++i;
  return m_first[polygon] + i;
}

void Triangulated_model::find_halfedges()
{
  m_halfedge.assign(m_first.back(), Mesh::null_halfedge());
  for(auto f : m_mesh.faces())
    for(auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f))) m_halfedge[corner_at(h)] = h;
}

} // namespace Tool
