// Materials, textures, and images of glTF files.
#ifndef TOOL_FILES_GLTF_ASSETS_H
#define TOOL_FILES_GLTF_ASSETS_H

#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace Tool {

// Returns the materials, textures, and images of a file. Images in its buffers are copied. An image that is damaged is
// empty.
tinygltf::Model assets_of(const tinygltf::Model& gltf);

// Returns a name for each material, which no other one has.
std::vector<std::string> material_names(const tinygltf::Model& gltf);

// Returns the names of the files that images or buffers refer to, relative to the folder of the file.
std::vector<std::string> external_files(const tinygltf::Model& gltf);

// Changes names of images for another folder.
void move_images(tinygltf::Model& gltf, const std::string& from, const std::string& to);

// Returns the image of the color of a material, or null if it has none.
const tinygltf::Image* color_image(const tinygltf::Model& gltf, const tinygltf::Material& material);

// Appends a material that is not metallic.
void add_material(tinygltf::Model& gltf, const std::string& name);

// Makes a file the image of the color of a material, and returns its texture. Materials with the same file have the
// same image.
tinygltf::Texture& set_color_image(tinygltf::Model& gltf, tinygltf::Material& material, const std::string& name);

// Returns the name of the file of an image, which is empty if the image is in the glTF file.
std::string file_of(const tinygltf::Image& image);

// extension for coordinates of textures
constexpr const char* texture_transform = "KHR_texture_transform";

} // namespace Tool

#endif // TOOL_FILES_GLTF_ASSETS_H
