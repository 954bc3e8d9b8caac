#include "color_coordinates.h"
#include "GLTF_assets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace Tool {

namespace {

// How an image is placed on a surface.
struct Placement
{
  const Attribute* set = nullptr; // null if it is missing
  std::array<double, 2> offset = {}, scale = { 1, 1 };
  double angle = 0;

  bool is_identity() const { return offset == Placement().offset && scale == Placement().scale && angle == 0; }
  // The coordinates are counted from the bottom of the image, but the transformation refers to the top.
  std::array<double, 2> operator()(const double* uv) const
  {
    if(is_identity()) return { uv[0], uv[1] };
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double u = scale[0] * uv[0], v = scale[1] * (1 - uv[1]);
    return { offset[0] + cosine * u + sine * v, 1 - (offset[1] - sine * u + cosine * v) };
  }
};

Placement placement_of(const Model& model, const tinygltf::Material& material)
{
  const tinygltf::TextureInfo& texture = material.pbrMetallicRoughness.baseColorTexture;
  int number = texture.texCoord;
  Placement placement;
  const auto found = texture.extensions.find(texture_transform);
  if(found != texture.extensions.end()) {
    const tinygltf::Value& extension = found->second;
    const auto read = [&](const char* name, std::array<double, 2>& values) {
      for(std::size_t i = 0; extension.Has(name) && i < extension.Get(name).ArrayLen() && i < 2; ++i)
        values[i] = extension.Get(name).Get(int(i)).GetNumberAsDouble();
    };
    read("offset", placement.offset);
    read("scale", placement.scale);
    if(extension.Has("rotation")) placement.angle = extension.Get("rotation").GetNumberAsDouble();
    if(extension.Has("texCoord")) number = extension.Get("texCoord").GetNumberAsInt();
  }
  placement.set = texture_coordinates(model, texture_name + (number == 0 ? "" : "_" + std::to_string(number)));
  return placement;
}

} // namespace

std::optional<Attribute> color_coordinates(const Model& model, const tinygltf::Model& gltf,
                                           const std::vector<int>& materials)
{
  Placement usual;
  usual.set = texture_coordinates(model);
  std::vector<Placement> placements;
  for(const tinygltf::Material& material : gltf.materials)
    placements.push_back(color_image(gltf, material) != nullptr ? placement_of(model, material) : usual);
  const auto is_usual = [&](const Placement& p) { return p.set == usual.set && p.is_identity(); };
  if(std::all_of(placements.begin(), placements.end(), is_usual))
    return usual.set != nullptr ? std::make_optional(*usual.set) : std::nullopt;

  Attribute result{ texture_name, Element::CORNER, Kind::REAL, Number_type::FLOAT64, { "u", "v" }, {}, {} };
  std::size_t corner = 0;
  for(std::size_t n = 0; n < model.soup.polygons.size(); ++n) {
    const Placement& placement = materials[n] < 0 ? usual : placements[std::size_t(materials[n])];
    for(std::size_t v : model.soup.polygons[n]) {
      std::array<double, 2> uv;
      uv.fill(std::numeric_limits<double>::quiet_NaN());
      if(const Attribute* const set = placement.set)
        uv = placement((*set)[set->element == Element::CORNER ? corner : v]);
      result.values.insert(result.values.end(), uv.begin(), uv.end());
      ++corner;
    }
  }
  return result;
}

} // namespace Tool
