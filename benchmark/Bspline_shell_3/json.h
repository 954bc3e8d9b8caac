// JSON output of benchmarks. JSON has no infinite numbers and no NaN.
#ifndef BENCHMARK_JSON_H
#define BENCHMARK_JSON_H

#include <cmath>
#include <ios>
#include <iostream>
#include <iterator>
#include <locale>
#include <string>

inline std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for(char c : text) {
    if(c == '"' || c == '\\') result += '\\';
    if(static_cast<unsigned char>(c) >= 0x20) result += c;
  }
  return result + "\"";
}

// Prints finite numbers as usual, and others as null.
class JSON_numbers : public std::num_put<char>
{
  typedef std::ostreambuf_iterator<char> Out;

  Out do_put(Out out, std::ios_base& stream, char fill, double x) const override
  {
    if(std::isfinite(x)) return std::num_put<char>::do_put(out, stream, fill, x);
    for(char c : { 'n', 'u', 'l', 'l' }) *out++ = c;
    return out;
  }
};

// Affects std::cout and all streams that are created later.
inline void print_JSON_numbers()
{
  std::locale::global(std::locale(std::locale(), new JSON_numbers));
  std::cout.imbue(std::locale());
}

#endif // BENCHMARK_JSON_H
