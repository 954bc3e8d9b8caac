// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OBJ_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OBJ_H

#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Joins lines that end in a backslash outside a comment. Their ends become vertical tabs, which are white space.
inline void join_continued_lines(std::string& text)
{
  for(std::size_t begin = 0, end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
    const std::size_t last = end - (end > begin && text[end - 1] == '\r');
    if(last == begin || text[last - 1] != '\\') continue;
    if(std::string_view(text).substr(begin, last - begin).find('#') != std::string_view::npos) continue;
    text[last - 1] = ' ';
    text[end] = '\v';
  }
}

// Reads the vertex index of v, v/vt, v//vn or v/vt/vn. Negative indices count back from the last vertex read.
inline bool read_OBJ_index(std::string_view word, std::size_t points, std::size_t& index)
{
  word = word.substr(0, word.find('/'));
  const bool is_relative = !word.empty() && word.front() == '-';
  if(is_relative) word.remove_prefix(1);
  if(!read_count(word, index) || index == 0 || (is_relative && index > points)) return false;
  index = is_relative ? points - index : index - 1;
  return true;
}

/*
 * Reads positions and facets of an OBJ file. CGAL's reader rejects continued lines, ends a facet at an index that is
 * not a number, and stops at "nan".
 *
 * \pre `join_continued_lines()` was called
 */
inline Shell_status read_OBJ(Text_soup& result)
{
  Text_rows rows(result.text(), 0, '#');
  std::vector<std::string_view> words;
  for(; rows.next(words); words.clear()) {
    bool is_right = true;
    if(words[0] == "v") is_right = result.add_point(words, 1);
    else if(words[0] == "f") {
      result.soup.polygons.emplace_back(words.size() - 1);
      for(std::size_t i = 1; i < words.size(); ++i)
        is_right = is_right && read_OBJ_index(words[i], result.soup.points.size(), result.soup.polygons.back()[i - 1]);
    }
    if(is_right) continue;
    result.line = rows.line();
    return Shell_status::MALFORMED_FILE;
  }
  return result.soup.points.empty() && result.soup.polygons.empty() ? Shell_status::MALFORMED_FILE
                                                                    : Shell_status::SUCCESS;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OBJ_H
