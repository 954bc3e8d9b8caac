#include "Surface_colors.h"

#include "../Files/GLTF_assets.h"
#include "../Files/color_coordinates.h"
#include "../Files/materials_of.h"
#include "../Files/sRGB.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

namespace Tool {

namespace {

// Returns the bytes of an image, which are empty if its file cannot be read.
std::string bytes_of(const tinygltf::Image& image, const std::string& folder)
{
  const std::string file = file_of(image);
  if(file.empty()) return std::string(image.image.begin(), image.image.end());
  std::ifstream in(std::filesystem::path(folder) / file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

// Returns whether browsers show an image with these first bytes.
bool is_PNG_or_JPEG(const std::string& bytes)
{
  return bytes.compare(0, 4, "\x89PNG") == 0 || bytes.compare(0, 2, "\xff\xd8") == 0;
}

} // namespace

Surface_colors::Surface_colors(const Model& model, Image_files& images) : m_mixer(model)
{
  for(Element element : { Element::CORNER, Element::POINT, Element::POLYGON })
    if(m_colors == nullptr) m_colors = model.find(Kind::COLOR, element);
  if(m_colors != nullptr && m_colors->dimension() < 3) m_colors = nullptr;
  read_materials(model, images);
}

bool Surface_colors::has_colors() const
{
  return m_colors != nullptr || std::any_of(m_material_of.begin(), m_material_of.end(), [&](int n) {
           return n >= 0 && m_materials[std::size_t(n)].color;
         });
}

std::array<float, 3> Surface_colors::color(std::size_t polygon, std::size_t corner) const
{
  constexpr float gray = 0.8f;
  const std::array<float, 3> of_material = material_of(polygon).color.value_or(
    std::array<float, 3>{ gray, gray, gray });
  if(m_colors == nullptr) return of_material;
  const std::size_t element = m_colors->element == Element::POLYGON ? polygon : m_mixer.element(*m_colors, corner);
  const double factor = is_real(m_colors->type) ? 1 : 1. / 255;
  std::array<float, 3> color;
  for(std::size_t i = 0; i < 3; ++i) {
    const double x = factor * (*m_colors)[element][i];
    if(!std::isfinite(x)) return of_material;
    color[i] = float(std::clamp(x, 0., 1.));
  }
  return color;
}

std::size_t Surface_colors::image(std::size_t polygon) const
{
  return material_of(polygon).image;
}

void Surface_colors::read_materials(const Model& model, Image_files& images)
{
  const std::shared_ptr<const tinygltf::Model> gltf = materials_of(model);
  m_material_of = materials_of_polygons(model, *gltf);
  m_coordinates = color_coordinates(model, *gltf, m_material_of);
  for(const tinygltf::Material& material : gltf->materials) {
    Material result;
    const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
    if(model.has_materials())
      result.color = { float(to_sRGB(factor[0])), float(to_sRGB(factor[1])), float(to_sRGB(factor[2])) };
    const tinygltf::Image* const image = m_coordinates ? color_image(*gltf, material) : nullptr;
    std::string bytes = image != nullptr ? bytes_of(*image, model.folder) : "";
    if(is_PNG_or_JPEG(bytes)) {
      const auto same = std::find(images.begin(), images.end(), bytes);
      result.image = std::size_t(same - images.begin());
      if(same == images.end()) images.push_back(std::move(bytes));
    }
    m_materials.push_back(result);
  }
  const bool shows_images = std::any_of(m_material_of.begin(), m_material_of.end(),
                                        [&](int n) { return n >= 0 && m_materials[std::size_t(n)].image != no_image; });
  if(!shows_images) m_coordinates.reset();
}

Surface_colors::Material Surface_colors::material_of(std::size_t polygon) const
{
  const int number = m_material_of[polygon];
  return number < 0 ? Material() : m_materials[std::size_t(number)];
}

} // namespace Tool
