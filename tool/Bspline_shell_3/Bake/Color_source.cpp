#include "Color_source.h"

#include "../Carry/texture_comments.h"
#include "../Files/MTL.h"
#include "../Files/Words.h"
#include "../Files/numbers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace Tool {

Color_source::Color_source(const Model& model, std::vector<std::string>& warnings) : m_model(&model), m_mixer(model)
{
  for(Element element : { Element::CORNER, Element::POINT, Element::POLYGON }) {
    if(m_texture == nullptr && element != Element::POLYGON) m_texture = model.find(texture_name, element);
    if(m_colors == nullptr) m_colors = model.find(Kind::COLOR, element);
  }
  if(m_colors != nullptr && m_colors->dimension() < 3) m_colors = nullptr;
  m_labels = model.find(material_name, Element::POLYGON);
  read_materials(warnings);
}

Color Color_source::operator()(std::size_t polygon, const Mix& mix) const
{
  const Material& material = material_of(polygon);
  if(material.texture && m_texture != nullptr) {
    const std::vector<double> uv = m_mixer(*m_texture, mix);
    if(std::isfinite(uv[0]) && std::isfinite(uv[1])) return material.texture->sample(uv[0], uv[1]);
  }
  if(m_colors != nullptr) {
    Color color;
    const double factor = is_real(m_colors->type) ? 255 : 1;
    if(m_colors->element == Element::POLYGON) std::copy_n((*m_colors)[polygon], 3, color.begin());
    else std::copy_n(m_mixer(*m_colors, mix).begin(), 3, color.begin());
    for(double& x : color) x = std::isnan(x) ? 0 : factor * x;
    return color;
  }
  return material.color ? *material.color : Color{};
}

void Color_source::read_materials(std::vector<std::string>& warnings)
{
  m_materials.emplace_back();
  for(const std::string& comment : texture_comments(*m_model))
    if(!m_materials[0].texture) m_materials[0].texture = texture(comment.substr(texture_comment.size()), warnings);
  Lines lines(m_model->materials);
  while(lines.next()) {
    const auto& words = lines.words;
    if(words[0] == "newmtl") m_materials.push_back({ lines.rest(), {}, {} });
    else if(words[0] == "Kd" && words.size() > 3) {
      Color color;
      bool are_numbers = true;
      for(std::size_t i = 0; i < 3; ++i) are_numbers = are_numbers && read_number(words[i + 1], color[i]);
      for(double& x : color) x *= 255;
      if(are_numbers) m_materials.back().color = color;
    } else if(words[0] == "map_Kd" && m_texture != nullptr && !texture_of(lines).empty())
      m_materials.back().texture = texture(std::string(texture_of(lines)), warnings);
  }
}

std::optional<Image> Color_source::texture(const std::string& name, std::vector<std::string>& warnings) const
{
  std::optional<Image> image = read_image((std::filesystem::path(m_model->folder) / name).string());
  if(!image) warnings.push_back("The texture " + name + " cannot be read: give a PNG or JPEG file.");
  return image;
}

bool Color_source::has_materials() const
{
  return std::any_of(m_materials.begin(), m_materials.end(), [&](const Material& material) {
    return (material.texture && m_texture != nullptr) || (material.color && m_labels != nullptr);
  });
}

const Color_source::Material& Color_source::material_of(std::size_t polygon) const
{
  if(m_labels == nullptr) return m_materials[0];
  const std::size_t label = std::size_t((*m_labels)[polygon][0]);
  if(label >= m_labels->names.size()) return m_materials[0];
  const auto found = std::find_if(m_materials.begin() + 1, m_materials.end(),
                                  [&](const Material& material) { return material.name == m_labels->names[label]; });
  return found == m_materials.end() ? m_materials[0] : *found;
}

} // namespace Tool
