#include "read_model.h"
#include "Words.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <system_error>

namespace Tool {

namespace {

// Returns the extension for the format of a text, from its first bytes.
std::string format_of(std::string_view text)
{
  if(text.substr(0, 4) == "glTF") return ".glb";
  if(is_STL(text)) return ".stl";
  Lines lines(text);
  if(!lines.next()) return ".obj";
  const std::string_view word = lines.words[0];
  if(word == "ply") return ".ply";
  if(word.front() == '{') return ".gltf";
  return word.size() >= 3 && word.substr(word.size() - 3) == "OFF" ? ".off" : ".obj";
}

} // namespace

std::string extension_of(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

File_status read_text(const std::string& file, std::string& text)
{
  const auto read = [&](std::istream& in) {
    text.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    return in.bad() ? File_status::UNREADABLE : text.empty() ? File_status::EMPTY : File_status::SUCCESS;
  };
  if(file == stream_name) return read(std::cin);
  std::error_code error;
  const std::filesystem::file_status found = std::filesystem::status(file, error);
  if(found.type() == std::filesystem::file_type::not_found) return File_status::MISSING;
  std::ifstream in(file, std::ios::binary);
  return !in || std::filesystem::is_directory(found) ? File_status::UNREADABLE : read(in);
}

File_report read_model(const std::string& file, Model& model)
{
  File_report report;
  std::string text;
  report.status = read_text(file, text);
  if(report.status == File_status::MISSING || report.status == File_status::UNREADABLE) return report;
  const bool is_stream = file == stream_name;
  const std::string extension = is_stream ? format_of(text) : extension_of(file);
  File_report (*const read)(std::string_view, Model&) = extension == ".ply"                           ? read_PLY
                                                        : extension == ".obj"                         ? read_OBJ
                                                        : extension == ".off"                         ? read_OFF
                                                        : extension == ".stl"                         ? read_STL
                                                        : extension == ".gltf" || extension == ".glb" ? read_GLTF
                                                                                                      : nullptr;
  if(read == nullptr) report.status = File_status::UNSUPPORTED;
  if(!report) return report;

  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::string_view contents = text;
  if(contents.substr(0, byte_order_mark.size()) == byte_order_mark) contents.remove_prefix(byte_order_mark.size());
  Model found;
  found.folder = std::filesystem::path(file).parent_path().string();
  found.format = extension.substr(1);
  if(!is_stream) found.files.push_back(file);
  report = read(contents, found);
  if(!report) return report;
  const auto& points = found.soup.points;
  const auto& polygons = found.soup.polygons;
  for(std::size_t n = 0; n < polygons.size() && report; ++n)
    for(std::size_t v : polygons[n])
      if(v >= points.size() && report) {
        report.status = File_status::MISSING_POINT;
        report.polygons = { n };
      }
  for(std::size_t v = 0; v < points.size() && report; ++v)
    if(!(std::isfinite(points[v].x()) && std::isfinite(points[v].y()) && std::isfinite(points[v].z()))) {
      report.status = File_status::NOT_FINITE;
      report.points = { v };
    }
  if(report && found.soup.polygons.empty()) report.status = File_status::NO_POLYGONS;
  if(report) model = std::move(found);
  return report;
}

} // namespace Tool
