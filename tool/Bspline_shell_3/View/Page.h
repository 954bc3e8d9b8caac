// A page of HTML with arrays, which shows models in a browser without a network.
#ifndef TOOL_VIEW_PAGE_H
#define TOOL_VIEW_PAGE_H

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace Tool {

// Returns whether the program contains the scripts of pages.
bool has_page_scripts();

// Returns a text with the characters that HTML reserves replaced.
std::string as_HTML(const std::string& text);

class Page
{
public:
  typedef std::vector<std::pair<std::string, std::string> > Lines; // titles and texts

  // Adds an array of numbers, which scripts find by its name. They read its title if they show it.
  template <typename Number>
  void add(const std::string& name, const std::vector<Number>& values, const std::string& title = "")
  {
    add(name, type_name(Number()), { reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number) },
        title);
  }
  // Adds data of another type.
  void add(const std::string& name, const std::string& type, std::string_view bytes, const std::string& title = "");

  // Adds the arrays of another page.
  void add(const Page& other) { m_data += other.m_data; }

  // Returns the number of bytes of all arrays in the page.
  std::size_t size() const { return m_data.size(); }
  std::string HTML(const std::string& title, const Lines& lines) const;

private:
  static const char* type_name(float) { return "Float32"; }
  static const char* type_name(double) { return "Float64"; }
  static const char* type_name(unsigned char) { return "Uint8"; }
  static const char* type_name(int) { return "Int32"; }
  static const char* type_name(unsigned int) { return "Uint32"; }

  std::string m_data;
};

} // namespace Tool

#endif // TOOL_VIEW_PAGE_H
