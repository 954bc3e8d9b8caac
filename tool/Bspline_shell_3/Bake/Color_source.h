// The colors of the surface of a model.
#ifndef TOOL_BAKE_COLOR_SOURCE_H
#define TOOL_BAKE_COLOR_SOURCE_H

#include "Image.h"

#include "../Carry/Mix.h"
#include "../Files/Model.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace Tool {

// Colors are those of the textures, or otherwise those of points, corners, polygons, or materials.
class Color_source
{
public:
  // Reads textures. Those that cannot be read are named in warnings.
  Color_source(const Model& model, std::vector<std::string>& warnings);

  // Returns whether the model has any colors.
  explicit operator bool() const { return m_colors != nullptr || has_materials(); }
  // Returns the color at a point of a polygon, given as a mix of its corners.
  Color operator()(std::size_t polygon, const Mix& mix) const;

private:
  struct Material
  {
    std::string name;
    std::optional<Color> color;
    std::optional<Image> texture;
  };

  void read_materials(std::vector<std::string>& warnings);
  std::optional<Image> texture(const std::string& name, std::vector<std::string>& warnings) const;
  bool has_materials() const;
  const Material& material_of(std::size_t polygon) const;

  const Model* m_model;
  Mixer m_mixer;
  const Attribute *m_texture = nullptr, *m_labels = nullptr, *m_colors = nullptr;
  std::vector<Material> m_materials; // the first one is that of polygons without a material
};

} // namespace Tool

#endif // TOOL_BAKE_COLOR_SOURCE_H
