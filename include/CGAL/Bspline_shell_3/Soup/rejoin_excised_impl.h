// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_IMPL_H
#define CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/triangles_overlap.h>
#include <CGAL/Bspline_shell_3/Soup/rejoin_excised.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

CGAL_BSPLINE_SHELL_3_INLINE Rejoined_soup_3 rejoin_excised(const Excised_soup_3& soup, const Excised_soup_3::Mesh& mesh)
{
  typedef Excised_soup_3::Mesh Mesh;
  Rejoined_soup_3 joined;
  joined.verdict = check_replacement(soup, mesh);
  if(!joined.verdict) return joined;
  joined.vertices = mesh.number_of_vertices();
  joined.facets = mesh.number_of_faces();

  std::map<Mesh::Point, std::size_t> excised; // positions in the soup
  for(std::size_t t : soup.excised_triangles())
    for(std::size_t p : soup.soup().triangles[t]) excised.emplace(soup.soup().points[p], p);
  std::vector<std::size_t> number(soup.soup().points.size(), Rejoined_soup_3::none); // positions in the result
  const auto add = [&](const Mesh::Point& p, std::size_t excised_point) {
    if(excised_point != Rejoined_soup_3::none) number[excised_point] = joined.soup.points.size();
    joined.soup.points.push_back(p);
    joined.excised_point.push_back(excised_point);
  };
  for(auto v : mesh.vertices()) {
    const auto found = excised.find(mesh.point(v));
    add(mesh.point(v), found == excised.end() ? Rejoined_soup_3::none : found->second);
  }
  for(auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    joined.soup.polygons.push_back(
      { std::size_t(mesh.source(h)), std::size_t(mesh.target(h)), std::size_t(mesh.target(mesh.next(h))) });
  }
  for(std::size_t t : soup.excised_triangles()) {
    const Soup_triangles::Triangle& corners = soup.soup().triangles[t];
    for(std::size_t p : corners)
      if(number[p] == Rejoined_soup_3::none) add(soup.soup().points[p], p);
    joined.soup.polygons.push_back({ number[corners[0]], number[corners[1]], number[corners[2]] });
  }
  return joined;
}

CGAL_BSPLINE_SHELL_3_INLINE std::size_t number_of_contacts(const Rejoined_soup_3& rejoined)
{
  typedef Box_intersection_d::Box_with_info_d<double, 3, std::size_t> Box;
  const auto& points = rejoined.soup.points;
  const auto corners = [&](std::size_t t) {
    const auto& polygon = rejoined.soup.polygons[t];
    return std::array<std::size_t, 3>{ polygon[0], polygon[1], polygon[2] };
  };
  std::vector<Box> of_mesh, excised;
  for(std::size_t t = 0; t < rejoined.soup.polygons.size(); ++t) {
    const auto c = corners(t);
    if(t >= rejoined.facets && CGAL::collinear(points[c[0]], points[c[1]], points[c[2]])) continue;
    (t < rejoined.facets ? of_mesh : excised)
      .emplace_back(points[c[0]].bbox() + points[c[1]].bbox() + points[c[2]].bbox(), t);
  }
  std::size_t contacts = 0;
  CGAL::box_intersection_d<Sequential_tag>(
    of_mesh.begin(), of_mesh.end(), excised.begin(), excised.end(),
    [&](const Box& a, const Box& b) { contacts += triangles_overlap(corners(a.info()), corners(b.info()), points); });
  return contacts;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_SOUP_REJOIN_EXCISED_IMPL_H
