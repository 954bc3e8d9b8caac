// Material libraries of OBJ files as materials of glTF files, and back.
#ifndef TOOL_FILES_MTL_ASSETS_H
#define TOOL_FILES_MTL_ASSETS_H

#include "write_model.h"

#include <string>

#include <tiny_gltf.h>

namespace Tool {

// Returns materials with the colors, opacities, and color textures of a material library.
tinygltf::Model assets_of_MTL(const std::string& materials);

// Returns whether a material library has other properties.
bool has_other_properties(const std::string& materials);

// Returns a material library with the colors, opacities, and color textures of materials.
// \param folder folder to which images are relative
// \param file the OBJ file; images that are not in files are written beside it
std::string MTL_of_assets(const tinygltf::Model& gltf, const std::string& folder, const std::string& file,
                          Written_files& written);

} // namespace Tool

#endif // TOOL_FILES_MTL_ASSETS_H
