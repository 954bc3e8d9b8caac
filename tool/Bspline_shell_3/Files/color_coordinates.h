// Texture coordinates for the images of the colors of materials.
#ifndef TOOL_FILES_COLOR_COORDINATES_H
#define TOOL_FILES_COLOR_COORDINATES_H

#include "Model.h"

#include <optional>
#include <vector>

#include <tiny_gltf.h>

namespace Tool {

// Returns texture coordinates of points or corners, or nothing if there are none. Materials of glTF files may select a
// further set of coordinates, and transform it.
// \param materials material of each polygon, or -1
std::optional<Attribute> color_coordinates(const Model& model, const tinygltf::Model& gltf,
                                           const std::vector<int>& materials);

} // namespace Tool

#endif // TOOL_FILES_COLOR_COORDINATES_H
