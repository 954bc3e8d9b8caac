#include "GLTF_accessor.h"
#include "GLTF_assets.h"
#include "MTL_assets.h"
#include "UTF8.h"
#include "materials_of.h"
#include "numbers.h"
#include "read_model.h"
#include "triangles_of.h"
#include "write_model.h"

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace Tool {

namespace {

// An attribute of vertices.
struct Column
{
  const Attribute* attribute;
  std::string semantic;
  Number_type type;
  std::size_t dimension;

  bool is_normalized() const { return attribute->kind == Kind::COLOR && !is_real(type); }
  const double* row(std::size_t corner, std::size_t point) const
  {
    return (*attribute)[attribute->element == Element::CORNER ? corner : point];
  }
  double number(const double* row, std::size_t i) const
  {
    if(std::isnan(row[i])) return 0;
    const bool is_vertical = i == 1 && semantic.compare(0, 9, "TEXCOORD_") == 0;
    const double factor = attribute->kind == Kind::COLOR ? color_factor(attribute->type, type) : 1;
    return rounded_to(type, is_vertical ? 1 - row[i] : row[i] * factor);
  }
};

// Returns the smallest type of vertices that holds all labels, or nothing if there is none.
std::optional<Number_type> type_of_labels(const Attribute& a)
{
  for(Number_type type :
      { Number_type::UINT8, Number_type::INT8, Number_type::UINT16, Number_type::INT16, Number_type::FLOAT32 })
    if(std::all_of(a.values.begin(), a.values.end(), [&](double x) { return rounded_to(type, x) == x; })) return type;
  return std::nullopt;
}

// Chooses the attributes of vertices.
class Columns
{
public:
  // Returns false if the format cannot hold the attribute.
  bool add(const Attribute& a)
  {
    Column column{ &a, "", Number_type::FLOAT32, a.dimension() };
    if(a.element == Element::POLYGON) return false;
    if(a.kind == Kind::NORMAL && a.dimension() == 3) column.semantic = "NORMAL";
    else if(is_texture(a)) {
      column.semantic = "TEXCOORD_" + std::to_string(m_textures++);
      column.dimension = 2;
    } else if(a.kind == Kind::COLOR && (a.dimension() == 3 || a.dimension() == 4)) {
      column.semantic = "COLOR_" + std::to_string(m_colors++);
      if(a.type == Number_type::UINT8) column.type = a.type;
    } else {
      column.semantic = "_" + to_UTF8(a.name);
      std::replace(column.semantic.begin(), column.semantic.end(), ' ', '_');
      const std::optional<Number_type> type = is_real(a.type) ? Number_type::FLOAT32 : type_of_labels(a);
      if(!type || a.dimension() > 4) return false;
      column.type = *type;
    }
    const auto is_equal = [&](const Column& other) { return other.semantic == column.semantic; };
    if(std::any_of(list.begin(), list.end(), is_equal)) return false;
    list.push_back(std::move(column));
    return true;
  }

  std::vector<Column> list;

private:
  int m_textures = 0, m_colors = 0;
};

// Triangles that become a primitive: corners, three by three.
typedef std::vector<std::size_t> Corners;

class GLTF_writer
{
public:
  GLTF_writer(const Model& model, tinygltf::Model& gltf, Written_files& written) : m_model(model), m_gltf(gltf)
  {
    for(const auto& polygon : model.soup.polygons) m_point_of.insert(m_point_of.end(), polygon.begin(), polygon.end());
    for(const char* name : { object_name, group_name, solid_name })
      if(m_object == nullptr) m_object = model.find(name, Element::POLYGON);
    m_material = labels_of_materials(model, gltf);
    // Sets of texture coordinates and colors are numbered: `texture` comes before `texture_1`.
    std::vector<const Attribute*> sorted;
    for(const Attribute& a : model.attributes) sorted.push_back(&a);
    std::stable_sort(sorted.begin(), sorted.end(), [](const Attribute* a, const Attribute* b) {
      return std::make_pair(a->name.size(), a->name) < std::make_pair(b->name.size(), b->name);
    });
    for(const Attribute* a : sorted)
      if(a == m_object || a == m_material || m_columns.add(*a)) written.hold(*a);
      else written.leave_out(*a, "a glTF file");
    set_origin(written);
  }

  // Appends nodes, meshes, and their data to a file with materials.
  void write()
  {
    const auto text_of = [](const Attribute* labels, std::size_t n) {
      return labels != nullptr ? labels->text(n) : "";
    };
    const std::vector<int> known = materials_of_polygons(m_model, m_gltf);
    std::map<std::string, int> others = { { "", -1 } };

    // Polygons with the same object, material, and attributes with values form a primitive.
    typedef std::tuple<std::string, int, std::vector<bool> > Key;
    std::map<Key, Corners> primitives;
    const std::vector<std::size_t> first = m_model.first_corners();
    for(std::size_t n = 0; n < m_model.soup.polygons.size(); ++n) {
      const std::vector<std::array<std::size_t, 3> > triangles = triangles_of(m_model, n);
      if(triangles.empty()) continue;
      int material = known[n];
      if(material < 0) {
        const auto [other, is_new] = others.emplace(text_of(m_material, n), int(m_gltf.materials.size()));
        material = other->second;
        if(is_new) {
          m_gltf.materials.emplace_back();
          m_gltf.materials.back().name = other->first;
        }
      }
      std::vector<bool> has_values;
      for(const Column& column : m_columns.list) has_values.push_back(is_given(column, first[n], first[n + 1]));
      Corners& corners = primitives[{ text_of(m_object, n), material, std::move(has_values) }];
      for(const auto& t : triangles)
        for(std::size_t i : t) corners.push_back(first[n] + i);
    }
    m_gltf.scenes.emplace_back();
    m_gltf.defaultScene = 0;
    for(const auto& [key, corners] : primitives) {
      const auto& [object, material, has_values] = key;
      if(m_gltf.nodes.empty() || m_gltf.nodes.back().name != to_UTF8(object)) add_node(object);
      tinygltf::Primitive primitive = primitive_of(corners, has_values);
      primitive.material = material;
      m_gltf.meshes.back().primitives.push_back(std::move(primitive));
    }
  }

private:
  // Coordinates with more digits than the format holds are written relative to the center, so that fewer are lost.
  void set_origin(Written_files& written)
  {
    const auto& points = m_model.soup.points;
    const auto is_float = [](const auto& p) {
      return p.x() == float(p.x()) && p.y() == float(p.y()) && p.z() == float(p.z());
    };
    if(std::all_of(points.begin(), points.end(), is_float)) return;
    written.warnings.push_back("Coordinates are rounded to single precision: a glTF file cannot store more digits.");
    CGAL::Bbox_3 box;
    for(const auto& p : points) box += p.bbox();
    for(int axis = 0; axis < 3; ++axis) m_origin[std::size_t(axis)] = (box.min(axis) + box.max(axis)) / 2;
  }

  bool is_given(const Column& column, std::size_t first, std::size_t end) const
  {
    for(std::size_t c = first; c < end; ++c)
      if(!std::isnan(column.row(c, m_point_of[c])[0])) return true;
    return false;
  }

  void add_node(const std::string& name)
  {
    tinygltf::Node node;
    node.name = to_UTF8(name);
    node.mesh = int(m_gltf.meshes.size());
    if(m_origin != std::array<double, 3>()) node.translation.assign(m_origin.begin(), m_origin.end());
    m_gltf.meshes.emplace_back();
    m_gltf.scenes[0].nodes.push_back(int(m_gltf.nodes.size()));
    m_gltf.nodes.push_back(std::move(node));
  }

  // Splits points where corners have several values.
  tinygltf::Primitive primitive_of(const Corners& corners, const std::vector<bool>& has_values)
  {
    const std::vector<Column>& columns = m_columns.list;
    std::map<std::vector<double>, std::size_t> index; // vertex by the point and its values
    GLTF_values indices, positions;
    indices.type = Number_type::UINT32;
    positions.dimension = 3;
    std::vector<GLTF_values> values(columns.size());
    for(std::size_t k = 0; k < columns.size(); ++k) {
      values[k].type = columns[k].type;
      values[k].is_normalized = columns[k].is_normalized();
      values[k].dimension = columns[k].dimension;
    }
    for(std::size_t c : corners) {
      const std::size_t point = m_point_of[c];
      std::vector<double> key = { double(point) };
      for(std::size_t k = 0; k < columns.size(); ++k)
        for(std::size_t i = 0; has_values[k] && i < columns[k].dimension; ++i)
          key.push_back(columns[k].number(columns[k].row(c, point), i));
      const auto [vertex, is_new] = index.emplace(std::move(key), index.size());
      indices.values.push_back(double(vertex->second));
      if(!is_new) continue;
      for(int axis = 0; axis < 3; ++axis)
        positions.values.push_back(float(m_model.soup.points[point][axis] - m_origin[std::size_t(axis)]));
      auto value = vertex->first.begin() + 1;
      for(std::size_t k = 0; k < columns.size(); ++k)
        for(std::size_t i = 0; has_values[k] && i < columns[k].dimension; ++i) values[k].values.push_back(*value++);
    }

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.indices = append_accessor(m_gltf, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    const int position = append_accessor(m_gltf, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["POSITION"] = position;
    std::vector<double>&low = m_gltf.accessors.back().minValues, &high = m_gltf.accessors.back().maxValues;
    low.assign(3, std::numeric_limits<double>::infinity());
    high.assign(3, -std::numeric_limits<double>::infinity());
    for(std::size_t n = 0; n < positions.values.size(); ++n) {
      low[n % 3] = (std::min)(low[n % 3], positions.values[n]);
      high[n % 3] = (std::max)(high[n % 3], positions.values[n]);
    }
    for(std::size_t k = 0; k < columns.size(); ++k)
      if(has_values[k])
        primitive.attributes[columns[k].semantic] = append_accessor(m_gltf, values[k], TINYGLTF_TARGET_ARRAY_BUFFER);
    return primitive;
  }

  const Model& m_model;
  tinygltf::Model& m_gltf;
  std::vector<std::size_t> m_point_of; // by corner
  const Attribute *m_object = nullptr, *m_material = nullptr;
  Columns m_columns;
  std::array<double, 3> m_origin = {};
};

} // namespace

void write_GLTF(const Model& model, const std::string& file, Written_files& written)
{
  tinygltf::Model gltf = *materials_of(model);
  if(model.assets == nullptr && has_other_properties(model.materials))
    written.warnings.push_back("A glTF file stores only names, colors (Kd), opacities (d), and color textures (map_Kd, "
                               "with -o, -s, and -clamp) of materials.");
  move_images(gltf, model.folder, std::filesystem::path(file).parent_path().string());
  for(tinygltf::Image& image : gltf.images)
    if(!image.image.empty()) image.bufferView = append_view(gltf, image.image);
  GLTF_writer(model, gltf, written).write();
  for(tinygltf::Material& material : gltf.materials) material.name = to_UTF8(material.name);
  tinygltf::TinyGLTF serializer;
  serializer.SetImageWriter(nullptr, nullptr);
  std::ostringstream text(std::ios::binary);
  serializer.WriteGltfSceneToStream(&gltf, text, true, extension_of(file) == ".glb");
  written.files.emplace_back(file, text.str());
}

} // namespace Tool
