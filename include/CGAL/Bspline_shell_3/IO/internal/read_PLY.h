// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_PLY_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_PLY_H

#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/IO/PLY.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

struct PLY_property
{
  std::size_t count_bytes = 0; // size of a list's length; 0 for a single value
  std::size_t value_bytes = 0;
  bool is_real = false;
  std::string name;
};

struct PLY_element
{
  // Returns the position of a property, or the number of properties if there is none with this name.
  std::size_t find(std::string_view property) const
  {
    std::size_t p = 0;
    while(p < properties.size() && properties[p].name != property) ++p;
    return p;
  }
  bool is_vertex() const { return name == "vertex" || name == "vertices"; }
  bool is_facet() const { return name == "face" || name == "faces"; }
  std::size_t vertex_indices() const { return std::min(find("vertex_indices"), find("vertex_index")); }

  std::string name;
  std::size_t size = 0;
  std::vector<PLY_property> properties;
};

struct PLY_header
{
  std::string format;
  std::vector<PLY_element> elements;
  std::size_t end = 0; // beginning of the data
};

// Returns the number of bytes of a type, or 0 if there is none with this name.
inline std::size_t size_of_PLY_type(std::string_view type, bool& is_real)
{
  is_real = type == "float" || type == "float32" || type == "double" || type == "float64";
  if(type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if(type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if(type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" || type == "float32")
    return 4;
  return is_real || type == "int64" || type == "uint64" ? 8 : 0;
}

inline bool read_PLY_header(std::string_view text, PLY_header& header)
{
  Text_rows rows(text);
  std::vector<std::string_view> words;
  if(!rows.next(words) || words[0] != "ply") return false;
  for(words.clear(); rows.next(words); words.clear()) {
    if(words[0] == "format" && words.size() > 1) {
      header.format = words[1];
    } else if(words[0] == "element" && words.size() >= 3) {
      header.elements.emplace_back();
      header.elements.back().name = words[1];
      if(!read_count(words[2], header.elements.back().size)) return false;
    } else if(words[0] == "property" && !header.elements.empty()) {
      // Words after the name are ignored.
      const bool is_list = words.size() > 1 && words[1] == "list";
      const std::size_t type = is_list ? 3 : 1;
      if(words.size() < type + 2) return false;
      PLY_property property;
      property.name = words[type + 1];
      property.value_bytes = size_of_PLY_type(words[type], property.is_real);
      bool is_real = false;
      if(is_list) property.count_bytes = size_of_PLY_type(words[2], is_real);
      if(property.value_bytes == 0 || (is_list && property.count_bytes == 0) || is_real) return false;
      header.elements.back().properties.push_back(std::move(property));
    } else if(words[0] == "end_header") {
      header.end = rows.position();
      return !header.format.empty();
    }
  }
  return false;
}

// Returns whether the binary data is complete, because CGAL's reader reserves memory for any list length in the file.
inline bool has_PLY_data(std::string_view text, const PLY_header& header)
{
  const bool is_big_endian = header.format == "binary_big_endian";
  std::size_t position = header.end;
  for(const PLY_element& element : header.elements)
    for(std::size_t i = 0; i < element.size; ++i)
      for(const PLY_property& property : element.properties) {
        std::size_t length = property.count_bytes == 0 ? 1 : 0;
        if(text.size() - position < property.count_bytes) return false;
        for(std::size_t b = 0; b < property.count_bytes; ++b)
          length = 256 * length
                   + static_cast<unsigned char>(text[position + (is_big_endian ? b : property.count_bytes - 1 - b)]);
        position += property.count_bytes;
        if((text.size() - position) / property.value_bytes < length) return false;
        position += length * property.value_bytes;
      }
  return true;
}

// Reads positions and facets of a text. If `by_lines`, each element is one line, which may have further words after its
// properties. Otherwise, line breaks have no meaning.
inline bool read_PLY_text(const PLY_header& header, bool by_lines, Text_rows& rows, Text_soup& result)
{
  std::vector<std::string_view> words, position(3);
  if(!by_lines)
    while(rows.next(words)) {}
  std::size_t w = 0;
  std::vector<std::pair<std::size_t, std::size_t> > values; // by property: position and number of its words
  for(const PLY_element& element : header.elements)
    for(std::size_t i = 0; i < element.size; ++i) {
      if(by_lines) {
        words.clear();
        w = 0;
        if(!rows.next(words)) return false;
      }
      values.clear();
      for(const PLY_property& property : element.properties) {
        std::size_t length = 1;
        if(property.count_bytes != 0 && (w == words.size() || !read_count(words[w++], length))) return false;
        if(words.size() - w < length) return false;
        values.emplace_back(w, length);
        w += length;
      }
      if(element.is_vertex()) {
        constexpr std::string_view axes = "xyz";
        for(std::size_t a = 0; a < 3; ++a) position[a] = words[values[element.find(axes.substr(a, 1))].first];
        if(!result.add_point(position, 0)) return false;
      } else if(element.is_facet()) {
        const auto& indices = values[element.vertex_indices()];
        if(!result.add_polygon(words, indices.first, indices.second)) return false;
      }
    }
  return by_lines || w == words.size();
}

/*
 * Reads positions and facets of a PLY file. CGAL's reader is not used for text, because it supports few types, stops at
 * "nan", and misreads lines with more numbers than declared in the header. Binary data is read by CGAL's reader. Files
 * with 8-byte integers or integer coordinates, which it would drop, are rejected.
 */
inline Shell_status read_PLY(Text_soup& result)
{
  PLY_header header;
  if(!read_PLY_header(result.text(), header)) return Shell_status::MALFORMED_FILE;
  const bool is_text = header.format == "ascii";
  if(!is_text && header.format != "binary_little_endian" && header.format != "binary_big_endian")
    return Shell_status::UNSUPPORTED_FILE;
  for(const PLY_element& element : header.elements) {
    if(element.size == 0) continue;
    if(element.name == "tristrips") return Shell_status::TRIANGLE_STRIPS;
    if(element.properties.empty()) return Shell_status::MALFORMED_FILE;
    for(const PLY_property& property : element.properties)
      if(!is_text && ((!property.is_real && property.value_bytes == 8) || property.count_bytes == 8))
        return Shell_status::UNSUPPORTED_FILE;
    if(element.is_vertex())
      for(const char* a : { "x", "y", "z" }) {
        const std::size_t p = element.find(a);
        if(p == element.properties.size()) return Shell_status::MALFORMED_FILE;
        if(element.properties[p].count_bytes != 0) return Shell_status::MALFORMED_FILE;
        if(!is_text && !element.properties[p].is_real) return Shell_status::UNSUPPORTED_FILE;
      }
    if(element.is_facet()) {
      const std::size_t p = element.vertex_indices();
      if(p == element.properties.size() || element.properties[p].count_bytes == 0) return Shell_status::MALFORMED_FILE;
      // CGAL's reader supports no other type of indices.
      if(!is_text && (element.properties[p].is_real || element.properties[p].value_bytes != 4))
        return Shell_status::UNSUPPORTED_FILE;
    }
  }
  if(!is_text) {
    std::istringstream in{ std::string(result.text()) };
    return has_PLY_data(result.text(), header)
               && CGAL::IO::read_PLY(in, result.soup.points, result.soup.polygons, CGAL::parameters::verbose(false))
             ? Shell_status::SUCCESS
             : Shell_status::MALFORMED_FILE;
  }
  Text_rows rows(result.text(), header.end), free_rows = rows;
  if(read_PLY_text(header, true, rows, result)) return Shell_status::SUCCESS;
  result.soup = Polygon_soup();
  result.line = 0;
  if(read_PLY_text(header, false, free_rows, result)) return Shell_status::SUCCESS;
  result.line = rows.line();
  return Shell_status::MALFORMED_FILE;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_PLY_H
