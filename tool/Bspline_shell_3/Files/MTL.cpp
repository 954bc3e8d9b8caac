#include "MTL.h"

#include <cstddef>
#include <filesystem>

namespace Tool {

std::string_view texture_of(const Lines& lines)
{
  const std::string_view keyword = lines.words[0];
  const bool is_texture = keyword.substr(0, 4) == "map_" || keyword == "bump" || keyword == "disp" || keyword == "decal"
                          || keyword == "norm" || keyword == "refl";
  if(!is_texture) return {};
  std::size_t w = 1;
  while(w < lines.words.size() && lines.words[w].size() > 1 && lines.words[w].front() == '-') {
    const std::string_view option = lines.words[w++];
    double number;
    if(option == "-o" || option == "-s" || option == "-t") {
      for(int i = 0; i < 3 && w < lines.words.size() && read_number(lines.words[w], number); ++i) ++w;
    } else w += option == "-mm" ? 2 : 1;
  }
  if(w >= lines.words.size()) return {};
  const char* const begin = lines.words[w].data();
  return { begin, std::size_t(lines.words.back().data() + lines.words.back().size() - begin) };
}

std::string moved_name(const std::string& name, const std::string& from, const std::string& to)
{
  namespace fs = std::filesystem;
  const auto absolute = [](const std::string& folder) {
    return fs::absolute(folder.empty() ? "." : folder).lexically_normal();
  };
  if(fs::path(name).is_absolute() || absolute(from) == absolute(to)) return name;
  return (absolute(from) / name).lexically_normal().lexically_relative(absolute(to)).string();
}

std::string moved_materials(const std::string& text, const std::string& from, const std::string& to)
{
  std::string moved;
  Lines lines(text);
  while(lines.next()) {
    const std::string_view texture = texture_of(lines);
    if(!texture.empty()) {
      const std::size_t begin = std::size_t(texture.data() - lines.line.data());
      moved += lines.line.substr(0, begin);
      moved += moved_name(std::string(texture), from, to);
      moved += lines.line.substr(begin + texture.size());
    } else moved += lines.line;
    moved += '\n';
  }
  return moved;
}

} // namespace Tool
