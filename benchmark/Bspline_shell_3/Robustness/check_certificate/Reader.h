// Files: their checksums, words and numbers.
#ifndef CHECK_CERTIFICATE_READER_H
#define CHECK_CERTIFICATE_READER_H

#include <boost/crc.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <ios>
#include <stdexcept>
#include <string>
#include <system_error>

typedef std::array<double, 3> Point;
typedef long long Integer;

// Errors of files, and of claims.
struct Malformed : std::runtime_error
{
  using std::runtime_error::runtime_error;
};
struct Unconfirmed : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

// Numbers in files are at most this large, and edges of cells at least its inverse, so that nothing can overflow.
const double largest = 1e60;

inline std::uint64_t crc64(const char* data, std::size_t size)
{
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, 0xFFFFFFFFFFFFFFFFULL, 0xFFFFFFFFFFFFFFFFULL, true, true> crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

inline std::string hexadecimal(std::uint64_t number)
{
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

inline std::string read_file(const std::string& name)
{
  std::ifstream in(name, std::ios::binary | std::ios::ate);
  if(!in) throw Malformed(name + ": the file cannot be read");
  std::string text(static_cast<std::size_t>((std::max)(std::streamoff(0), std::streamoff(in.tellg()))), '\0');
  in.seekg(0);
  if(!in.read(&text[0], std::streamsize(text.size()))) throw Malformed(name + ": the file cannot be read");
  return text;
}

// The tokens of a text. If strict, single blanks and one '\n' after each line; otherwise, any blanks, and comments.
class Reader
{
public:
  Reader(const std::string& name, const std::string& text, bool strict)
    : name(name), next(text.data()), end(next + text.size()), strict(strict)
  {
    if(!strict) return;
    // The last line is the checksum of all bytes before it.
    const std::size_t line_size = 9 + 16 + 1;
    if(text.size() < line_size || text.compare(text.size() - line_size, 9, "checksum ") != 0 || text.back() != '\n')
      fail("the last line is not a checksum");
    end -= line_size;
    checksum = hexadecimal(crc64(text.data(), text.size() - line_size));
    if(text.compare(text.size() - 17, 16, checksum) != 0) fail("the checksum is wrong");
  }

  [[noreturn]] void fail(const std::string& what) const
  {
    throw Malformed(name + ", line " + std::to_string(line) + ": " + what);
  }

  std::string word()
  {
    start_token();
    const char* const first = next;
    while(next != end && static_cast<unsigned char>(*next) > ' ') ++next;
    if(next == first) fail("a word is missing");
    return std::string(first, next);
  }
  Reader& expect(const std::string& text)
  {
    if(word() != text) fail("expected \"" + text + "\"");
    return *this;
  }
  double number()
  {
    double x = 0;
    parse(x);
    if(!(std::abs(x) <= largest)) fail("a number is not finite, or larger than 1e60");
    return x;
  }
  Integer integer(Integer least, Integer most)
  {
    Integer n = 0;
    parse(n);
    if(n < least || n > most) fail("an integer is out of range");
    return n;
  }
  Point point()
  {
    Point p;
    for(double& x : p) x = number();
    return p;
  }
  void end_line()
  {
    if(!strict) return;
    if(next == end || *next != '\n') fail("expected the end of the line");
    ++next;
    ++line;
    at_line_start = true;
  }
  void end_file()
  {
    if(!strict) skip_blanks();
    if(next != end) fail("unexpected data after the last section");
  }

  std::string checksum;

private:
  void start_token()
  {
    if(!strict) return skip_blanks();
    if(!at_line_start && (next == end || *next++ != ' ')) fail("expected a blank");
    at_line_start = false;
  }
  void skip_blanks()
  {
    for(; next != end && (std::strchr(" \t\r\n", *next) || *next == '#'); ++next) {
      if(*next == '#') next = std::find(next, end, '\n');
      if(next == end) return;
      line += *next == '\n';
    }
  }
  template <class T>
  void parse(T& value)
  {
    start_token();
    const std::from_chars_result result = std::from_chars(next, end, value);
    if(result.ec != std::errc() || (result.ptr != end && static_cast<unsigned char>(*result.ptr) > ' '))
      fail("expected a number");
    next = result.ptr;
  }

  std::string name;
  const char *next, *end;
  bool strict, at_line_start = true;
  std::size_t line = 1;
};

#endif // CHECK_CERTIFICATE_READER_H
