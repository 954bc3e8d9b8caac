#include "GLTF_assets.h"
#include "MTL.h"
#include "MTL_assets.h"
#include "Words.h"
#include "color_coordinates.h"
#include "materials_of.h"
#include "name_beside.h"
#include "numbers.h"
#include "write_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace Tool {

namespace {

// Lists different values at corners, as OBJ files do.
class Indexed_values
{
public:
  Indexed_values(const char* keyword, const Attribute* attribute) : m_keyword(keyword), m_attribute(attribute) {}

  // Returns the index, from 1, of the value at a corner or a point, or 0 if it has none. New values are appended.
  std::size_t index(std::size_t corner, std::size_t point, std::string& text)
  {
    if(m_attribute == nullptr) return 0;
    const double* const value = (*m_attribute)[m_attribute->element == Element::CORNER ? corner : point];
    if(std::isnan(value[0])) return 0;
    const std::vector<double> key(value, value + m_attribute->dimension());
    const auto found = m_index.emplace(key, m_index.size() + 1);
    if(found.second) {
      text += m_keyword;
      for(double x : key) {
        text += ' ';
        append_number(text, x);
      }
      text += '\n';
    }
    return found.first->second;
  }

private:
  const char* m_keyword;
  const Attribute* m_attribute;
  std::map<std::vector<double>, std::size_t> m_index;
};

// A line for each state of polygons that the format has, in the order in which it is written.
const std::array<std::pair<const char*, const char*>, 4> states = {
  { { object_name, "o" }, { group_name, "g" }, { material_name, "usemtl" }, { smoothing_name, "s" } }
};
constexpr std::size_t group_state = 1, material_state = 2;

} // namespace

void write_OBJ(const Model& model, const std::string& file, Written_files& written)
{
  const std::shared_ptr<const tinygltf::Model> gltf = materials_of(model);
  const std::vector<int> material_of = materials_of_polygons(model, *gltf);
  const Attribute *colors = nullptr, *texture = nullptr, *normals = nullptr;
  std::array<const Attribute*, 4> labels = {};
  for(const Attribute& a : model.attributes) {
    const Attribute** place = nullptr;
    if(a.element == Element::POLYGON) {
      for(std::size_t s = 0; s < states.size(); ++s)
        if(s != material_state && a.kind == Kind::LABEL && a.name == states[s].first) place = &labels[s];
      if(a.kind == Kind::LABEL && a.name == solid_name) place = &labels[group_state];
      if(&a == labels_of_materials(model, *gltf)) place = &labels[material_state];
    } else if(a.kind == Kind::NORMAL) place = &normals;
    else if(a.name == texture_name && a.kind == Kind::REAL) place = &texture;
    else if(a.kind == Kind::COLOR && a.element == Element::POINT && a.dimension() >= 3) place = &colors;
    if(place != nullptr && *place == nullptr) {
      *place = &a;
      written.hold(a);
    } else written.leave_out(a, "an OBJ file");
  }
  if(colors != nullptr && colors->dimension() > 3)
    written.warnings.push_back("Opacities of points are omitted: an OBJ file cannot store them.");

  std::optional<Attribute> placed; // texture coordinates for the images of the materials
  if(model.assets != nullptr) placed = color_coordinates(model, *gltf, material_of);
  if(placed) texture = &*placed;

  std::string text;
  for(const std::string& comment : model.comments)
    if(comment.front() == '#') text += comment + "\n";
  const std::filesystem::path path(file);
  if(model.has_materials() || !gltf->materials.empty()) {
    const std::string usual = path.stem().string() + ".mtl";
    const bool is_kept = model.assets == nullptr && !model.materials.empty();
    std::string materials = is_kept ? moved_materials(model.materials, model.folder, path.parent_path().string())
                                    : MTL_of_assets(*gltf, model.folder, file, written);
    if(model.assets != nullptr)
      written.warnings.push_back("An OBJ file stores only names, colors, opacities, and color textures of materials.");
    const std::string library = name_beside(file, ".mtl", materials);
    if(library != usual)
      written.warnings.push_back("The material library is " + library + ", because " + usual
                                 + " belongs to another model.");
    text += "mtllib " + library + "\n";
    written.files.emplace_back((path.parent_path() / library).string(), std::move(materials));
  }
  for(std::size_t n = 0; n < model.soup.points.size(); ++n) {
    text += "v";
    for(int axis = 0; axis < 3; ++axis) {
      text += ' ';
      append_number(text, model.soup.points[n][axis]);
    }
    for(std::size_t i = 0; i < 3 && colors != nullptr && !std::isnan((*colors)[n][i]); ++i) {
      text += ' ';
      append_number(text, (*colors)[n][i] * color_factor(colors->type, Number_type::FLOAT64));
    }
    text += '\n';
  }

  // Polygons with the same states follow each other.
  const std::vector<std::size_t> first = model.first_corners();
  std::vector<std::size_t> order(model.soup.polygons.size());
  std::iota(order.begin(), order.end(), 0);
  const auto label = [&](std::size_t s, std::size_t n) { return labels[s] != nullptr ? (*labels[s])[n][0] : 0; };
  const std::vector<std::string> names = material_names(*gltf);
  const auto text_of = [&](std::size_t s, std::size_t n) {
    if(s == material_state && material_of[n] >= 0) return names[std::size_t(material_of[n])];
    return labels[s] != nullptr ? labels[s]->text(n) : "";
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t n, std::size_t m) {
    for(std::size_t s = 0; s < states.size(); ++s)
      if(label(s, n) != label(s, m)) return label(s, n) < label(s, m);
    return false;
  });
  Indexed_values texture_values("vt", texture), normal_values("vn", normals);
  std::array<std::string, 4> current; // The states of a file begin with empty texts.
  for(std::size_t n : order) {
    for(std::size_t s = 0; s < states.size(); ++s) {
      const std::string state = text_of(s, n);
      if(state == current[s]) continue;
      text += std::string(states[s].second) + " " + state + "\n";
      current[s] = state;
    }
    std::string line = "f";
    for(std::size_t i = 0; i < model.soup.polygons[n].size(); ++i) {
      const std::size_t point = model.soup.polygons[n][i], corner = first[n] + i;
      const std::size_t vt = texture_values.index(corner, point, text), vn = normal_values.index(corner, point, text);
      line += ' ' + std::to_string(point + 1);
      if(vt > 0 || vn > 0) line += '/';
      if(vt > 0) line += std::to_string(vt);
      if(vn > 0) line += '/' + std::to_string(vn);
    }
    text += line + '\n';
  }
  written.files.insert(written.files.begin(), { file, std::move(text) });
}

} // namespace Tool
