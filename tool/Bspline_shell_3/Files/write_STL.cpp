#include "Words.h"
#include "numbers.h"
#include "triangles_of.h"
#include "write_model.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace Tool {

namespace {

typedef std::vector<std::array<std::size_t, 3> > Triangles;

std::array<double, 3> unit_normal(const Model& model, const std::array<std::size_t, 3>& t)
{
  const auto& p = model.soup.points;
  const auto n = CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  const double length = std::sqrt(n.squared_length());
  if(!(length > 0)) return {};
  return { n.x() / length, n.y() / length, n.z() / length };
}

void append_bytes(std::string& text, const void* data, std::size_t size)
{
  text.append(static_cast<const char*>(data), size);
}

void write_binary(const Model& model, const Triangles& triangles, const Attribute* value, std::string& text)
{
  constexpr std::size_t header_size = 80;
  text = model.encoding == "binary" && !model.comments.empty() ? model.comments[0] : "";
  text.resize(header_size, '\0');
  const std::uint32_t size = std::uint32_t(triangles.size());
  append_bytes(text, &size, sizeof size);
  for(std::size_t n = 0; n < triangles.size(); ++n) {
    std::array<float, 12> numbers;
    const std::array<double, 3> normal = unit_normal(model, triangles[n]);
    for(std::size_t i = 0; i < 3; ++i) numbers[i] = float(normal[i]);
    for(std::size_t i = 0; i < 9; ++i) numbers[3 + i] = float(model.soup.points[triangles[n][i / 3]][int(i % 3)]);
    append_bytes(text, numbers.data(), sizeof numbers);
    const std::uint16_t label = value != nullptr ? rounded_to<std::uint16_t>((*value)[n][0]) : std::uint16_t(0);
    append_bytes(text, &label, sizeof label);
  }
}

void write_ascii(const Model& model, const Triangles& triangles, const Attribute* solid, std::string& text)
{
  const std::size_t solids = solid != nullptr ? (std::max)(solid->names.size(), std::size_t(1)) : 1;
  const auto append = [&](const char* before, const auto& numbers) {
    text += before;
    for(int i = 0; i < 3; ++i) {
      text += ' ';
      append_number(text, double(numbers[std::size_t(i)]));
    }
    text += '\n';
  };
  for(std::size_t s = 0; s < solids; ++s) {
    const std::string name = solid != nullptr && s < solid->names.size() ? solid->names[s] : "";
    text += "solid " + name + "\n";
    for(std::size_t n = 0; n < triangles.size(); ++n) {
      if(solid != nullptr && (*solid)[n][0] != double(s)) continue;
      append("facet normal", unit_normal(model, triangles[n]));
      text += "outer loop\n";
      for(std::size_t v : triangles[n]) {
        const auto& p = model.soup.points[v];
        append("vertex", std::array<double, 3>{ p.x(), p.y(), p.z() });
      }
      text += "endloop\nendfacet\n";
    }
    text += "endsolid " + name + "\n";
  }
}

} // namespace

void write_STL(const Model& model, const std::string& file, Written_files& written)
{
  Triangles triangles;
  Attribute label;
  const bool are_floats = std::all_of(model.soup.points.begin(), model.soup.points.end(), [](const auto& p) {
    return p.x() == float(p.x()) && p.y() == float(p.y()) && p.z() == float(p.z());
  });
  const bool is_binary = are_floats && model.encoding != "ascii";
  const Attribute* kept = nullptr;
  for(const Attribute& a : model.attributes) {
    const bool is_label = a.element == Element::POLYGON && a.kind == Kind::LABEL;
    const bool is_held = is_label && (is_binary ? a.name == facet_attribute_name : !a.names.empty());
    if(is_held && kept == nullptr) {
      kept = &a;
      written.hold(a);
    } else if(a.kind != Kind::NORMAL) written.leave_out(a, is_binary ? "a binary STL file" : "an ASCII STL file");
  }
  written.leave_out_materials(model, "an STL file");
  if(!are_floats && model.encoding == "binary")
    written.warnings.push_back("The file is written as ASCII STL, because its coordinates have more digits than "
                               "binary STL files can hold.");
  for(std::size_t n = 0; n < model.soup.polygons.size(); ++n) {
    const auto& polygon = model.soup.polygons[n];
    for(const auto& t : triangles_of(model, n)) {
      triangles.push_back({ polygon[t[0]], polygon[t[1]], polygon[t[2]] });
      if(kept != nullptr) label.values.push_back((*kept)[n][0]);
    }
  }
  if(kept != nullptr) {
    label.components = kept->components;
    label.names = kept->names;
  }
  std::string text;
  if(is_binary) write_binary(model, triangles, kept != nullptr ? &label : nullptr, text);
  else write_ascii(model, triangles, kept != nullptr ? &label : nullptr, text);
  written.files.emplace_back(file, std::move(text));
}

} // namespace Tool
