// Colors and images that a model has on its polygons.
#ifndef TOOL_VIEW_SURFACE_COLORS_H
#define TOOL_VIEW_SURFACE_COLORS_H

#include "../Carry/Mix.h"
#include "../Files/Model.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace Tool {

// Contents of PNG and JPEG files; models with the same textures share them.
typedef std::vector<std::string> Image_files;

class Surface_colors
{
public:
  static constexpr std::size_t no_image = std::size_t(-1);

  // Appends images of the model to those of other models. Images that cannot be read are not shown.
  Surface_colors(const Model& model, Image_files& images);

  bool has_colors() const;
  // Returns the color at a corner, from 0 to 1: that of the point, the corner, or the polygon, or else of the material.
  std::array<float, 3> color(std::size_t polygon, std::size_t corner) const;
  // Returns the position of the polygon's image, or `no_image`.
  std::size_t image(std::size_t polygon) const;
  // Returns the texture coordinates, or null if no image is shown.
  const Attribute* texture_coordinates() const { return m_coordinates ? &*m_coordinates : nullptr; }

private:
  struct Material
  {
    std::optional<std::array<float, 3> > color;
    std::size_t image = no_image;
  };

  void read_materials(const Model& model, Image_files& images);
  Material material_of(std::size_t polygon) const;

  Mixer m_mixer;
  std::optional<Attribute> m_coordinates;
  const Attribute* m_colors = nullptr;
  std::vector<int> m_material_of; // by polygon; negative if it has none
  std::vector<Material> m_materials;
};

} // namespace Tool

#endif // TOOL_VIEW_SURFACE_COLORS_H
