// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_NORMALIZE_OFF_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_NORMALIZE_OFF_H

#include <CGAL/Bspline_shell_3/IO/internal/Text_rows.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The OFF file whose numbers stand in lines as they like: possible if there is nothing but three counts, positions and indices.
inline bool normalize_free_OFF(const std::string& text, std::string& out)
{
  std::vector<std::string_view> words;
  for(Text_rows rows(text, 0, '#'); rows.next(words); ) {}
  std::size_t n = !words.empty() && words[0] == "OFF" ? 1 : 0, vertices, facets;
  if(words.size() < n + 3 || !read_count(words[n], vertices) || !read_count(words[n + 1], facets)) return false;
  n += 3;
  if(vertices > (words.size() - n) / 3 || facets > words.size()) return false;
  out = "OFF\n" + std::to_string(vertices) + ' ' + std::to_string(facets) + " 0\n";
  for(std::size_t v = 0; v < vertices; ++v, n += 3)
    for(std::size_t a = 0; a < 3; ++a) (out += words[n + a]) += a < 2 ? ' ' : '\n';
  for(std::size_t f = 0, size; f < facets; ++f, n += 1 + size)
    if(n == words.size() || !read_count(words[n], size) || words.size() - n - 1 < size || !write_facet(words, n + 1, size, out)) return false;
  return n == words.size();
}

// The OFF file with a row for the counts, for each vertex and for each facet, whatever else the rows have.
inline bool normalize_OFF_rows(const std::string& text, std::string& out)
{
  Text_rows rows(text, 0, '#');
  std::vector<std::string_view> words;
  if(!rows.next(words)) return false;

  // the keyword [ST][C][N][4][n]OFF
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

  // the numbers of vertices, facets and edges; the last one may be missing
  const std::size_t first = has_keyword && any_dimension ? 1 : 0;
  while(words.size() < first + 2)
    if(!rows.next(words)) return false;
  std::size_t dimension = 3, vertices, facets;
  if(first == 1 && (!read_count(words[0], dimension) || dimension != 3)) return false;
  if(!read_count(words[first], vertices) || !read_count(words[first + 1], facets)) return false;
  if(words.size() == first + 2) {
    Text_rows ahead = rows;
    std::vector<std::string_view> edges;
    if(ahead.next(edges) && edges.size() == 1) rows = ahead;
  } else if(words.size() > first + 3) return false;

  const std::size_t coordinates = has_keyword && homogeneous ? 4 : 3;
  out = (coordinates == 4 ? "4OFF\n" : "OFF\n") + std::to_string(vertices) + ' ' + std::to_string(facets) + " 0\n";
  for(std::size_t v = 0; v < vertices; ++v) {
    words.clear();
    if(!rows.next(words) || words.size() < coordinates) return false;
    for(std::size_t a = 0; a < coordinates; ++a) (out += words[a]) += a + 1 < coordinates ? ' ' : '\n';
  }
  for(std::size_t f = 0, size; f < facets; ++f) {
    words.clear();
    if(!rows.next(words) || !read_count(words[0], size) || words.size() - 1 < size || !write_facet(words, 1, size, out)) return false;
  }
  return true;
}

/*
 * Reduces the text of an OFF file to positions and facets, as CGAL's reader wants them. That reader refuses "OFF8 6 12"
 * and a header without a keyword; takes the first coordinate for the number of edges where that is missing; reads
 * beyond its buffers where colors or texture coordinates are; and reserves space for whatever number the file names.
 * Returns false for binary files, for other dimensions than three, and where a row is missing or too short.
 */
inline bool normalize_OFF(std::string& text)
{
  std::string out;
  if(!normalize_OFF_rows(text, out) && !normalize_free_OFF(text, out)) return false;
  text.swap(out);
  return true;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_NORMALIZE_OFF_H
