// The contents of a mesh file: points, polygons, and everything that is attached to them.
#ifndef TOOL_FILES_MODEL_H
#define TOOL_FILES_MODEL_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace Tool {

namespace BS = CGAL::Bspline_shells;

enum class Element
{
  POINT,
  POLYGON,
  CORNER // corner of a polygon; numbered polygon by polygon
};

enum class Kind
{
  REAL,
  LABEL,
  NORMAL,
  COLOR // real numbers are from 0 to 1, and integers from 0 to 255
};

enum class Number_type
{
  INT8,
  UINT8,
  INT16,
  UINT16,
  INT32,
  UINT32,
  FLOAT32,
  FLOAT64
};

inline bool is_real(Number_type type)
{
  return type == Number_type::FLOAT32 || type == Number_type::FLOAT64;
}

// Values at elements of one kind. A value that the file does not give is NaN.
struct Attribute
{
  std::string name;
  Element element = Element::POINT;
  Kind kind = Kind::REAL;
  Number_type type = Number_type::FLOAT64;
  std::vector<std::string> components; // names of the components
  std::vector<double> values;          // by element, all of its components together
  std::vector<std::string> names;      // labels that the file gives as text: the texts, by label

  std::size_t dimension() const { return components.size(); }
  const double* operator[](std::size_t element) const { return values.data() + element * dimension(); }
  double* operator[](std::size_t element) { return values.data() + element * dimension(); }
  // Returns the label of an element as text.
  std::string text(std::size_t element) const
  {
    const double label = (*this)[element][0];
    return label >= 0 && label < double(names.size()) ? names[std::size_t(label)] : std::to_string(long(label));
  }
};

struct Model
{
  typedef BS::Polygon_soup::Points Points;
  typedef BS::Polygon_soup::Polygons Polygons;

  BS::Polygon_soup soup;
  std::vector<Attribute> attributes; // have the order of the file
  std::vector<std::string> comments; // lines, with the word with which the format begins them
  std::string materials;             // text of the material libraries of an OBJ file
  // materials, textures, and images of a glTF file; null for other formats
  std::shared_ptr<const tinygltf::Model> assets;
  std::string folder;             // folder of the file; texture files are relative to it
  std::vector<std::string> files; // the file, its material libraries, textures, and buffers
  std::string format;             // extension of the file, without its dot
  std::string encoding;           // name of the encoding; empty if the format has only one
  Number_type coordinates = Number_type::FLOAT64;

  bool has_materials() const { return !materials.empty() || assets != nullptr; }
  // Returns the number of the first corner of each polygon, and then the number of all corners.
  std::vector<std::size_t> first_corners() const
  {
    std::vector<std::size_t> first = { 0 };
    for(const auto& polygon : soup.polygons) first.push_back(first.back() + polygon.size());
    return first;
  }
  // Returns null if there is no attribute with these properties.
  const Attribute* find(const std::string& name, Element element) const
  {
    for(const Attribute& a : attributes)
      if(a.name == name && a.element == element) return &a;
    return nullptr;
  }
  const Attribute* find(Kind kind, Element element) const
  {
    for(const Attribute& a : attributes)
      if(a.kind == kind && a.element == element) return &a;
    return nullptr;
  }
};

// name of the standard input and of the standard output
constexpr const char* stream_name = "-";

// names that formats without names of their own use
constexpr const char *color_name = "color", *normal_name = "normal", *texture_name = "texture",
                     *material_name = "material", *group_name = "group", *object_name = "object",
                     *smoothing_name = "smoothing_group", *solid_name = "solid", *facet_attribute_name = "attribute";

// Returns whether an attribute has texture coordinates. Further sets of them are named `texture_1`, `texture_2`, ...
inline bool is_texture(const Attribute& a)
{
  const std::string name = texture_name, prefix = name + "_";
  return a.kind == Kind::REAL && a.element != Element::POLYGON && a.dimension() >= 2
         && (a.name == name || a.name.compare(0, prefix.size(), prefix) == 0);
}

// Returns texture coordinates of corners, or otherwise of points, or null if there are none.
inline const Attribute* texture_coordinates(const Model& model, const std::string& name = texture_name)
{
  const Attribute* found = nullptr;
  for(const Attribute& a : model.attributes)
    if(a.name == name && is_texture(a) && (found == nullptr || a.element == Element::CORNER)) found = &a;
  return found;
}

} // namespace Tool

#endif // TOOL_FILES_MODEL_H
