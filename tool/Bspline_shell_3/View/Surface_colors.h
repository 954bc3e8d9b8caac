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

  bool has_colors() const { return m_colors != nullptr || m_has_material_colors; }
  // Returns the color at a corner, from 0 to 1: that of the point, the corner, or the polygon, or else of the material.
  std::array<float, 3> color(std::size_t polygon, std::size_t corner) const;
  // Returns the position of the polygon's image, or `no_image`.
  std::size_t image(std::size_t polygon) const;
  // Returns the texture coordinates, or null if no image is shown.
  const Attribute* texture_coordinates() const { return m_texture; }

private:
  struct Material
  {
    std::string name;
    std::optional<std::array<float, 3> > color;
    std::size_t image = no_image;
  };

  void read_materials(Image_files& images);
  const Material& material_of(std::size_t polygon) const;

  const Model* m_model;
  Mixer m_mixer;
  const Attribute *m_texture = nullptr, *m_labels = nullptr, *m_colors = nullptr;
  std::vector<Material> m_materials; // the first one is that of polygons without a material
  std::vector<std::size_t> m_material_of_label;
  bool m_has_material_colors = false;
};

} // namespace Tool

#endif // TOOL_VIEW_SURFACE_COLORS_H
