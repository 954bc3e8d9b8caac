#include "Words.h"
#include "read_model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>

namespace Tool {

namespace {

constexpr std::size_t header_size = 80, facet_size = 50;

std::uint32_t number_of_facets(std::string_view text)
{
  std::uint32_t size = 0;
  if(text.size() >= header_size + sizeof size) std::memcpy(&size, text.data() + header_size, sizeof size);
  return size;
}

bool is_binary(std::string_view text)
{
  return text.size() >= header_size + sizeof(std::uint32_t)
         && text.size() == header_size + sizeof(std::uint32_t) + number_of_facets(text) * facet_size;
}

// Points at equal positions are one point, because the format has no indices.
class Points
{
public:
  explicit Points(BS::Polygon_soup& soup) : m_soup(soup) {}

  void add_corner(const std::array<double, 3>& p)
  {
    const auto found = m_index.emplace(p, m_soup.points.size());
    if(found.second) m_soup.points.emplace_back(p[0], p[1], p[2]);
    m_soup.polygons.back().push_back(found.first->second);
  }

private:
  BS::Polygon_soup& m_soup;
  std::map<std::array<double, 3>, std::size_t> m_index;
};

File_report read_binary(std::string_view text, Model& model)
{
  model.encoding = "binary";
  model.coordinates = Number_type::FLOAT32;
  const std::string header(text.substr(0, header_size));
  model.comments.push_back(header);
  Attribute a{
    facet_attribute_name, Element::POLYGON, Kind::LABEL, Number_type::UINT16, { facet_attribute_name }, {}, {}
  };
  Points points(model.soup);
  bool is_used = false;
  for(std::uint32_t n = 0; n < number_of_facets(text); ++n) {
    const char* const facet = text.data() + header_size + sizeof(std::uint32_t) + n * facet_size;
    model.soup.polygons.emplace_back();
    for(std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> p;
      std::memcpy(p.data(), facet + (corner + 1) * sizeof p, sizeof p);
      points.add_corner({ p[0], p[1], p[2] });
    }
    std::uint16_t value;
    std::memcpy(&value, facet + facet_size - sizeof value, sizeof value);
    a.values.push_back(value);
    is_used = is_used || value != 0;
  }
  if(is_used) model.attributes.push_back(std::move(a));
  return {};
}

// Some programs write keywords with capital letters.
bool is_keyword(std::string_view word, std::string_view keyword)
{
  const auto is_equal = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b; };
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), is_equal);
}

File_report read_ascii(std::string_view text, Model& model)
{
  File_report report;
  model.encoding = "ascii";
  Attribute a{ solid_name, Element::POLYGON, Kind::LABEL, Number_type::INT32, { solid_name }, {}, {} };
  Points points(model.soup);
  Lines lines(text);
  bool is_right = lines.next() && is_keyword(lines.words[0], "solid");
  if(is_right) a.names.push_back(lines.rest());
  while(is_right && lines.next()) {
    const auto& words = lines.words;
    if(is_keyword(words[0], "solid")) a.names.push_back(lines.rest());
    else if(is_keyword(words[0], "facet")) {
      model.soup.polygons.emplace_back();
      a.values.push_back(double(a.names.size() - 1));
    } else if(is_keyword(words[0], "vertex")) {
      std::array<double, 3> p = {};
      is_right = words.size() >= 4 && !model.soup.polygons.empty();
      for(std::size_t i = 0; i < 3 && is_right; ++i) is_right = read_number(words[i + 1], p[i]);
      if(is_right) points.add_corner(p);
    } else if(is_keyword(words[0], "endloop"))
      is_right = !model.soup.polygons.empty() && model.soup.polygons.back().size() == 3;
  }
  model.attributes.push_back(std::move(a));
  if(is_right) return report;
  report.status = File_status::MALFORMED;
  report.line = lines.number();
  return report;
}

} // namespace

bool is_STL(std::string_view text)
{
  Lines lines(text);
  return is_binary(text) || (lines.next() && is_keyword(lines.words[0], "solid"));
}

File_report read_STL(std::string_view text, Model& model)
{
  return is_binary(text) ? read_binary(text, model) : read_ascii(text, model);
}

} // namespace Tool
