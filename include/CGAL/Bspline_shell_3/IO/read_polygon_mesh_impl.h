// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/IO/internal/normalize_OFF.h>
#include <CGAL/Bspline_shell_3/IO/internal/normalize_PLY.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>

#include <CGAL/IO/polygon_soup_io.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline std::string read_text(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

// Whether an STL file without facets says so. CGAL's reader takes every text that is shorter than a binary header for
// an empty mesh.
inline bool is_empty_STL(const std::string& text)
{
  return text.find("endsolid") != std::string::npos
      || (text.size() >= 84 && text.compare(80, 4, std::string(4, '\0')) == 0);      // a header, and the number of facets
}

// CGAL's readers, behind what they need so as not to misread a file
inline Shell_status read_polygons(const std::string& file, Polygon_soup::Points& points, Polygon_soup::Polygons& polygons)
{
  const std::string extension = CGAL::IO::internal::get_file_extension(file);
  const auto silent = CGAL::parameters::verbose(false);
  bool is_read = false;
  if(extension == "off") {
    std::string text = read_text(file);
    if(normalize_OFF(text)) {
      std::istringstream in(std::move(text));
      is_read = CGAL::IO::read_OFF(in, points, polygons, silent);
    }
  } else if(extension == "ply") {
    std::string text = read_text(file);
    const Shell_status status = normalize_PLY(text);
    if(status != Shell_status::SUCCESS) return status;
    std::istringstream in(std::move(text));
    is_read = CGAL::IO::read_PLY(in, points, polygons, silent);
  } else {
    is_read = CGAL::IO::read_polygon_soup(file, points, polygons, silent)
           && (!polygons.empty() || extension != "stl" || is_empty_STL(read_text(file)));
  }
  return is_read ? Shell_status::SUCCESS : Shell_status::UNREADABLE_FILE;
}

} // namespace internal

CGAL_BSPLINE_SHELL_3_INLINE Shell_status
read_polygon_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders)
{
  offenders = Offending_simplices();
  Polygon_soup found;
  try {
    const Shell_status status = internal::read_polygons(file, found.points, found.polygons);
    if(status != Shell_status::SUCCESS) return status;
  } catch(const std::exception&) {       // some readers throw on broken files
    return Shell_status::UNREADABLE_FILE;
  }
  if(found.polygons.empty()) return Shell_status::EMPTY_MESH;
  for(const auto& polygon : found.polygons)
    for(std::size_t v : polygon)
      if(v >= found.points.size()) return Shell_status::UNREADABLE_FILE;
  for(std::size_t v = 0; v < found.points.size(); ++v)
    for(int a = 0; a < 3; ++a)
      if(!std::isfinite(found.points[v][a])) { offenders.vertices.push_back(v); break; }
  if(!offenders.vertices.empty()) return Shell_status::NOT_FINITE;
  soup = std::move(found);
  return Shell_status::SUCCESS;
}

namespace internal {

CGAL_BSPLINE_SHELL_3_INLINE Shell_status read_oriented_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders)
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
