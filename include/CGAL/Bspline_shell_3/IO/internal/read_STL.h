// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_STL_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_STL_H

#include <CGAL/Bspline_shell_3/IO/checksum.h>
#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns whether an STL file is binary: it has a header of 80 bytes, the number of facets, and 50 bytes per facet.
inline bool is_binary_STL(std::string_view text)
{
  constexpr std::size_t header = 84, facet = 50;
  return text.size() >= header
         && text.size() - header == facet * std::size_t(from_little_endian<std::uint32_t>(&text[80]));
}

// \pre is_binary_STL(text)
inline void read_binary_STL(std::string_view text, Polygon_soup& soup)
{
  for(std::size_t facet = 84; facet < text.size(); facet += 50) {
    const std::size_t first = soup.points.size();
    soup.polygons.push_back({ first, first + 1, first + 2 });
    for(std::size_t v = 0; v < 3; ++v) {
      const char* const p = &text[facet + 12 + 12 * v]; // after the normal
      soup.points.emplace_back(from_little_endian<float>(p), from_little_endian<float>(p + 4),
                               from_little_endian<float>(p + 8));
    }
  }
}

// Reads facets of a text. Keywords are case-insensitive. Other lines between facets (names, comments, colors) are
// skipped.
inline Shell_status read_STL_text(Text_soup& result)
{
  Text_rows rows(result.text(), 0, '#');
  std::vector<std::string_view> words;
  std::string keyword;
  bool is_in_facet = false, has_end = false;
  for(; rows.next(words); words.clear()) {
    for(std::size_t w = 0; w < words.size();) {
      keyword.clear();
      for(char c : words[w]) keyword += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
      if(!is_in_facet) {
        if(w == 0) has_end = has_end || keyword == "endsolid" || keyword == "end";
        if(keyword != "facet") break; // the line is skipped
        is_in_facet = true;
        result.soup.polygons.emplace_back();
        ++w;
        continue;
      }
      std::vector<std::size_t>& polygon = result.soup.polygons.back();
      if(keyword == "normal") w += 4; // the normal is not used
      else if(keyword == "vertex" && polygon.size() < 3 && result.add_point(words, w + 1)) {
        polygon.push_back(result.soup.points.size() - 1);
        w += 4;
      } else if(keyword == "outer" || keyword == "loop" || keyword == "endloop") ++w;
      else if(keyword == "endfacet" && polygon.size() == 3) {
        is_in_facet = false;
        ++w;
      } else {
        result.line = rows.line();
        return Shell_status::MALFORMED_FILE;
      }
    }
  }
  if(!is_in_facet && (has_end || !result.soup.polygons.empty())) return Shell_status::SUCCESS;
  result.line = result.text().find('\0') == result.text().npos ? rows.line() : 0;
  return Shell_status::MALFORMED_FILE;
}

/*
 * Reads an STL file. CGAL's reader treats a text as binary unless it begins with "solid" and a space. It treats a text
 * shorter than a binary header as an empty mesh, and stops at "nan".
 */
inline Shell_status read_STL(Text_soup& result)
{
  if(!is_binary_STL(result.text())) return read_STL_text(result);
  read_binary_STL(result.text(), result.soup);
  return Shell_status::SUCCESS;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_STL_H
