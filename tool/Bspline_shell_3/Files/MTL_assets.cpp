#include "MTL_assets.h"
#include "GLTF_assets.h"
#include "MTL.h"
#include "Words.h"
#include "name_beside.h"
#include "sRGB.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace Tool {

namespace {

// Returns the words between an option of a texture in a material library and the name of the texture.
std::vector<std::string_view> option_of(const Lines& lines, std::string_view option)
{
  const char* const name = texture_of(lines).data();
  std::vector<std::string_view> words;
  for(auto word = std::find(lines.words.begin(), lines.words.end(), option);
      word != lines.words.end() && ++word != lines.words.end() && word->data() < name;)
    words.push_back(*word);
  return words;
}

std::array<double, 2> numbers_of(const Lines& lines, std::string_view option, double usual)
{
  std::array<double, 2> numbers = { usual, usual };
  const std::vector<std::string_view> words = option_of(lines, option);
  for(std::size_t i = 0; i < 2 && i < words.size() && read_number(words[i], numbers[i]);) ++i;
  return numbers;
}

// Sets the color texture of a material from a line of a material library.
void set_color_texture(tinygltf::Model& gltf, tinygltf::Material& material, const Lines& lines)
{
  tinygltf::Texture& texture = set_color_image(gltf, material, std::string(texture_of(lines)));
  const std::vector<std::string_view> clamp = option_of(lines, "-clamp");
  if(!clamp.empty() && clamp[0] == "on") {
    texture.sampler = int(gltf.samplers.size());
    gltf.samplers.emplace_back();
    gltf.samplers.back().wrapS = gltf.samplers.back().wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  }
  const std::array<double, 2> offset = numbers_of(lines, "-o", 0), scale = numbers_of(lines, "-s", 1);
  if(offset == std::array<double, 2>{ 0, 0 } && scale == std::array<double, 2>{ 1, 1 }) return;
  const auto pair = [](double x, double y) {
    return tinygltf::Value(tinygltf::Value::Array{ tinygltf::Value(x), tinygltf::Value(y) });
  };
  // Images of glTF files begin at the top.
  material.pbrMetallicRoughness.baseColorTexture.extensions[texture_transform] = tinygltf::Value(
    tinygltf::Value::Object{ { "offset", pair(offset[0], 1 - scale[1] - offset[1]) },
                             { "scale", pair(scale[0], scale[1]) } });
  if(gltf.extensionsUsed.empty()) gltf.extensionsUsed.push_back(texture_transform);
}

// Returns the ending of a file with the data of an image.
std::string ending_of(const tinygltf::Image& image)
{
  constexpr std::array<std::pair<std::string_view, const char*>, 5> endings = { { { "image/png", ".png" },
                                                                                  { "image/jpeg", ".jpg" },
                                                                                  { "image/webp", ".webp" },
                                                                                  { "image/ktx2", ".ktx2" },
                                                                                  { "image/avif", ".avif" } } };
  for(const auto& [type, ending] : endings)
    if(image.mimeType == type) return ending;
  return ".image";
}

} // namespace

tinygltf::Model assets_of_MTL(const std::string& materials)
{
  tinygltf::Model gltf;
  gltf.asset.generator = "bspline_shell";
  Lines lines(materials);
  while(lines.next()) {
    const std::string_view keyword = lines.words[0];
    if(keyword == "newmtl") add_material(gltf, lines.rest());
    if(gltf.materials.empty()) continue;
    tinygltf::Material& material = gltf.materials.back();
    std::vector<double>& color = material.pbrMetallicRoughness.baseColorFactor;
    double x = 0;
    if(keyword == "Kd" && lines.words.size() > 3) {
      for(std::size_t i = 0; i < 3; ++i)
        if(read_number(lines.words[i + 1], x)) color[i] = to_linear(x);
    } else if((keyword == "d" || keyword == "Tr") && read_number(lines.words.back(), x)) {
      color[3] = keyword == "d" ? x : 1 - x;
      if(color[3] < 1) material.alphaMode = "BLEND";
    } else if(keyword == "map_Kd" && !texture_of(lines).empty()) set_color_texture(gltf, material, lines);
  }
  return gltf;
}

bool has_other_properties(const std::string& materials)
{
  constexpr std::array<std::string_view, 5> known = { "newmtl", "Kd", "d", "Tr", "map_Kd" };
  Lines lines(materials);
  while(lines.next()) {
    const std::string_view keyword = lines.words[0];
    if(keyword.front() != '#' && std::find(known.begin(), known.end(), keyword) == known.end()) return true;
  }
  return false;
}

std::string MTL_of_assets(const tinygltf::Model& gltf, const std::string& folder, const std::string& file,
                          Written_files& written)
{
  const std::filesystem::path path(file);
  const std::vector<std::string> names = material_names(gltf);
  std::vector<std::string> image_names(gltf.images.size());
  std::string text;
  for(std::size_t n = 0; n < names.size(); ++n) {
    const tinygltf::Material& material = gltf.materials[n];
    const std::vector<double>& color = material.pbrMetallicRoughness.baseColorFactor;
    text += "newmtl " + names[n] + "\nKd";
    for(std::size_t i = 0; i < 3; ++i) {
      constexpr double steps = 1e6; // The conversion has rounding errors, which are not written.
      text += ' ';
      append_number(text, std::round(steps * to_sRGB(color[i])) / steps);
    }
    if(material.alphaMode != "OPAQUE" && color[3] < 1) {
      text += "\nd ";
      append_number(text, color[3]);
    }
    text += '\n';
    const tinygltf::Image* const image = color_image(gltf, material);
    if(image == nullptr) continue;
    std::string& name = image_names[std::size_t(image - gltf.images.data())];
    if(name.empty() && !file_of(*image).empty())
      name = moved_name(file_of(*image), folder, path.parent_path().string());
    else if(name.empty() && !image->image.empty()) {
      const std::string ending = "_image" + std::to_string(image - gltf.images.data()) + ending_of(*image);
      std::string bytes(image->image.begin(), image->image.end());
      name = name_beside(path.parent_path() / (path.stem().string() + ".mtl"), ending, bytes);
      if(ending_of(*image) != ".png" && ending_of(*image) != ".jpg")
        written.warnings.push_back("Many programs cannot read the image " + name + ": convert it to PNG or JPEG.");
      written.files.emplace_back((path.parent_path() / name).string(), std::move(bytes));
    }
    if(name.empty())
      written.warnings.push_back("The image " + std::to_string(image - gltf.images.data())
                                 + " is omitted: it cannot be decoded.");
    else text += "map_Kd " + name + "\n";
  }
  return text;
}

} // namespace Tool
