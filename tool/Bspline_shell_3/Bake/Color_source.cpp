#include "Color_source.h"

#include "../Files/GLTF_assets.h"
#include "../Files/color_coordinates.h"
#include "../Files/materials_of.h"
#include "../Files/sRGB.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace Tool {

namespace {

// Returns the coordinate in an image that repeats itself at which a texture has the color of a coordinate.
double wrapped(double x, int wrap, std::size_t size)
{
  if(wrap == TINYGLTF_TEXTURE_WRAP_REPEAT) return x;
  if(wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) {
    x -= 2 * std::floor(x / 2);
    if(x > 1) x = 2 - x;
  }
  const double half = 0.5 / double(size); // half of a texel
  return (std::min)((std::max)(x, half), 1 - half);
}

std::array<int, 2> wrap_of(const tinygltf::Model& gltf, const tinygltf::Material& material)
{
  const tinygltf::Texture& texture = gltf.textures[std::size_t(material.pbrMetallicRoughness.baseColorTexture.index)];
  if(texture.sampler < 0 || std::size_t(texture.sampler) >= gltf.samplers.size())
    return { TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_REPEAT };
  const tinygltf::Sampler& sampler = gltf.samplers[std::size_t(texture.sampler)];
  return { sampler.wrapS, sampler.wrapT };
}

} // namespace

Color_source::Color_source(const Model& model, std::vector<std::string>& warnings) : m_mixer(model)
{
  for(Element element : { Element::CORNER, Element::POINT, Element::POLYGON })
    if(m_colors == nullptr) m_colors = model.find(Kind::COLOR, element);
  if(m_colors != nullptr && m_colors->dimension() < 3) m_colors = nullptr;
  read_materials(model, warnings);
}

Color_source::operator bool() const
{
  return m_colors != nullptr || std::any_of(m_material_of.begin(), m_material_of.end(), [&](int n) {
           return n >= 0 && (m_materials[std::size_t(n)].color || m_materials[std::size_t(n)].image != none);
         });
}

Color Color_source::operator()(std::size_t polygon, const Mix& mix) const
{
  const int number = m_material_of[polygon];
  const Material& material = number < 0 ? Material() : m_materials[std::size_t(number)];
  if(material.image != none) {
    const std::vector<double> uv = m_mixer(*m_coordinates, mix);
    if(std::isfinite(uv[0]) && std::isfinite(uv[1])) return color_of_image(material, uv);
  }
  if(m_colors != nullptr) {
    Color color;
    if(m_colors->element == Element::POLYGON) std::copy_n((*m_colors)[polygon], 3, color.begin());
    else std::copy_n(m_mixer(*m_colors, mix).begin(), 3, color.begin());
    if(is_real(m_colors->type))
      for(double& x : color) x *= 255;
    if(std::none_of(color.begin(), color.end(), [](double x) { return std::isnan(x); })) return color;
  }
  return material.color ? *material.color : Color{};
}

void Color_source::read_materials(const Model& model, std::vector<std::string>& warnings)
{
  const std::shared_ptr<const tinygltf::Model> gltf = materials_of(model);
  m_material_of = materials_of_polygons(model, *gltf);
  m_coordinates = color_coordinates(model, *gltf, m_material_of);
  if(!model.has_materials() && gltf->materials.size() > 1 && labels_of_materials(model, *gltf) == nullptr)
    warnings.push_back("Only the first texture is used: the polygons have no property \"texnumber\".");
  m_images.resize(gltf->images.size());
  std::vector<char> is_read(m_images.size(), 0);
  const auto read = [&](std::size_t n) {
    const tinygltf::Image& image = gltf->images[n];
    const std::string file = file_of(image);
    m_images[n] = file.empty() ? read_image(image.image)
                               : read_image((std::filesystem::path(model.folder) / file).string());
    if(!m_images[n])
      warnings.push_back("The texture " + (file.empty() ? "in image " + std::to_string(n) : file)
                         + " cannot be read: give a PNG or JPEG file.");
  };
  for(const tinygltf::Material& material : gltf->materials) {
    const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
    m_materials.emplace_back();
    Material& result = m_materials.back();
    if(model.has_materials())
      result.color = { 255 * to_sRGB(factor[0]), 255 * to_sRGB(factor[1]), 255 * to_sRGB(factor[2]) };
    const tinygltf::Image* const image = color_image(*gltf, material);
    if(image == nullptr || !m_coordinates) continue;
    const std::size_t n = std::size_t(image - gltf->images.data());
    if(is_read[n]++ == 0) read(n);
    if(!m_images[n]) continue;
    result.image = n;
    result.wrap = wrap_of(*gltf, material);
    if(model.assets != nullptr) std::copy_n(factor.begin(), 3, result.tint.begin());
  }
}

Color Color_source::color_of_image(const Material& material, const std::vector<double>& uv) const
{
  const Image& image = *m_images[material.image];
  Color color = image.sample(wrapped(uv[0], material.wrap[0], image.width),
                             wrapped(uv[1], material.wrap[1], image.height));
  for(std::size_t i = 0; i < 3; ++i)
    if(material.tint[i] != 1) color[i] = 255 * to_sRGB(material.tint[i] * to_linear(color[i] / 255));
  return color;
}

} // namespace Tool
