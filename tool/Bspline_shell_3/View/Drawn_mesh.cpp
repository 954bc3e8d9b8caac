#include "Drawn_mesh.h"

#include "../Carry/Mix.h"

#include <CGAL/Bspline_shell_3/Support/coordinates.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

namespace Tool {

namespace {

// A component of an attribute that becomes a channel.
struct Drawn_component
{
  const Attribute* attribute;
  std::size_t component;
};

std::vector<Drawn_component> columns_of(const Model& model)
{
  std::vector<Drawn_component> columns;
  for(const Attribute& a : model.attributes)
    if((a.kind == Kind::REAL || a.kind == Kind::LABEL) && a.name != texture_name)
      for(std::size_t i = 0; i < a.dimension(); ++i) columns.push_back({ &a, i });
  return columns;
}

// Numbers the rows of values that differ at a vertex of the mesh.
class Distinct_rows
{
public:
  Distinct_rows(std::size_t vertices, std::size_t width) : m_of_vertex(vertices), m_width(width) {}

  // Returns the number of the row, and whether it is new.
  std::pair<unsigned int, bool> number(Mesh::Vertex_index v, const std::vector<float>& row)
  {
    for(unsigned int n : m_of_vertex[v])
      if(std::memcmp(&values[n * m_width], row.data(), m_width * sizeof(float)) == 0) return { n, false };
    m_of_vertex[v].push_back(m_number);
    values.insert(values.end(), row.begin(), row.end());
    values.resize(std::size_t(m_number + 1) * m_width);
    return { m_number++, true };
  }

  std::vector<float> values;

private:
  std::vector<std::vector<unsigned int> > m_of_vertex;
  std::size_t m_width;
  unsigned int m_number = 0;
};

} // namespace

Drawn_mesh::Drawn_mesh(const Model& model, const Surface_colors& colors) : m_triangulated(model)
{
  const std::vector<Drawn_component> columns = columns_of(model);
  const Attribute* const texture = colors.texture_coordinates();
  const std::size_t of_texture = texture != nullptr ? 2 : 0, of_colors = colors.has_colors() ? 3 : 0;
  const std::size_t width = (std::max)(of_texture + of_colors + columns.size(), std::size_t(1));
  const Mixer mixer(model);
  Distinct_rows rows(mesh().num_vertices(), width);
  std::map<std::size_t, std::vector<unsigned int> > triangles; // by image; those without an image have the number 0
  std::size_t images = 0;
  std::vector<float> row(width, 0);
  for(auto f : mesh().faces()) {
    const std::size_t polygon = m_triangulated.polygon_of(f), image = colors.image(polygon) + 1;
    images = (std::max)(images, image);
    for(auto h : mesh().halfedges_around_face(mesh().halfedge(f))) {
      const std::size_t corner = m_triangulated.corner_at(h);
      const auto value = [&](const Attribute& a, std::size_t i) {
        return float(a[a.element == Element::POLYGON ? polygon : mixer.element(a, corner)][i]);
      };
      for(std::size_t i = 0; i < of_texture; ++i) row[i] = value(*texture, i);
      if(of_colors > 0) {
        const auto color = colors.color(polygon, corner);
        std::copy(color.begin(), color.end(), row.begin() + std::ptrdiff_t(of_texture));
      }
      for(std::size_t c = 0; c < columns.size(); ++c)
        row[of_texture + of_colors + c] = value(*columns[c].attribute, columns[c].component);
      const auto [number, is_new] = rows.number(mesh().target(h), row);
      if(is_new) m_vertices.push_back(mesh().target(h));
      triangles[image].push_back(number);
    }
  }
  for(std::size_t image = 0; image <= images; ++image) {
    const auto& of_image = triangles[image];
    m_groups.push_back(static_cast<unsigned int>(of_image.size() / 3));
    m_triangles.insert(m_triangles.end(), of_image.begin(), of_image.end());
  }
  for(const Drawn_component& c : columns)
    channels.push_back({ c.attribute->dimension() > 1 ? c.attribute->name + " " + c.attribute->components[c.component]
                                                      : c.attribute->name,
                         c.attribute->kind == Kind::LABEL,
                         c.attribute->names,
                         {} });
  for(std::size_t n = 0; n < m_vertices.size(); ++n) {
    const float* const values = &rows.values[n * width];
    m_texture_coordinates.insert(m_texture_coordinates.end(), values, values + of_texture);
    for(std::size_t i = 0; i < of_colors; ++i)
      m_colors.push_back(static_cast<unsigned char>(255 * values[of_texture + i] + 0.5f));
    for(std::size_t c = 0; c < columns.size(); ++c) channels[c].values.push_back(values[of_texture + of_colors + c]);
  }
}

void Drawn_mesh::write(Page& page, const std::string& prefix, const std::array<double, 3>& center) const
{
  std::vector<float> points;
  for(auto v : m_vertices)
    for(int i = 0; i < 3; ++i) points.push_back(float(mesh().point(v)[i] - center[std::size_t(i)]));
  page.add(prefix + ".points", points);
  page.add(prefix + ".triangles", m_triangles);
  page.add(prefix + ".groups", m_groups);
  if(!m_texture_coordinates.empty()) page.add(prefix + ".texture", m_texture_coordinates);
  if(!m_colors.empty()) page.add(prefix + ".colors", m_colors);
  for(std::size_t n = 0; n < channels.size(); ++n) {
    const std::string name = prefix + ".channel" + std::to_string(n);
    page.add(name, channels[n].values, channels[n].title);
    if(!channels[n].has_labels) continue;
    std::string names;
    for(const std::string& label : channels[n].names) names += label + "\n";
    page.add(name + ".labels", "text", names);
  }
}

} // namespace Tool
