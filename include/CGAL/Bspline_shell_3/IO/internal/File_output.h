// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_OUTPUT_H
#define CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_OUTPUT_H

#include <CGAL/Bspline_shell_3/IO/checksum.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string_view>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

// Writes text and numbers to a stream, through a buffer and independently of all locales, and keeps their checksum.
class File_output
{
public:
  explicit File_output(std::ostream& out) : m_out(out), m_buffer(capacity) {}
  File_output(const File_output&) = delete;
  File_output& operator=(const File_output&) = delete;

  void text(std::string_view text)
  {
    for(std::size_t begin = 0; begin < text.size(); begin += longest) {
      const std::string_view part = text.substr(begin, longest);
      make_room();
      std::memcpy(&m_buffer[m_size], part.data(), part.size());
      m_size += part.size();
    }
  }

  // Writes a number in decimal; reading it yields the same number.
  template <typename T>
  void decimal(T x)
  {
    make_room();
    char* const begin = &m_buffer[m_size];
    if constexpr(std::is_floating_point<T>::value)
      m_size += std::size_t(std::to_chars(begin, begin + longest, x, std::chars_format::general, 17).ptr - begin);
    else m_size += std::size_t(std::to_chars(begin, begin + longest, x).ptr - begin);
  }

  // Writes the bytes of a number, least significant byte first.
  template <typename T>
  void binary(T x)
  {
    make_room();
    const std::array<char, sizeof(T)> bytes = to_little_endian(x);
    std::memcpy(&m_buffer[m_size], bytes.data(), bytes.size());
    m_size += bytes.size();
  }

  // Returns the checksum of all data written so far.
  std::uint64_t checksum()
  {
    pass_on();
    return m_checksum.value();
  }

  // Returns whether all data was written.
  bool flush()
  {
    pass_on();
    m_out.flush();
    return m_out.good();
  }

private:
  static constexpr std::size_t capacity = 1 << 16, longest = 64;

  void make_room()
  {
    if(m_size + longest > capacity) pass_on();
  }
  void pass_on()
  {
    m_checksum.add(m_buffer.data(), m_size);
    m_out.write(m_buffer.data(), std::streamsize(m_size));
    m_size = 0;
  }

  std::ostream& m_out;
  std::vector<char> m_buffer;
  std::size_t m_size = 0;
  Checksum m_checksum;
};

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_INTERNAL_FILE_OUTPUT_H
