#include "PLY_types.h"
#include "Words.h"
#include "numbers.h"
#include "read_model.h"
#include "texture_comments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

namespace {

struct Property
{
  std::string name;
  Number_type type = Number_type::FLOAT64;
  std::optional<Number_type> count; // type of the length, for lists
};

struct Section
{
  std::string name;
  std::size_t size = 0;
  std::vector<Property> properties;

  bool is_of_points() const { return name == "vertex" || name == "vertices"; }
  bool is_of_polygons() const { return name == "face" || name == "faces"; }
};

// Reads numbers from text or from bytes.
class Numbers
{
public:
  Numbers(std::string_view text, std::size_t begin, const std::string& encoding)
    : m_text(text), m_begin(begin), m_is_text(encoding == "ascii"), m_swaps(encoding == "binary_big_endian")
  {}

  bool next(Number_type type, double& x)
  {
    return m_is_text ? next_word(x) : with_type(type, [&](auto zero) { return next_bytes(zero, x); });
  }
  std::size_t position() const { return m_begin; }
  // Returns whether the file can have this number of further values.
  bool can_have(double values) const { return values >= 0 && values <= double(m_text.size() - m_begin); }

private:
  bool next_word(double& x)
  {
    constexpr const char* spaces = " \t\r\n\v\f";
    const std::size_t begin = m_text.find_first_not_of(spaces, m_begin);
    if(begin == m_text.npos) return false;
    m_begin = (std::min)(m_text.find_first_of(spaces, begin), m_text.size());
    return read_number(m_text.substr(begin, m_begin - begin), x);
  }
  template <typename T>
  bool next_bytes(T value, double& x)
  {
    std::array<char, sizeof(T)> bytes;
    if(m_text.size() - m_begin < bytes.size()) return false;
    std::copy_n(m_text.begin() + std::ptrdiff_t(m_begin), bytes.size(), bytes.begin());
    if(m_swaps) std::reverse(bytes.begin(), bytes.end());
    std::memcpy(&value, bytes.data(), bytes.size());
    m_begin += bytes.size();
    x = double(value);
    return true;
  }

  std::string_view m_text;
  std::size_t m_begin;
  bool m_is_text, m_swaps;
};

bool read_property(const Lines& lines, Section& section)
{
  const auto& words = lines.words;
  const bool is_list = words.size() > 1 && words[1] == "list";
  const std::size_t at = is_list ? 3 : 1;
  if(words.size() < at + 2) return false;
  Property property;
  const std::optional<Number_type> type = PLY_type(words[at]);
  if(is_list) property.count = PLY_type(words[2]);
  if(!type || (is_list && !property.count)) return false;
  property.type = *type;
  property.name = words[at + 1];
  section.properties.push_back(property);
  return true;
}

// Reads the lines before the data. Their end is the position of `lines`.
bool read_header(Lines& lines, Model& model, std::vector<Section>& sections)
{
  if(!lines.next() || lines.words[0] != "ply") return false;
  while(lines.next()) {
    const auto& words = lines.words;
    long size = 0;
    if(words[0] == "format" && words.size() > 1) model.encoding = words[1];
    else if(words[0] == "comment" || words[0] == "obj_info") model.comments.emplace_back(lines.line);
    else if(words[0] == "element") {
      if(words.size() < 3 || !read_integer(words[2], size) || size < 0) return false;
      sections.push_back({ std::string(words[1]), std::size_t(size), {} });
    } else if(words[0] == "property") {
      if(sections.empty() || !read_property(lines, sections.back())) return false;
    } else if(words[0] == "end_header")
      return model.encoding == "ascii" || model.encoding == "binary_little_endian"
             || model.encoding == "binary_big_endian";
  }
  return false;
}

// Where the values of a property go: to a component of an attribute or of a coordinate, or nowhere.
struct Place
{
  std::size_t attribute = none, component = 0;
  static constexpr std::size_t none = std::size_t(-1), coordinate = std::size_t(-2);
};

// Makes attributes for the properties of points or polygons that are not lists.
std::vector<Place> make_attributes(const Section& section, Element element, Model& model)
{
  std::vector<Place> places(section.properties.size());
  const auto find = [&](std::string_view name) {
    std::size_t p = 0;
    while(p < section.properties.size() && !(section.properties[p].name == name && !section.properties[p].count)) ++p;
    return p;
  };
  for(std::size_t p = 0; p < places.size(); ++p) {
    const Property& property = section.properties[p];
    if(property.count || places[p].attribute != Place::none) continue;
    const std::string_view axes = "xyz";
    if(element == Element::POINT && property.name.size() == 1 && axes.find(property.name) != axes.npos) {
      places[p] = { Place::coordinate, axes.find(property.name) };
      model.coordinates = property.type;
      continue;
    }
    Attribute attribute;
    attribute.name = property.name;
    attribute.element = element;
    attribute.type = property.type;
    attribute.kind = is_real(property.type) ? Kind::REAL : Kind::LABEL;
    std::vector<std::size_t> members = { p };
    for(const PLY_group& group : PLY_groups) {
      if(group.properties[0] != property.name) continue;
      std::vector<std::size_t> found;
      for(std::string_view name : group.properties) {
        const std::size_t q = name.empty() ? places.size() : find(name);
        if(q < places.size() && section.properties[q].type == property.type) found.push_back(q);
      }
      const std::size_t fewest = group.properties[2].empty() ? 2 : 3;
      if(found.size() < fewest || (group.kind != Kind::COLOR && !is_real(property.type))) continue;
      attribute.name = group.attribute;
      attribute.kind = group.kind;
      members = found;
    }
    for(std::size_t i = 0; i < members.size(); ++i) {
      places[members[i]] = { model.attributes.size(), i };
      attribute.components.push_back(section.properties[members[i]].name);
    }
    attribute.values.assign(section.size * attribute.dimension(), 0);
    model.attributes.push_back(std::move(attribute));
  }
  return places;
}

// Gives the texts in comments to attributes of labels. These comments are written from the attributes.
void read_labels(Model& model)
{
  std::map<std::string, std::vector<std::string> > texts; // by property
  std::vector<std::string> others;
  for(const std::string& comment : model.comments) {
    Lines lines(comment);
    long label = 0;
    const bool is_label = comment.compare(0, std::strlen(PLY_label), PLY_label) == 0 && lines.next()
                          && lines.words.size() > 3 && read_integer(lines.words[3], label);
    const auto is_property = [&](const Attribute& a) {
      return a.kind == Kind::LABEL && a.components[0] == lines.words[2];
    };
    if(is_label && std::any_of(model.attributes.begin(), model.attributes.end(), is_property)) {
      std::vector<std::string>& known = texts[std::string(lines.words[2])];
      if(label == long(known.size())) {
        known.emplace_back(lines.words.size() > 4 ? comment.substr(std::size_t(lines.words[4].data() - comment.data()))
                                                  : "");
        continue;
      }
    }
    others.push_back(comment);
  }
  for(Attribute& a : model.attributes) {
    const auto found = texts.find(a.components[0]);
    if(found != texts.end() && a.kind == Kind::LABEL) a.names = found->second;
  }
  model.comments = std::move(others);
}

class PLY_reader
{
public:
  PLY_reader(Numbers& numbers, Model& model, File_report& report) : m_numbers(numbers), m_model(model), m_report(report)
  {}

  bool read(const Section& section)
  {
    if(section.is_of_points()) return read_elements(section, Element::POINT);
    if(section.is_of_polygons()) return read_elements(section, Element::POLYGON);
    m_report.warnings.push_back("The element \"" + section.name + "\" is omitted: only points and polygons are kept.");
    return read_elements(section, std::nullopt);
  }

private:
  bool read_elements(const Section& section, std::optional<Element> element)
  {
    if(!section.properties.empty() && !m_numbers.can_have(double(section.size))) return false;
    std::vector<Place> places(section.properties.size());
    if(element) places = make_attributes(section, *element, m_model);
    const bool has_corners = element == Element::POLYGON;
    std::size_t texture = Place::none;
    for(const Property& property : section.properties) {
      if(!element || !property.count || (has_corners && is_polygon(property))) continue;
      if(has_corners && is_texture(property)) {
        texture = m_model.attributes.size();
        m_model.attributes.push_back(
          { texture_name, Element::CORNER, Kind::REAL, property.type, { "u", "v" }, {}, {} });
      } else m_report.warnings.push_back("The property \"" + property.name + "\" is omitted, because it is a list.");
    }
    std::vector<double> list;
    for(std::size_t n = 0; n < section.size; ++n) {
      std::array<double, 3> point = {};
      std::vector<double> corners;
      if(has_corners) m_model.soup.polygons.emplace_back();
      for(std::size_t p = 0; p < places.size(); ++p) {
        const Property& property = section.properties[p];
        double x = 0;
        if(property.count) {
          if(!read_list(property, list)) return false;
          if(!has_corners) continue;
          if(is_texture(property)) corners = list;
          if(is_polygon(property))
            for(double index : list) {
              if(!(index >= 0 && index < 1e15)) return false;
              m_model.soup.polygons.back().push_back(std::size_t(index));
            }
          continue;
        }
        if(!m_numbers.next(property.type, x)) return false;
        if(places[p].attribute == Place::coordinate) point[places[p].component] = x;
        else if(places[p].attribute != Place::none) m_model.attributes[places[p].attribute][n][places[p].component] = x;
      }
      if(element == Element::POINT) m_model.soup.points.emplace_back(point[0], point[1], point[2]);
      if(texture == Place::none) continue;
      const std::size_t size = 2 * m_model.soup.polygons.back().size();
      if(corners.size() != size) corners.assign(size, std::numeric_limits<double>::quiet_NaN());
      auto& values = m_model.attributes[texture].values;
      values.insert(values.end(), corners.begin(), corners.end());
    }
    return true;
  }

  bool read_list(const Property& property, std::vector<double>& list)
  {
    double size = 0;
    if(!m_numbers.next(*property.count, size) || !m_numbers.can_have(size)) return false;
    list.assign(std::size_t(size), 0);
    for(double& x : list)
      if(!m_numbers.next(property.type, x)) return false;
    return true;
  }

  static bool is_polygon(const Property& property)
  {
    return property.name == "vertex_indices" || property.name == "vertex_index";
  }
  static bool is_texture(const Property& property) { return property.name == PLY_corner_texture; }

  Numbers& m_numbers;
  Model& m_model;
  File_report& m_report;
};

} // namespace

File_report read_PLY(std::string_view text, Model& model)
{
  File_report report;
  report.status = File_status::MALFORMED;
  Lines lines(text);
  std::vector<Section> sections;
  if(!read_header(lines, model, sections)) {
    report.line = lines.number();
    return report;
  }
  Numbers numbers(text, lines.position(), model.encoding);
  PLY_reader reader(numbers, model, report);
  for(const Section& section : sections)
    if(!reader.read(section)) {
      if(model.encoding == "ascii")
        report.line = 1
                      + std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(numbers.position()), '\n'));
      return report;
    }
  read_labels(model);
  for(const std::string& texture : textures_in_comments(model, model.folder))
    model.files.push_back((std::filesystem::path(model.folder) / texture).string());
  report.status = File_status::SUCCESS;
  return report;
}

} // namespace Tool
