// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H

#include <CGAL/Bspline_shell_3/Mesh/Input_mesh_3.h>
#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace CGAL {
namespace Bspline_shells {

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check(const Tolerated_defects& tolerated)
{
  Shell_status status = check_surface();
  if(status == Shell_status::SUCCESS) status = triangulate();
  if(status == Shell_status::SUCCESS && !tolerated.self_intersections) status = check_intersections<ConcurrencyTag>();
  if(status == Shell_status::SUCCESS) find_components();
  if(status == Shell_status::SUCCESS && !tolerated.orientation)
    status = tolerated.self_intersections ? check_volume() : check_orientation();
  if(status == Shell_status::SUCCESS && !tolerated.singular_vertices) status = check_vertices();
  return status;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_surface()
{
  std::vector<std::size_t> open;
  for(auto h : m_mesh.halfedges())
    if(m_mesh.is_border(h) && !m_mesh.is_border(m_mesh.opposite(h)))
      open.push_back(m_origin[m_mesh.face(m_mesh.opposite(h))]);
  if(!open.empty()) return refuse_facets(Shell_status::OPEN_MESH, open);
  std::vector<Triangle_mesh::Halfedge_index> pinched;
  Polygon_mesh_processing::non_manifold_vertices(m_mesh, std::back_inserter(pinched));
  std::vector<std::size_t> vertices;      // there is a halfedge for each fan
  for(auto h : pinched) vertices.push_back(m_vertex_origin[m_mesh.target(h)]);
  return vertices.empty() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::NON_MANIFOLD, vertices);
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::triangulate()
{
  std::vector<std::size_t> degenerate;
  if(!CGAL::is_triangle_mesh(m_mesh)) {
    const std::vector<Face_index> polygons(m_mesh.faces().begin(), m_mesh.faces().end());
    for(Face_index f : polygons)
      if(!CGAL::is_triangle(m_mesh.halfedge(f), m_mesh) && !triangulate(f)) degenerate.push_back(m_origin[f]);
    if(!degenerate.empty()) return refuse_facets(Shell_status::DEGENERATE_FACET, degenerate);
  }
  for(auto f : m_mesh.faces())
    if(Polygon_mesh_processing::is_degenerate_triangle_face(f, m_mesh)) degenerate.push_back(m_origin[f]);
  if(!degenerate.empty()) return refuse_facets(Shell_status::DEGENERATE_FACET, degenerate);
  return Shell_status::SUCCESS;
}

// false for a polygon of two edges
CGAL_BSPLINE_SHELL_3_INLINE bool Input_mesh_3::triangulate(Face_index f)
{
  std::vector<Triangle_mesh::Halfedge_index> halfedges;      // to the vertices of the polygon
  std::vector<Kernel::Point_3> points;
  for(auto h : m_mesh.halfedges_around_face(m_mesh.halfedge(f))) {
    halfedges.push_back(h);
    points.push_back(m_mesh.point(m_mesh.target(h)));
  }
  if(points.size() < 3) return false;
  std::vector<std::array<std::size_t, 3> > triangles = triangulate_polygon(points);
  triangles.pop_back();       // what is left of the polygon
  for(const auto& t : triangles) {
    const Triangle_mesh::Halfedge_index across = CGAL::Euler::split_face(halfedges[t[0]], halfedges[t[2]], m_mesh);
    halfedges[t[2]] = across;
    const Face_index cut_off = m_mesh.face(m_mesh.opposite(across));
    if(m_origin.size() <= std::size_t(cut_off)) m_origin.resize(std::size_t(cut_off) + 1);
    m_origin[cut_off] = m_origin[f];
  }
  return true;
}

template <typename ConcurrencyTag>
Shell_status Input_mesh_3::check_intersections()
{
  std::vector<std::pair<Face_index, Face_index> > pairs;
  // overlapping meshes may have a quadratic number of pairs: enough of them is enough
  Polygon_mesh_processing::self_intersections<ConcurrencyTag>(m_mesh, std::back_inserter(pairs),
                                                              CGAL::parameters::maximum_number(max_pairs));
  std::vector<std::size_t> facets;
  for(const auto& pair : pairs) {
    facets.push_back(m_origin[pair.first]);
    facets.push_back(m_origin[pair.second]);
  }
  return facets.empty() ? Shell_status::SUCCESS : refuse_facets(Shell_status::SELF_INTERSECTION, facets);
}

// All components must be oriented as the boundary of one volume, or all the other way round.
CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_orientation()
{
  typedef Triangle_mesh::Property_map<Face_index, std::size_t> Face_map;
  Face_map component = m_mesh.add_property_map<Face_index, std::size_t>("f:component", 0).first;
  Face_map volume = m_mesh.add_property_map<Face_index, std::size_t>("f:volume", 0).first;
  std::vector<bool> outward;
  std::vector<std::size_t> nesting;
  Polygon_mesh_processing::volume_connected_components(m_mesh, volume,
    CGAL::parameters::do_orientation_tests(true)
                    .face_connected_component_map(component)
                    .nesting_levels(std::ref(nesting))
                    .is_cc_outward_oriented(std::ref(outward)));
  m_outwards = outward[0] == (nesting[0] % 2 == 0);
  std::vector<bool> wrong(nesting.size(), false);
  for(std::size_t c = 0; c < nesting.size(); ++c) wrong[c] = (outward[c] == (nesting[c] % 2 == 0)) != m_outwards;
  std::vector<std::size_t> facets;      // one facet of each component that disagrees
  for(auto f : m_mesh.faces())
    if(wrong[component[f]]) { facets.push_back(m_origin[f]); wrong[component[f]] = false; }
  m_mesh.remove_property_map(component);
  m_mesh.remove_property_map(volume);
  return facets.empty() ? Shell_status::SUCCESS : refuse_facets(Shell_status::INCONSISTENT_ORIENTATION, facets);
}

CGAL_BSPLINE_SHELL_3_INLINE void Input_mesh_3::find_components()
{
  Triangle_mesh::Property_map<Face_index, std::size_t> component =
    m_mesh.add_property_map<Face_index, std::size_t>("f:component", 0).first;
  m_components = Polygon_mesh_processing::connected_components(m_mesh, component);
  constexpr std::size_t unknown = std::size_t(-1);
  std::vector<std::size_t> number(m_components, unknown);
  std::size_t next = 0;
  m_component.resize(m_mesh.number_of_faces());
  for(Face_index f : m_mesh.faces()) {
    if(number[component[f]] == unknown) number[component[f]] = next++;
    m_component[f] = number[component[f]];
  }
  m_mesh.remove_property_map(component);
}

// Components that intersect have no nesting: the sign of the volume, where rounding leaves no doubt about it, decides.
CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_volume()
{
  const Kernel::Point_3 o((m_bbox.xmin() + m_bbox.xmax()) / 2, (m_bbox.ymin() + m_bbox.ymax()) / 2,
                          (m_bbox.zmin() + m_bbox.zmax()) / 2);
  double volume = 0, products = 0;
  for(auto f : m_mesh.faces()) {
    const auto t = triangle(f);
    const Kernel::Vector_3 u = t[0] - o, v = t[1] - o, w = t[2] - o;
    volume += CGAL::determinant(u, v, w);
    const auto size = [](const Kernel::Vector_3& x) { return std::abs(x.x()) + std::abs(x.y()) + std::abs(x.z()); };
    products += size(u) * size(v) * size(w);
  }
  // three roundings of differences and three of products in each term, and one for each sum
  const double error = std::numeric_limits<double>::epsilon() * (8. + double(m_mesh.number_of_faces())) * products;
  if(!(std::abs(volume) > error)) {
    std::vector<std::size_t> first = { m_origin[*m_mesh.faces().begin()] };
    return refuse_facets(Shell_status::INCONSISTENT_ORIENTATION, first);
  }
  m_outwards = volume > 0;
  return Shell_status::SUCCESS;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::check_vertices()
{
  std::vector<std::size_t> singular;
  for(auto v : m_mesh.vertices())
    if(!m_mesh.is_isolated(v) && !vertex_cone(m_mesh, v)) singular.push_back(m_vertex_origin[v]);
  return singular.empty() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::SINGULAR_VERTEX, singular);
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::refuse_facets(Shell_status status, std::vector<std::size_t>& facets)
{
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  m_offenders.facets.swap(facets);
  return status;
}

CGAL_BSPLINE_SHELL_3_INLINE Shell_status Input_mesh_3::refuse_vertices(Shell_status status, std::vector<std::size_t>& vertices)
{
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  m_offenders.vertices.swap(vertices);
  return status;
}

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_IMPL_H
