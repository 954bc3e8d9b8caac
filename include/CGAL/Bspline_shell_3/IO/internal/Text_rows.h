// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// The lines of a text that hold words. A comment reaches to the end of its line.
class Text_rows
{
public:
  explicit Text_rows(std::string_view text, std::size_t begin = 0, char comment = '\0')
    : m_text(text), m_begin(begin), m_comment(comment) {}

  // appends the words of the next line that has any
  bool next(std::vector<std::string_view>& words)
  {
    const std::size_t before = words.size();
    while(words.size() == before && m_begin < m_text.size()) {
      const std::size_t end = std::min(m_text.find('\n', m_begin), m_text.size());
      std::string_view line = m_text.substr(m_begin, end - m_begin);
      m_begin = end + 1;
      if(m_comment != '\0') line = line.substr(0, line.find(m_comment));
      while((line = line.substr(std::min(line.find_first_not_of(spaces), line.size()))) != "") {
        words.push_back(line.substr(0, line.find_first_of(spaces)));
        line.remove_prefix(words.back().size());
      }
    }
    return words.size() > before;
  }

  // where the next line begins
  std::size_t position() const { return std::min(m_begin, m_text.size()); }

private:
  static constexpr const char* spaces = " \t\r\v\f";
  std::string_view m_text;
  std::size_t m_begin;
  char m_comment;
};

// Reads a number of things, or the index of one. Some programs write them as real numbers.
inline bool read_count(std::string_view word, std::size_t& count)
{
  double value = 0;
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if(result.ec != std::errc() || result.ptr != end || !(value >= 0 && value < 1e15) || value != std::floor(value)) return false;
  count = static_cast<std::size_t>(value);
  return true;
}

// Writes a facet: the number of its vertices and their indices, which begin at `words[first]`.
inline bool write_facet(const std::vector<std::string_view>& words, std::size_t first, std::size_t size, std::string& out)
{
  out += std::to_string(size);
  for(std::size_t i = 0, v; i < size; ++i) {
    if(!read_count(words[first + i], v)) return false;
    (out += ' ') += std::to_string(v);
  }
  out += '\n';
  return true;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_TEXT_ROWS_H
