#include "PLY_types.h"
#include "Words.h"
#include "numbers.h"
#include "texture_comments.h"
#include "write_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace Tool {

namespace {

class Output
{
public:
  Output(std::string& text, const std::string& encoding)
    : m_text(text), m_is_text(encoding == "ascii"), m_swaps(encoding == "binary_big_endian")
  {}

  void number(Number_type type, double x)
  {
    with_type(type, [&](auto zero) { number(rounded_to<decltype(zero)>(x)); });
  }
  void end_row()
  {
    if(m_is_text) m_text.back() = '\n';
  }

private:
  template <typename T>
  void number(T x)
  {
    if(m_is_text) {
      if constexpr(std::numeric_limits<T>::is_integer) m_text += std::to_string(x);
      else append_number(m_text, x);
      m_text += ' ';
      return;
    }
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &x, bytes.size());
    if(m_swaps) std::reverse(bytes.begin(), bytes.end());
    m_text.append(bytes.data(), bytes.size());
  }

  std::string& m_text;
  bool m_is_text, m_swaps;
};

// Returns names of properties for the components of an attribute of another format.
std::vector<std::string> property_names(const Attribute& attribute)
{
  std::string name = attribute.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  if(attribute.dimension() == 1) return { name };
  const auto group = std::find_if(PLY_groups.begin(), PLY_groups.end(),
                                  [&](const PLY_group& g) { return attribute.name == g.attribute; });
  std::vector<std::string> names;
  for(std::size_t i = 0; i < attribute.dimension(); ++i)
    names.push_back(group != PLY_groups.end() && i < 4 && !group->properties[i].empty()
                      ? std::string(group->properties[i])
                      : name + "_" + std::to_string(i));
  return names;
}

} // namespace

void write_PLY(const Model& model, const std::string& file, Written_files& written)
{
  // A binary STL file has the encoding "binary", and comments that a PLY file cannot hold.
  const bool is_of_format = model.encoding == "ascii" || model.encoding.compare(0, 7, "binary_") == 0;
  const std::string encoding = is_of_format ? model.encoding : "binary_little_endian";
  std::string text = "ply\nformat " + encoding + " 1.0\n";
  const auto is_texture = [](const Attribute& a) { return a.name == texture_name && a.dimension() == 2; };
  std::vector<const Attribute*> of_points, of_polygons;
  const Attribute* corners = nullptr;
  for(const Attribute& a : model.attributes) {
    if(a.element == Element::POINT) of_points.push_back(&a);
    else if(a.element == Element::POLYGON) of_polygons.push_back(&a);
    else if(is_texture(a) && corners == nullptr) corners = &a;
    else {
      written.warnings.push_back("The attribute \"" + a.name
                                 + "\" is omitted: a PLY file cannot store values of corners, except for texture "
                                   "coordinates.");
      continue;
    }
    written.hold(a);
  }
  if(model.has_materials()) written.warnings.push_back("The material library is omitted: a PLY file cannot store it.");

  const auto properties = [&](const Attribute& a) { return is_of_format ? a.components : property_names(a); };
  const std::string folder = std::filesystem::path(file).parent_path().string();
  for(const std::string& comment : model.comments)
    if(is_texture_comment(comment))
      text += texture_comment + moved_name(comment.substr(texture_comment.size()), model.folder, folder) + "\n";
    else if(is_of_format) text += comment + "\n";
  for(const Attribute& a : model.attributes)
    for(std::size_t n = 0; n < a.names.size(); ++n)
      text += std::string(PLY_label) + properties(a)[0] + " " + std::to_string(n)
              + (a.names[n].empty() ? "" : " " + a.names[n]) + "\n";
  const auto declare = [&](const Attribute& a) {
    for(const std::string& name : properties(a))
      text += std::string("property ") + PLY_name(a.type) + " " + name + "\n";
  };
  const bool are_floats = model.coordinates == Number_type::FLOAT32
                          && std::all_of(model.soup.points.begin(), model.soup.points.end(), [](const auto& p) {
                               return p.x() == float(p.x()) && p.y() == float(p.y()) && p.z() == float(p.z());
                             });
  const Number_type coordinate = are_floats ? Number_type::FLOAT32 : Number_type::FLOAT64;
  text += "element vertex " + std::to_string(model.soup.points.size()) + "\n";
  for(char axis : { 'x', 'y', 'z' }) text += std::string("property ") + PLY_name(coordinate) + " " + axis + "\n";
  for(const Attribute* a : of_points) declare(*a);
  text += "element face " + std::to_string(model.soup.polygons.size()) + "\n";
  const bool is_long = std::any_of(model.soup.polygons.begin(), model.soup.polygons.end(),
                                   [](const auto& polygon) { return polygon.size() > 127; });
  const Number_type size = is_long ? Number_type::INT32 : Number_type::UINT8;
  const std::string list = std::string("property list ") + PLY_name(size) + " ";
  text += list + "int vertex_indices\n";
  for(const Attribute* a : of_polygons) declare(*a);
  if(corners != nullptr) text += list + PLY_name(corners->type) + " " + PLY_corner_texture + "\n";
  text += "end_header\n";

  Output out(text, encoding);
  const auto append = [&](const Attribute& a, std::size_t n) {
    for(std::size_t i = 0; i < a.dimension(); ++i) out.number(a.type, a[n][i]);
  };
  for(std::size_t n = 0; n < model.soup.points.size(); ++n) {
    for(int axis = 0; axis < 3; ++axis) out.number(coordinate, model.soup.points[n][axis]);
    for(const Attribute* a : of_points) append(*a, n);
    out.end_row();
  }
  std::size_t corner = 0;
  for(std::size_t n = 0; n < model.soup.polygons.size(); ++n) {
    const auto& polygon = model.soup.polygons[n];
    out.number(size, double(polygon.size()));
    for(std::size_t v : polygon) out.number(Number_type::INT32, double(v));
    for(const Attribute* a : of_polygons) append(*a, n);
    if(corners != nullptr) {
      const bool is_known = !std::isnan((*corners)[corner][0]);
      out.number(size, is_known ? 2. * double(polygon.size()) : 0);
      for(std::size_t i = 0; is_known && i < polygon.size(); ++i) append(*corners, corner + i);
    }
    corner += polygon.size();
    out.end_row();
  }
  written.files.emplace_back(file, std::move(text));
}

} // namespace Tool
