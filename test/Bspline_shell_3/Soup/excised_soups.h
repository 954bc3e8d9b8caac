// Small soups whose excision is known.
#ifndef EXCISED_SOUPS_H
#define EXCISED_SOUPS_H

#include <CGAL/Bspline_shell_3/Mesh/Polygon_soup.h>
#include <CGAL/Bspline_shell_3/Soup/Excised_soup_3.h>
#include <CGAL/Bspline_shell_3/Soup/choose_excision.h>
#include "test_meshes.h"

#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace excised_soups {

namespace BS = CGAL::Bspline_shells;

inline BS::Polygon_soup soup_of(const Mesh& mesh)
{
  BS::Polygon_soup soup;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(mesh, soup.points, soup.polygons);
  return soup;
}

// Appends a triangle with points of its own.
inline void add_triangle(BS::Polygon_soup& soup, const Point_3& p, const Point_3& q, const Point_3& r)
{
  const std::size_t n = soup.points.size();
  soup.points.insert(soup.points.end(), { p, q, r });
  soup.polygons.push_back({ n, n + 1, n + 2 });
}

inline BS::Excised_soup_3 chosen(const BS::Polygon_soup& soup)
{
  return BS::choose_excision(BS::different_triangles(soup));
}

// Returns the soup with the given triangles excised, whatever their defects.
inline BS::Excised_soup_3 excised(const BS::Polygon_soup& soup, std::initializer_list<std::size_t> triangles)
{
  BS::Soup_triangles all = BS::different_triangles(soup);
  const std::size_t size = all.triangles.size();
  std::vector<BS::Excision_reason> reasons(size, BS::Excision_reason::KEPT);
  for(std::size_t t : triangles) reasons[t] = BS::Excision_reason::INTERSECTING;
  return BS::Excised_soup_3(std::move(all), std::move(reasons), std::vector<char>(size, 0));
}

// Returns a square of side 2 around the origin, in the plane z = 0, as four triangles around its middle. Its corners
// are the points 0 to 3, counterclockwise, and its middle is the point 4.
inline BS::Polygon_soup square()
{
  return { { Point_3(-1, -1, 0), Point_3(1, -1, 0), Point_3(1, 1, 0), Point_3(-1, 1, 0), Point_3(0, 0, 0) },
           { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } } };
}

// Returns a triangulated mesh of the soup.
inline Mesh mesh_of(const std::vector<Point_3>& points, const std::vector<std::vector<std::size_t> >& triangles)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for(const Point_3& p : points) v.push_back(mesh.add_vertex(p));
  for(const auto& t : triangles) mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
  return mesh;
}

// Returns the unit cube with a fin at the edge from (0, 0, 0) to (0, 0, 1): the last triangle, of area 1/2.
inline BS::Polygon_soup cube_with_fin()
{
  BS::Polygon_soup soup = soup_of(box(Point_3(0, 0, 0), Point_3(1, 1, 1)));
  add_triangle(soup, Point_3(0, 0, 0), Point_3(0, 0, 1), Point_3(-1, -1, 0));
  return soup;
}

} // namespace excised_soups

#endif // EXCISED_SOUPS_H
