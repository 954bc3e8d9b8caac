// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_CHECKSUM_H
#define CGAL_BSPLINE_SHELL_3_IO_CHECKSUM_H

#include <boost/crc.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace CGAL {
namespace Bspline_shells {

namespace internal {

// Unsigned integer of the size of T, which has 1, 4 or 8 bytes.
template <typename T>
using Bits_of =
  std::conditional_t<sizeof(T) == 8, std::uint64_t, std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint8_t> >;

// Returns the bytes of a number, the least significant first, on every machine.
template <typename T>
std::array<char, sizeof(T)> to_little_endian(T x)
{
  static_assert(sizeof(Bits_of<T>) == sizeof(T), "T must have 1, 4 or 8 bytes.");
  Bits_of<T> bits;
  std::memcpy(&bits, &x, sizeof(T));
  std::array<char, sizeof(T)> bytes;
  for(std::size_t n = 0; n < sizeof(T); ++n) bytes[n] = char((bits >> (8 * n)) & 0xff);
  return bytes;
}

template <typename T>
T from_little_endian(const char* bytes)
{
  typedef Bits_of<T> Bits;
  static_assert(sizeof(Bits) == sizeof(T), "T must have 1, 4 or 8 bytes.");
  Bits bits = 0;
  for(std::size_t n = 0; n < sizeof(T); ++n)
    bits = Bits(bits | (Bits(static_cast<unsigned char>(bytes[n])) << (8 * n)));
  T x;
  std::memcpy(&x, &bits, sizeof(T));
  return x;
}

} // namespace internal

/*!
 * \ingroup PkgBsplineShell3IO
 *
 * \brief CRC-64/XZ of a sequence of bytes, the checksum at the end of this package's files.
 */
class Checksum
{
public:
  void add(const char* bytes, std::size_t size) { m_crc.process_bytes(bytes, size); }
  void add(const std::string& text) { add(text.data(), text.size()); }
  /// Adds the little-endian bytes of a number.
  template <typename T, typename = std::enable_if_t<std::is_arithmetic<T>::value> >
  void add(T x)
  {
    add(internal::to_little_endian(x).data(), sizeof(T));
  }

  /// Returns the checksum of all bytes added.
  std::uint64_t value() const { return m_crc.checksum(); }

  /// Returns a checksum as written to files: 16 lower-case hexadecimal digits.
  static std::string text(std::uint64_t value)
  {
    std::string digits(16, '0');
    for(int n = 15; n >= 0; --n, value >>= 4) digits[std::size_t(n)] = "0123456789abcdef"[value & 15];
    return digits;
  }

private:
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ull, 0xFFFFFFFFFFFFFFFFull, 0xFFFFFFFFFFFFFFFFull, true, true> m_crc;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_CHECKSUM_H
