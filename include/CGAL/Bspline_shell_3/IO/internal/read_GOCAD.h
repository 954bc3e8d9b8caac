// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_GOCAD_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_GOCAD_H

#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Reads positions and facets of a GOCAD surface. CGAL's reader stops at "nan" and skips vertices that refer to others.
inline Shell_status read_GOCAD(Text_soup& result)
{
  Text_rows rows(result.text(), 0, '#');
  std::vector<std::string_view> words;
  std::unordered_map<std::string_view, std::size_t> position; // by vertex name
  for(; rows.next(words); words.clear()) {
    bool is_right = true;
    if(words[0] == "VRTX" || words[0] == "PVRTX") {
      is_right = words.size() > 1 && result.add_point(words, 2);
      if(is_right) position[words[1]] = result.soup.points.size() - 1;
    } else if(words[0] == "ATOM" || words[0] == "PATOM") {
      is_right = words.size() > 2 && position.count(words[2]) > 0;
      if(is_right) position[words[1]] = position[words[2]];
    } else if(words[0] == "TRGL") {
      is_right = words.size() > 3;
      for(std::size_t i = 1; i <= 3; ++i) is_right = is_right && position.count(words[i]) > 0;
      if(is_right) result.soup.polygons.push_back({ position[words[1]], position[words[2]], position[words[3]] });
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

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_GOCAD_H
