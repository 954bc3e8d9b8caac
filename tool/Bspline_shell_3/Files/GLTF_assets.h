// Materials, textures, and images of glTF files.
#ifndef TOOL_FILES_GLTF_ASSETS_H
#define TOOL_FILES_GLTF_ASSETS_H

#include "write_model.h"

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

// Returns materials with the colors, opacities, and color textures of a material library.
tinygltf::Model assets_of_MTL(const std::string& materials);

// Returns a material library with the colors, opacities, and color textures of materials.
// \param folder folder to which images are relative
// \param file the OBJ file; images that are not in files are written beside it
std::string MTL_of_assets(const tinygltf::Model& gltf, const std::string& folder, const std::string& file,
                          Written_files& written);

} // namespace Tool

#endif // TOOL_FILES_GLTF_ASSETS_H
