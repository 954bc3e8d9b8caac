// Texts in UTF-8.
#ifndef TOOL_FILES_UTF8_H
#define TOOL_FILES_UTF8_H

#include <cstddef>
#include <string>
#include <string_view>

namespace Tool {

// Returns the number of bytes of the character at the beginning of a text that is not empty, or 0 if it is not UTF-8.
inline std::size_t UTF8_size(std::string_view text)
{
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned char first = byte(0);
  const std::size_t size = first < 0x80                    ? 1
                           : first >= 0xC2 && first < 0xE0 ? 2
                           : first >= 0xE0 && first < 0xF0 ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  if(size > text.size()) return 0;
  for(std::size_t n = 1; n < size; ++n)
    if((byte(n) & 0xC0) != 0x80) return 0;
  // Longer forms than necessary, surrogates, and numbers that are too large
  const bool is_wrong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) >= 0xA0)
                        || (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) >= 0x90);
  return is_wrong ? 0 : size;
}

// Returns a text in which bytes that are not UTF-8 are replaced by the characters that Latin-1 gives them.
inline std::string to_UTF8(std::string_view text)
{
  std::string result;
  while(!text.empty()) {
    const std::size_t size = UTF8_size(text);
    if(size > 0) result += text.substr(0, size);
    else {
      const unsigned char byte = static_cast<unsigned char>(text[0]);
      result += { char(0xC0 | byte >> 6), char(0x80 | (byte & 0x3F)) };
    }
    text.remove_prefix(size > 0 ? size : 1);
  }
  return result;
}

} // namespace Tool

#endif // TOOL_FILES_UTF8_H
