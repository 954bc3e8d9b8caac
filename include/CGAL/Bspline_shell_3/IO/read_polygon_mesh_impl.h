// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/IO/internal/read_GOCAD.h>
#include <CGAL/Bspline_shell_3/IO/internal/read_OBJ.h>
#include <CGAL/Bspline_shell_3/IO/internal/read_OFF.h>
#include <CGAL/Bspline_shell_3/IO/internal/read_PLY.h>
#include <CGAL/Bspline_shell_3/IO/internal/read_STL.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ios>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline Shell_status read_file(const std::string& file, std::string& text)
{
  std::error_code error;
  const std::filesystem::file_status found = std::filesystem::status(file, error);
  if(found.type() == std::filesystem::file_type::not_found) return Shell_status::MISSING_FILE;
  std::ifstream in(file, std::ios::binary);
  if(!in || std::filesystem::is_directory(found)) return Shell_status::UNREADABLE_FILE;
  std::vector<char> buffer(1 << 16);
  do {
    in.read(buffer.data(), std::streamsize(buffer.size()));
    text.append(buffer.data(), std::size_t(in.gcount()));
  } while(in);
  return in.bad() ? Shell_status::UNREADABLE_FILE : text.empty() ? Shell_status::EMPTY_FILE : Shell_status::SUCCESS;
}

// Returns the extension of a file name in lower case, with the dot.
inline std::string extension_of(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  for(char& c : extension)
    if(c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

inline Shell_status read_polygons(const std::string& file, Polygon_soup& soup, std::size_t& line)
{
  const std::string extension = extension_of(file);
  std::string text;
  const Shell_status status = read_file(file, text);
  if(status == Shell_status::MISSING_FILE || status == Shell_status::UNREADABLE_FILE) return status;
  Shell_status (*read)(Text_soup&) = extension == ".off"   ? read_OFF
                                     : extension == ".ply" ? read_PLY
                                     : extension == ".stl" ? read_STL
                                     : extension == ".obj" ? read_OBJ
                                     : extension == ".ts"  ? read_GOCAD
                                                           : nullptr;
  if(read == nullptr) return Shell_status::UNSUPPORTED_FILE;
  if(status != Shell_status::SUCCESS) return status;

  const bool is_binary = extension == ".stl" && is_binary_STL(text);
  if(!is_binary && text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3); // byte order mark
  if(extension == ".obj") join_continued_lines(text);
  Text_soup result(text);
  const Shell_status outcome = read(result);
  soup = std::move(result.soup);
  line = result.line;
  return outcome;
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Shell_status read_polygon_soup(const std::string& file, Polygon_soup& soup,
                                                           Offending_simplices& offenders)
{
  offenders = Offending_simplices();
  Polygon_soup found;
  try {
    const Shell_status status = internal::read_polygons(file, found, offenders.line);
    if(status != Shell_status::SUCCESS) return status;
  } catch(const std::bad_alloc&) {
    throw;
  } catch(const std::exception&) { // CGAL's readers may throw on damaged files
    return Shell_status::MALFORMED_FILE;
  }
  for(std::size_t f = 0; f < found.polygons.size(); ++f)
    for(std::size_t v : found.polygons[f])
      if(v >= found.points.size()) {
        offenders.facets.push_back(f);
        break;
      }
  if(!offenders.facets.empty()) return Shell_status::MALFORMED_FILE;
  for(std::size_t v = 0; v < found.points.size(); ++v)
    for(int a = 0; a < 3; ++a)
      if(!std::isfinite(found.points[v][a])) {
        offenders.vertices.push_back(v);
        break;
      }
  if(!offenders.vertices.empty()) return Shell_status::NOT_FINITE;
  if(found.polygons.empty()) return Shell_status::EMPTY_MESH;
  if(internal::extension_of(file) == ".stl") internal::merge_points(found); // the format has no shared points
  soup = std::move(found);
  return Shell_status::SUCCESS;
}

namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE Shell_status read_oriented_soup(const std::string& file, Polygon_soup& soup,
                                                            Offending_simplices& offenders)
{
  const Shell_status status = read_polygon_soup(file, soup, offenders);
  if(status != Shell_status::SUCCESS) return status;
  const std::vector<std::size_t> first = merge_points(soup);
  std::size_t turned;
  const Shell_status oriented = orient_soup(soup, offenders, turned);
  for(std::size_t& v : offenders.vertices) v = first[v];
  return oriented;
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H
