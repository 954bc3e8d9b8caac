// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_INPUT_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_INPUT_H

#include <CGAL/Bspline_shell_3/IO/checksum.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Parses the words of a line, which are separated by single blanks. After one failure, all following calls fail.
class Words
{
public:
  explicit Words(std::string_view line) : m_rest(line) {}

  Words& word(std::string_view expected)
  {
    begin_word();
    if(m_rest.substr(0, expected.size()) == expected) m_rest.remove_prefix(expected.size());
    else m_ok = false;
    return *this;
  }

  // Fails for numbers that are infinite, NaN, or out of range.
  template <typename T>
  Words& number(T& x)
  {
    begin_word();
    const std::from_chars_result result = std::from_chars(m_rest.data(), m_rest.data() + m_rest.size(), x);
    m_ok = m_ok && result.ec == std::errc();
    if constexpr(std::is_floating_point<T>::value) m_ok = m_ok && std::isfinite(x);
    if(m_ok) m_rest.remove_prefix(std::size_t(result.ptr - m_rest.data()));
    return *this;
  }

  bool are_as_expected() const { return m_ok; }                // all words so far are as expected
  bool are_complete() const { return m_ok && m_rest.empty(); } // and the line has no more words

private:
  void begin_word()
  {
    if(!m_first) {
      m_ok = m_ok && !m_rest.empty() && m_rest.front() == ' ';
      if(m_ok) m_rest.remove_prefix(1);
    }
    m_first = false;
  }

  std::string_view m_rest;
  bool m_first = true, m_ok = true;
};

// Reads lines or bytes of a stream through a buffer, independently of all locales, and keeps the checksum of the data.
// Uses little memory for any file content, and does not throw.
class File_input
{
public:
  // Uses a separate stream, because the caller's stream may be set to throw.
  explicit File_input(std::istream& in) : m_in(in.rdbuf()), m_buffer(capacity) {}
  File_input(const File_input&) = delete;
  File_input& operator=(const File_input&) = delete;

  // Returns whether the file continues with `text`; does not consume it.
  bool starts_with(std::string_view text)
  {
    require(text.size());
    return available().substr(0, text.size()) == text;
  }

  // Returns the next line without its end. If there is no line, or if it is too long, returns an empty line and sets
  // `is_bad()`.
  std::string_view line()
  {
    std::size_t length = available().find('\n');
    if(length == std::string_view::npos) {
      require(capacity);
      length = available().find('\n');
    }
    if(length == std::string_view::npos) {
      m_bad = true;
      return std::string_view();
    }
    const std::string_view line = available().substr(0, length);
    m_checksum.add(line.data(), length + 1);
    m_begin += length + 1;
    return line;
  }

  // Returns zero and sets `is_bad()` if the file ends too early.
  template <typename T>
  T binary()
  {
    require(sizeof(T));
    if(available().size() < sizeof(T)) {
      m_bad = true;
      return T();
    }
    const T x = from_little_endian<T>(available().data());
    m_checksum.add(available().data(), sizeof(T));
    m_begin += sizeof(T);
    return x;
  }

  bool is_bad() const { return m_bad; }
  std::uint64_t checksum() const { return m_checksum.value(); } // covers all data read so far
  bool is_at_end()
  {
    require(1);
    return available().empty();
  }

private:
  static constexpr std::size_t capacity = 1 << 16; // bytes; also the length of the longest line

  std::string_view available() const { return std::string_view(&m_buffer[0] + m_begin, m_end - m_begin); }

  // Makes at least `size` characters available, unless the file ends earlier.
  void require(std::size_t size)
  {
    if(m_end - m_begin >= size) return;
    std::memmove(&m_buffer[0], &m_buffer[0] + m_begin, m_end - m_begin);
    m_end -= m_begin;
    m_begin = 0;
    m_in.read(&m_buffer[0] + m_end, std::streamsize(capacity - m_end));
    m_end += std::size_t(m_in.gcount());
  }

  std::istream m_in;
  std::vector<char> m_buffer;
  std::size_t m_begin = 0, m_end = 0;
  bool m_bad = false;
  Checksum m_checksum;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_INPUT_H
