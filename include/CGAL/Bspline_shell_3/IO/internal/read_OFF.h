// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OFF_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OFF_H

#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Reads an OFF file with arbitrary line breaks, which must contain only three counts, positions, and indices.
inline bool read_free_OFF(Text_soup& result)
{
  std::vector<std::string_view> words;
  for(Text_rows rows(result.text(), 0, '#'); rows.next(words);) {}
  std::size_t n = !words.empty() && words[0] == "OFF" ? 1 : 0, vertices, facets;
  if(words.size() < n + 3 || !read_count(words[n], vertices) || !read_count(words[n + 1], facets)) return false;
  n += 3;
  if(vertices > (words.size() - n) / 3 || facets > words.size()) return false;
  for(std::size_t v = 0; v < vertices; ++v, n += 3)
    if(!result.add_point(words, n)) return false;
  for(std::size_t f = 0, size; f < facets; ++f, n += 1 + size)
    if(n == words.size() || !read_count(words[n], size) || !result.add_polygon(words, n + 1, size)) return false;
  return n == words.size();
}

// Reads an OFF file with one row for the counts and one for each vertex and facet. Further words after a vertex or
// facet are ignored.
inline Shell_status read_OFF_rows(Text_rows& rows, Text_soup& result)
{
  std::vector<std::string_view> words;
  if(!rows.next(words)) return Shell_status::MALFORMED_FILE;

  // The keyword is [ST][C][N][4][n]OFF.
  std::string_view keyword = words[0];
  const auto skip = [&keyword](std::string_view prefix) {
    if(keyword.substr(0, prefix.size()) != prefix) return false;
    keyword.remove_prefix(prefix.size());
    return true;
  };
  skip("ST"), skip("C"), skip("N");
  const bool homogeneous = skip("4"), any_dimension = skip("n"), has_keyword = skip("OFF");
  if(has_keyword && keyword.empty()) words.erase(words.begin());
  else if(has_keyword) words[0] = keyword;
  if(has_keyword && !words.empty() && words[0] == "BINARY") return Shell_status::UNSUPPORTED_FILE;

  // The number of vertices, facets, and edges; the last one may be missing.
  const std::size_t first = has_keyword && any_dimension ? 1 : 0;
  while(words.size() < first + 2)
    if(!rows.next(words)) return Shell_status::MALFORMED_FILE;
  std::size_t dimension = 3, vertices, facets;
  if(first == 1 && !read_count(words[0], dimension)) return Shell_status::MALFORMED_FILE;
  if(dimension != 3) return Shell_status::UNSUPPORTED_FILE;
  if(!read_count(words[first], vertices) || !read_count(words[first + 1], facets)) return Shell_status::MALFORMED_FILE;
  if(words.size() == first + 2) {
    Text_rows ahead = rows;
    std::vector<std::string_view> edges;
    if(ahead.next(edges) && edges.size() == 1) rows = ahead;
  } else if(words.size() > first + 3) return Shell_status::MALFORMED_FILE;

  for(std::size_t v = 0; v < vertices; ++v) {
    words.clear();
    if(!rows.next(words)) return Shell_status::MALFORMED_FILE;
    if(!result.add_point(words, 0, has_keyword && homogeneous)) return Shell_status::MALFORMED_FILE;
  }
  for(std::size_t f = 0, size; f < facets; ++f) {
    words.clear();
    if(!rows.next(words) || !read_count(words[0], size)) return Shell_status::MALFORMED_FILE;
    if(!result.add_polygon(words, 1, size)) return Shell_status::MALFORMED_FILE;
  }
  return Shell_status::SUCCESS;
}

/*
 * Reads positions and facets of an OFF file. CGAL's reader rejects "OFF8 6 12" and headers without a keyword. If the
 * number of edges is missing, it reads the first coordinate instead. It also reads beyond its buffers if there are
 * colors or texture coordinates, reserves memory for any count in the file, and stops at "nan".
 */
inline Shell_status read_OFF(Text_soup& result)
{
  Text_rows rows(result.text(), 0, '#');
  const Shell_status status = read_OFF_rows(rows, result);
  if(status != Shell_status::MALFORMED_FILE) return status;
  result.soup = Polygon_soup();
  result.line = 0;
  if(read_free_OFF(result)) return Shell_status::SUCCESS;
  result.line = rows.line();
  return Shell_status::MALFORMED_FILE;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_READ_OFF_H
