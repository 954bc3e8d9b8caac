#include "GLTF_assets.h"
#include "GLTF_accessor.h"
#include "MTL.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
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

const tinygltf::Image* color_image(const tinygltf::Model& gltf, const tinygltf::Material& material)
{
  const int index = material.pbrMetallicRoughness.baseColorTexture.index;
  if(index < 0 || std::size_t(index) >= gltf.textures.size()) return nullptr;
  const tinygltf::Texture& texture = gltf.textures[std::size_t(index)];
  int source = texture.source;
  // Images in other formats belong to extensions such as EXT_texture_webp.
  for(const auto& [name, extension] : texture.extensions)
    if(source < 0 && extension.Has("source")) source = extension.Get("source").GetNumberAsInt();
  return source < 0 || std::size_t(source) >= gltf.images.size() ? nullptr : &gltf.images[std::size_t(source)];
}

std::string file_of(const tinygltf::Image& image)
{
  return is_file(image.uri) ? decoded(image.uri) : "";
}

void add_material(tinygltf::Model& gltf, const std::string& name)
{
  gltf.materials.emplace_back();
  gltf.materials.back().name = name;
  gltf.materials.back().pbrMetallicRoughness.metallicFactor = 0;
}

tinygltf::Texture& set_color_image(tinygltf::Model& gltf, tinygltf::Material& material, const std::string& name)
{
  const auto is_same = [&](const tinygltf::Image& image) { return image.uri == encoded(name); };
  const auto image = std::find_if(gltf.images.begin(), gltf.images.end(), is_same);
  material.pbrMetallicRoughness.baseColorTexture.index = int(gltf.textures.size());
  gltf.textures.emplace_back();
  gltf.textures.back().source = int(image - gltf.images.begin());
  if(image == gltf.images.end()) {
    gltf.images.emplace_back();
    gltf.images.back().uri = encoded(name);
  }
  return gltf.textures.back();
}

std::vector<std::string> external_files(const tinygltf::Model& gltf)
{
  std::vector<std::string> names;
  for(const tinygltf::Buffer& buffer : gltf.buffers)
    if(is_file(buffer.uri)) names.push_back(decoded(buffer.uri));
  for(const tinygltf::Image& image : gltf.images)
    if(!file_of(image).empty()) names.push_back(file_of(image));
  return names;
}

void move_images(tinygltf::Model& gltf, const std::string& from, const std::string& to)
{
  for(tinygltf::Image& image : gltf.images) {
    const std::string name = file_of(image), moved = name.empty() ? name : moved_name(name, from, to);
    if(moved != name) image.uri = encoded(moved);
  }
}

} // namespace Tool
