#include "MTL.h"
#include "Words.h"
#include "read_model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Tool {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Texts that lines set for the polygons after them, such as names of groups. Label 0 is that of polygons before them.
struct State
{
  const char* name;
  std::vector<std::string> texts = { "" };
  std::map<std::string, std::size_t> label = { { "", 0 } };
  std::size_t current = 0;
  std::vector<double> of_polygons = {};

  void set(const std::string& text)
  {
    const auto found = label.emplace(text, texts.size());
    if(found.second) texts.push_back(text);
    current = found.first->second;
  }
};

// Values that polygons refer to: texture coordinates or normals.
struct Values
{
  std::vector<std::array<double, 3> > values = {};
  std::size_t dimension = 0;
  std::vector<double> of_corners = {};
  bool is_used = false;

  void append(std::size_t corner)
  {
    for(std::size_t i = 0; i < dimension; ++i)
      of_corners.push_back(corner < values.size() ? values[corner][i] : unknown);
    is_used = is_used || corner < values.size();
  }
};

constexpr std::size_t none = std::size_t(-1);

// Reads an index from 1, or a negative one that counts back from the end. An empty word is none.
bool read_index(std::string_view word, std::size_t size, std::size_t& index)
{
  long n = 0;
  index = none;
  if(word.empty()) return true;
  if(!read_integer(word, n) || n == 0 || (n < 0 && std::size_t(-n) > size)) return false;
  index = n > 0 ? std::size_t(n - 1) : size - std::size_t(-n);
  return true;
}

class OBJ_reader
{
public:
  OBJ_reader(Model& model, File_report& report) : m_model(model), m_report(report) {}

  bool read(const Lines& lines)
  {
    const std::string_view word = lines.words[0];
    if(word.front() == '#') m_model.comments.emplace_back(lines.line);
    else if(word == "v") return read_point(lines.words);
    else if(word == "vt") return read_value(lines.words, m_texture);
    else if(word == "vn") return read_value(lines.words, m_normals);
    else if(word == "f") return read_polygon(lines.words);
    else if(word == "usemtl") m_material.set(lines.rest());
    else if(word == "g") m_group.set(lines.rest());
    else if(word == "o") m_object.set(lines.rest());
    else if(word == "s") m_smoothing.set(lines.rest() == "off" ? "0" : lines.rest());
    else if(word == "mtllib") read_library(lines.rest());
    else if(m_left_out.insert(std::string(word)).second)
      m_report.warnings.push_back("Lines that begin with \"" + std::string(word) + "\" are omitted.");
    return true;
  }

  // Makes the attributes. Values may follow the polygons that refer to them.
  void finish()
  {
    for(const auto& corner : m_corners) {
      m_texture.append(corner[0]);
      m_normals.append(corner[1]);
    }
    if(!m_colors.empty()) {
      Attribute a{ color_name, Element::POINT, Kind::COLOR, Number_type::FLOAT64, { "red", "green", "blue" }, {}, {} };
      m_colors.resize(3 * m_model.soup.points.size(), unknown);
      a.values = std::move(m_colors);
      m_model.attributes.push_back(std::move(a));
    }
    if(m_texture.is_used) {
      Attribute a{ texture_name, Element::CORNER, Kind::REAL, Number_type::FLOAT64, { "u", "v", "w" }, {}, {} };
      add_corners(std::move(a), m_texture);
    }
    if(m_normals.is_used) {
      Attribute a{ normal_name, Element::CORNER, Kind::NORMAL, Number_type::FLOAT64, { "nx", "ny", "nz" }, {}, {} };
      add_corners(std::move(a), m_normals);
    }
    for(State* state : { &m_object, &m_group, &m_material, &m_smoothing })
      if(state->texts.size() > 1) {
        Attribute a{ state->name, Element::POLYGON, Kind::LABEL, Number_type::INT32, { state->name }, {}, {} };
        a.values = std::move(state->of_polygons);
        a.names = std::move(state->texts);
        m_model.attributes.push_back(std::move(a));
      }
  }

private:
  typedef std::vector<std::string_view> Words;

  bool read_point(const Words& words)
  {
    std::vector<double> x;
    for(std::size_t w = 1; w < words.size(); ++w) {
      x.emplace_back();
      if(!read_number(words[w], x.back())) return false;
    }
    if(x.size() < 3) return false;
    const double weight = x.size() == 4 || x.size() == 7 ? x[3] : 1;
    m_model.soup.points.emplace_back(x[0] / weight, x[1] / weight, x[2] / weight);
    if(x.size() >= 6) {
      m_colors.resize(3 * (m_model.soup.points.size() - 1), unknown);
      m_colors.insert(m_colors.end(), x.end() - 3, x.end());
    }
    return true;
  }

  static bool read_value(const Words& words, Values& values)
  {
    std::array<double, 3> x = {};
    const std::size_t size = (std::min)(words.size() - 1, x.size());
    for(std::size_t i = 0; i < size; ++i)
      if(!read_number(words[i + 1], x[i])) return false;
    values.values.push_back(x);
    values.dimension = (std::max)(values.dimension, size);
    return size > 0;
  }

  bool read_polygon(const Words& words)
  {
    m_model.soup.polygons.emplace_back();
    for(std::size_t w = 1; w < words.size(); ++w) {
      std::array<std::string_view, 3> parts;
      std::string_view rest = words[w];
      for(std::size_t i = 0; i < 3 && !rest.empty(); ++i) {
        parts[i] = rest.substr(0, rest.find('/'));
        rest.remove_prefix((std::min)(parts[i].size() + 1, rest.size()));
      }
      std::array<std::size_t, 3> index;
      if(!read_index(parts[0], m_model.soup.points.size(), index[0])
         || !read_index(parts[1], m_texture.values.size(), index[1])
         || !read_index(parts[2], m_normals.values.size(), index[2]) || index[0] == none)
        return false;
      m_model.soup.polygons.back().push_back(index[0]);
      m_corners.push_back({ index[1], index[2] });
    }
    for(State* state : { &m_object, &m_group, &m_material, &m_smoothing })
      state->of_polygons.push_back(double(state->current));
    return true;
  }

  void add_corners(Attribute attribute, Values& values)
  {
    attribute.components.resize(values.dimension);
    attribute.values = std::move(values.of_corners);
    m_model.attributes.push_back(std::move(attribute));
  }

  void read_library(const std::string& name)
  {
    std::string text;
    const std::filesystem::path folder(m_model.folder);
    const std::string file = (folder / name).string();
    if(read_text(file, text) != File_status::SUCCESS) {
      m_report.warnings.push_back("The material library " + name + " cannot be read.");
      return;
    }
    m_model.materials += text + (text.back() == '\n' ? "" : "\n");
    m_model.files.push_back(file);
    Lines lines(text);
    while(lines.next())
      if(!texture_of(lines).empty()) m_model.files.push_back((folder / texture_of(lines)).string());
  }

  Model& m_model;
  File_report& m_report;
  State m_object = { object_name }, m_group = { group_name }, m_material = { material_name },
        m_smoothing = { smoothing_name };
  Values m_texture, m_normals;
  std::vector<std::array<std::size_t, 2> > m_corners;
  std::vector<double> m_colors;
  std::set<std::string> m_left_out;
};

} // namespace

File_report read_OBJ(std::string_view text, Model& model)
{
  File_report report;
  Lines lines(text, '\\');
  OBJ_reader reader(model, report);
  while(lines.next()) {
    // A comment may follow the words of a line.
    if(lines.words[0].front() != '#') {
      const auto is_comment = [](std::string_view word) { return word.front() == '#'; };
      lines.words.erase(std::find_if(lines.words.begin(), lines.words.end(), is_comment), lines.words.end());
    }
    if(reader.read(lines)) continue;
    report.status = File_status::MALFORMED;
    report.line = lines.number();
    return report;
  }
  reader.finish();
  return report;
}

} // namespace Tool
