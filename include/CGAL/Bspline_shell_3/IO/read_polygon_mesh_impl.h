// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H
#define CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H

#include <CGAL/Bspline_shell_3/IO/internal/normalize_OFF.h>
#include <CGAL/Bspline_shell_3/IO/internal/normalize_PLY.h>
#include <CGAL/Bspline_shell_3/IO/read_polygon_mesh.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {
namespace internal {

inline void sort_and_remove_repetitions(std::vector<std::size_t>& positions)
{
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
}

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
inline Shell_status read_polygons(const std::string& file, std::vector<Polygon_soup::Point_3>& points, Polygon_soup::Polygons& polygons)
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

// Identifies points at equal positions. Returns where the first of each was, ascending.
inline std::vector<std::size_t> merge_points(std::vector<Polygon_soup::Point_3>& points, Polygon_soup::Polygons& polygons)
{
  std::map<Polygon_soup::Point_3, std::size_t> positions;
  std::vector<std::size_t> first, merged;
  merged.reserve(points.size());
  for(std::size_t v = 0; v < points.size(); ++v) {
    const auto inserted = positions.emplace(points[v], first.size());
    if(inserted.second) {
      points[first.size()] = points[v];
      first.push_back(v);
    }
    merged.push_back(inserted.first->second);
  }
  points.resize(first.size());
  for(auto& polygon : polygons)
    for(std::size_t& v : polygon) v = merged[v];
  return first;
}

// notes which vertices are copied when a soup is oriented: those whose facets do not form one fan
struct Copied_vertices : Polygon_mesh_processing::Default_orientation_visitor
{
  explicit Copied_vertices(std::vector<std::size_t>& copied) : copied(copied) {}
  void duplicated_vertex(std::size_t v, std::size_t) { copied.push_back(v); }

  std::vector<std::size_t>& copied;
};

// What keeps polygons from being a mesh. Two polygons at an edge must walk it in opposite directions, after some of
// them are turned round; a parity that contradicts itself around the surface makes it one-sided.
inline Shell_status diagnose_polygons(const Polygon_soup::Polygons& polygons, Offending_simplices& offenders)
{
  struct Use { std::size_t polygon; bool forward; };
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Use> > edges;
  for(std::size_t p = 0; p < polygons.size(); ++p) {
    const std::vector<std::size_t>& polygon = polygons[p];
    std::vector<std::size_t> sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    if(polygon.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      offenders.facets.push_back(p);
      continue;
    }
    for(std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      edges[std::minmax(a, b)].push_back({ p, a < b });
    }
  }
  if(!offenders.facets.empty()) return Shell_status::DEGENERATE_FACET;
  for(const auto& edge : edges)
    if(edge.second.size() > 2)
      for(const Use& use : edge.second) offenders.facets.push_back(use.polygon);
  if(!offenders.facets.empty()) {
    sort_and_remove_repetitions(offenders.facets);
    return Shell_status::NON_MANIFOLD;
  }
  // union-find with parities
  std::vector<std::size_t> parent(polygons.size());
  std::vector<char> turned(polygons.size(), 0);     // relative to the parent
  for(std::size_t p = 0; p < parent.size(); ++p) parent[p] = p;
  const auto root = [&](std::size_t p, char& parity) {
    parity = 0;
    for(; parent[p] != p; p = parent[p]) {
      turned[p] = char(turned[p] ^ turned[parent[p]]);       // halves the path
      parent[p] = parent[parent[p]];
      parity ^= turned[p];
    }
    return p;
  };
  for(const auto& edge : edges) {
    if(edge.second.size() != 2) continue;
    const Use &a = edge.second[0], &b = edge.second[1];
    char pa, pb;
    const std::size_t ra = root(a.polygon, pa), rb = root(b.polygon, pb);
    const char differ = char(a.forward == b.forward);
    if(ra == rb) {
      if((pa ^ pb) != differ) { offenders.facets.push_back(a.polygon); offenders.facets.push_back(b.polygon); }
    } else {
      parent[ra] = rb;
      turned[ra] = char(pa ^ pb ^ differ);
    }
  }
  sort_and_remove_repetitions(offenders.facets);
  return offenders.facets.empty() ? Shell_status::SUCCESS : Shell_status::NOT_ORIENTABLE;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status read_oriented_soup(const std::string& file, Polygon_soup& soup, Offending_simplices& offenders)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  offenders = Offending_simplices();
  std::vector<Polygon_soup::Point_3>& points = soup.points;
  Polygon_soup::Polygons& polygons = soup.polygons;
  try {
    const Shell_status status = read_polygons(file, points, polygons);
    if(status != Shell_status::SUCCESS) return status;
  } catch(const std::exception&) {       // some readers throw on broken files
    return Shell_status::UNREADABLE_FILE;
  }
  if(polygons.empty()) return Shell_status::EMPTY_MESH;
  for(const auto& polygon : polygons)
    for(std::size_t v : polygon)
      if(v >= points.size()) return Shell_status::UNREADABLE_FILE;
  for(std::size_t v = 0; v < points.size(); ++v)
    for(int a = 0; a < 3; ++a)
      if(!std::isfinite(points[v][a])) { offenders.vertices.push_back(v); break; }
  if(!offenders.vertices.empty()) return Shell_status::NOT_FINITE;

  const std::vector<std::size_t> first = merge_points(points, polygons);
  const Shell_status status = diagnose_polygons(polygons, offenders);
  if(status != Shell_status::SUCCESS) return status;
  PMP::orient_polygon_soup(points, polygons,
                           CGAL::parameters::visitor(Copied_vertices(offenders.vertices)));
  sort_and_remove_repetitions(offenders.vertices);
  for(std::size_t& v : offenders.vertices) v = first[v];
  return offenders.vertices.empty() && PMP::is_polygon_soup_a_polygon_mesh(polygons) ? Shell_status::SUCCESS : Shell_status::NON_MANIFOLD;
}

CGAL_BSPLINE_SHELL_3_INLINE bool triangulate(Polygon_soup& soup)
{
  Polygon_soup::Polygons triangles;
  for(std::vector<std::size_t>& polygon : soup.polygons)
    if(polygon.size() == 3) triangles.push_back(std::move(polygon));
    else {
      std::vector<Polygon_soup::Point_3> corners;
      for(std::size_t v : polygon) corners.push_back(soup.points[v]);
      for(const std::array<std::size_t, 3>& t : triangulate_polygon(corners)) triangles.push_back({ polygon[t[0]], polygon[t[1]], polygon[t[2]] });
    }
  soup.polygons.swap(triangles);
  return Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(soup.polygons);
}

} // namespace internal
} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_IO_READ_POLYGON_MESH_IMPL_H
