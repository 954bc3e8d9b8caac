// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <system_error>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Returns the line number of a position, from 1. Vertical tabs mark the ends of continued lines.
inline std::size_t line_at(std::string_view text, std::size_t position)
{
  const auto is_end = [](char c) { return c == '\n' || c == '\v'; };
  return 1 + static_cast<std::size_t>(std::count_if(text.begin(), text.begin() + std::ptrdiff_t(position), is_end));
}

// Iterates over the lines of a text that have words. A comment extends to the end of its line.
class Text_rows
{
public:
  explicit Text_rows(std::string_view text, std::size_t begin = 0, char comment = '\0')
    : m_text(text), m_begin(begin), m_comment(comment)
  {}

  // Appends the words of the next line that has words; returns false if there is none.
  bool next(std::vector<std::string_view>& words)
  {
    const std::size_t before = words.size();
    while(words.size() == before && m_begin < m_text.size()) {
      const std::size_t end = std::min(m_text.find('\n', m_begin), m_text.size());
      std::string_view line = m_text.substr(m_begin, end - m_begin);
      m_begin = end + 1;
      if(m_comment != '\0') line = line.substr(0, comment_in(line));
      while((line = line.substr(std::min(line.find_first_not_of(spaces), line.size()))) != "") {
        words.push_back(line.substr(0, line.find_first_of(spaces)));
        line.remove_prefix(words.back().size());
      }
    }
    return words.size() > before;
  }

  // Returns the beginning of the next line.
  std::size_t position() const { return std::min(m_begin, m_text.size()); }
  // Returns the number of the last line read, from 1.
  std::size_t line() const { return line_at(m_text, std::max(position(), std::size_t(1)) - 1); }

private:
  // Returns the beginning of the comment. In "1.#INF", the '#' is part of a number.
  std::size_t comment_in(std::string_view line) const
  {
    std::size_t position = line.find(m_comment);
    while(position != line.npos && position > 0 && line[position - 1] == '.')
      position = line.find(m_comment, position + 1);
    return position;
  }

  static constexpr const char* spaces = " \t\r\v\f";
  std::string_view m_text;
  std::size_t m_begin;
  char m_comment;
};

// Reads a count or an index. Some programs write them as real numbers.
inline bool read_count(std::string_view word, std::size_t& count)
{
  double value = 0;
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if(result.ec != std::errc() || result.ptr != end || !(value >= 0 && value < 1e15) || value != std::floor(value))
    return false;
  count = static_cast<std::size_t>(value);
  return true;
}

// Reads a coordinate, which may be infinite or NaN, also in Microsoft's notation (1.#INF).
inline bool read_coordinate(std::string_view word, double& x)
{
  if(!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, x);
  if(result.ec == std::errc::result_out_of_range) {
    const bool is_tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    x = is_tiny ? 0 : std::numeric_limits<double>::infinity();
  } else if(result.ec == std::errc() && result.ptr != end && *result.ptr == '#') {
    x = std::numeric_limits<double>::quiet_NaN();
    return true;
  } else if(result.ec != std::errc()) return false;
  return result.ptr == end;
}

// Collects the points and polygons of a text from its words.
class Text_soup
{
public:
  explicit Text_soup(std::string_view text) : m_text(text) {}

  // Adds a point whose coordinates begin at `words[first]`; returns false if they are not numbers.
  bool add_point(const std::vector<std::string_view>& words, std::size_t first, bool is_homogeneous = false)
  {
    std::array<double, 4> x = { 0, 0, 0, 1 };
    const std::size_t size = is_homogeneous ? 4 : 3;
    if(words.size() < first + size) return false;
    for(std::size_t a = 0; a < size; ++a)
      if(!read_coordinate(words[first + a], x[a])) return false;
    const Polygon_soup::Points::value_type p(x[0] / x[3], x[1] / x[3], x[2] / x[3]);
    if(!(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) && line == 0)
      line = line_at(m_text, std::size_t(words[first].data() - m_text.data()));
    soup.points.push_back(p);
    return true;
  }
  // Adds a polygon of `size` indices that begin at `words[first]`; returns false if they are not indices.
  bool add_polygon(const std::vector<std::string_view>& words, std::size_t first, std::size_t size)
  {
    if(words.size() < first || words.size() - first < size) return false;
    soup.polygons.emplace_back(size);
    for(std::size_t i = 0; i < size; ++i)
      if(!read_count(words[first + i], soup.polygons.back()[i])) return false;
    return true;
  }
  std::string_view text() const { return m_text; }

  Polygon_soup soup;
  std::size_t line = 0; // line of the syntax error or of the first point that is not finite; 0 if there is none

private:
  std::string_view m_text;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H
