#include "GLTF_assets.h"
#include "GLTF_accessor.h"
#include "MTL.h"
#include "Words.h"
#include "name_beside.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace Tool {

namespace {

constexpr std::string_view hexadecimal = "0123456789ABCDEF";

std::string decoded(const std::string& uri)
{
  std::string name;
  for(std::size_t n = 0; n < uri.size(); ++n) {
    const auto digit = [&](std::size_t i) {
      return i < uri.size() ? hexadecimal.find(char(std::toupper(static_cast<unsigned char>(uri[i])))) : uri.npos;
    };
    if(uri[n] == '%' && digit(n + 1) != uri.npos && digit(n + 2) != uri.npos) {
      name += char(16 * digit(n + 1) + digit(n + 2));
      n += 2;
    } else name += uri[n];
  }
  return name;
}

std::string encoded(const std::string& name)
{
  std::string uri;
  for(char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if(byte < 0x80 && (std::isalnum(byte) || std::string_view("/-._~").find(c) != std::string_view::npos)) uri += c;
    else uri += { '%', hexadecimal[byte / 16], hexadecimal[byte % 16] };
  }
  return uri;
}

// Returns whether a reference names a file in a folder, and neither contains data nor has a protocol.
bool is_file(const std::string& uri)
{
  return !uri.empty() && uri.find(':') == uri.npos;
}

// Returns whether an extension belongs to meshes or nodes, which are written without it.
bool is_of_meshes(const std::string& extension)
{
  constexpr std::array<std::string_view, 7> names = {
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",        "KHR_materials_variants",  "FB_ngon_encoding"
  };
  return std::find(names.begin(), names.end(), extension) != names.end();
}

// Returns the image of the color of a material, or null if it has none.
const tinygltf::Image* color_image(const tinygltf::Model& gltf, const tinygltf::Material& material)
{
  const int texture = material.pbrMetallicRoughness.baseColorTexture.index;
  if(texture < 0 || std::size_t(texture) >= gltf.textures.size()) return nullptr;
  const int source = gltf.textures[std::size_t(texture)].source;
  return source < 0 || std::size_t(source) >= gltf.images.size() ? nullptr : &gltf.images[std::size_t(source)];
}

} // namespace

tinygltf::Model assets_of(const tinygltf::Model& gltf)
{
  tinygltf::Model assets;
  assets.asset = gltf.asset;
  assets.materials = gltf.materials;
  assets.textures = gltf.textures;
  assets.samplers = gltf.samplers;
  assets.images = gltf.images;
  for(tinygltf::Image& image : assets.images) {
    if(image.bufferView < 0) continue;
    const unsigned char* const bytes = bytes_of_view(gltf, image.bufferView);
    if(bytes != nullptr) image.image.assign(bytes, bytes + gltf.bufferViews[std::size_t(image.bufferView)].byteLength);
    image.bufferView = -1;
  }
  std::remove_copy_if(gltf.extensionsUsed.begin(), gltf.extensionsUsed.end(), std::back_inserter(assets.extensionsUsed),
                      is_of_meshes);
  std::remove_copy_if(gltf.extensionsRequired.begin(), gltf.extensionsRequired.end(),
                      std::back_inserter(assets.extensionsRequired), is_of_meshes);
  return assets;
}

std::vector<std::string> material_names(const tinygltf::Model& gltf)
{
  std::vector<std::string> names;
  std::set<std::string> used = { "" };
  for(const tinygltf::Material& material : gltf.materials) {
    std::string name = material.name;
    for(std::size_t n = names.size(); !used.insert(name).second; ++n)
      name = (material.name.empty() ? "material" : material.name) + "_" + std::to_string(n);
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> external_files(const tinygltf::Model& gltf)
{
  std::vector<std::string> names;
  for(const tinygltf::Buffer& buffer : gltf.buffers)
    if(is_file(buffer.uri)) names.push_back(decoded(buffer.uri));
  for(const tinygltf::Image& image : gltf.images)
    if(is_file(image.uri)) names.push_back(decoded(image.uri));
  return names;
}

void move_images(tinygltf::Model& gltf, const std::string& from, const std::string& to)
{
  for(tinygltf::Image& image : gltf.images) {
    const std::string name = decoded(image.uri), moved = moved_name(name, from, to);
    if(is_file(image.uri) && moved != name) image.uri = encoded(moved);
  }
}

tinygltf::Model assets_of_MTL(const std::string& materials)
{
  tinygltf::Model gltf;
  gltf.asset.generator = "bspline_shell";
  Lines lines(materials);
  while(lines.next()) {
    const std::string_view keyword = lines.words[0];
    if(keyword == "newmtl") {
      gltf.materials.emplace_back();
      gltf.materials.back().name = lines.rest();
      gltf.materials.back().pbrMetallicRoughness.metallicFactor = 0;
    }
    if(gltf.materials.empty()) continue;
    tinygltf::Material& material = gltf.materials.back();
    std::vector<double>& color = material.pbrMetallicRoughness.baseColorFactor;
    double x = 0;
    if(keyword == "Kd" && lines.words.size() > 3) {
      for(std::size_t i = 0; i < 3; ++i)
        if(read_number(lines.words[i + 1], x)) color[i] = x;
    } else if((keyword == "d" || keyword == "Tr") && read_number(lines.words.back(), x)) {
      color[3] = keyword == "d" ? x : 1 - x;
      if(color[3] < 1) material.alphaMode = "BLEND";
    } else if(keyword == "map_Kd") {
      tinygltf::Image image;
      image.uri = encoded(std::string(texture_of(lines)));
      if(image.uri.empty()) continue;
      material.pbrMetallicRoughness.baseColorTexture.index = int(gltf.textures.size());
      gltf.textures.emplace_back();
      gltf.textures.back().source = int(gltf.images.size());
      gltf.images.push_back(std::move(image));
    }
  }
  return gltf;
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
      text += ' ';
      append_number(text, color[i]);
    }
    if(color[3] < 1) {
      text += "\nd ";
      append_number(text, color[3]);
    }
    text += '\n';
    const tinygltf::Image* const image = color_image(gltf, material);
    if(image == nullptr) continue;
    std::string& name = image_names[std::size_t(image - gltf.images.data())];
    if(name.empty() && is_file(image->uri)) name = moved_name(decoded(image->uri), folder, path.parent_path().string());
    else if(name.empty() && !image->image.empty()) {
      const std::string ending = "_image" + std::to_string(image - gltf.images.data())
                                 + (image->mimeType == "image/png" ? ".png" : ".jpg");
      std::string bytes(image->image.begin(), image->image.end());
      name = name_beside(path.parent_path() / (path.stem().string() + ".mtl"), ending, bytes);
      written.files.emplace_back((path.parent_path() / name).string(), std::move(bytes));
    }
    if(!name.empty()) text += "map_Kd " + name + "\n";
  }
  return text;
}

} // namespace Tool
