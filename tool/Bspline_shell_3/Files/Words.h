// Words and numbers of text files.
#ifndef TOOL_FILES_WORDS_H
#define TOOL_FILES_WORDS_H

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace Tool {

// Returns false if the word is not a number. The result is the nearest `double`.
inline bool read_number(std::string_view word, double& x)
{
  if(!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, x);
  if(result.ec == std::errc::result_out_of_range)
    x = word.find_first_of("eE") != word.npos && word[word.find_first_of("eE") + 1] == '-'
          ? 0
          : std::numeric_limits<double>::infinity();
  else if(result.ec != std::errc()) return false;
  return result.ptr == end;
}

inline bool read_integer(std::string_view word, long& n)
{
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, n);
  return result.ec == std::errc() && result.ptr == end;
}

// Appends the shortest decimal number that is read as the same value.
inline void append_number(std::string& text, double x)
{
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}
inline void append_number(std::string& text, float x)
{
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr);
}

// Iterates over the lines of a text that have words.
class Lines
{
public:
  // A line that ends in the character `continuation` continues in the next one.
  explicit Lines(std::string_view text, char continuation = '\0') : m_text(text), m_continuation(continuation) {}

  // Returns false if there is no further line with words.
  bool next()
  {
    words.clear();
    while(words.empty() && m_begin < m_text.size()) {
      bool continues = true;
      line = std::string_view();
      while(continues && m_begin < m_text.size()) {
        const std::size_t end = (std::min)(m_text.find('\n', m_begin), m_text.size());
        std::string_view part = m_text.substr(m_begin, end - m_begin);
        if(!part.empty() && part.back() == '\r') part.remove_suffix(1);
        continues = !part.empty() && part.back() == m_continuation;
        if(line.empty()) line = part;
        if(continues) part.remove_suffix(1);
        split(part);
        m_begin = end + 1;
        ++m_number;
      }
    }
    return !words.empty();
  }

  std::size_t number() const { return m_number; }                             // number of the line, from 1
  std::size_t position() const { return (std::min)(m_begin, m_text.size()); } // beginning of the next line
  // Returns the line after its first word.
  std::string rest() const
  {
    if(words.size() < 2) return "";
    const std::size_t begin = std::size_t(words[1].data() - line.data());
    std::string_view rest = line.substr((std::min)(begin, line.size()));
    while(!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
    return std::string(rest);
  }

  std::string_view line; // the first one, if it is continued
  std::vector<std::string_view> words;

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  void split(std::string_view part)
  {
    for(std::size_t begin = 0; begin < part.size();) {
      while(begin < part.size() && is_space(part[begin])) ++begin;
      std::size_t end = begin;
      while(end < part.size() && !is_space(part[end])) ++end;
      if(end > begin) words.push_back(part.substr(begin, end - begin));
      begin = end;
    }
  }

  std::string_view m_text;
  std::size_t m_begin = 0, m_number = 0;
  char m_continuation;
};

} // namespace Tool

#endif // TOOL_FILES_WORDS_H
