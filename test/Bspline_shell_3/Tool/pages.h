// The arrays in a page.
#ifndef TEST_TOOL_PAGES_H
#define TEST_TOOL_PAGES_H

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

// Decodes text that has four characters for every three bytes.
inline std::string decoded_base64(const std::string& text)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned int bits = 0, number = 0;
  for(char c : text) {
    if(c == '=') break;
    bits = bits << 6 | static_cast<unsigned int>(digits.find(c));
    number += 6;
    if(number < 8) continue;
    number -= 8;
    bytes += char(bits >> number & 255);
  }
  return bytes;
}

inline bool has_array(const std::string& page, const std::string& name)
{
  return page.find("data-name=\"" + name + "\"") != std::string::npos;
}

template <typename Number>
std::vector<Number> array_of(const std::string& page, const std::string& name)
{
  const std::size_t begin = page.find('>', page.find("data-name=\"" + name + "\"")) + 1;
  const std::string bytes = decoded_base64(page.substr(begin, page.find('<', begin) - begin));
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

#endif // TEST_TOOL_PAGES_H
