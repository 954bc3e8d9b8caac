// The colors of the surface of a model.
#ifndef TOOL_BAKE_COLOR_SOURCE_H
#define TOOL_BAKE_COLOR_SOURCE_H

#include "Image.h"

#include "../Carry/Mix.h"
#include "../Files/Model.h"

#include <array>
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
  explicit operator bool() const;
  // Returns the color at a point of a polygon, given as a mix of its corners.
  Color operator()(std::size_t polygon, const Mix& mix) const;

private:
  struct Material
  {
    std::optional<Color> color;
    std::size_t image = none;
    std::array<int, 2> wrap = {};             // wrapping modes of glTF, horizontal and vertical
    std::array<double, 3> tint = { 1, 1, 1 }; // factors of the light that the image reflects
  };
  static constexpr std::size_t none = std::size_t(-1);

  void read_materials(const Model& model, std::vector<std::string>& warnings);
  Color color_of_image(const Material& material, const std::vector<double>& uv) const;

  Mixer m_mixer;
  std::optional<Attribute> m_coordinates; // texture coordinates
  const Attribute* m_colors = nullptr;
  std::vector<int> m_material_of; // by polygon; negative if it has none
  std::vector<Material> m_materials;
  std::vector<std::optional<Image> > m_images; // by image of the materials; only used images are read
};

} // namespace Tool

#endif // TOOL_BAKE_COLOR_SOURCE_H
