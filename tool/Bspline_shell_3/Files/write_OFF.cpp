#include "Words.h"
#include "numbers.h"
#include "write_model.h"

#include <cmath>
#include <cstddef>

namespace Tool {

namespace {

void append(std::string& text, const Attribute& a, std::size_t n)
{
  for(std::size_t i = 0; i < a.dimension(); ++i) {
    text += ' ';
    if(!is_real(a.type)) text += std::to_string(long(rounded_to(a.type, a[n][i])));
    else {
      const std::size_t begin = text.size();
      append_number(text, rounded_to(a.type, a[n][i]));
      // A decimal point distinguishes real colors.
      if(a.kind == Kind::COLOR && text.find_first_of(".en", begin) == text.npos) text += ".0";
    }
  }
}

} // namespace

void write_OFF(const Model& model, const std::string& file, Written_files& written)
{
  const Attribute *normals = nullptr, *colors = nullptr, *texture = nullptr, *polygon_colors = nullptr;
  for(const Attribute& a : model.attributes) {
    const bool is_of_points = a.element == Element::POINT;
    const bool is_color = a.kind == Kind::COLOR && (a.dimension() == 3 || a.dimension() == 4);
    const Attribute** place = is_of_points && a.kind == Kind::NORMAL                         ? &normals
                              : is_of_points && is_color                                     ? &colors
                              : is_of_points && a.name == texture_name && a.dimension() == 2 ? &texture
                              : a.element == Element::POLYGON && is_color                    ? &polygon_colors
                                                                                             : nullptr;
    if(place != nullptr && *place == nullptr) {
      *place = &a;
      written.hold(a);
    } else written.leave_out(a, "an OFF file");
  }
  written.leave_out_materials(model, "an OFF file");

  std::string text = texture != nullptr ? "ST" : "";
  if(colors != nullptr) text += "C";
  if(normals != nullptr) text += "N";
  text += "OFF\n";
  for(const std::string& comment : model.comments)
    if(comment.front() == '#') text += comment + "\n";
  text += std::to_string(model.soup.points.size()) + " " + std::to_string(model.soup.polygons.size()) + " 0\n";
  for(std::size_t n = 0; n < model.soup.points.size(); ++n) {
    for(int axis = 0; axis < 3; ++axis) {
      if(axis > 0) text += ' ';
      append_number(text, model.soup.points[n][axis]);
    }
    for(const Attribute* a : { normals, colors, texture })
      if(a != nullptr) append(text, *a, n);
    text += '\n';
  }
  for(std::size_t n = 0; n < model.soup.polygons.size(); ++n) {
    text += std::to_string(model.soup.polygons[n].size());
    for(std::size_t v : model.soup.polygons[n]) text += ' ' + std::to_string(v);
    if(polygon_colors != nullptr && !std::isnan((*polygon_colors)[n][0])) append(text, *polygon_colors, n);
    text += '\n';
  }
  written.files.emplace_back(file, std::move(text));
}

} // namespace Tool
