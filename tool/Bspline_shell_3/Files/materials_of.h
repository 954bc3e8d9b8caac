// The materials of models of any format.
#ifndef TOOL_FILES_MATERIALS_OF_H
#define TOOL_FILES_MATERIALS_OF_H

#include "Model.h"

#include <memory>
#include <vector>

#include <tiny_gltf.h>

namespace Tool {

// Returns the materials of a glTF file or of material libraries, or otherwise one for each texture of a PLY file.
std::shared_ptr<const tinygltf::Model> materials_of(const Model& model);

// Returns the labels of polygons whose texts are names of these materials, or null if there are none.
const Attribute* labels_of_materials(const Model& model, const tinygltf::Model& gltf);

// Returns the material of each polygon, or -1 if it has none.
std::vector<int> materials_of_polygons(const Model& model, const tinygltf::Model& gltf);

} // namespace Tool

#endif // TOOL_FILES_MATERIALS_OF_H
