#include "Words.h"
#include "read_model.h"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace Tool {

namespace {

bool read_numbers(const std::vector<std::string_view>& words, std::size_t first, std::vector<double>& values)
{
  values.clear();
  for(std::size_t w = first; w < words.size(); ++w) {
    values.emplace_back();
    if(!read_number(words[w], values.back())) return false;
  }
  return true;
}

bool has_point(const std::vector<std::string_view>& words, std::size_t first)
{
  for(std::size_t w = first; w < words.size(); ++w)
    if(words[w].find('.') != words[w].npos) return true;
  return false;
}

// Lines with words before a comment. The first lines of comments are those of the file.
class Rows
{
public:
  Rows(std::string_view text, std::vector<std::string>& comments) : m_lines(text), m_comments(comments) {}

  bool next()
  {
    while(m_lines.next()) {
      auto& words = m_lines.words;
      for(std::size_t w = 0; w < words.size(); ++w)
        if(words[w].front() == '#') {
          if(w == 0) m_comments.emplace_back(m_lines.line);
          words.resize(w);
        }
      if(!words.empty()) return true;
    }
    return false;
  }
  std::vector<std::string_view>& words() { return m_lines.words; }
  std::size_t number() const { return m_lines.number(); }

private:
  Lines m_lines;
  std::vector<std::string>& m_comments;
};

Attribute color(Element element, std::size_t dimension, bool is_of_reals)
{
  Attribute a;
  a.name = color_name;
  a.element = element;
  a.kind = Kind::COLOR;
  a.type = is_of_reals ? Number_type::FLOAT64 : Number_type::UINT8;
  for(const char* name : { "red", "green", "blue", "alpha" })
    if(a.dimension() < dimension) a.components.push_back(name);
  return a;
}

} // namespace

File_report read_OFF(std::string_view text, Model& model)
{
  File_report report;
  Rows rows(text, model.comments);
  const auto fail = [&](File_status status) {
    report.status = status;
    report.line = rows.number();
    return report;
  };
  if(!rows.next()) return fail(File_status::MALFORMED);
  std::string prefix;
  const std::string_view head = rows.words()[0];
  const bool has_head = head.size() >= 3 && head.substr(head.size() - 3) == "OFF";
  if(has_head) {
    prefix = head.substr(0, head.size() - 3);
    rows.words().erase(rows.words().begin());
    if(!rows.words().empty() && rows.words()[0] == "BINARY") return fail(File_status::UNSUPPORTED);
    if(rows.words().empty() && !rows.next()) return fail(File_status::MALFORMED);
  }
  if(prefix.find_first_of("4n") != prefix.npos) return fail(File_status::UNSUPPORTED);
  const bool has_texture = prefix.find("ST") != prefix.npos, has_normals = prefix.find('N') != prefix.npos;
  const bool has_colors = prefix.find('C') != prefix.npos;
  long points = 0, polygons = 0;
  if(rows.words().size() < 2 || !read_integer(rows.words()[0], points) || !read_integer(rows.words()[1], polygons)
     || points < 0 || polygons < 0)
    return fail(File_status::MALFORMED);

  std::vector<Attribute> of_points; // normals, colors, texture
  std::vector<double> values;
  const std::size_t before = 3 + (has_normals ? 3 : 0), after = has_texture ? 2 : 0;
  for(long n = 0; n < points; ++n) {
    if(!rows.next() || !read_numbers(rows.words(), 0, values) || values.size() < before + after)
      return fail(File_status::MALFORMED);
    const std::size_t colors = has_colors ? values.size() - before - after : 0;
    if(has_colors && colors != 3 && colors != 4) return fail(File_status::MALFORMED);
    if(n == 0) {
      const Number_type real = Number_type::FLOAT64;
      if(has_normals)
        of_points.push_back({ normal_name, Element::POINT, Kind::NORMAL, real, { "nx", "ny", "nz" }, {}, {} });
      if(has_colors) {
        auto words = rows.words();
        words.resize(before + colors);
        of_points.push_back(color(Element::POINT, colors, has_point(words, before)));
      }
      if(has_texture) of_points.push_back({ texture_name, Element::POINT, Kind::REAL, real, { "s", "t" }, {}, {} });
    }
    model.soup.points.emplace_back(values[0], values[1], values[2]);
    std::size_t at = 3;
    for(Attribute& a : of_points) {
      if(values.size() < at + a.dimension()) return fail(File_status::MALFORMED);
      a.values.insert(a.values.end(), values.begin() + std::ptrdiff_t(at),
                      values.begin() + std::ptrdiff_t(at + a.dimension()));
      at += a.dimension();
    }
  }

  std::vector<std::pair<std::size_t, std::array<double, 4> > > colors; // numbers of components, and these
  std::size_t most = 0;
  bool are_reals = false, are_indices = false;
  for(long n = 0; n < polygons; ++n) {
    long size = 0;
    if(!rows.next() || !read_integer(rows.words()[0], size) || size < 0 || !read_numbers(rows.words(), 1, values)
       || values.size() < std::size_t(size))
      return fail(File_status::MALFORMED);
    model.soup.polygons.emplace_back();
    for(std::size_t i = 0; i < std::size_t(size); ++i) {
      if(!(values[i] >= 0 && values[i] < 1e15)) return fail(File_status::MALFORMED);
      model.soup.polygons.back().push_back(std::size_t(values[i]));
    }
    const std::size_t rest = values.size() - std::size_t(size);
    colors.emplace_back(rest == 3 || rest == 4 ? rest : 0, std::array<double, 4>());
    for(std::size_t i = 0; i < colors.back().first; ++i) colors.back().second[i] = values[std::size_t(size) + i];
    most = (std::max)(most, colors.back().first);
    if(colors.back().first > 0) are_reals = are_reals || has_point(rows.words(), 1 + std::size_t(size));
    are_indices = are_indices || rest == 1 || rest == 2;
  }
  if(are_indices) report.warnings.push_back("Colors that are indices of a color map are omitted.");
  model.attributes = std::move(of_points);
  if(most > 0) {
    Attribute a = color(Element::POLYGON, most, are_reals);
    for(const auto& c : colors)
      for(std::size_t i = 0; i < most; ++i)
        a.values.push_back(c.first == 0  ? std::numeric_limits<double>::quiet_NaN()
                           : i < c.first ? c.second[i]
                           : are_reals   ? 1
                                         : 255);
    model.attributes.push_back(std::move(a));
  }
  return report;
}

} // namespace Tool
