// Names that PLY files use.
#ifndef TOOL_FILES_PLY_TYPES_H
#define TOOL_FILES_PLY_TYPES_H

#include "Model.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace Tool {

inline const char* PLY_name(Number_type type)
{
  constexpr std::array<const char*, 8> names = { "char", "uchar", "short", "ushort", "int", "uint", "float", "double" };
  return names[std::size_t(type)];
}

inline std::optional<Number_type> PLY_type(std::string_view name)
{
  constexpr std::array<std::string_view, 8> sized = { "int8",  "uint8",  "int16",   "uint16",
                                                      "int32", "uint32", "float32", "float64" };
  for(std::size_t n = 0; n < sized.size(); ++n)
    if(name == sized[n] || name == PLY_name(Number_type(n))) return Number_type(n);
  return std::nullopt;
}

// properties that are components of one attribute, in their order
struct PLY_group
{
  const char* attribute;
  Kind kind;
  std::array<std::string_view, 4> properties;
};
constexpr std::array<PLY_group, 6> PLY_groups = { {
  { color_name, Kind::COLOR, { "red", "green", "blue", "alpha" } },
  { "diffuse", Kind::COLOR, { "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha" } },
  { normal_name, Kind::NORMAL, { "nx", "ny", "nz", "" } },
  { texture_name, Kind::REAL, { "s", "t", "", "" } },
  { texture_name, Kind::REAL, { "u", "v", "", "" } },
  { texture_name, Kind::REAL, { "texture_u", "texture_v", "", "" } },
} };

// Comments with the texts of labels: this, a property, a label, and its text.
constexpr const char* PLY_label = "comment label ";

// list of polygons with two coordinates for each corner
constexpr const char* PLY_corner_texture = "texcoord";

} // namespace Tool

#endif // TOOL_FILES_PLY_TYPES_H
