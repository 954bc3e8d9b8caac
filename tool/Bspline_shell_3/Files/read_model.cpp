#include "read_model.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace Tool {

std::string extension_of(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

File_status read_text(const std::string& file, std::string& text)
{
  std::error_code error;
  const std::filesystem::file_status found = std::filesystem::status(file, error);
  if(found.type() == std::filesystem::file_type::not_found) return File_status::MISSING;
  std::ifstream in(file, std::ios::binary);
  if(!in || std::filesystem::is_directory(found)) return File_status::UNREADABLE;
  text.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  return in.bad() ? File_status::UNREADABLE : text.empty() ? File_status::EMPTY : File_status::SUCCESS;
}

File_report read_model(const std::string& file, Model& model)
{
  File_report report;
  const std::string extension = extension_of(file);
  File_report (*const read)(std::string_view, Model&) = extension == ".ply"                           ? read_PLY
                                                        : extension == ".obj"                         ? read_OBJ
                                                        : extension == ".off"                         ? read_OFF
                                                        : extension == ".stl"                         ? read_STL
                                                        : extension == ".gltf" || extension == ".glb" ? read_GLTF
                                                                                                      : nullptr;
  std::string text;
  report.status = read_text(file, text);
  if(report.status == File_status::MISSING || report.status == File_status::UNREADABLE) return report;
  if(read == nullptr) report.status = File_status::UNSUPPORTED;
  if(!report) return report;

  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string_view contents = text;
  if(contents.substr(0, byte_order_mark.size()) == byte_order_mark) contents.remove_prefix(byte_order_mark.size());
  Model found;
  found.folder = std::filesystem::path(file).parent_path().string();
  found.files.push_back(file);
  report = read(contents, found);
  if(!report) return report;
  for(const auto& polygon : found.soup.polygons)
    for(std::size_t v : polygon)
      if(v >= found.soup.points.size()) report.status = File_status::MISSING_POINT;
  for(const auto& p : found.soup.points)
    if(!(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()))) report.status = File_status::NOT_FINITE;
  if(report && found.soup.polygons.empty()) report.status = File_status::NO_POLYGONS;
  if(report) model = std::move(found);
  return report;
}

} // namespace Tool
