// Copyright (c) 2026 The authors of the cubic B-spline shell package.
// All rights reserved.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
#define CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H

#include <CGAL/Bspline_shell_3/Mesh/triangulate_polygon.h>
#include <CGAL/Bspline_shell_3/Mesh/vertex_cone.h>
#include <CGAL/Bspline_shell_3/Support/Status.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/FPU.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Bspline_shells {

/*!
 * \ingroup PkgBsplineShell3Mesh
 *
 * \brief a user's mesh as the package works on it: triangles with `double` coordinates, each with its facet of origin,
 * checked for all that a shell needs.
 *
 * Coordinates that are no `double`s are rounded; what is said of the mesh is said of the rounded one.
 */
class Input_mesh_3
{
  typedef Exact_predicates_inexact_constructions_kernel Kernel;
public:
  typedef Surface_mesh<Kernel::Point_3> Triangle_mesh;
  typedef Triangle_mesh::Face_index Face_index;

  /// defects that the caller accepts
  struct Tolerated_defects
  {
    bool self_intersections = false;
    bool singular_vertices = false;
    bool orientation = false;          // components that bound no volume together; `faces_outwards()` means nothing then
  };

  Input_mesh_3() = default;

  /// copies, triangulates and checks the mesh.
  /// \tparam FaceGraph a model of `FaceListGraph`
  /// \tparam VertexPointMap a model of `ReadablePropertyMap` from its vertices to points of a \cgal kernel
  template <typename ConcurrencyTag, typename FaceGraph, typename VertexPointMap>
  Shell_status build(const FaceGraph& mesh, VertexPointMap vpm, const Tolerated_defects& tolerated)
  {
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);      // that of exact predicates
    m_status = Shell_status::NOT_BUILT;
    m_offenders = Offending_simplices();
    Shell_status status = copy(mesh, vpm);
    if(status == Shell_status::SUCCESS) status = check_surface();
    if(status == Shell_status::SUCCESS) status = triangulate();
    if(status == Shell_status::SUCCESS && !tolerated.self_intersections) status = check_intersections<ConcurrencyTag>();
    if(status == Shell_status::SUCCESS) find_components();
    if(status == Shell_status::SUCCESS && !tolerated.orientation)
      status = tolerated.self_intersections ? check_volume() : check_orientation();
    if(status == Shell_status::SUCCESS && !tolerated.singular_vertices) status = check_vertices();
    if(status != Shell_status::SUCCESS) {
      m_mesh.clear();
      m_components = 0;
    }
    return m_status = status;
  }

  /// what `build()` returned; without `SUCCESS` there is no mesh
  Shell_status status() const { return m_status; }
  const Triangle_mesh& mesh() const { return m_mesh; }
  /// the facet of the user's mesh (position in `faces(mesh)`) that a triangle is part of
  std::size_t facet_of_origin(Face_index f) const { return m_origin[f]; }
  std::size_t number_of_facets_of_origin() const { return m_number_of_facets; }      ///< of the user's mesh
  /// smallest box around the facets
  Bbox_3 bbox() const { return m_bbox; }
  /// length of the longest side of the box: the paper's unit
  double unit() const
  {
    return (std::max)({ m_bbox.x_span(), m_bbox.y_span(), m_bbox.z_span() });
  }
  std::size_t number_of_components() const { return m_components; }
  /// the connected component that has a triangle; components are numbered in the order of their first facets
  std::size_t component(Face_index f) const { return m_component[f]; }
  /// `false` if the facets face the bounded side; the field then grows inwards. Of a self-intersecting mesh: whether its
  /// volume is positive.
  bool faces_outwards() const { return m_outwards; }
  const Offending_simplices& offending_simplices() const { return m_offenders; }
  /// the vertex of the user's mesh (position in `vertices(mesh)`) that a vertex is
  std::size_t vertex_of_origin(Triangle_mesh::Vertex_index v) const { return m_vertex_origin[v]; }

  std::array<Kernel::Point_3, 3> triangle(Face_index f) const
  {
    Triangle_mesh::Halfedge_index h = m_mesh.halfedge(f);
    return { m_mesh.point(m_mesh.source(h)), m_mesh.point(m_mesh.target(h)), m_mesh.point(m_mesh.target(m_mesh.next(h))) };
  }

private:
  // to_double() of a lazy number depends on its history, to one part in 10^5; the copy must not
  template <typename NT>
  static double rounded(const NT& x) { return CGAL::to_double(x); }
  template <typename ET>
  static double rounded(const Lazy_exact_nt<ET>& x) { return CGAL::to_double(x.exact()); }

  template <typename FaceGraph, typename VertexPointMap>
  Shell_status copy(const FaceGraph& mesh, VertexPointMap vpm)
  {
    m_mesh.clear();
    if(CGAL::is_empty(mesh) || faces(mesh).begin() == faces(mesh).end()) return Shell_status::EMPTY_MESH;
    std::size_t position = 0;
    for(auto v : vertices(mesh)) {
      const auto& p = get(vpm, v);
      for(int a = 0; a < 3; ++a)
        if(!std::isfinite(CGAL::to_double(p[a]))) {
          m_offenders.vertices.push_back(position);
          break;
        }
      ++position;
    }
    if(!m_offenders.vertices.empty()) return Shell_status::NOT_FINITE;

    typedef typename boost::graph_traits<FaceGraph>::face_descriptor face_descriptor;
    typedef typename boost::graph_traits<FaceGraph>::vertex_descriptor vertex_descriptor;
    std::vector<std::pair<face_descriptor, Face_index> > face_pairs;
    std::vector<std::pair<vertex_descriptor, Triangle_mesh::Vertex_index> > vertex_pairs;
    face_pairs.reserve(num_faces(mesh));
    CGAL::copy_face_graph(mesh, m_mesh,
                          CGAL::parameters::vertex_point_map(vpm)
                                          .face_to_face_output_iterator(std::back_inserter(face_pairs))
                                          .vertex_to_vertex_output_iterator(std::back_inserter(vertex_pairs)));
    for(const auto& pair : vertex_pairs) {
      const auto& p = get(vpm, pair.first);
      m_mesh.point(pair.second) = Kernel::Point_3(rounded(p[0]), rounded(p[1]), rounded(p[2]));
    }
    // faces are copied in the order of their range, vertices in the order in which edges lead to them
    m_number_of_facets = face_pairs.size();
    m_origin.assign(m_number_of_facets, 0);
    for(std::size_t n = 0; n < face_pairs.size(); ++n) m_origin[face_pairs[n].second] = n;
    const auto vertex_position = get(CGAL::dynamic_vertex_property_t<std::size_t>(), mesh);
    position = 0;
    for(auto v : vertices(mesh)) put(vertex_position, v, position++);
    m_vertex_origin.assign(m_mesh.number_of_vertices(), 0);
    for(const auto& pair : vertex_pairs) m_vertex_origin[pair.second] = get(vertex_position, pair.first);
    m_bbox = Bbox_3();
    for(auto f : m_mesh.faces()) m_bbox += Polygon_mesh_processing::face_bbox(f, m_mesh);
    // squares of cross products, and determinants, must be far from what a double can hold
    constexpr double largest = 1e60, smallest = 1e-60;
    for(int a = 0; a < 3; ++a)
      if((std::max)(std::abs((m_bbox.min)(a)), std::abs((m_bbox.max)(a))) > largest)
        return Shell_status::COORDINATES_OUT_OF_RANGE;
    // a box that is a point has nothing but degenerate facets, which say more
    return unit() > 0 && unit() < smallest ? Shell_status::COORDINATES_OUT_OF_RANGE : Shell_status::SUCCESS;
  }

  Shell_status check_surface()
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

  Shell_status triangulate()
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
  bool triangulate(Face_index f)
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
  Shell_status check_intersections()
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
  Shell_status check_orientation()
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

  void find_components()
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
  Shell_status check_volume()
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

  Shell_status check_vertices()
  {
    std::vector<std::size_t> singular;
    for(auto v : m_mesh.vertices())
      if(!m_mesh.is_isolated(v) && !vertex_cone(m_mesh, v)) singular.push_back(m_vertex_origin[v]);
    return singular.empty() ? Shell_status::SUCCESS : refuse_vertices(Shell_status::SINGULAR_VERTEX, singular);
  }

  Shell_status refuse_facets(Shell_status status, std::vector<std::size_t>& facets)
  {
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    m_offenders.facets.swap(facets);
    return status;
  }

  Shell_status refuse_vertices(Shell_status status, std::vector<std::size_t>& vertices)
  {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    m_offenders.vertices.swap(vertices);
    return status;
  }

  static constexpr unsigned int max_pairs = 1000;

  Shell_status m_status = Shell_status::NOT_BUILT;
  Triangle_mesh m_mesh;
  std::vector<std::size_t> m_origin, m_vertex_origin, m_component;
  Bbox_3 m_bbox;
  std::size_t m_number_of_facets = 0, m_components = 0;
  bool m_outwards = true;
  Offending_simplices m_offenders;
};

} // namespace Bspline_shells
} // namespace CGAL

#endif // CGAL_BSPLINE_SHELL_3_MESH_INPUT_MESH_3_H
