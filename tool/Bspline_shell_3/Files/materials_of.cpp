#include "materials_of.h"
#include "GLTF_assets.h"
#include "MTL_assets.h"
#include "texture_comments.h"

#include <cstddef>
#include <map>
#include <string>

namespace Tool {

namespace {

// Returns whether the materials of a model are the textures of a PLY file.
bool has_PLY_textures(const Model& model, const tinygltf::Model& gltf)
{
  return !model.has_materials() && !gltf.materials.empty();
}

} // namespace

std::shared_ptr<const tinygltf::Model> materials_of(const Model& model)
{
  if(model.assets != nullptr) return model.assets;
  auto gltf = std::make_shared<tinygltf::Model>(assets_of_MTL(model.materials));
  if(!gltf->materials.empty()) return gltf;
  // The name of a material is the number of its texture.
  for(const std::string& texture : textures_in_comments(model, model.folder)) {
    add_material(*gltf, std::to_string(gltf->materials.size()));
    set_color_image(*gltf, gltf->materials.back(), texture);
  }
  return gltf;
}

const Attribute* labels_of_materials(const Model& model, const tinygltf::Model& gltf)
{
  return model.find(has_PLY_textures(model, gltf) ? texture_number_name : material_name, Element::POLYGON);
}

std::vector<int> materials_of_polygons(const Model& model, const tinygltf::Model& gltf)
{
  const Attribute* const labels = labels_of_materials(model, gltf);
  std::vector<int> materials(model.soup.polygons.size(), labels == nullptr && has_PLY_textures(model, gltf) ? 0 : -1);
  if(labels == nullptr) return materials;
  std::map<std::string, int> number;
  for(const std::string& name : material_names(gltf)) number.emplace(name, int(number.size()));
  std::map<double, int> of_label;
  for(std::size_t n = 0; n < materials.size(); ++n) {
    const auto [label, is_new] = of_label.emplace((*labels)[n][0], -1);
    if(is_new) {
      const auto found = number.find(labels->text(n));
      if(found != number.end()) label->second = found->second;
    }
    materials[n] = label->second;
  }
  return materials;
}

} // namespace Tool
