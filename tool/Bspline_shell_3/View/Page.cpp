#include "Page.h"
#include "page_template.h"

namespace Tool {

namespace {

std::string base64(std::string_view bytes)
{
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for(std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t size = bytes.size() - n < 3 ? bytes.size() - n : 3;
    unsigned int bits = 0;
    for(std::size_t i = 0; i < 3; ++i) bits = bits << 8 | (i < size ? static_cast<unsigned char>(bytes[n + i]) : 0u);
    for(std::size_t i = 0; i < 4; ++i) text += i <= size ? digits[bits >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

void replace(std::string& text, const std::string& mark, const std::string& by)
{
  const std::size_t position = text.find(mark);
  if(position != std::string::npos) text.replace(position, mark.size(), by);
}

} // namespace

bool has_page_scripts()
{
  return !page_template().empty();
}

std::string as_HTML(const std::string& text)
{
  std::string result;
  for(char c : text) {
    if(c == '&') result += "&amp;";
    else if(c == '<') result += "&lt;";
    else if(c == '>') result += "&gt;";
    else if(c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

void Page::add(const std::string& name, const std::string& type, std::string_view bytes, const std::string& title)
{
  m_data += "<script type=\"text/plain\" data-name=\"" + as_HTML(name) + "\" data-type=\"" + as_HTML(type) + "\"";
  if(!title.empty()) m_data += " data-title=\"" + as_HTML(title) + "\"";
  m_data += ">" + base64(bytes) + "</script>\n";
}

std::string Page::HTML(const std::string& title, const Lines& lines) const
{
  std::string page(page_template()), report;
  for(const auto& [name, text] : lines) report += "<dt>" + as_HTML(name) + "</dt><dd>" + as_HTML(text) + "</dd>\n";
  // The data come last, because a search for marks would be slow in them.
  replace(page, "@TITLE@", as_HTML(title));
  replace(page, "@HEADING@", as_HTML(title));
  replace(page, "@REPORT@", report);
  replace(page, "@DATA@", m_data);
  return page;
}

} // namespace Tool
