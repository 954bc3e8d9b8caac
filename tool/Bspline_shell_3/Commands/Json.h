// Results as JSON.
#ifndef TOOL_COMMANDS_JSON_H
#define TOOL_COMMANDS_JSON_H

#include "../Files/Words.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace Tool {

// An object whose members are listed in the order in which they are added.
class Json
{
public:
  Json& add(const std::string& name, const std::string& text) { return raw(name, quoted(text)); }
  Json& add(const std::string& name, const char* text) { return raw(name, quoted(text)); }
  Json& add(const std::string& name, std::size_t n) { return raw(name, std::to_string(n)); }
  Json& add(const std::string& name, bool b) { return raw(name, b ? "true" : "false"); }
  Json& add(const std::string& name, double x)
  {
    std::string text;
    if(std::isfinite(x)) append_number(text, x);
    else text = "null";
    return raw(name, text);
  }
  Json& add(const std::string& name, const Json& object) { return raw(name, object.text()); }
  Json& add(const std::string& name, const std::vector<std::string>& list)
  {
    std::string text = "[";
    for(const std::string& item : list) text += (text.size() > 1 ? ", " : "") + quoted(item);
    return raw(name, text + "]");
  }
  Json& add(const std::string& name, const std::vector<std::size_t>& list)
  {
    std::string text = "[";
    for(std::size_t item : list) text += (text.size() > 1 ? ", " : "") + std::to_string(item);
    return raw(name, text + "]");
  }
  std::string text() const { return "{" + m_members + "}"; }

private:
  Json& raw(const std::string& name, const std::string& value)
  {
    m_members += (m_members.empty() ? "" : ", ") + quoted(name) + ": " + value;
    return *this;
  }
  static std::string quoted(const std::string& text)
  {
    std::string result = "\"";
    for(char c : text) {
      if(c == '"' || c == '\\') result += '\\';
      if(static_cast<unsigned char>(c) >= 0x20) result += c;
      else result += std::string("\\u00") + (c < 0x10 ? '0' : '1') + "0123456789abcdef"[c & 15];
    }
    return result + '"';
  }

  std::string m_members;
};

} // namespace Tool

#endif // TOOL_COMMANDS_JSON_H
