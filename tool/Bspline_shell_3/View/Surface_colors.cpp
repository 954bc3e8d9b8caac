#include "Surface_colors.h"

#include "../Carry/texture_comments.h"
#include "../Files/GLTF_assets.h"
#include "../Files/MTL.h"
#include "../Files/Words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

namespace Tool {

namespace {

// Returns the contents of a file, which are empty if it cannot be read.
std::string contents(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

} // namespace

Surface_colors::Surface_colors(const Model& model, Image_files& images) : m_model(&model), m_mixer(model)
{
  for(Element element : { Element::CORNER, Element::POINT, Element::POLYGON }) {
    if(m_texture == nullptr && element != Element::POLYGON) m_texture = model.find(texture_name, element);
    if(m_colors == nullptr) m_colors = model.find(Kind::COLOR, element);
  }
  if(m_texture != nullptr && m_texture->dimension() < 2) m_texture = nullptr;
  if(m_colors != nullptr && m_colors->dimension() < 3) m_colors = nullptr;
  m_labels = model.find(material_name, Element::POLYGON);
  read_materials(images);
  const bool shows_images = std::any_of(m_materials.begin(), m_materials.end(),
                                        [](const Material& material) { return material.image != no_image; });
  if(!shows_images) m_texture = nullptr;
}

std::array<float, 3> Surface_colors::color(std::size_t polygon, std::size_t corner) const
{
  constexpr float gray = 0.8f;
  std::array<float, 3> color = { gray, gray, gray };
  if(m_colors != nullptr) {
    const std::size_t element = m_colors->element == Element::POLYGON ? polygon : m_mixer.element(*m_colors, corner);
    const double factor = is_real(m_colors->type) ? 1 : 1. / 255;
    for(std::size_t i = 0; i < 3; ++i) {
      const double x = factor * (*m_colors)[element][i];
      if(std::isfinite(x)) color[i] = float(std::clamp(x, 0., 1.));
    }
    return color;
  }
  return material_of(polygon).color.value_or(color);
}

std::size_t Surface_colors::image(std::size_t polygon) const
{
  return m_texture == nullptr ? no_image : material_of(polygon).image;
}

void Surface_colors::read_materials(Image_files& images)
{
  Written_files of_assets;
  const std::string text = m_model->assets ? MTL_of_assets(*m_model->assets, m_model->folder, "image.obj", of_assets)
                                           : m_model->materials;
  const auto image = [&](const std::string& name) {
    const auto in_model = std::find_if(of_assets.files.begin(), of_assets.files.end(), [&](const auto& file) {
      return std::filesystem::path(file.first).filename() == std::filesystem::path(name).filename();
    });
    std::string bytes = in_model != of_assets.files.end() ? in_model->second
                                                          : contents(std::filesystem::path(m_model->folder) / name);
    const bool is_shown = bytes.compare(0, 4, "\x89PNG") == 0 || bytes.compare(0, 2, "\xff\xd8") == 0;
    if(!is_shown) return no_image;
    const auto same = std::find(images.begin(), images.end(), bytes);
    const std::size_t position = std::size_t(same - images.begin());
    if(same == images.end()) images.push_back(std::move(bytes));
    return position;
  };
  m_materials.emplace_back();
  if(m_texture != nullptr)
    for(const std::string& comment : texture_comments(*m_model))
      if(m_materials[0].image == no_image) m_materials[0].image = image(comment.substr(texture_comment.size()));
  Lines lines(text);
  while(lines.next()) {
    const auto& words = lines.words;
    if(words[0] == "newmtl") m_materials.push_back({ lines.rest(), {}, no_image });
    else if(words[0] == "Kd" && words.size() > 3) {
      std::array<double, 3> color;
      if(read_number(words[1], color[0]) && read_number(words[2], color[1]) && read_number(words[3], color[2]))
        m_materials.back().color = { float(color[0]), float(color[1]), float(color[2]) };
    } else if(words[0] == "map_Kd" && m_texture != nullptr && !texture_of(lines).empty())
      m_materials.back().image = image(std::string(texture_of(lines)));
  }
  if(m_labels == nullptr) return;
  for(const std::string& name : m_labels->names) {
    const auto found = std::find_if(m_materials.begin() + 1, m_materials.end(),
                                    [&](const Material& material) { return material.name == name; });
    m_material_of_label.push_back(found == m_materials.end() ? 0 : std::size_t(found - m_materials.begin()));
    m_has_material_colors = m_has_material_colors || m_materials[m_material_of_label.back()].color;
  }
}

const Surface_colors::Material& Surface_colors::material_of(std::size_t polygon) const
{
  if(m_labels == nullptr) return m_materials[0];
  const double label = (*m_labels)[polygon][0];
  return m_materials[label >= 0 && label < double(m_material_of_label.size()) ? m_material_of_label[std::size_t(label)]
                                                                              : 0];
}

} // namespace Tool
