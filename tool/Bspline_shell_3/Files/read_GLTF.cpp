#include "GLTF_accessor.h"
#include "GLTF_assets.h"
#include "read_model.h"

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace Tool {

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Aff_transformation_3<Kernel> Transform;

// A primitive of a node: triangles that refer to its vertices.
struct Part
{
  std::vector<std::array<std::size_t, 3> > triangles;
  GLTF_values positions;
  std::map<std::string, GLTF_values> values; // by semantic
  std::size_t material = 0, object = 0;      // labels
};

// An attribute without values for the semantic of an attribute of vertices, or nothing if it is not carried.
std::optional<Attribute> attribute_of(const std::string& semantic)
{
  const auto named = [&](const char* name, const char* prefix) {
    const std::string number = semantic.substr(std::strlen(prefix));
    return number == "0" ? std::string(name) : name + ("_" + number);
  };
  Attribute a;
  a.element = Element::CORNER;
  if(semantic == "NORMAL") {
    a.name = normal_name;
    a.kind = Kind::NORMAL;
    a.components = { "nx", "ny", "nz" };
  } else if(semantic.compare(0, 9, "TEXCOORD_") == 0) {
    a.name = named(texture_name, "TEXCOORD_");
    a.components = { "u", "v" };
  } else if(semantic.compare(0, 6, "COLOR_") == 0) {
    a.name = named(color_name, "COLOR_");
    a.kind = Kind::COLOR;
    a.components = { "red", "green", "blue", "alpha" };
  } else if(semantic.size() > 1 && semantic.front() == '_') a.name = semantic.substr(1);
  else return std::nullopt;
  return a;
}

std::optional<Transform> transform_of(const tinygltf::Node& node)
{
  const std::vector<double>&m = node.matrix, &t = node.translation, &r = node.rotation, &s = node.scale;
  if(m.size() == 16) return Transform(m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14], 1);
  if(!m.empty() || (!t.empty() && t.size() != 3) || (!r.empty() && r.size() != 4) || (!s.empty() && s.size() != 3))
    return std::nullopt;
  Transform transform(CGAL::IDENTITY);
  if(!t.empty()) transform = transform * Transform(CGAL::TRANSLATION, Kernel::Vector_3(t[0], t[1], t[2]));
  if(!r.empty()) {
    const double x = r[0], y = r[1], z = r[2], w = r[3];
    transform = transform
                * Transform(1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), //
                            2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), //
                            2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 1);
  }
  if(!s.empty()) transform = transform * Transform(s[0], 0, 0, 0, s[1], 0, 0, 0, s[2], 1);
  return transform;
}

// Transforms normals by the matrix of cofactors, so that they remain normal to surfaces.
void transform_normals(const Transform& t, GLTF_values& normals)
{
  const auto cofactor = [&](int i, int j) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return t.m(i1, j1) * t.m(i2, j2) - t.m(i1, j2) * t.m(i2, j1);
  };
  const Transform cofactors(cofactor(0, 0), cofactor(0, 1), cofactor(0, 2), cofactor(1, 0), cofactor(1, 1),
                            cofactor(1, 2), cofactor(2, 0), cofactor(2, 1), cofactor(2, 2), t.is_odd() ? -1 : 1);
  normals.make_real();
  for(std::size_t n = 0; n + 2 < normals.values.size(); n += 3) {
    const Kernel::Vector_3 v = cofactors.transform(
      Kernel::Vector_3(normals.values[n], normals.values[n + 1], normals.values[n + 2]));
    const double length = std::sqrt(v.squared_length());
    for(int i = 0; i < 3 && length > 0; ++i) normals.values[n + std::size_t(i)] = v[i] / length;
  }
}

bool is_translation(const Transform& t)
{
  for(int i = 0; i < 3; ++i)
    for(int j = 0; j < 3; ++j)
      if(t.m(i, j) != (i == j ? 1 : 0)) return false;
  return true;
}

class GLTF_reader
{
public:
  GLTF_reader(const tinygltf::Model& gltf, Model& model, File_report& report)
    : m_gltf(gltf), m_model(model), m_report(report)
  {}

  bool read()
  {
    const auto assets = std::make_shared<tinygltf::Model>(assets_of(m_gltf));
    for(std::size_t n = 0; n < m_gltf.images.size(); ++n)
      if(m_gltf.images[n].bufferView >= 0 && assets->images[n].image.empty())
        return fail("The image " + std::to_string(n) + " is not in its buffer.");
    if(!read_nodes()) return false;
    add_points();
    add_attributes();
    const std::vector<std::string> names = material_names(*assets);
    m_materials.insert(m_materials.end(), names.begin(), names.end());
    add_labels(object_name, m_objects, &Part::object);
    add_labels(material_name, m_materials, &Part::material);
    name_left_out();
    if(!names.empty()) m_model.assets = assets;
    return true;
  }

private:
  bool fail(const std::string& reason)
  {
    m_report.warnings.push_back(reason);
    return false;
  }

  bool read_nodes()
  {
    std::vector<std::pair<int, Transform> > nodes;
    const auto add = [&](const std::vector<int>& indices, const Transform& parent) {
      for(auto n = indices.rbegin(); n != indices.rend(); ++n) nodes.emplace_back(*n, parent);
    };
    const std::size_t scene = m_gltf.defaultScene >= 0 ? std::size_t(m_gltf.defaultScene) : 0;
    if(scene < m_gltf.scenes.size()) add(m_gltf.scenes[scene].nodes, Transform(CGAL::IDENTITY));
    else if(m_gltf.defaultScene < 0) add(roots(), Transform(CGAL::IDENTITY));
    else return fail("The scene " + std::to_string(scene) + " does not exist.");
    std::set<int> visited;
    while(!nodes.empty()) {
      const auto [index, parent] = nodes.back();
      nodes.pop_back();
      const std::string name = "The node " + std::to_string(index);
      if(index < 0 || std::size_t(index) >= m_gltf.nodes.size()) return fail(name + " does not exist.");
      if(!visited.insert(index).second) return fail(name + " has several parents.");
      const tinygltf::Node& node = m_gltf.nodes[std::size_t(index)];
      const std::optional<Transform> own = transform_of(node);
      if(!own) return fail("The transformation of node " + std::to_string(index) + " does not have the right size.");
      const Transform transform = parent * *own;
      add(node.children, transform);
      if(node.mesh >= 0 && !read_mesh(node, transform)) return false;
    }
    return true;
  }

  // Returns the nodes without parents, which are those of files without scenes.
  std::vector<int> roots() const
  {
    std::set<int> children;
    for(const tinygltf::Node& node : m_gltf.nodes) children.insert(node.children.begin(), node.children.end());
    std::vector<int> found;
    for(int n = 0; n < int(m_gltf.nodes.size()); ++n)
      if(children.count(n) == 0) found.push_back(n);
    return found;
  }

  bool read_mesh(const tinygltf::Node& node, const Transform& transform)
  {
    if(std::size_t(node.mesh) >= m_gltf.meshes.size())
      return fail("The mesh " + std::to_string(node.mesh) + " does not exist.");
    const tinygltf::Mesh& mesh = m_gltf.meshes[std::size_t(node.mesh)];
    const std::string name = node.name.empty() ? mesh.name : node.name;
    const auto [object, is_new] = m_object_labels.emplace(name, m_objects.size());
    if(is_new) m_objects.push_back(name);
    for(std::size_t n = 0; n < mesh.primitives.size(); ++n) {
      const tinygltf::Primitive& primitive = mesh.primitives[n];
      if(primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        m_left_out.insert("Primitives that are points or lines");
        continue;
      }
      Part part;
      part.object = object->second;
      // The place of a mesh with a skin follows from its joints, and not from its node.
      if(!read_primitive(primitive, node.skin >= 0 ? Transform(CGAL::IDENTITY) : transform, part))
        return fail("The primitive " + std::to_string(n) + " of mesh " + std::to_string(node.mesh)
                    + (m_report ? " is damaged." : " is not finite."));
      m_parts.push_back(std::move(part));
    }
    return true;
  }

  bool read_primitive(const tinygltf::Primitive& primitive, const Transform& transform, Part& part)
  {
    if(!primitive.targets.empty()) m_left_out.insert("Morph targets");
    if(primitive.material >= 0) part.material = std::size_t(primitive.material) + 1;
    if(part.material > m_gltf.materials.size()) return false;
    for(const auto& [semantic, accessor] : primitive.attributes) {
      const bool is_position = semantic == "POSITION";
      if(!is_position && !attribute_of(semantic)) {
        m_left_out.insert("Attributes \"" + semantic + "\"");
        continue;
      }
      std::optional<GLTF_values> values = read_accessor(m_gltf, accessor);
      if(!values) return false;
      if(is_position) part.positions = std::move(*values);
      else part.values.emplace(semantic, std::move(*values));
    }
    GLTF_values& positions = part.positions;
    const std::size_t size = positions.size();
    if(positions.dimension != 3) return false;
    positions.make_real();
    for(std::size_t n = 0; n < size; ++n) {
      double* const x = &positions.values[3 * n];
      const auto p = transform.transform(Kernel::Point_3(x[0], x[1], x[2]));
      for(int i = 0; i < 3; ++i) x[i] = p[i];
      if(!std::all_of(x, x + 3, [](double coordinate) { return std::isfinite(coordinate); })) {
        m_report.status = File_status::NOT_FINITE;
        return false;
      }
    }
    for(auto& [semantic, values] : part.values) {
      if(values.size() != size || (semantic == "NORMAL" && values.dimension != 3)) return false;
      if(semantic == "NORMAL" && !is_translation(transform)) transform_normals(transform, values);
    }
    return read_triangles(primitive, size, transform.is_odd(), part.triangles);
  }

  bool read_triangles(const tinygltf::Primitive& primitive, std::size_t vertices, bool is_reflected,
                      std::vector<std::array<std::size_t, 3> >& triangles) const
  {
    std::vector<std::size_t> indices;
    if(primitive.indices >= 0) {
      const std::optional<GLTF_values> values = read_accessor(m_gltf, primitive.indices);
      if(!values || values->dimension != 1) return false;
      for(double index : values->values) {
        if(!(index >= 0 && index < double(vertices))) return false;
        indices.push_back(std::size_t(index));
      }
    } else
      for(std::size_t n = 0; n < vertices; ++n) indices.push_back(n);
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    for(std::size_t n = 0; n + 2 < indices.size(); n += is_list ? 3 : 1) {
      std::array<std::size_t, 3> t = { indices[n], indices[n + 1], indices[n + 2] };
      if(primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) t = { indices[0], indices[n + 1], indices[n + 2] };
      else if(!is_list && n % 2 == 1) std::swap(t[1], t[2]);
      // Triangles without area connect the parts of a strip.
      if(!is_list && (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])) continue;
      if(is_reflected) std::swap(t[1], t[2]);
      triangles.push_back(t);
    }
    return true;
  }

  // Vertices at equal positions are one point: the format splits points that have several values.
  void add_points()
  {
    std::map<std::array<double, 3>, std::size_t> index;
    bool are_floats = true;
    for(const Part& part : m_parts)
      for(const auto& t : part.triangles) {
        m_model.soup.polygons.emplace_back();
        for(std::size_t v : t) {
          const double* const x = &part.positions.values[3 * v];
          const auto found = index.emplace(std::array<double, 3>{ x[0], x[1], x[2] }, m_model.soup.points.size());
          if(found.second) m_model.soup.points.emplace_back(x[0], x[1], x[2]);
          m_model.soup.polygons.back().push_back(found.first->second);
          for(int i = 0; i < 3; ++i) are_floats = are_floats && x[i] == float(x[i]);
        }
      }
    m_model.coordinates = are_floats ? Number_type::FLOAT32 : Number_type::FLOAT64;
  }

  void add_attributes()
  {
    std::set<std::string> semantics;
    for(const Part& part : m_parts)
      for(const auto& values : part.values) semantics.insert(values.first);
    for(const std::string& semantic : semantics) {
      Attribute a = *attribute_of(semantic);
      make_equal_types(semantic, a);
      const bool is_texture = semantic.compare(0, 9, "TEXCOORD_") == 0;
      const double opaque = is_real(a.type) ? 1 : 255;
      for(const Part& part : m_parts) {
        const auto found = part.values.find(semantic);
        for(const auto& t : part.triangles)
          for(std::size_t v : t)
            for(std::size_t i = 0; i < a.dimension(); ++i) {
              const bool is_given = found != part.values.end() && i < found->second.dimension;
              const double x = is_given ? found->second.values[v * found->second.dimension + i]
                               : found != part.values.end() && a.kind == Kind::COLOR
                                 ? opaque
                                 : std::numeric_limits<double>::quiet_NaN();
              // In this format, images begin at the top.
              a.values.push_back(is_texture && i == 1 ? 1 - x : x);
            }
      }
      give_to_points(a);
      m_model.attributes.push_back(std::move(a));
    }
  }

  // Gives an attribute the type and the components that all parts can have.
  void make_equal_types(const std::string& semantic, Attribute& a)
  {
    std::vector<GLTF_values*> all;
    for(Part& part : m_parts) {
      const auto found = part.values.find(semantic);
      if(found != part.values.end()) all.push_back(&found->second);
    }
    const GLTF_values& first = *all[0];
    std::size_t dimension = 0;
    const bool is_own = semantic.front() == '_';
    bool is_kept = a.kind == Kind::COLOR ? first.type == Number_type::UINT8 : is_own && !first.is_normalized;
    for(const GLTF_values* values : all) {
      dimension = (std::max)(dimension, values->dimension);
      is_kept = is_kept && values->type == first.type && values->is_normalized == first.is_normalized;
    }
    if(!is_kept)
      for(GLTF_values* values : all) values->make_real();
    a.type = first.type;
    if(!is_real(a.type) && a.kind == Kind::REAL) a.kind = Kind::LABEL;
    if(!a.components.empty()) a.components.resize((std::min)(dimension, a.components.size()));
    else
      for(std::size_t i = 0; i < dimension; ++i)
        a.components.push_back(dimension == 1 ? a.name : a.name + "_" + std::to_string(i));
  }

  // Makes an attribute one of points if all corners at each point have equal values.
  void give_to_points(Attribute& a) const
  {
    const std::size_t dimension = a.dimension();
    std::vector<double> of_points(m_model.soup.points.size() * dimension);
    std::vector<char> is_known(m_model.soup.points.size(), 0);
    std::size_t corner = 0;
    for(const auto& polygon : m_model.soup.polygons)
      for(std::size_t v : polygon) {
        const double* const value = a[corner++];
        double* const known = of_points.data() + v * dimension;
        if(is_known[v] == 0) std::copy_n(value, dimension, known);
        else if(std::memcmp(value, known, dimension * sizeof *value) != 0) return;
        is_known[v] = 1;
      }
    a.element = Element::POINT;
    a.values = std::move(of_points);
  }

  void add_labels(const char* name, const std::vector<std::string>& texts, std::size_t Part::*label)
  {
    if(texts.size() < 2) return;
    Attribute a{ name, Element::POLYGON, Kind::LABEL, Number_type::INT32, { name }, {}, texts };
    for(const Part& part : m_parts) a.values.insert(a.values.end(), part.triangles.size(), double(part.*label));
    m_model.attributes.push_back(std::move(a));
  }

  void name_left_out()
  {
    if(!m_gltf.skins.empty()) m_left_out.insert("Skins");
    if(!m_gltf.animations.empty()) m_left_out.insert("Animations");
    if(!m_gltf.cameras.empty()) m_left_out.insert("Cameras");
    if(!m_gltf.lights.empty()) m_left_out.insert("Lights");
    const auto& used = m_gltf.extensionsUsed;
    if(std::find(used.begin(), used.end(), "EXT_mesh_gpu_instancing") != used.end())
      m_left_out.insert("Instances of meshes (EXT_mesh_gpu_instancing)");
    if(m_gltf.scenes.size() > 1) m_left_out.insert("Scenes that are not the default one");
    for(const std::string& item : m_left_out) m_report.warnings.push_back(item + " are omitted.");
  }

  const tinygltf::Model& m_gltf;
  Model& m_model;
  File_report& m_report;
  std::vector<Part> m_parts;
  std::vector<std::string> m_objects = { "" }, m_materials = { "" }; // texts by label
  std::map<std::string, std::size_t> m_object_labels = { { "", 0 } };
  std::set<std::string> m_left_out;
};

// Keeps images that the file contains as they are.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                void*)
{
  if(image->uri.empty() && image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

// Returns whether a file can be read without the extension, or the extension is kept with the materials.
bool is_supported_extension(const std::string& name)
{
  const auto begins_with = [&](const char* prefix) { return name.compare(0, std::strlen(prefix), prefix) == 0; };
  return name == "KHR_mesh_quantization" || name == "KHR_lights_punctual" || begins_with("KHR_materials_")
         || begins_with("KHR_texture_") || begins_with("EXT_texture_");
}

bool parse(std::string_view text, const std::string& folder, tinygltf::Model& gltf, std::string& reason)
{
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_image, nullptr);
  std::string warnings; // about images; they are not needed
  try {
    return text.substr(0, 4) == "glTF"
             ? parser.LoadBinaryFromMemory(&gltf, &reason, &warnings,
                                           reinterpret_cast<const unsigned char*>(text.data()), unsigned(text.size()),
                                           folder)
             : parser.LoadASCIIFromString(&gltf, &reason, &warnings, text.data(), unsigned(text.size()), folder);
  } catch(const std::exception& error) {
    reason = error.what();
    return false;
  }
}

} // namespace

File_report read_GLTF(std::string_view text, Model& model)
{
  File_report report;
  tinygltf::Model gltf;
  std::string reason;
  const bool is_parsed = parse(text, model.folder, gltf, reason);
  for(const std::string& name : gltf.extensionsRequired)
    if(!is_supported_extension(name)) {
      report.status = File_status::UNSUPPORTED_EXTENSION;
      report.warnings.push_back("The file requires the extension " + name + ".");
    }
  if(!report) return report;
  if(!is_parsed && !reason.empty()) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    report.warnings.push_back(reason);
  }
  for(const std::string& name : external_files(gltf)) {
    model.files.push_back((std::filesystem::path(model.folder) / name).string());
    std::error_code error;
    if(!std::filesystem::exists(model.files.back(), error))
      report.warnings.push_back("The file " + name + " does not exist.");
  }
  const bool is_read = is_parsed && GLTF_reader(gltf, model, report).read();
  if(!is_read && report) report.status = File_status::MALFORMED;
  return report;
}

} // namespace Tool
